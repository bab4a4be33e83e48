//! Other programs, started in this workspace.

use crate::schedule::in_a_stage;
use cargo_fmu::Workspace;
pub use cargo_fmu::process::{Failure, Outcome, answer, at, output, run};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// This workspace, as those see it who build libraries.
pub fn workspace() -> Workspace {
    Workspace {
        folder: root(),
        root: root(),
        target: root().join("target"),
        beside: Vec::new(),
        flags: vec!["--locked".to_owned()],
    }
}

/// The folder of the workspace.
pub fn root() -> PathBuf {
    // Cargo sets it when it runs us, also when the clone has moved since it compiled us.
    let package =
        std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_else(|| env!("CARGO_MANIFEST_DIR").into());
    let package = PathBuf::from(package);
    package
        .parent()
        .map_or_else(|| package.clone(), Path::to_owned)
}

/// The cargo that runs us, in the workspace's folder.
pub fn cargo<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>) -> Command {
    program(cargo_fmu::process::cargo(), arguments)
}

/// A program in the workspace's folder, without standard input.
pub fn program<S: AsRef<OsStr>>(
    name: impl AsRef<OsStr>,
    arguments: impl IntoIterator<Item = S>,
) -> Command {
    let mut command = Command::new(name);
    command
        .args(arguments)
        .current_dir(root())
        .stdin(Stdio::null());
    command
}

/// Where a program of ours lies; builds it, unless this is a stage that finds it built.
///
/// # Errors
/// When cargo fails.
pub fn built(name: &str) -> Outcome<PathBuf> {
    if !in_a_stage() {
        build(&[name])?;
    }
    let target =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| "target".into(), PathBuf::from);
    let file = format!("{name}{}", std::env::consts::EXE_SUFFIX);
    Ok(root().join(target).join("debug").join(file))
}

/// Builds programs of ours. They are built as part of the workspace, so that what they have in common with the tests is compiled
/// once; and without the importers, whose features would bring another compressor, so that the archives had other bytes.
///
/// # Errors
/// When cargo fails.
pub fn build(names: &[&str]) -> Outcome {
    let mut build = cargo(["build", "--quiet", "--locked", "--workspace"]);
    build.args(["--exclude", "importers"]);
    for name in names {
        build.args(["--bin", name]);
    }
    run(&mut build)
}
