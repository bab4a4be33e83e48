//! Archives from libraries.

use crate::process::{Outcome, at};
use fmu_archive::archive::{self, Binary, Contents};
use fmu_archive::{Component, Standard};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// What an archive is made from besides the interface and what the model's author has written.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Parts {
    /// Where the archive of FMI 2.0 goes; those of FMI 3.0 lie in folders beside it.
    pub archive: PathBuf,
    /// Its libraries.
    pub binaries: Vec<Library>,
    /// What is linked into them.
    pub linked: Vec<Component>,
    /// What must stand in none of its files: folders of this machine.
    pub forbidden: Vec<String>,
}

/// A library for one platform.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Library {
    /// Folder under `binaries/`.
    pub platform: String,
    /// File extension with its dot.
    pub extension: String,
    /// Where it lies.
    pub path: PathBuf,
}

impl Parts {
    /// The bytes of the archive with these contents, whose libraries and components are these parts.
    ///
    /// # Errors
    /// When a library cannot be read, a file tells of this machine, or a second archive of the same files has other bytes.
    pub fn bytes(&self, contents: &Contents<'_>) -> Result<Vec<u8>, String> {
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
        let contents = Contents {
            binaries: &binaries,
            linked: &self.linked,
            ..*contents
        };
        let name = contents.interface.name;
        for (path, bytes) in archive::files(&contents) {
            if let Some(folder) = carried(&self.forbidden, &bytes) {
                return Err(format!("{name}.fmu: {path} carries the path {folder}"));
            }
        }
        let write = || archive::write(&contents).map_err(|error| error.to_string());
        let bytes = write()?;
        if bytes == write()? {
            Ok(bytes)
        } else {
            Err(format!("{name}: two archives differ"))
        }
    }
}

impl Parts {
    /// The archives of all standards that the model has and that are `wanted`, each with its place.
    ///
    /// # Errors
    /// As [`bytes`](Self::bytes).
    pub fn archives(
        &self,
        contents: &Contents<'_>,
        wanted: impl Fn(&Standard) -> bool,
    ) -> Result<Vec<(PathBuf, Vec<u8>)>, String> {
        let folder = self.archive.parent().unwrap_or(Path::new(""));
        let file = self.archive.file_name().unwrap_or_default();
        Standard::of(contents.interface)
            .filter(wanted)
            .map(|standard| {
                let bytes = self.bytes(&Contents {
                    standard,
                    ..*contents
                })?;
                Ok((folder.join(standard.folder()).join(file), bytes))
            })
            .collect()
    }
}

/// The first of some texts that the bytes contain.
pub fn carried<'a>(texts: &'a [String], bytes: &[u8]) -> Option<&'a String> {
    texts.iter().find(|text| {
        !text.is_empty()
            && bytes
                .windows(text.len())
                .any(|part| part == text.as_bytes())
    })
}

/// Replaces a file in one go, so that nobody who reads or loads it sees half of it.
///
/// # Errors
/// When it cannot be written.
pub fn replace(path: &Path, bytes: &[u8]) -> Outcome {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(at(folder))?;
    }
    let new = path.with_extension("new");
    std::fs::write(&new, bytes).map_err(at(&new))?;
    std::fs::rename(&new, path).map_err(at(path))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_found_where_it_stands_and_an_empty_one_nowhere() {
        let texts = [
            String::new(),
            "/home/you/".to_owned(),
            "/home/me/".to_owned(),
        ];
        let bytes = b"\x7fELF\0/home/me/project/src/lib.rs\0";
        assert_eq!(carried(&texts, bytes), Some(&texts[2]));
        assert_eq!(carried(&texts[..2], bytes), None);
    }
}
