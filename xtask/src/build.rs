//! The libraries of all FMUs, built for this machine without a trace of it.

use crate::process::{Outcome, root, workspace};
use cargo_fmu::cdylib::Cdylib;
use cargo_fmu::{compile, trace};
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::PathBuf;

/// The model that the C interface is tested with, `modelDescription/export/examples/lag.rs`: it panics when told to.
pub const LAG: &str = "lag";

/// The smallest model, `modelDescription/export/examples/integrator.rs`.
pub const SMALLEST: &str = "integrator";

/// A model with every type of FMI 3.0, and one with those types that FMI 2.0 can show, both in `modelDescription/export/examples`.
pub const EVERY_TYPE: &str = "feedthrough";
/// See [`EVERY_TYPE`].
pub const SMALL_TYPES: &str = "narrow";

/// The examples of which there are archives.
pub const PACKED: [&str; 3] = [SMALLEST, EVERY_TYPE, SMALL_TYPES];

/// All FMUs.
pub fn fmus() -> Vec<Cdylib> {
    let cdylib = |fmu: &fmus::Fmu| Cdylib::example(&fmu.package(), fmu.name);
    fmus::ALL.iter().map(cdylib).collect()
}

/// An example of the exporter.
pub fn example(name: &str) -> Cdylib {
    Cdylib::example("fmu-export", name)
}

/// Builds the libraries of all FMUs and of the examples in release mode; returns where they lie, by name.
pub fn libraries() -> Outcome<BTreeMap<String, PathBuf>> {
    let mut cdylibs = fmus();
    cdylibs.extend(PACKED.map(example));
    cdylibs.push(example(LAG));
    let target = root().join("target/fmu-build");
    compile::here(&workspace(), &cdylibs, &target, "release")
}

/// File name of a library of this machine.
pub fn library_name(name: &str) -> String {
    let (prefix, suffix) = (std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    format!("{prefix}{name}{suffix}")
}

/// Refuses bytes that tell of this machine.
///
/// # Errors
/// Names the file and the path that is in it.
pub fn forbid_private_paths(file: &str, bytes: &[u8]) -> Outcome {
    trace::forbid_private_paths(&workspace(), file, bytes)
}

/// Compiler flags that replace this machine's paths, and `others`.
pub fn remapping(others: &[(PathBuf, String)]) -> Outcome<OsString> {
    trace::remapping(&workspace(), others)
}

/// Paths that must not be in a library or an archive.
pub fn private_paths() -> Vec<OsString> {
    trace::private_paths(&workspace())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_workspace_is_private() {
        assert!(private_paths().contains(&root().into_os_string()));
    }
}
