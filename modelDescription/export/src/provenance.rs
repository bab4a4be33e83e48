//! What the library was built from, readable as the variables that [`fmu_declaration::provenance`] declares. It is the model's
//! package that has a version, so [`export!`](crate::export) looks, which is expanded there, and tells.

use fmu_declaration::Provenance;
use std::sync::OnceLock;

/// What a library was built from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Source {
    /// Version of the model's package.
    pub version: &'static str,
    /// Commit of the model's source: `FMU_GIT_HASH` in the environment of the build; cargo builds anew when it changes.
    pub git_hash: Option<&'static str>,
}

static TOLD: OnceLock<Source> = OnceLock::new();

/// Says what the library was built from. Before anything can be read; only the first time counts.
pub fn tell(source: Source) {
    let _ = TOLD.set(source);
}

/// The value of the variable; `unknown` where nothing was told.
pub fn text(of: Provenance) -> &'static str {
    let told = TOLD.get();
    let text = match of {
        Provenance::Version => told.map(|source| source.version),
        Provenance::GitHash => told.and_then(|source| source.git_hash),
    };
    text.unwrap_or("unknown")
}

/// The [`Source`] of the crate in which it is expanded.
#[doc(hidden)]
#[macro_export]
macro_rules! built_from {
    () => {
        $crate::provenance::Source {
            version: env!("CARGO_PKG_VERSION"),
            git_hash: option_env!("FMU_GIT_HASH"),
        }
    };
}
