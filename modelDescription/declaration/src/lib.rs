//! Declare once: a model's variables, one row each.
//!
//! A row says what a variable is (name, causality, variability, unit, range, description) and where it lives in the
//! model (the path of a field). The C interface reads and writes through these rows; the
//! `modelDescription.xml`, the interface document, the C header and the guid are written from them. Start values are
//! the model's [`Default`].
//!
//! ```
//! use fmu_declaration::{Declare, Description, Experiment, Rows, Start, Stepping};
//!
//! #[derive(Rows, Start)]
//! struct Lag {
//!     /// Input.
//!     #[input(0)]
//!     u: f64,
//!     /// Output, tau dy/dt = u - y.
//!     #[output(1)]
//!     y: f64,
//!     /// Time constant.
//!     #[parameter(2, unit = SECOND, range = POSITIVE, start = 0.5)]
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
//! assert_eq!(Lag::DESCRIPTION.scalars().nth(1).unwrap().name(), "y");
//! assert_eq!(Lag::default().tau, 0.5);
//! ```
//!
//! The items of a choice are declared by [`choices!`].
//!
//! | module | what |
//! |---|---|
//! | [`variable`] | the row: [`Variable`], its type, causality, variability |
//! | [`place`] | where its values lie in the model |
//! | [`integer`] | the types of integers |
//! | [`mod@range`] | what a number may be |
//! | [`mod@unit`] | units with their SI base exponents |
//! | [`compose`] | rows of parts and of arrays of parts |
//! | [`check`] | a struct's values held against its rows |
//! | [`description`] | the model as a whole: [`Description`], [`Declare`], default experiment |
//! | [`guid`] | what identifies an interface |
//! | `read_back` | declarations that were written as bytes (feature `serde`) |
//! | [`provenance`] | version and git hash, which every FMU has beside its rows |
//!
//! Without the feature `std` there are no strings and no guid, and nothing needs a heap: for a control law, whose
//! parameters are rows too.

#![cfg_attr(not(feature = "std"), no_std)]

extern crate self as fmu_declaration;

mod brief;
pub mod check;
pub mod compose;
pub mod description;
#[cfg(feature = "std")]
pub mod guid;
pub mod integer;
pub mod place;
#[cfg(feature = "std")]
pub mod provenance;
pub mod range;
#[cfg(feature = "serde")]
pub mod read_back;
mod rows;
pub mod unit;
pub mod variable;

pub use brief::Brief;
pub use compose::Rows;
pub use description::{Declare, Description, Experiment, Scalar, Stepping};
pub use fmu_declaration_derive::{Rows, Start};
pub use integer::IntegerType;
pub use place::{Place, Value};
#[cfg(feature = "std")]
pub use provenance::Provenance;
pub use range::Range;
pub use unit::Unit;
pub use variable::{Access, Causality, Declared, Enumeration, Item, Of, Variability, Variable};
