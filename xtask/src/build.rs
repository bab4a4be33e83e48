//! The libraries, built so that nothing in them tells of this machine: a path in a binary is a leak, and makes it
//! differ from the same source built elsewhere.

use crate::process::{Failure, Outcome, answer, at, cargo, program, root, run};
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::PathBuf;

/// The model that the C interface is tested with, `modelDescription/export/examples/lag.rs`: it panics when told to.
pub const LAG: &str = "lag";

/// The smallest model, `modelDescription/export/examples/integrator.rs`.
pub const SMALLEST: &str = "integrator";

/// Builds the libraries of all FMUs and of the two examples in release mode; returns where they lie, by name.
pub fn libraries() -> Outcome<BTreeMap<&'static str, PathBuf>> {
    let target = root().join("target/fmu-build");
    // One call: it compiles once what they share, and links side by side.
    let mut build = cargo(["build", "--locked", "--release", "--target-dir"]);
    build.arg(&target);
    let mut names: Vec<&'static str> = Vec::new();
    for fmu in fmus::ALL {
        build.args(["--package", &fmu.package(), "--example", fmu.name]);
        names.push(fmu.name);
    }
    build.args(["--package", "fmu-export"]);
    for example in [SMALLEST, LAG] {
        build.args(["--example", example]);
        names.push(example);
    }
    // The encoded form takes precedence over RUSTFLAGS and over cargo's configuration, and takes spaces in paths.
    run(build
        .env("FMU_GIT_HASH", git_hash())
        .env("CARGO_ENCODED_RUSTFLAGS", remapping(&[])?))?;
    let mut libraries = BTreeMap::new();
    for name in names {
        let path = target.join("release/examples").join(library_name(name));
        let bytes = std::fs::read(&path).map_err(at(&path))?;
        forbid_private_paths(&path.to_string_lossy(), &bytes)?;
        libraries.insert(name, path);
    }
    Ok(libraries)
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
    match private_paths()
        .into_iter()
        .find(|private| contains(bytes, &[private.as_encoded_bytes(), b"/"].concat()))
    {
        Some(private) => Err(Failure::Found(format!(
            "{file} carries the path {}",
            private.to_string_lossy()
        ))),
        None => Ok(()),
    }
}

/// The commit that is built: its hash, with `-dirty` when files that git knows differ from it; `unknown` outside of git.
/// A source without its history can be told by `FMU_GIT_HASH` in the environment.
pub fn git_hash() -> String {
    if let Ok(told) = std::env::var("FMU_GIT_HASH") {
        return told;
    }
    let hash = answer(&mut program("git", ["rev-parse", "HEAD"]));
    let status = answer(&mut program(
        "git",
        ["status", "--porcelain", "--untracked-files=no"],
    ));
    match (hash, status.as_deref()) {
        (Some(hash), Some("")) => hash,
        (Some(hash), Some(_)) => hash + "-dirty",
        _ => "unknown".to_owned(),
    }
}

/// Compiler flags that replace this machine's paths, and `others`. Where several prefixes match, the last one wins.
pub fn remapping(others: &[(PathBuf, String)]) -> Outcome<OsString> {
    let mut replaced = vec![(cargo_home(), "/cargo".to_owned())];
    // The sources' folder is named after the registry that the machine uses. They must be there to be listed.
    run(&mut cargo(["fetch", "--locked", "--quiet"]))?;
    let sources = cargo_home().join("registry/src");
    for entry in std::fs::read_dir(&sources).into_iter().flatten().flatten() {
        replaced.push((entry.path(), "/cargo/registry".to_owned()));
    }
    replaced.extend(sysroot().map(|path| (path, "/rust".to_owned())));
    replaced.push((root(), "/source".to_owned()));
    replaced.extend_from_slice(others);

    let mut flags = OsString::new();
    for (path, name) in replaced {
        if !flags.is_empty() {
            flags.push("\x1f");
        }
        flags.push("--remap-path-prefix=");
        flags.push(path);
        flags.push("=");
        flags.push(name);
    }
    Ok(flags)
}

/// Paths that must not be in a library or an archive.
pub fn private_paths() -> Vec<OsString> {
    let home = std::env::var_os("HOME").map(PathBuf::from);
    let paths = [Some(root()), Some(cargo_home()), sysroot(), home];
    // A home of `/` is in every path.
    paths
        .into_iter()
        .flatten()
        .filter(|path| path.components().count() > 1)
        .map(PathBuf::into_os_string)
        .collect()
}

fn cargo_home() -> PathBuf {
    match std::env::var_os("CARGO_HOME") {
        Some(path) => path.into(),
        None => PathBuf::from(std::env::var_os("HOME").unwrap_or_default()).join(".cargo"),
    }
}

/// Where the compiler of this machine and its library lie.
pub fn sysroot() -> Option<PathBuf> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    answer(&mut program(rustc, ["--print", "sysroot"])).map(PathBuf::from)
}

fn contains(bytes: &[u8], part: &[u8]) -> bool {
    !part.is_empty() && bytes.windows(part.len()).any(|window| window == part)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_in_a_library_is_found() {
        assert!(contains(
            b"\x7fELF\0/home/me/project/src/lib.rs\0",
            b"/home/me"
        ));
        assert!(!contains(b"\x7fELF\0/source/src/lib.rs\0", b"/home/me"));
        assert!(!contains(b"x", b""));
    }

    #[test]
    fn a_file_with_a_path_of_this_machine_is_refused_and_named() {
        let text = format!("see {}/src/lib.rs", root().display());
        let message = forbid_private_paths("index.html", text.as_bytes())
            .unwrap_err()
            .to_string();
        assert!(message.contains("index.html") && message.contains(&*root().to_string_lossy()));
        assert!(forbid_private_paths("index.html", b"see /source/src/lib.rs").is_ok());
    }

    #[test]
    fn the_workspace_is_private() {
        assert!(private_paths().contains(&root().into_os_string()));
    }
}
