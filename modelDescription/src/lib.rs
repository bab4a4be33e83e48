//! Writes what belongs in an FMU archive, from a model's [`fmu_declaration`] alone.
//!
//! ```
//! use fmu_declaration::{Declare, Description, Experiment, Rows, Start, Stepping};
//! use fmu_archive::{Interface, Package, archive::{self, Contents}};
//!
//! #[derive(Rows, Start)]
//! struct Lag {
//!     /// Input.
//!     #[input(0)]
//!     u: f64,
//!     /// Output.
//!     #[output(1, from = ["u"])]
//!     y: f64,
//!     /// Time constant.
//!     #[parameter(2, unit = SECOND, range = 0.0..)]
//!     tau: f64,
//! }
//!
//! impl Declare for Lag {
//!     const DESCRIPTION: Description<Self> = Description {
//!         name: "Lag",
//!         about: "First-order lag",
//!         stepping: Stepping::Exact,
//!         experiment: Experiment { start: 0.0, stop: 1.0, tolerance: 1e-6, step: 0.01 },
//!         variables: Self::ROWS,
//!     };
//! }
//!
//! let interface = Interface::of::<Lag>().unwrap();
//! let package = Package { version: "1.0.0", license: "MIT", ..Package::default() };
//! let xml = fmu_archive::xml(&interface, package);
//! assert!(xml.contains(r#"<ScalarVariable name="tau" valueReference="512""#));
//! assert!(xml.contains(r#"<Unknown index="2" dependencies="1" dependenciesKind="dependent"/>"#));
//!
//! let contents = Contents { package, ..Contents::of(&interface) };
//! let fmu: Vec<u8> = archive::write(&contents).unwrap();
//! assert_eq!(fmu, archive::write(&contents).unwrap(), "two archives, same bytes");
//! ```
//!
//! | module | what | where in the archive | FMI 2.0.5 |
//! |---|---|---|---|
//! | [`interface`], [`entry`] | the declaration read once, the model's type gone | | 2.2 |
//! | [`rules`], [`error`] | every rule that a declaration can break, and what is said of it | | 2.2 |
//! | [`hand_over`] | the interface as bytes, from a library to who packs it | | |
//! | [`name`] | names of the structured naming convention | | 2.2.9 |
//! | [`schema`], [`mod@xml`] | the XML's elements, and their contents | `modelDescription.xml` | 2.2, 4.3.1 |
//! | [`standard`] | FMI 2.0 or 3.0, co-simulation or scheduled execution | | |
//! | [`arrays`], [`schema3`], [`xml3`] | the same for FMI 3.0, where a row is one variable | `modelDescription.xml` | 3.0: 2.4 |
//! | [`terminals`] | what is connected by one line, and the icons | `terminalsAndIcons/` | 3.0: 2.4.9 |
//! | [`mod@document`] | the interface document for humans | `documentation/index.html` | 2.3 |
//! | `html` | its pieces | | |
//! | [`guide`] | what the rows cannot tell: what it does, picture, wiring | in the document | |
//! | [`quick_start`] | first steps in a few tools | in the document | |
//! | [`package`] | whose the model is: version, author, copyright, licence | in all of them | |
//! | [`product`] | what is delivered, as licences and bill of materials name it | | |
//! | [`component`], [`mod@sbom`] | what is linked in, and its bill of materials | `documentation/sbom.cdx.json` | |
//! | [`licences`] | licence texts of all that is linked in | `documentation/licenses/` | 2.3 |
//! | [`mod@header`] | value references for C programs | `documentation/<name>.h` | |
//! | [`archive`] | the archive, the same bytes every time | `<name>.fmu` | 2.3 |
//!
//! No model is known here. The list of this project's FMUs is the package `fmus`.

#[cfg(feature = "write")]
pub mod archive;
pub mod arrays;
pub mod component;
#[cfg(feature = "write")]
mod deviations;
#[cfg(feature = "write")]
pub mod document;
pub mod entry;
pub mod error;
#[cfg(feature = "write")]
pub mod guide;
pub mod hand_over;
#[cfg(feature = "write")]
pub mod header;
#[cfg(feature = "write")]
mod html;
pub mod interface;
#[cfg(feature = "write")]
pub mod licences;
pub mod name;
#[cfg(feature = "write")]
pub mod package;
#[cfg(feature = "write")]
pub mod product;
#[cfg(feature = "write")]
pub mod quick_start;
pub mod rules;
#[cfg(feature = "write")]
pub mod sbom;
#[cfg(feature = "write")]
pub mod schema;
#[cfg(feature = "write")]
pub mod schema3;
#[cfg(feature = "write")]
pub mod standard;
#[cfg(feature = "write")]
pub mod terminals;
mod texts;
#[cfg(feature = "write")]
mod variables;
#[cfg(feature = "write")]
pub mod xml;
#[cfg(feature = "write")]
pub mod xml3;

pub use component::Component;
#[cfg(feature = "write")]
pub use document::write as document;
pub use error::Error;
#[cfg(feature = "write")]
pub use guide::{Connection, Guide, System};
#[cfg(feature = "write")]
pub use header::write as header;
pub use interface::Interface;
#[cfg(feature = "write")]
pub use package::Package;
#[cfg(feature = "write")]
pub use product::Product;
#[cfg(feature = "write")]
pub use sbom::write as sbom;
#[cfg(feature = "write")]
pub use standard::Standard;
#[cfg(feature = "write")]
pub use terminals::{Matching, Member, Terminal};
#[cfg(feature = "write")]
pub use xml::write as xml;

/// Version of this tool.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
