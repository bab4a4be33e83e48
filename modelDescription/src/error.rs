//! What a declaration got wrong, in words that name the row.

use crate::entry::Kind;
use core::fmt;
use declaration::description::SCALARS_PER_ROW;
use declaration::{Causality, Experiment, Stepping, Variability, provenance};

/// What a declaration got wrong.
#[derive(Clone, Debug)]
pub enum Error {
    /// The model's name is no C identifier.
    ModelName(&'static str),
    /// The default experiment is not finite, ends before it starts, or has a step or tolerance that is not positive.
    Experiment(Experiment),
    /// More rows than value references.
    Rows(usize),
    /// Some rows bear numbers and others do not, or the numbers do not ascend.
    Numbers {
        /// The first row out of order.
        row: &'static str,
    },
    /// The row's length is 0, above 256, or not that of its field.
    Length {
        /// Row.
        row: &'static str,
        /// Length in the row.
        declared: usize,
        /// Length of the field.
        held: usize,
    },
    /// A vector's name lacks `[i]`, or a scalar's has it.
    VectorName {
        /// Row.
        row: &'static str,
        /// Length.
        len: usize,
    },
    /// The standard, or the way the model steps, does not allow this combination.
    Variability {
        /// Row.
        row: &'static str,
        /// Its causality.
        causality: Causality,
        /// Its variability.
        variability: Variability,
        /// How the model steps.
        stepping: Stepping,
    },
    /// An enumeration without items, or whose items do not ascend, or with two items of one name.
    Items {
        /// Row.
        row: &'static str,
        /// Type.
        enumeration: &'static str,
    },
    /// `initially_from` stands at a row that is neither output nor calculated parameter, or names a row that is
    /// neither input nor parameter.
    InitiallyFrom {
        /// Row.
        row: &'static str,
        /// Name in `initially_from`.
        from: &'static str,
    },
    /// Not a name of the structured naming convention.
    Name {
        /// Scalar.
        row: String,
    },
    /// Two names that differ in case only, or not at all.
    SameName {
        /// Scalar.
        row: String,
        /// The scalar before it.
        other: String,
    },
    /// Two units of one name.
    Unit {
        /// Scalar.
        row: String,
        /// Name of the unit.
        unit: &'static str,
    },
    /// Two enumeration types of one name.
    Type {
        /// Scalar.
        row: String,
        /// Name of the type.
        name: &'static str,
    },
    /// A variable named like an enumeration type.
    TypeAndVariable {
        /// Scalar.
        row: String,
    },
    /// A start value that is not finite, outside of its bounds, or no item.
    Start {
        /// Scalar.
        row: String,
        /// Type, bounds and start value.
        kind: Box<Kind>,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ModelName(name) => write!(f, "model name {name}: expected a C identifier"),
            Self::Experiment(experiment) => {
                write!(
                    f,
                    "default experiment: expected finite times, start < stop, step and tolerance > 0, got {experiment:?}"
                )
            }
            Self::Rows(rows) => write!(f, "{rows} rows: expected at most {}", provenance::ROW),
            Self::Numbers { row } => {
                write!(
                    f,
                    "{row}: expected a number above that of the row before it, or none on any row"
                )
            }
            Self::Length {
                row,
                declared,
                held,
            } => {
                write!(
                    f,
                    "{row}: expected 1 to {SCALARS_PER_ROW} scalars, as many as its field has, got {declared} for {held}"
                )
            }
            Self::VectorName { row, len } => {
                write!(
                    f,
                    "{row}: expected [i] in the name of a vector and of no scalar, got length {len}"
                )
            }
            Self::Variability {
                row,
                causality,
                variability,
                stepping,
            } => write!(
                f,
                "{row}: {causality:?} and {variability:?} do not go together here (only Reals are Continuous; inputs and \
                 outputs are Discrete or Continuous, of a Sampled model Discrete; parameters are Fixed or Tunable; this \
                 model is {stepping:?})"
            ),
            Self::Items { row, enumeration } => {
                write!(
                    f,
                    "{row}: expected items of ascending value and different names in {enumeration}"
                )
            }
            Self::InitiallyFrom { row, from } => write!(
                f,
                "{row}: initially_from {from}: expected an output or calculated parameter that names rows of inputs or parameters"
            ),
            Self::Name { row } => write!(f, "{row}: expected a name like energy.H or tau_a[1]"),
            Self::SameName { row, other } => write!(
                f,
                "{row}: expected a name that differs from {other} in more than case"
            ),
            Self::Unit { row, unit } => write!(
                f,
                "{row}: expected one definition of the unit {unit}, got two"
            ),
            Self::Type { row, name } => write!(
                f,
                "{row}: expected one definition of the type {name}, got two"
            ),
            Self::TypeAndVariable { row } => {
                write!(f, "{row}: expected a name that no enumeration type has")
            }
            Self::Start { row, kind } => write!(
                f,
                "{row}: expected a start value within its bounds, got {kind:?}"
            ),
        }
    }
}

impl std::error::Error for Error {}
