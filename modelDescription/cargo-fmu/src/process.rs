//! Other programs, and what went wrong with them.

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
        }
    }
}

impl std::error::Error for Failure {}

/// The cargo that runs us.
pub fn cargo() -> std::ffi::OsString {
    std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// The compiler that cargo calls.
pub fn rustc() -> std::ffi::OsString {
    std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into())
}

/// A program without standard input.
pub fn program<S: AsRef<OsStr>>(
    name: impl AsRef<OsStr>,
    arguments: impl IntoIterator<Item = S>,
) -> Command {
    let mut command = Command::new(name);
    command.args(arguments).stdin(Stdio::null());
    command
}

/// Runs it; what it prints is shown.
///
/// # Errors
/// When it cannot be started or fails.
pub fn run(command: &mut Command) -> Outcome {
    let status = command.status().map_err(|cause| start(command, cause))?;
    ended(command, status)
}

/// Runs it for what it prints; its errors are shown.
///
/// # Errors
/// When it cannot be started or fails; what it has printed is shown then.
pub fn output(command: &mut Command) -> Outcome<String> {
    let outcome = command.stderr(Stdio::inherit()).output();
    let output = outcome.map_err(|cause| start(command, cause))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    if !output.status.success() {
        print!("{text}");
    }
    ended(command, output.status).map(|()| text)
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

/// A failure to read or write `path`.
pub fn at(path: &Path) -> impl FnOnce(io::Error) -> Failure {
    move |cause| Failure::File {
        path: path.to_owned(),
        cause,
    }
}

/// A failure to start it.
pub(crate) fn start(command: &Command, cause: io::Error) -> Failure {
    Failure::Start {
        command: line(command),
        cause,
    }
}

/// What its status means.
pub(crate) fn ended(command: &Command, status: ExitStatus) -> Outcome {
    if status.success() {
        return Ok(());
    }
    Err(Failure::Exit {
        command: line(command),
        status,
    })
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
