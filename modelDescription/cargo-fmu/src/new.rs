//! A package to begin with: a mass on a spring with a damper, and a test that steps it.

use crate::process::{Failure, Outcome, at, cargo, program};
use fmu_archive::name::{LONGEST_MODEL_NAME, is_model_name};
use std::path::{Path, PathBuf};

const MANIFEST: &str = include_str!("../template/Cargo.toml.in");
const MODEL: &str = include_str!("../template/lib.rs.in");
const TEST: &str = include_str!("../template/test.py.in");

/// Names that mean something else where the model is declared.
const TAKEN: [&str; 6] = ["Log", "Model", "Refusal", "Step", "Result", "Self"];

/// Where the SDK's crates come from.
#[derive(Clone, Debug)]
pub enum Sdk {
    /// The registry.
    Registry,
    /// The folder of the SDK's sources.
    Sources(PathBuf),
}

impl Sdk {
    fn dependency(&self, name: &str, place: &str) -> Outcome<String> {
        let version = env!("CARGO_PKG_VERSION");
        let Self::Sources(folder) = self else {
            return Ok(format!("{name} = \"{version}\""));
        };
        let path = std::path::absolute(folder).map_err(at(folder))?.join(place);
        if !path.join("Cargo.toml").is_file() {
            return Err(Failure::Found(format!(
                "--sdk {}: expected the folder of the SDK's sources, with {place}/Cargo.toml in it",
                folder.display()
            )));
        }
        // A literal string of TOML: nothing in it is an escape.
        Ok(format!(
            "{name} = {{ version = \"{version}\", path = '{}' }}",
            path.display()
        ))
    }
}

/// Makes the package in a folder that is not there yet; its name is the folder's. Returns the files.
///
/// # Errors
/// When the name is no package's, the folder is there, or the SDK is not.
pub fn package(folder: &Path, sdk: &Sdk) -> Outcome<Vec<PathBuf>> {
    let name = folder
        .file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let legal = name.starts_with(|c: char| c.is_ascii_lowercase())
        && name
            .chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || "-_".contains(c));
    if !legal {
        return Err(Failure::Found(format!(
            "{name:?}: expected the name of a package: small letters, digits, - and _, beginning with a letter"
        )));
    }
    let model = model(&name);
    if !is_model_name(&model) || TAKEN.contains(&model.as_str()) {
        return Err(Failure::Found(format!(
            "{name:?}: the model would be called {model:?}; expected another name than those of C, Windows, Rust and the SDK, with at \
             most {LONGEST_MODEL_NAME} letters"
        )));
    }
    if folder.exists() {
        return Err(Failure::Found(format!(
            "{}: is there already",
            folder.display()
        )));
    }
    let export = sdk.dependency("fmu-export", "modelDescription/export")?;
    let module = name.replace('-', "_");
    let fill = |text: &str| {
        text.replace("{{name}}", &name)
            .replace("{{module}}", &module)
            .replace("{{Model}}", &model)
            .replace("{{export}}", &export)
    };
    let mut files = Vec::new();
    for (path, text) in [
        ("Cargo.toml".to_owned(), fill(MANIFEST)),
        ("src/lib.rs".to_owned(), fill(MODEL)),
        (format!("tests/test_{module}.py"), fill(TEST)),
        (".gitignore".to_owned(), "/target\n".to_owned()),
    ] {
        let path = folder.join(path);
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(at(folder))?;
        }
        std::fs::write(&path, text).map_err(at(&path))?;
        files.push(path);
    }
    in_a_workspace(folder)?;
    Ok(files)
}

/// Below a workspace that does not know the package, cargo refuses it.
fn in_a_workspace(folder: &Path) -> Outcome {
    let arguments = [
        "metadata",
        "--no-deps",
        "--offline",
        "--format-version",
        "1",
    ];
    let mut metadata = program(cargo(), arguments);
    let output = metadata.current_dir(folder).output().map_err(at(folder))?;
    let said = String::from_utf8_lossy(&output.stderr);
    if said.contains("believes it's in a workspace") {
        return Err(Failure::Found(format!(
            "{} is made, and lies in the folder of a workspace that does not name it: add it to `members` in that workspace's \
             Cargo.toml. cargo says:\n{}",
            folder.display(),
            said.trim()
        )));
    }
    Ok(())
}

/// `my-plant` → `MyPlant`
fn model(name: &str) -> String {
    let words = name.split(['-', '_']).filter(|word| !word.is_empty());
    words
        .map(|word| {
            let (first, rest) = word.split_at(1);
            first.to_uppercase() + rest
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_model_is_named_like_the_package_in_capitals() {
        for (name, wanted) in [
            ("my-plant", "MyPlant"),
            ("mass_spring", "MassSpring"),
            ("p", "P"),
        ] {
            assert_eq!(model(name), wanted);
        }
    }

    #[test]
    fn a_name_that_is_no_package_s_and_an_sdk_that_is_not_there_are_refused() {
        for name in ["My-Plant", "1st", "my plant", "ä"] {
            let message = package(&Path::new("/nowhere").join(name), &Sdk::Registry).unwrap_err();
            assert!(
                message
                    .to_string()
                    .contains("expected the name of a package"),
                "{name}"
            );
        }
        for name in ["step", "self", "con", "lpt1", &"a".repeat(201)] {
            let message = package(&Path::new("/nowhere").join(name), &Sdk::Registry).unwrap_err();
            let message = message.to_string();
            assert!(message.contains("expected another name"), "{message}");
        }
        let sdk = Sdk::Sources("/nowhere".into());
        let message = package(Path::new("/nowhere/plant"), &sdk)
            .unwrap_err()
            .to_string();
        assert!(message.contains("--sdk /nowhere: expected"), "{message}");
    }
}
