//! Archives from libraries, as `cargo xtask` asks for them in a file of JSON.

use crate::{Fmu, PACKAGE, extra, terminals, wiring};
use cargo_fmu::pack::{Parts, carried};
use fmu_archive::archive::Contents;
use fmu_archive::{Component, Guide, Product, licences, sbom};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// One archive.
#[derive(Debug, Serialize, Deserialize)]
pub struct Request {
    /// The FMU.
    pub name: String,
    /// Where the archive of FMI 2.0 goes, libraries, what is linked in.
    pub parts: Parts,
}

impl Request {
    /// The archive of FMI 2.0 and, in the folder `fmi3` beside it, those of FMI 3.0: their places and bytes.
    ///
    /// # Errors
    /// When the declaration breaks a rule, a library cannot be read, a file tells of this machine, or a second archive of the
    /// same files has other bytes.
    pub fn archives(&self, fmu: &Fmu) -> Result<Vec<(PathBuf, Vec<u8>)>, String> {
        let interface = fmu
            .interface()
            .map_err(|error| format!("declaration of {}: {error}", fmu.name))?;
        let extra = extra::of(fmu.name)?;
        let what = fmu.what.to_owned() + extra::told(&extra);
        let contents = Contents {
            package: PACKAGE,
            guide: Guide {
                what: &what,
                picture: fmu.picture,
                wiring: &wiring::of(fmu.name),
                system: wiring::system(fmu.name),
            },
            icon: fmu.icon,
            terminals: &terminals::of(fmu.name),
            extra: &extra,
            ..Contents::of(&interface)
        };
        self.parts.archives(&contents, |_| true)
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
            package: PACKAGE,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FMUS;
    use cargo_fmu::pack::Library;

    #[test]
    fn an_archive_that_tells_of_this_machine_is_refused_and_the_file_named() {
        let path = std::env::temp_dir().join(format!("catalogue-{}.so", std::process::id()));
        std::fs::write(&path, b"\x7fELF\0/home/me/project/src/lib.rs\0").expect("writable");
        let mut request = Request {
            name: FMUS[0].name.to_owned(),
            parts: Parts {
                archive: PathBuf::new(),
                binaries: vec![Library {
                    platform: "linux64".to_owned(),
                    extension: ".so".to_owned(),
                    path: path.clone(),
                }],
                linked: Vec::new(),
                forbidden: vec!["/home/you/".to_owned()],
            },
        };
        assert!(request.archives(&FMUS[0]).is_ok());
        request.parts.forbidden.push("/home/me/".to_owned());
        let message = request.archives(&FMUS[0]).unwrap_err();
        let file = format!("binaries/linux64/{}.so", FMUS[0].name);
        assert!(
            message.contains(&file) && message.contains("/home/me/"),
            "{message}"
        );
        std::fs::remove_file(path).expect("was there");
    }
}
