//! Archives from libraries, as `cargo xtask` asks for them in a file of JSON.

use crate::{Fmu, extra, wiring};
use model_description::archive::{self, Binary, Contents};
use model_description::{Component, Guide, Product, licences, sbom};
use serde::Deserialize;
use std::path::PathBuf;

/// One archive.
#[derive(Debug, Deserialize)]
pub struct Request {
    /// The FMU.
    pub name: String,
    /// Where the archive goes.
    pub archive: PathBuf,
    /// Its libraries.
    pub binaries: Vec<Library>,
    /// What is linked into them.
    pub linked: Vec<Component>,
    /// What must stand in none of its files: folders of this machine.
    pub forbidden: Vec<String>,
}

/// A library for one platform.
#[derive(Debug, Deserialize)]
pub struct Library {
    /// Folder under `binaries/`.
    pub platform: String,
    /// File extension with its dot.
    pub extension: String,
    /// Where it lies.
    pub path: PathBuf,
}

impl Request {
    /// The bytes of the archive.
    ///
    /// # Errors
    /// When the declaration breaks a rule, a library cannot be read, a file tells of this machine, or a second archive of the
    /// same files has other bytes.
    pub fn archive(&self, fmu: &Fmu) -> Result<Vec<u8>, String> {
        let interface = fmu
            .interface()
            .map_err(|error| format!("declaration of {}: {error}", fmu.name))?;
        let read = |library: &Library| {
            std::fs::read(&library.path)
                .map_err(|error| format!("{}: {error}", library.path.display()))
        };
        let libraries: Vec<_> = self.binaries.iter().map(read).collect::<Result<_, _>>()?;
        let binaries: Vec<_> = std::iter::zip(&self.binaries, &libraries)
            .map(|(library, bytes)| Binary {
                platform: &library.platform,
                extension: &library.extension,
                bytes,
            })
            .collect();
        let extra = extra::of(fmu.name)?;
        let what = fmu.what.to_owned() + extra::told(&extra);
        let contents = Contents {
            interface: &interface,
            binaries: &binaries,
            linked: &self.linked,
            guide: Guide {
                what: &what,
                picture: fmu.picture,
                wiring: &wiring::of(fmu.name),
                system: wiring::system(fmu.name),
            },
            icon: fmu.icon,
            extra: &extra,
        };
        for (path, bytes) in archive::files(&contents) {
            if let Some(folder) = carried(&self.forbidden, &bytes) {
                return Err(format!(
                    "{}.fmu: {path} carries the path {folder}",
                    fmu.name
                ));
            }
        }
        let write = || archive::write(&contents).map_err(|error| error.to_string());
        let bytes = write()?;
        if bytes == write()? {
            Ok(bytes)
        } else {
            Err(format!("{}: two archives differ", fmu.name))
        }
    }
}

/// What goes with the C library, which is no archive: its licences and its bill of materials.
#[derive(Debug, Deserialize)]
pub struct LawDocuments {
    /// The folder in which the library is installed.
    pub prefix: PathBuf,
    /// What is linked into it.
    pub linked: Vec<Component>,
    /// What must stand in none of its files: folders of this machine.
    pub forbidden: Vec<String>,
}

impl LawDocuments {
    /// Paths and contents.
    ///
    /// # Errors
    /// When a file tells of this machine.
    pub fn files(&self) -> Result<Vec<(PathBuf, Vec<u8>)>, String> {
        let product = Product {
            name: "exo-law",
            about: "The admittance laws as a C library",
            guid: None,
        };
        let licences = licences::files(&product, &self.linked);
        let bill = sbom(&product, &self.linked).into_bytes();
        let licences = licences
            .into_iter()
            .map(|(path, text)| (format!("share/licenses/exo_law/{path}"), text));
        let files = licences.chain([("share/sbom/exo_law.cdx.json".to_owned(), bill)]);
        files
            .map(|(path, bytes)| match carried(&self.forbidden, &bytes) {
                Some(folder) => Err(format!("{path} carries the path {folder}")),
                None => Ok((self.prefix.join(path), bytes)),
            })
            .collect()
    }
}

/// The first of some texts that the bytes contain.
fn carried<'a>(texts: &'a [String], bytes: &[u8]) -> Option<&'a String> {
    texts.iter().find(|text| {
        !text.is_empty()
            && bytes
                .windows(text.len())
                .any(|part| part == text.as_bytes())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FMUS;

    #[test]
    fn an_archive_that_tells_of_this_machine_is_refused_and_the_file_named() {
        let path = std::env::temp_dir().join(format!("catalogue-{}.so", std::process::id()));
        std::fs::write(&path, b"\x7fELF\0/home/me/project/src/lib.rs\0").expect("writable");
        let mut request = Request {
            name: FMUS[0].name.to_owned(),
            archive: PathBuf::new(),
            binaries: vec![Library {
                platform: "linux64".to_owned(),
                extension: ".so".to_owned(),
                path: path.clone(),
            }],
            linked: Vec::new(),
            forbidden: vec!["/home/you/".to_owned()],
        };
        assert!(request.archive(&FMUS[0]).is_ok());
        request.forbidden.push("/home/me/".to_owned());
        let message = request.archive(&FMUS[0]).unwrap_err();
        let file = format!("binaries/linux64/{}.so", FMUS[0].name);
        assert!(
            message.contains(&file) && message.contains("/home/me/"),
            "{message}"
        );
        std::fs::remove_file(path).expect("was there");
    }
}
