//! Whose this project's FMUs are.

use fmu_archive::Package;

/// What every archive, and what goes with the C library, says of this project.
pub const PACKAGE: Package<'static> = Package {
    version: env!("CARGO_PKG_VERSION"),
    author: "",
    copyright: "Copyright the authors of this project",
    license: env!("CARGO_PKG_LICENSE"),
    texts: &[
        ("LICENSE-MIT", include_bytes!("../../../LICENSE-MIT")),
        ("LICENSE-APACHE", include_bytes!("../../../LICENSE-APACHE")),
    ],
};
