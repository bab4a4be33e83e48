//! The program `catalogue`, which knows the models: this one asks it, and so compiles without any.

use crate::build::private_paths;
use crate::process::{Outcome, at, built, program, root, run};
use cargo_fmu::pack::{Library, Parts};
use fmu_archive::Component;
use serde::Serialize;
use serde_json::json;
use std::path::Path;

/// One archive to be packed.
#[derive(Serialize)]
pub struct Request {
    name: &'static str,
    parts: Parts,
}

impl Request {
    /// The archive of an FMU in a folder, with what is linked into its libraries.
    pub fn new(name: &'static str, folder: &Path, linked: Vec<Component>) -> Self {
        Self {
            name,
            parts: Parts {
                archive: folder.join(name).with_extension("fmu"),
                binaries: Vec::new(),
                linked,
                forbidden: forbidden(),
            },
        }
    }

    /// With a library: its folder under `binaries/`, its file extension with the dot, where it lies.
    pub fn add(&mut self, platform: &str, extension: &str, path: &Path) {
        self.parts.binaries.push(Library {
            platform: platform.to_owned(),
            extension: extension.to_owned(),
            path: path.to_owned(),
        });
    }
}

/// Packs archives.
///
/// # Errors
/// When one of its files tells of this machine, or two archives of the same files differ.
pub fn pack(requests: &[Request]) -> Outcome {
    requested("archives", &json!(requests))
}

/// Asks with a file of JSON.
fn requested(what: &str, request: &serde_json::Value) -> Outcome {
    // `fmu` and `dist` may ask at the same time.
    let path = root().join(format!("target/requests-{}.json", std::process::id()));
    std::fs::write(&path, request.to_string()).map_err(at(&path))?;
    let outcome = ask(what, Some(&path));
    let _ = std::fs::remove_file(&path);
    outcome
}

/// Folders of this machine, which must stand in no file.
fn forbidden() -> Vec<String> {
    let paths = private_paths();
    let folder = |path: &std::ffi::OsString| format!("{}/", path.to_string_lossy());
    paths.iter().map(folder).collect()
}

/// Says which committed descriptions are not what the declarations give; with `bless` writes them.
pub fn descriptions(bless: bool) -> Outcome {
    ask(if bless { "bless" } else { "descriptions" }, None)
}

/// Writes the tables of the C host, `<Name>.txt`.
pub fn tables(folder: &Path) -> Outcome {
    ask("tables", Some(folder))
}

/// Writes the C headers of the law's library.
pub fn law_headers(folder: &Path) -> Outcome {
    ask("law-headers", Some(folder))
}

/// Writes what goes with the installed C library: licences and bill of materials of what is linked in.
pub fn law_documents(prefix: &Path, linked: Vec<Component>) -> Outcome {
    let request = json!({"prefix": prefix, "linked": linked, "forbidden": forbidden()});
    requested("law-documents", &request)
}

fn ask(what: &str, about: Option<&Path>) -> Outcome {
    let mut command = program(built("catalogue")?, [what]);
    run(command.args(about))
}
