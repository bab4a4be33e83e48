//! What a parameter may be: the range that its row says, checked when a plant is built.

use core::fmt;
use fmu_declaration::check::{self, Objection};
use fmu_declaration::{Access, Causality, Rows, compose};

/// What a value may be: the range of its row, or the part of it that other parameters leave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The row's name; a vector's may end in `[i]`.
    pub name: &'static str,
    /// The element, from 1; `None` for a scalar.
    pub element: Option<usize>,
    /// Unit of value and bounds.
    pub unit: &'static str,
    /// Smallest accepted value.
    pub low: f64,
    /// Largest accepted value.
    pub high: f64,
}

impl Bounds {
    /// Those of the row `name` of `P`.
    ///
    /// # Panics
    /// When `P` has no Real of this name (at compile time: for constants only).
    pub(crate) const fn of<P: Rows>(name: &str) -> Self {
        let mut i = 0;
        while i < P::ROWS.len() {
            let row = &P::ROWS[i];
            if let (true, Access::Real { unit, range, .. }) =
                (compose::equal(row.name, name), &row.access)
            {
                return Self {
                    name: row.name,
                    element: None,
                    unit: unit.name,
                    low: range.low,
                    high: range.high,
                };
            }
            i += 1;
        }
        panic!("no row has this name")
    }

    /// Those of element `i`, from 0.
    pub(crate) fn element(self, i: usize) -> Self {
        Self {
            element: Some(i + 1),
            ..self
        }
    }

    /// The part from `low` on.
    pub(crate) fn at_least(self, low: f64) -> Self {
        Self {
            low: self.low.max(low),
            ..self
        }
    }

    /// The part up to `high`.
    pub(crate) fn at_most(self, high: f64) -> Self {
        Self {
            high: self.high.min(high),
            ..self
        }
    }

    /// Accepts `value` if it lies within; NaN does not.
    ///
    /// # Errors
    /// [`ParameterError::OutOfRange`].
    pub fn check(self, value: f64) -> Result<(), ParameterError> {
        if self.low <= value && value <= self.high {
            Ok(())
        } else {
            Err(ParameterError::OutOfRange {
                bounds: self,
                value,
            })
        }
    }
}

/// Whether every parameter of `of` lies in the range that its row says.
///
/// # Errors
/// The first, in the order of the rows, that does not.
pub fn in_range<P: Rows>(of: &P) -> Result<(), ParameterError> {
    Ok(check::first(of, P::ROWS, Causality::Parameter, false)?)
}

/// Why a plant cannot be built.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParameterError {
    /// A parameter lies out of its bounds.
    OutOfRange {
        /// Which one, and what was expected.
        bounds: Bounds,
        /// What came.
        value: f64,
    },
    /// The mass would start inside the wall, with energy in it that nobody put there.
    StartBeyondWall {
        /// Start position (m).
        q_start: f64,
        /// Position of the wall (m).
        wall_q: f64,
    },
}

impl From<Objection> for ParameterError {
    fn from(objection: Objection) -> Self {
        Self::OutOfRange {
            bounds: Bounds {
                name: objection.name,
                element: objection.element,
                unit: objection.unit,
                low: objection.low,
                high: objection.high,
            },
            value: objection.value,
        }
    }
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange {
                bounds:
                    Bounds {
                        name,
                        element,
                        unit,
                        low,
                        high,
                    },
                value,
            } => {
                f.write_str(name.strip_suffix("[i]").unwrap_or(name))?;
                if let Some(element) = element {
                    write!(f, "[{element}]")?;
                }
                write!(
                    f,
                    " = {value:?} {unit}: expected {low:?} to {high:?} {unit}"
                )
            }
            Self::StartBeyondWall { q_start, wall_q } => {
                write!(
                    f,
                    "q_start = {q_start:?} m: expected at most wall.q = {wall_q:?} m, the mass starts outside the wall"
                )
            }
        }
    }
}

impl core::error::Error for ParameterError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testbed::Parameters;

    const BOUNDS: Bounds = Bounds::of::<Parameters>("wall.k");

    #[test]
    fn bounds_are_those_of_the_row() {
        assert_eq!((BOUNDS.unit, BOUNDS.low, BOUNDS.high), ("N/m", 1.0, 1e9));
    }

    #[test]
    fn bounds_belong_to_the_range_and_nan_does_not() {
        for value in [1.0, 2.0, 1e9] {
            assert_eq!(BOUNDS.check(value), Ok(()));
        }
        for value in [0.999, 1.1e9, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(BOUNDS.check(value).is_err(), "{value}");
        }
    }
}
