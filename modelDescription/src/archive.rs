//! The `.fmu` archive: the same bytes for the same contents, on any machine and day.

use crate::{Component, Guide, Interface, document, header, licences, sbom, xml};
use std::io::{Cursor, Write as _};
use zip::result::ZipResult;
use zip::write::{SimpleFileOptions, ZipWriter};
use zip::{CompressionMethod, DateTime};

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

/// All that an archive is made from.
#[derive(Clone, Copy, Debug)]
pub struct Contents<'a> {
    /// The interface.
    pub interface: &'a Interface,
    /// Its libraries.
    pub binaries: &'a [Binary<'a>],
    /// What is linked into them.
    pub linked: &'a [Component],
    /// What the interface document says besides the rows.
    pub guide: Guide<'a>,
    /// `model.png`, which importers show on the block.
    pub icon: &'a [u8],
    /// Other files, by their path in the archive.
    pub extra: &'a [(String, Vec<u8>)],
}

impl<'a> Contents<'a> {
    /// What follows from the interface alone: no library, nothing linked in, the icon of a control loop.
    pub fn of(interface: &'a Interface) -> Self {
        Self {
            interface,
            binaries: &[],
            linked: &[],
            guide: Guide::default(),
            icon: PICTURE,
            extra: &[],
        }
    }
}

/// Writes the archive. Paths are sorted, dates are 1980-01-01, libraries are executable, nothing else is.
///
/// # Errors
/// None in practice: the archive is written to memory.
pub fn write(contents: &Contents<'_>) -> ZipResult<Vec<u8>> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (path, bytes) in files(contents) {
        if path.ends_with('/') {
            archive.add_directory(path, options(0o755))?;
        } else {
            let permissions = if path.starts_with("binaries/") {
                0o755
            } else {
                0o644
            };
            archive.start_file(path, options(permissions))?;
            archive.write_all(&bytes)?;
        }
    }
    Ok(archive.finish()?.into_inner())
}

/// Paths in ascending order, with contents; a folder's path ends in `/`.
pub fn files(contents: &Contents<'_>) -> Vec<(String, Vec<u8>)> {
    let Contents {
        interface,
        binaries,
        linked,
        guide,
        icon,
        extra,
    } = *contents;
    let name = interface.name;
    let mut files = vec![
        (
            "modelDescription.xml".to_owned(),
            xml(interface).into_bytes(),
        ),
        ("model.png".to_owned(), icon.to_vec()),
        (
            "documentation/index.html".to_owned(),
            document(interface, guide).into_bytes(),
        ),
        (
            format!("documentation/{name}.h"),
            header(interface).into_bytes(),
        ),
        (
            "documentation/sbom.cdx.json".to_owned(),
            sbom(&interface.into(), linked).into_bytes(),
        ),
        // Importers pass its location to fmi2Instantiate, so it exists, although nothing is in it.
        ("resources/".to_owned(), Vec::new()),
    ];
    let licences = licences::files(&interface.into(), linked);
    files.extend(
        licences
            .into_iter()
            .map(|(path, text)| (format!("documentation/licenses/{path}"), text)),
    );
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
    files.extend_from_slice(extra);
    files.sort();
    files
}

fn options(permissions: u32) -> SimpleFileOptions {
    SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .compression_level(Some(9))
        .last_modified_time(DateTime::default()) // 1980-01-01 00:00:00
        .unix_permissions(permissions)
}
