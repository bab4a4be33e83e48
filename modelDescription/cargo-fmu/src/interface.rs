//! The interface of a model, from its library: built once more so that it hands it over, and loaded in a process of its own,
//! because what is loaded is anybody's code.

use crate::cdylib::Cdylib;
use crate::compile;
use crate::process::{Failure, Outcome, at, run};
use crate::subject::Subject;
use fmu_archive::{Interface, hand_over};
use std::path::Path;

/// The word with which this program is started to load a library: then follow the library, and the file for its interface.
pub const LOAD: &str = "load-interface";

/// Builds the library, into the folder `target`, and asks it.
///
/// # Errors
/// When it does not compile or load, or its declaration breaks a rule.
pub fn read(subject: &Subject, cdylib: &Cdylib, target: &Path) -> Outcome<Interface> {
    let target = target.join("interface");
    let library = compile::handing_over(&subject.workspace, cdylib, &target, &subject.feature)?;
    let written = library.with_extension("interface");
    let own = std::env::current_exe().map_err(at(Path::new("cargo-fmu")))?;
    let mut child = subject.workspace.program(own);
    run(child.arg(LOAD).arg(&library).arg(&written)).map_err(|failure| {
        Failure::Found(format!(
            "the interface of {cdylib} cannot be read: {failure}"
        ))
    })?;
    let bytes = std::fs::read(&written).map_err(at(&written))?;
    hand_over::read(bytes).map_err(|error| Failure::Found(format!("{cdylib}: {error}")))
}

/// Loads a library and writes what it hands over: in the child.
///
/// # Errors
/// When it cannot be loaded, or hands nothing over.
pub fn load(library: &Path, written: &Path) -> Outcome {
    let failed =
        |error: libloading::Error| Failure::Found(format!("{}: {error}", library.display()));
    type HandOver = unsafe extern "C" fn(*mut usize) -> *const u8;
    // SAFETY: a library of our exporter, which has nothing that runs when it is loaded; what else its author has linked in
    // runs in this process alone, which has no other task.
    let loaded = unsafe { libloading::Library::new(library) }.map_err(failed)?;
    // SAFETY: the exporter's macro gives the function of this name this type.
    let hand_over = unsafe { loaded.get::<HandOver>(hand_over::SYMBOL.as_bytes()) };
    let hand_over = hand_over.map_err(|_| {
        Failure::Found(format!(
            "{} hands no interface over: expected `fmu_export::export!(Model);` in it",
            library.display()
        ))
    })?;
    let mut length = 0;
    // SAFETY: the length is writable; the bytes live as long as the library.
    let bytes = unsafe {
        let begin = hand_over(&raw mut length);
        std::slice::from_raw_parts(begin, length)
    };
    std::fs::write(written, bytes).map_err(at(written))
}
