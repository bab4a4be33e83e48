//! Declare once: a model's variables, one row each.
//!
//! A row says what a variable is (name, causality, variability, unit, bounds, description) and where it lives in the
//! model (a function that borrows it). The C interface reads and writes through these rows; the
//! `modelDescription.xml`, the interface document, the C header and the guid are written from them. Start values are
//! the model's [`Default`].
//!
//! ```
//! use declaration::{real, Declare, Description, Experiment, Stepping, Variable, Variability::*, unit};
//!
//! #[derive(Default)]
//! struct Lag { u: f64, y: f64, tau: f64 }
//!
//! impl Declare for Lag {
//!     const DESCRIPTION: Description<Self> = Description {
//!         name: "Lag",
//!         about: "First-order lag",
//!         stepping: Stepping::Exact,
//!         experiment: Experiment { start: 0.0, stop: 1.0, tolerance: 1e-6, step: 0.01 },
//!         variables: &[
//!             real!(u, unit::NONE).input(Continuous).about("input"),
//!             real!(y, unit::NONE).output(Continuous).about("output, tau dy/dt = u - y"),
//!             real!(tau, unit::SECOND).parameter(Fixed).within(0.0, 10.0).about("time constant"),
//!         ],
//!     };
//! }
//! assert_eq!(Lag::DESCRIPTION.scalars().nth(1).unwrap().name(), "y");
//! ```
//!
//! | module | what |
//! |---|---|
//! | [`variable`] | the row: [`Variable`], its type, causality, variability |
//! | [`mod@unit`] | units with their SI base exponents |
//! | [`description`] | the model as a whole: [`Description`], [`Declare`], default experiment, guid |
//! | [`provenance`] | version and git hash, which every FMU has beside its rows |

pub mod description;
pub mod provenance;
mod rows;
pub mod unit;
pub mod variable;

pub use description::{Declare, Description, Experiment, Scalar, Stepping};
pub use provenance::Provenance;
pub use unit::Unit;
pub use variable::{Access, Causality, Declared, Enumeration, Item, Variability, Variable};
