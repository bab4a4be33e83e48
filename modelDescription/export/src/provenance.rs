//! What the library was built from, readable as the variables that [`fmu_declaration::provenance`] declares.

use fmu_declaration::Provenance;

/// The value of the variable. The git hash is that of `EXO_GIT_HASH` in the environment of the build; cargo builds
/// anew when it changes.
pub fn text(of: Provenance) -> &'static str {
    match of {
        Provenance::Version => env!("CARGO_PKG_VERSION"),
        Provenance::GitHash => match option_env!("EXO_GIT_HASH") {
            Some(hash) => hash,
            None => "unknown",
        },
    }
}
