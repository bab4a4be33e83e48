//! What a model's package says of it in its `Cargo.toml`: under `[package]`, and under
//!
//! ```toml
//! [package.metadata.fmu]
//! author = "Jane Doe"                         # without it the package's authors
//! copyright = "Copyright 2026 Jane Doe"
//! licenses = ["LICENSE"]                      # without it files of such names beside Cargo.toml, or in the workspace's folder
//! icon = "icon.png"                           # shown on the block
//! guide = "guide.html"                        # what the model does: paragraphs for the interface document
//! picture = "signs.svg"                       # signs and frames, in the interface document
//! resources = "resources"                     # a folder, which the model finds again at run time
//! extra = "extra"                             # a folder, for layered standards
//! fmi = ["3.0"]                               # the versions of the standard; without it "2.0" and "3.0"
//! ```

use crate::process::{Failure, Outcome, at};
use crate::table::{Table, wrong};
use crate::{folder, linked};
use cargo_metadata::Package;
use fmu_archive::{Standard, licences};
use std::path::Path;

/// All of it, read.
#[derive(Clone, Debug, Default)]
pub struct Facts {
    /// Version.
    pub version: String,
    /// Author.
    pub author: String,
    /// Copyright.
    pub copyright: String,
    /// Licence, as an SPDX expression.
    pub license: String,
    /// Names and contents of licence texts.
    pub texts: Vec<(String, Vec<u8>)>,
    /// A PNG.
    pub icon: Option<Vec<u8>>,
    /// Paragraphs of HTML.
    pub guide: String,
    /// An `<svg>` element.
    pub picture: String,
    /// Other files of the archive, by their path.
    pub extra: Vec<(String, Vec<u8>)>,
    /// The versions of the standard for which there are archives.
    pub fmi: Vec<Version>,
    /// The file that says it all.
    pub manifest: String,
}

/// A version of the standard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Version {
    /// FMI 2.0
    Fmi2,
    /// FMI 3.0
    Fmi3,
}

impl Version {
    /// That of this name.
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "2.0" => Some(Self::Fmi2),
            "3.0" => Some(Self::Fmi3),
            _ => None,
        }
    }

    /// That of an archive.
    pub const fn of(standard: Standard) -> Self {
        if standard.is_fmi3() {
            Self::Fmi3
        } else {
            Self::Fmi2
        }
    }
}

impl Facts {
    /// Reads what the package says; `root` is its workspace's folder.
    ///
    /// # Errors
    /// Names the key and what was expected.
    pub fn of(package: &Package, root: &Path) -> Outcome<Self> {
        let table = Table::of(package)?;
        let folder = package
            .manifest_path
            .parent()
            .map_or(root, |folder| folder.as_std_path());
        let bytes = |key: &str, path: &str| {
            std::fs::read(folder.join(path)).map_err(|error| unread(package, key, path, &error))
        };
        let text = |key: &str, path: &Option<String>| match path {
            None => Ok(String::new()),
            Some(path) => std::fs::read_to_string(folder.join(path))
                .map_err(|error| unread(package, key, path, &error)),
        };
        let icon = table.icon.as_deref().map(|path| {
            bytes("icon", path).and_then(|icon| match icon.starts_with(b"\x89PNG\r\n\x1a\n") {
                true => Ok(icon),
                false => Err(wrong_path(package, "icon", path, "a PNG file")),
            })
        });
        let picture = text("picture", &table.picture)?;
        if let Some(path) = table
            .picture
            .as_deref()
            .filter(|_| !picture.trim_start().starts_with("<svg"))
        {
            return Err(wrong_path(
                package,
                "picture",
                path,
                "a file that begins with <svg",
            ));
        }
        let mut extra = Vec::new();
        for (key, path) in [("resources", &table.resources), ("extra", &table.extra)] {
            if let Some(path) = path {
                let files = folder::files(&folder.join(path), key).map_err(|what| {
                    wrong_path(package, key, path, &format!("a folder ({what})"))
                })?;
                extra.extend(files);
            }
        }
        let texts = match &table.licenses {
            Some(paths) => {
                let named = |path: &String| {
                    let name = Path::new(path).file_name().unwrap_or_default();
                    Ok((
                        name.to_string_lossy().into_owned(),
                        bytes("licenses", path)?,
                    ))
                };
                paths.iter().map(named).collect::<Outcome<_>>()?
            }
            None => found(package, folder, root)?,
        };
        one_name_each(&texts)?;
        let fmi = table
            .fmi
            .unwrap_or_else(|| vec![Version::Fmi2, Version::Fmi3]);
        let facts = Self {
            fmi,
            manifest: package.manifest_path.to_string(),
            version: package.version.to_string(),
            author: table.author.unwrap_or_else(|| package.authors.join(", ")),
            copyright: table.copyright.unwrap_or_default(),
            license: package.license.clone().unwrap_or_default(),
            texts,
            icon: icon.transpose()?,
            guide: text("guide", &table.guide)?,
            picture,
            extra,
        };
        facts.on_one_line()?;
        Ok(facts)
    }

    /// Refuses what XML cannot carry, and line ends, which no reader of the description keeps.
    fn on_one_line(&self) -> Outcome {
        for (key, text) in [
            ("author", &self.author),
            ("copyright", &self.copyright),
            ("license", &self.license),
        ] {
            if !fmu_archive::name::is_line(text) {
                let manifest = &self.manifest;
                return Err(Failure::Found(format!(
                    "{manifest}: {key} = {text:?}: expected one line without control characters"
                )));
            }
        }
        Ok(())
    }
}

/// Refuses two licence texts that would be one file of the archive.
fn one_name_each(texts: &[(String, Vec<u8>)]) -> Outcome {
    let mut names = std::collections::BTreeMap::new();
    for (name, _) in texts {
        if let Some(other) = names.insert(licences::file_name(name).to_lowercase(), name) {
            return Err(Failure::Found(format!(
                "licence texts {other} and {name}: expected file names that differ, because they lie in one folder of the archive"
            )));
        }
    }
    Ok(())
}

/// Licence texts: the file that the package names, those beside its manifest, or those of its workspace.
fn found(package: &Package, folder: &Path, root: &Path) -> Outcome<Vec<(String, Vec<u8>)>> {
    if let Some(path) = package.license_file() {
        let name = path.file_name().unwrap_or("LICENSE").to_owned();
        let text = std::fs::read(&path).map_err(at(path.as_std_path()))?;
        return Ok(vec![(name, text)]);
    }
    let texts = linked::texts(folder)?;
    if texts.is_empty() {
        linked::texts(root)
    } else {
        Ok(texts)
    }
}

fn unread(package: &Package, key: &str, path: &str, error: &std::io::Error) -> Failure {
    let expected = format!("a path beside Cargo.toml ({error})");
    wrong_path(package, key, path, &expected)
}

fn wrong_path(package: &Package, key: &str, path: &str, expected: &str) -> Failure {
    wrong(package, key, &format!("{path:?}"), expected)
}
