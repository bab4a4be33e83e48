//! Libraries for this machine. Models in one call of cargo share what they have in common.

use crate::Workspace;
use crate::cdylib::Cdylib;
use crate::process::{Failure, Outcome, answer, at, ended, program, rustc, start};
use crate::trace::{forbid_private_paths, git_hash, remapping};
use cargo_metadata::Message;
use std::collections::BTreeMap;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// This machine's own name among cargo's targets.
///
/// # Errors
/// When the compiler does not say it.
pub fn host() -> Outcome<String> {
    let about = answer(&mut program(rustc(), ["-vV"]));
    let line = about
        .as_deref()
        .and_then(|text| text.lines().find_map(|line| line.strip_prefix("host: ")));
    line.map(str::to_owned)
        .ok_or(Failure::Missing("rustc does not say its host"))
}

/// Builds libraries for this machine without a trace of it, into the folder `target`; returns where they lie, by name.
///
/// # Errors
/// When cargo fails, or a library tells of this machine.
pub fn here(
    workspace: &Workspace,
    cdylibs: &[Cdylib],
    target: &Path,
    profile: &str,
) -> Outcome<BTreeMap<String, PathBuf>> {
    let mut build = for_this_machine(workspace, target)?;
    // The encoded form takes precedence over RUSTFLAGS and over cargo's configuration, and takes spaces in paths.
    build
        .args(["--profile", profile])
        .env("FMU_GIT_HASH", git_hash(workspace))
        .env("CARGO_ENCODED_RUSTFLAGS", remapping(workspace, &[])?)
        .envs(as_exported(profile));
    let libraries = built(&mut build, cdylibs, std::env::consts::DLL_SUFFIX)?;
    for path in libraries.values() {
        let bytes = std::fs::read(path).map_err(at(path))?;
        forbid_private_paths(workspace, &path.to_string_lossy(), &bytes)?;
    }
    Ok(libraries)
}

/// Builds a library that hands its interface over, as fast as can be, into the folder `target`; returns where it lies. The folder
/// must be another one than that of the archive's library: cargo gives both the same file name.
///
/// # Errors
/// When cargo fails.
pub fn handing_over(
    workspace: &Workspace,
    cdylib: &Cdylib,
    target: &Path,
    feature: &str,
) -> Outcome<PathBuf> {
    let mut build = for_this_machine(workspace, target)?;
    build
        .args(["--profile", "dev", "--features", feature])
        .env("CARGO_ENCODED_RUSTFLAGS", "")
        .env("CARGO_PROFILE_DEV_OPT_LEVEL", "0")
        .env("CARGO_PROFILE_DEV_DEBUG", "false")
        .env("CARGO_PROFILE_DEV_PANIC", "unwind");
    let one = std::slice::from_ref(cdylib);
    let mut libraries = built(&mut build, one, std::env::consts::DLL_SUFFIX)?;
    libraries
        .remove(&cdylib.name)
        .ok_or(Failure::Missing("cargo has made no library"))
}

fn for_this_machine(workspace: &Workspace, target: &Path) -> Outcome<Command> {
    let mut build = workspace.cargo("build");
    // Said, because the configuration of somebody's cargo may say another one.
    build
        .args(["--target", &host()?, "--target-dir"])
        .arg(target);
    Ok(build)
}

/// What a library of an archive needs, whatever its workspace says of the profile: panics that can be caught, no function
/// besides those of the standard, no symbols.
pub(crate) fn as_exported(profile: &str) -> [(String, &'static str); 4] {
    let name = profile.to_uppercase().replace('-', "_");
    let set = |key: &str, value| (format!("CARGO_PROFILE_{name}_{key}"), value);
    [
        set("PANIC", "unwind"),
        set("LTO", "fat"),
        set("CODEGEN_UNITS", "1"),
        set("STRIP", "symbols"),
    ]
}

/// Runs a build of some libraries; returns where they lie, by name. Errors of the compiler are shown.
///
/// # Errors
/// When cargo fails, or has made no such library.
pub fn built(
    command: &mut Command,
    cdylibs: &[Cdylib],
    suffix: &str,
) -> Outcome<BTreeMap<String, PathBuf>> {
    for cdylib in cdylibs {
        command.args(cdylib.arguments());
    }
    command
        .arg("--message-format=json-render-diagnostics")
        .stdout(Stdio::piped());
    let mut child = command.spawn().map_err(|cause| start(command, cause))?;
    let mut libraries = BTreeMap::new();
    let messages = child.stdout.take().map(BufReader::new);
    for message in messages.into_iter().flat_map(Message::parse_stream) {
        let Ok(Message::CompilerArtifact(artifact)) = message else {
            continue;
        };
        let Some(cdylib) = cdylibs.iter().find(|one| one.is(&artifact.target)) else {
            continue;
        };
        let files = artifact.filenames.into_iter();
        let library = files.map(PathBuf::from).find(|path| {
            path.file_name()
                .is_some_and(|name| name.to_string_lossy().ends_with(suffix))
        });
        libraries.extend(library.map(|path| (cdylib.name.clone(), path)));
    }
    let status = child.wait().map_err(|cause| start(command, cause))?;
    ended(command, status)?;
    match cdylibs
        .iter()
        .find(|one| !libraries.contains_key(&one.name))
    {
        None => Ok(libraries),
        Some(missing) => Err(Failure::Found(format!(
            "cargo has made no library {suffix} of {missing}"
        ))),
    }
}
