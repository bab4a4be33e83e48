//! The `.fmu` archive: the same bytes for the same contents, on any machine and day.

use crate::{Interface, document, header, xml};
use std::io::{Cursor, Write as _};
use zip::result::ZipResult;
use zip::write::{SimpleFileOptions, ZipWriter};
use zip::{CompressionMethod, DateTime};

const MIT: &str = include_str!("../../LICENSE-MIT");
const APACHE: &str = include_str!("../../LICENSE-APACHE");
const PICTURE: &[u8] = include_bytes!("../model.png");

/// A shared library for one platform.
#[derive(Clone, Copy, Debug)]
pub struct Binary<'a> {
    /// Folder under `binaries/`: `linux64`, `win64`, …
    pub platform: &'a str,
    /// File extension with its dot: `.so`, `.dll`, `.dylib`.
    pub extension: &'a str,
    /// The library.
    pub bytes: &'a [u8],
}

/// Writes the archive. Paths are sorted, dates are 1980-01-01, libraries are executable, nothing else is.
///
/// # Errors
/// None in practice: the archive is written to memory.
pub fn write(interface: &Interface, binaries: &[Binary<'_>]) -> ZipResult<Vec<u8>> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (path, contents) in files(interface, binaries) {
        if path.ends_with('/') {
            archive.add_directory(path, options(0o755))?;
        } else {
            let permissions = if path.starts_with("binaries/") {
                0o755
            } else {
                0o644
            };
            archive.start_file(path, options(permissions))?;
            archive.write_all(&contents)?;
        }
    }
    Ok(archive.finish()?.into_inner())
}

/// Paths in ascending order, with contents.
fn files(interface: &Interface, binaries: &[Binary<'_>]) -> Vec<(String, Vec<u8>)> {
    let name = interface.name;
    let mut files = vec![
        (
            "modelDescription.xml".to_owned(),
            xml(interface).into_bytes(),
        ),
        ("model.png".to_owned(), PICTURE.to_vec()),
        (
            "documentation/index.html".to_owned(),
            document(interface).into_bytes(),
        ),
        (
            format!("documentation/{name}.h"),
            header(interface).into_bytes(),
        ),
        (
            "documentation/licenses/license.txt".to_owned(),
            licence(interface).into_bytes(),
        ),
        (
            "documentation/licenses/LICENSE-MIT.txt".to_owned(),
            MIT.into(),
        ),
        (
            "documentation/licenses/LICENSE-APACHE.txt".to_owned(),
            APACHE.into(),
        ),
        // Importers pass its location to fmi2Instantiate, so it exists, although nothing is in it.
        ("resources/".to_owned(), Vec::new()),
    ];
    for Binary {
        platform,
        extension,
        bytes,
    } in binaries
    {
        files.push((
            format!("binaries/{platform}/{name}{extension}"),
            bytes.to_vec(),
        ));
    }
    files.sort();
    files
}

/// The entry point for licence information (section 2.3).
fn licence(interface: &Interface) -> String {
    format!(
        "{} {}\n{}\n\nLicensed under {}, at your option:\nLICENSE-MIT.txt or LICENSE-APACHE.txt in this folder.\n",
        interface.name,
        crate::VERSION,
        xml::COPYRIGHT,
        crate::LICENSE
    )
}

fn options(permissions: u32) -> SimpleFileOptions {
    SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .compression_level(Some(9))
        .last_modified_time(DateTime::default()) // 1980-01-01 00:00:00
        .unix_permissions(permissions)
}
