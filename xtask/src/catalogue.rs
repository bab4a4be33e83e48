//! The program `catalogue`, which knows the models: this one asks it, and so compiles without any.

use crate::build::private_paths;
use crate::component::Component;
use crate::process::{Outcome, at, built, output, program, root, run};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// One archive to be packed.
pub struct Request {
    name: &'static str,
    archive: PathBuf,
    binaries: Vec<Value>,
    linked: Vec<Component>,
}

impl Request {
    /// The archive of an FMU in a folder, with what is linked into its libraries.
    pub fn new(name: &'static str, folder: &Path, linked: Vec<Component>) -> Self {
        Self {
            name,
            archive: folder.join(name).with_extension("fmu"),
            binaries: Vec::new(),
            linked,
        }
    }

    /// With a library: its folder under `binaries/`, its file extension with the dot, where it lies.
    pub fn add(&mut self, platform: &str, extension: &str, path: &Path) {
        let library = json!({"platform": platform, "extension": extension, "path": path});
        self.binaries.push(library);
    }

    fn json(&self) -> Value {
        let forbidden: Vec<_> = private_paths()
            .iter()
            .map(|path| format!("{}/", path.to_string_lossy()))
            .collect();
        json!({
            "name": self.name,
            "archive": self.archive,
            "binaries": self.binaries,
            "linked": self.linked,
            "forbidden": forbidden,
        })
    }
}

/// Packs archives.
///
/// # Errors
/// When one of its files tells of this machine, or two archives of the same files differ.
pub fn pack(requests: &[Request]) -> Outcome {
    // `fmu` and `dist` may ask at the same time.
    let path = root().join(format!("target/requests-{}.json", std::process::id()));
    let text = Value::Array(requests.iter().map(Request::json).collect()).to_string();
    std::fs::write(&path, text).map_err(at(&path))?;
    let outcome = ask("archives", Some(&path));
    let _ = std::fs::remove_file(&path);
    outcome
}

/// Says which committed descriptions are not what the declarations give; with `bless` writes them.
pub fn descriptions(bless: bool) -> Outcome {
    ask(if bless { "bless" } else { "descriptions" }, None)
}

/// Writes the tables of the C host, `<Name>.txt`.
pub fn tables(folder: &Path) -> Outcome {
    ask("tables", Some(folder))
}

/// The C header of the law's library.
pub fn law_header() -> Outcome<String> {
    output(&mut program(built("catalogue")?, ["law-header"]))
}

/// Names of the functions that a library exports.
pub fn functions() -> Outcome<BTreeSet<String>> {
    let text = output(&mut program(built("catalogue")?, ["functions"]))?;
    Ok(text.lines().map(str::to_owned).collect())
}

fn ask(what: &str, about: Option<&Path>) -> Outcome {
    let mut command = program(built("catalogue")?, [what]);
    run(command.args(about))
}
