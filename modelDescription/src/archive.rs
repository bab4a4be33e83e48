//! The `.fmu` archive: the same bytes for the same contents, on any machine and day.

use crate::{
    Component, Guide, Interface, Package, Product, Standard, Terminal, document, header, licences,
    sbom, terminals,
};
use std::io::{Cursor, Write as _};
use zip::result::ZipResult;
use zip::write::{SimpleFileOptions, ZipWriter};
use zip::{CompressionMethod, DateTime};

const PICTURE: &[u8] = include_bytes!("../model.png");

/// A shared library for one platform.
#[derive(Clone, Copy, Debug)]
pub struct Binary<'a> {
    /// Folder under `binaries/` as FMI 2.0 names it: `linux64`, `win64`, …
    pub platform: &'a str,
    /// File extension with its dot: `.so`, `.dll`, `.dylib`.
    pub extension: &'a str,
    /// The library.
    pub bytes: &'a [u8],
}

/// All that an archive is made from.
#[derive(Clone, Copy, Debug)]
pub struct Contents<'a> {
    /// What it is for.
    pub standard: Standard,
    /// The interface.
    pub interface: &'a Interface,
    /// Whose model it is.
    pub package: Package<'a>,
    /// Its libraries.
    pub binaries: &'a [Binary<'a>],
    /// What is linked into them.
    pub linked: &'a [Component],
    /// What the interface document says besides the rows.
    pub guide: Guide<'a>,
    /// The PNG that importers show on the block: `model.png`, in FMI 3.0 `terminalsAndIcons/icon.png`.
    pub icon: &'a [u8],
    /// Other files, by their path in the archive.
    pub extra: &'a [(String, Vec<u8>)],
    /// What is connected by one line, in FMI 3.0.
    pub terminals: &'a [Terminal],
}

impl<'a> Contents<'a> {
    /// What follows from the interface alone: of no package, no library, nothing linked in, the icon of a control loop.
    pub fn of(interface: &'a Interface) -> Self {
        Self {
            standard: Standard::Fmi2,
            interface,
            package: Package::default(),
            binaries: &[],
            linked: &[],
            guide: Guide::default(),
            icon: PICTURE,
            extra: &[],
            terminals: &[],
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
        standard,
        interface,
        package,
        binaries,
        linked,
        guide,
        icon,
        extra,
        terminals,
    } = *contents;
    let name = interface.name;
    let product = Product::of(interface, package);
    let mut files = vec![
        (
            "modelDescription.xml".to_owned(),
            standard.description(interface, package).into_bytes(),
        ),
        (
            "documentation/index.html".to_owned(),
            document(interface, package, guide, standard).into_bytes(),
        ),
        (
            format!("documentation/{name}.h"),
            header(interface, standard).into_bytes(),
        ),
        (
            "documentation/sbom.cdx.json".to_owned(),
            sbom(&product, linked).into_bytes(),
        ),
        // Importers pass its location to fmi2Instantiate and fmi3Instantiate…, so it exists, although nothing is in it.
        ("resources/".to_owned(), Vec::new()),
    ];
    if standard.is_fmi3() {
        let icons = terminals::files(terminals, icon);
        files.extend(
            icons
                .into_iter()
                .map(|(path, bytes)| (format!("terminalsAndIcons/{path}"), bytes)),
        );
    } else {
        files.push(("model.png".to_owned(), icon.to_vec()));
    }
    let licences = licences::files(&product, linked);
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
        let platform = standard.platform(platform);
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
