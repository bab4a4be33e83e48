//! Writes what belongs in an FMU archive, from a model's [`fmu_declaration`] alone.
//!
//! ```
//! use fmu_declaration::{Declare, Description, Experiment, Rows, Start, Stepping};
//! use fmu_archive::{Interface, archive::{self, Contents}};
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
//! let xml = fmu_archive::xml(&interface);
//! assert!(xml.contains(r#"<ScalarVariable name="tau" valueReference="512""#));
//! assert!(xml.contains(r#"<Unknown index="2" dependencies="1" dependenciesKind="dependent"/>"#));
//!
//! let fmu: Vec<u8> = archive::write(&Contents::of(&interface)).unwrap();
//! assert_eq!(fmu, archive::write(&Contents::of(&interface)).unwrap(), "two archives, same bytes");
//! ```
//!
//! | module | what | where in the archive | FMI 2.0.5 |
//! |---|---|---|---|
//! | [`interface`], [`entry`] | the declaration read once, the model's type gone | | 2.2 |
//! | [`rules`], [`error`] | every rule that a declaration can break, and what is said of it | | 2.2 |
//! | [`name`] | names of the structured naming convention | | 2.2.9 |
//! | [`schema`], [`mod@xml`] | the XML's elements, and their contents | `modelDescription.xml` | 2.2, 4.3.1 |
//! | [`standard`] | FMI 2.0 or 3.0, co-simulation or scheduled execution | | |
//! | [`arrays`], [`schema3`], [`xml3`] | the same for FMI 3.0, where a row is one variable | `modelDescription.xml` | 3.0: 2.4 |
//! | [`terminals`] | what is connected by one line, and the icons | `terminalsAndIcons/` | 3.0: 2.4.9 |
//! | [`mod@document`] | the interface document for humans | `documentation/index.html` | 2.3 |
//! | `html` | its pieces | | |
//! | [`guide`] | what the rows cannot tell: what it does, picture, wiring | in the document | |
//! | [`quick_start`] | first steps in a few tools | in the document | |
//! | [`product`] | what is delivered, as licences and bill of materials name it | | |
//! | [`component`], [`mod@sbom`] | what is linked in, and its bill of materials | `documentation/sbom.cdx.json` | |
//! | [`licences`] | licence texts of all that is linked in | `documentation/licenses/` | 2.3 |
//! | [`mod@header`] | value references for C programs | `documentation/<name>.h` | |
//! | [`archive`] | the archive, the same bytes every time | `<name>.fmu` | 2.3 |
//!
//! No model is known here. The list of this project's FMUs is the package `fmus`.

pub mod archive;
pub mod arrays;
pub mod component;
mod deviations;
pub mod document;
pub mod entry;
pub mod error;
pub mod guide;
pub mod header;
mod html;
pub mod interface;
pub mod licences;
pub mod name;
pub mod product;
pub mod quick_start;
pub mod rules;
pub mod sbom;
pub mod schema;
pub mod schema3;
pub mod standard;
pub mod terminals;
mod variables;
pub mod xml;
pub mod xml3;

pub use component::Component;
pub use document::write as document;
pub use error::Error;
pub use guide::{Connection, Guide, System};
pub use header::write as header;
pub use interface::Interface;
pub use product::Product;
pub use sbom::write as sbom;
pub use standard::Standard;
pub use terminals::{Matching, Member, Terminal};
pub use xml::write as xml;

/// Version of the FMUs and of this tool: the workspace has one.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Licence of the FMUs, as an SPDX expression.
pub const LICENSE: &str = env!("CARGO_PKG_LICENSE");
