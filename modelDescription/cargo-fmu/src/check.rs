//! The validator: `exo validate`, a Python program that comes with the sources of this SDK.

use crate::process::{Failure, Outcome, answer, program, run};
use crate::subject::Subject;
use std::path::{Path, PathBuf};

/// Judges archives.
///
/// # Errors
/// When the validator cannot be found, or finds something: it has printed that.
pub fn archives(archives: &[PathBuf], validator: &Path) -> Outcome {
    run(program(validator, ["validate"]).args(archives))
}

/// Where the validator is: as the user says, on the `PATH`, or in the environment beside the sources of the SDK that the model
/// depends on by its path.
///
/// # Errors
/// Says how it can be had.
pub fn validator(said: Option<&Path>, subject: Option<&Subject>) -> Outcome<PathBuf> {
    if let Some(said) = said {
        return Ok(said.to_owned());
    }
    if answer(&mut program("exo", ["--help"])).is_some() {
        return Ok("exo".into());
    }
    let beside = subject.iter().flat_map(|subject| &subject.workspace.beside);
    let mut sdks = beside.flat_map(|folder| folder.ancestors()).map(|folder| {
        let programs = if cfg!(windows) {
            "Scripts/exo.exe"
        } else {
            "bin/exo"
        };
        folder.join(".venv").join(programs)
    });
    sdks.find(|path| path.is_file()).ok_or(Failure::Missing(
        "the validator `exo` is neither on the PATH nor beside the SDK's sources. It comes with them:\n\n    \
         python3 -m venv exo-venv\n    exo-venv/bin/pip install SDK/harness\n    \
         cargo fmu check --validator exo-venv/bin/exo\n",
    ))
}
