//! All FMUs with their models: the only package that depends on every one of them.
//!
//! The list itself is [`fmus::each`]. What goes through the names alone depends on that package, which depends on nothing; what
//! needs the types goes through the same list with [`FMUS`] or with a macro of its own:
//!
//! ```
//! for fmu in catalogue::FMUS {
//!     let interface = fmu.interface().expect("a legal declaration");
//!     assert_eq!(interface.name, fmu.name);
//! }
//! ```
//!
//! | module | what |
//! |---|---|
//! | [`fmu`] | the list with types, and the committed descriptions |
//! | [`wiring`] | which output belongs to which input |
//! | [`terminals`] | the same by terminals, for FMI 3.0 |
//! | [`table`] | what the C host must know of an FMU |
//! | [`header`] | the C header of the law's library |
//! | [`laws`] | the table of the laws in docs/controllers.md |
//! | [`package`] | whose they are: version, copyright, licence |
//! | [`extra`] | what else goes into an archive: the references |
//! | [`request`] | what `cargo xtask` asks for: archives from libraries |
//!
//! The program `catalogue` answers `cargo xtask`, which so compiles without any model.

pub mod extra;
pub mod fmu;
pub mod header;
pub mod laws;
pub mod package;
#[cfg(test)]
mod pictures;
pub mod request;
pub mod table;
pub mod terminals;
pub mod wiring;

pub use fmu::{FMUS, Fmu};
pub use package::PACKAGE;

/// The crates of the models, for macros that go through the list.
pub mod models {
    macro_rules! crates {
        ($($crate_name:ident::$Type:ident, picture $picture:literal;)*) => {
            $(pub use $crate_name;)*
        };
    }

    fmus::each!(crates);
}

/// The folder of the workspace.
pub fn root() -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .components()
        .collect()
}
