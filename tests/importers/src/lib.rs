//! A foreign importer loads the built FMUs: the `fmi` crate (0.8), which shares no code with our exporter.
//!
//! | module | what |
//! |---|---|
//! | [`imported`] | an instance by variable name |
//! | [`record`] | inputs and outputs as a table in a file |
//!
//! The program `fmi_crate` runs one FMU with the inputs of a file; `tests/system/test_trajectories.py` lets fmpy,
//! libcosim and this program run each FMU with the same file and compares the outputs.
//!
//! `tests/fmi_crate.rs` couples controller and testbed and compares every output with the same models linked into the
//! test, bit for bit; saves, restores and serializes the state; and looks at what a refused call does.
//! `tests/descriptions.rs` reads the description of every FMU, and shows which valid descriptions this importer refuses.
//!
//! `tests/fmi3.rs` lets it call the archives of FMI 3.0.
//!
//! What this importer cannot do, so that it is not tested here:
//! * it reads no units, bounds, display units and no start values of Strings and Enumerations from the description;
//! * it sees `dependencies=""` and missing dependencies alike;
//! * its logger prints through the `log` crate, so that messages cannot be inspected;
//! * it passes neither NULL callbacks nor other spellings of `fmuResourceLocation`.
//!
//! Those are tested by `tests/abi` (C interface) and `tests/system` (fmpy, libcosimpy, XSD).

pub mod imported;
pub mod record;

pub use imported::{Imported, Type, Variable};

use std::path::{Path, PathBuf};

/// Path of a built archive.
///
/// # Panics
/// When it is not built.
pub fn archive(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../target/fmu")
        .join(name)
        .with_extension("fmu");
    assert!(
        path.is_file(),
        "target/fmu/{name}.fmu is not there: run `cargo xtask fmu` first"
    );
    path
}
