//! A foreign importer loads the built FMUs: the `fmi` crate (0.8), which shares no code with our exporter.
//!
//! The tests are in `tests/fmi_crate.rs`. They read the description, couple controller and testbed, and compare every
//! output with the same models linked into the test, bit for bit; save, restore and serialize the state; and look at
//! what a refused call does.
//!
//! What this importer cannot do, so that it is not tested here:
//! * it reads no units, bounds, display units and no start values of Strings and Enumerations from the description;
//! * it sees `dependencies=""` and missing dependencies alike;
//! * its logger prints through the `log` crate, so that messages cannot be inspected;
//! * it passes neither NULL callbacks nor other spellings of `fmuResourceLocation`.
//!
//! Those are tested by `tests/abi` (C interface) and `tests/system` (fmpy, libcosimpy, XSD).

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
