//! Other programs, and what went wrong with them.

use crate::schedule::BUILT;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::{fmt, io};

/// Why a command of ours ended early.
#[derive(Debug)]
pub enum Failure {
    /// Something that the machine must offer is missing: one sentence that says what to do.
    Missing(&'static str),
    /// A program could not be started.
    Start {
        /// Command line.
        command: String,
        /// Cause.
        cause: io::Error,
    },
    /// A program ended with an error, which it has printed.
    Exit {
        /// Command line.
        command: String,
        /// Its status.
        status: ExitStatus,
    },
    /// A file could not be read or written.
    File {
        /// Path.
        path: PathBuf,
        /// Cause.
        cause: io::Error,
    },
    /// Found wrong by ourselves.
    Found(String),
    /// Stages failed.
    Stages(Vec<&'static str>),
}

/// Result of a command or of a part of it.
pub type Outcome<T = ()> = Result<T, Failure>;

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing(what) => f.write_str(what),
            Self::Start { command, cause } => write!(f, "cannot start `{command}`: {cause}"),
            Self::Exit { command, status } => write!(f, "`{command}` failed ({status})"),
            Self::File { path, cause } => write!(f, "{}: {cause}", path.display()),
            Self::Found(what) => f.write_str(what),
            Self::Stages(names) => write!(f, "failed: {}", names.join(", ")),
        }
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
    program(
        std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()),
        arguments,
    )
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

/// Runs it; what it prints is shown.
pub fn run(command: &mut Command) -> Outcome {
    let status = command.status().map_err(|cause| Failure::Start {
        command: line(command),
        cause,
    })?;
    if status.success() {
        Ok(())
    } else {
        Err(Failure::Exit {
            command: line(command),
            status,
        })
    }
}

/// Runs it for what it prints; its errors are shown.
pub fn output(command: &mut Command) -> Outcome<String> {
    let outcome = command.stderr(Stdio::inherit()).output();
    let output = outcome.map_err(|cause| Failure::Start {
        command: line(command),
        cause,
    })?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    if output.status.success() {
        return Ok(text);
    }
    print!("{text}");
    Err(Failure::Exit {
        command: line(command),
        status: output.status,
    })
}

/// Runs it for its first line of output; `None` when it cannot be started or fails.
pub fn answer(command: &mut Command) -> Option<String> {
    let output = command
        .stderr(Stdio::null())
        .output()
        .ok()
        .filter(|output| output.status.success())?;
    String::from_utf8(output.stdout)
        .ok()
        .map(|text| text.trim().to_owned())
}

/// Where a program of ours lies; builds it, unless this is a stage that finds it built.
///
/// # Errors
/// When cargo fails.
pub fn built(name: &str) -> Outcome<PathBuf> {
    if std::env::var_os(BUILT).is_none() {
        build(name)?;
    }
    let target =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| "target".into(), PathBuf::from);
    let file = format!("{name}{}", std::env::consts::EXE_SUFFIX);
    Ok(root().join(target).join("debug").join(file))
}

/// Builds a program of ours. It is built as part of the workspace, so that what it has in common with the tests is compiled
/// once; and without the importers, whose features would bring another compressor, so that the archives had other bytes.
///
/// # Errors
/// When cargo fails.
pub fn build(name: &str) -> Outcome {
    let packages = ["--locked", "--workspace", "--exclude", "importers"];
    run(cargo(["build", "--quiet"])
        .args(packages)
        .args(["--bin", name]))
}

/// A failure to read or write `path`.
pub fn at(path: &Path) -> impl FnOnce(io::Error) -> Failure {
    move |cause| Failure::File {
        path: path.to_owned(),
        cause,
    }
}

/// The command line for messages: the program's file name and its arguments.
fn line(command: &Command) -> String {
    let name = Path::new(command.get_program())
        .file_name()
        .unwrap_or(command.get_program());
    let words = std::iter::once(name).chain(command.get_args());
    words
        .map(|word| word.to_string_lossy().into_owned())
        .collect::<Vec<_>>()
        .join(" ")
}
