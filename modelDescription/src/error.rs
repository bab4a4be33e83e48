//! What a declaration got wrong, in words that name the row.

use crate::entry::Kind;
use crate::name::LONGEST_MODEL_NAME;
use fmu_declaration::description::SCALARS_PER_ROW;
use fmu_declaration::{Brief, Causality, Experiment, Stepping, Variability, provenance};

/// What a declaration got wrong.
#[derive(Clone, Debug, thiserror::Error)]
pub enum Error {
    /// The model's name is no C identifier, or no file can have it.
    #[error(
        "model name {0:?}: expected a C identifier of at most {LONGEST_MODEL_NAME} letters, no keyword of C and no device of Windows"
    )]
    ModelName(&'static str),
    /// The default experiment is not finite, ends before it starts, or has a step or tolerance that is not positive.
    #[error(
        "default experiment: expected finite times, start < stop, step and tolerance normal numbers > 0, got {0:?}"
    )]
    Experiment(Experiment),
    /// More rows than value references.
    #[error("{0} rows: expected at most {max}", max = provenance::ROW)]
    Rows(usize),
    /// Some rows bear numbers and others do not, or the numbers do not ascend.
    #[error("{row}: expected a number above that of the row before it, or none on any row")]
    Numbers {
        /// The first row out of order.
        row: &'static str,
    },
    /// The row's length is 0, above 256, or not that of its field.
    #[error("{row}: expected 1 to {most} scalars, as many as its field has, got {declared} for {held}", most = SCALARS_PER_ROW)]
    Length {
        /// Row.
        row: &'static str,
        /// Length in the row.
        declared: usize,
        /// Length of the field.
        held: usize,
    },
    /// A vector's name lacks `[i]`, or a scalar's has it.
    #[error("{row}: expected [i] in the name of a vector and of no scalar, got length {len}")]
    VectorName {
        /// Row.
        row: &'static str,
        /// Length.
        len: usize,
    },
    /// The standard, or the way the model steps, does not allow this combination.
    #[error(
        "{row}: {causality:?} and {variability:?} do not go together here (only Reals are Continuous; inputs and \
         outputs are Discrete or Continuous, of a Sampled model Discrete: write discrete in its attribute, or #[rows(discrete)] above the \
         struct; parameters are Fixed or Tunable; this model is {stepping:?})"
    )]
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
    #[error("{row}: expected items of ascending value and different names in {enumeration}")]
    Items {
        /// Row.
        row: &'static str,
        /// Type.
        enumeration: &'static str,
    },
    /// `initially_from` stands at a row that is neither output nor calculated parameter, or names a row that is
    /// neither input nor parameter.
    #[error(
        "{row}: initially_from {from}: expected an output or calculated parameter that names rows of inputs or parameters"
    )]
    InitiallyFrom {
        /// Row.
        row: &'static str,
        /// Name in `initially_from`.
        from: &'static str,
    },
    /// Not a name of the structured naming convention.
    #[error("{row:?}: expected a name like energy.H or tau_a[1]")]
    Name {
        /// Scalar.
        row: String,
    },
    /// Two names that differ in case only, or not at all.
    #[error("{row}: expected a name that differs from {other} in more than case")]
    SameName {
        /// Scalar.
        row: String,
        /// The scalar before it.
        other: String,
    },
    /// Two units of one name.
    #[error("{row}: expected one definition of the unit {unit}, got two")]
    Unit {
        /// Scalar.
        row: String,
        /// Name of the unit.
        unit: &'static str,
    },
    /// A display unit that no value can be shown in.
    #[error(
        "{row}: display unit {display}: expected a finite factor other than 0 and a finite offset, got {factor:?} and {offset:?}"
    )]
    Display {
        /// Scalar.
        row: String,
        /// Name of the display unit.
        display: &'static str,
        /// Its factor.
        factor: f64,
        /// Its offset.
        offset: f64,
    },
    /// A text that XML cannot carry or does not give back, or a name that is empty.
    #[error("{row}: {what} {text:?}: expected one line without control characters{or_empty}", or_empty = if text.is_empty() { ", not empty" } else { "" })]
    Text {
        /// Scalar, or the model.
        row: String,
        /// Whose text it is.
        what: &'static str,
        /// The text.
        text: String,
    },
    /// Two enumeration types of one name.
    #[error("{row}: expected one definition of the type {name}, got two")]
    Type {
        /// Scalar.
        row: String,
        /// Name of the type.
        name: &'static str,
    },
    /// A variable named like an enumeration type.
    #[error("{row}: expected a name that no enumeration type has")]
    TypeAndVariable {
        /// Scalar.
        row: String,
    },
    /// Bounds that no value lies within, or that are not finite.
    #[error(
        "{row}: expected finite bounds, of which the first is not above the second, got {low} to {high}"
    )]
    Bounds {
        /// Scalar.
        row: String,
        /// The smallest value.
        low: Brief<f64>,
        /// The largest value.
        high: Brief<f64>,
    },
    /// A start value that is not finite, outside of its bounds, or no item.
    #[error("{row}: expected a start value within its bounds, got {kind}")]
    Start {
        /// Scalar.
        row: String,
        /// Type, bounds and start value.
        kind: Box<Kind>,
    },
}
