//! The libraries, built so that nothing in them tells of this machine: a path in a binary is a leak, and makes it
//! differ from the same source built elsewhere.

use crate::process::{Failure, Outcome, answer, at, cargo, program, root, run};
use std::ffi::OsString;
use std::path::PathBuf;

/// Builds the example target `name` of `package` in release mode; returns the library.
pub fn library(package: &str, name: &str) -> Outcome<Vec<u8>> {
    let target = root().join("target/fmu-build");
    let mut build = cargo([
        "build",
        "--locked",
        "--release",
        "--package",
        package,
        "--example",
        name,
        "--target-dir",
    ]);
    // The encoded form takes precedence over RUSTFLAGS and over cargo's configuration, and takes spaces in paths.
    run(build
        .arg(&target)
        .env("CARGO_ENCODED_RUSTFLAGS", remapping()?))?;
    let file = format!(
        "{}{name}{}",
        std::env::consts::DLL_PREFIX,
        std::env::consts::DLL_SUFFIX
    );
    let path = target.join("release/examples").join(file);
    let bytes = std::fs::read(&path).map_err(at(&path))?;
    match private_paths()
        .into_iter()
        .find(|private| contains(&bytes, private.as_encoded_bytes()))
    {
        Some(private) => Err(Failure::Found(format!(
            "{} carries the path {}",
            path.display(),
            private.to_string_lossy()
        ))),
        None => Ok(bytes),
    }
}

/// Compiler flags that replace this machine's paths. Where several prefixes match, the last one wins.
fn remapping() -> Outcome<OsString> {
    let mut replaced = vec![(cargo_home(), "/cargo".to_owned())];
    // The sources' folder is named after the registry that the machine uses. They must be there to be listed.
    run(&mut cargo(["fetch", "--locked", "--quiet"]))?;
    let sources = cargo_home().join("registry/src");
    for entry in std::fs::read_dir(&sources).into_iter().flatten().flatten() {
        replaced.push((entry.path(), "/cargo/registry".to_owned()));
    }
    replaced.extend(sysroot().map(|path| (path, "/rust".to_owned())));
    replaced.push((root(), "/source".to_owned()));

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

/// Paths that must not be in a library.
fn private_paths() -> Vec<OsString> {
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

fn sysroot() -> Option<PathBuf> {
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
    fn the_workspace_is_private() {
        assert!(private_paths().contains(&root().into_os_string()));
    }
}
