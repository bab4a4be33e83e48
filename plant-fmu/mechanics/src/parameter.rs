//! Parameter ranges, checked when a plant is built.

use core::fmt;

/// What a parameter may be: `low ..= high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Name in the interface, for instance `wall.k`.
    pub variable: &'static str,
    /// Unit of value and bounds.
    pub unit: &'static str,
    /// Smallest accepted value.
    pub low: f64,
    /// Largest accepted value.
    pub high: f64,
}

impl Range {
    /// Accepts `value` if it lies in the range; NaN does not.
    ///
    /// # Errors
    /// [`ParameterError::OutOfRange`].
    pub fn check(self, value: f64) -> Result<(), ParameterError> {
        if self.low <= value && value <= self.high {
            Ok(())
        } else {
            Err(ParameterError::OutOfRange { range: self, value })
        }
    }
}

/// Why a plant cannot be built.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParameterError {
    /// A parameter lies outside its range.
    OutOfRange {
        /// Variable and what was expected.
        range: Range,
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

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange {
                range:
                    Range {
                        variable,
                        unit,
                        low,
                        high,
                    },
                value,
            } => {
                write!(
                    f,
                    "{variable} = {value:?} {unit}: expected {low:?} to {high:?} {unit}"
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

    const RANGE: Range = Range {
        variable: "M",
        unit: "kg",
        low: 0.5,
        high: 2.0,
    };

    #[test]
    fn bounds_belong_to_the_range_and_nan_does_not() {
        for value in [0.5, 1.0, 2.0] {
            assert_eq!(RANGE.check(value), Ok(()));
        }
        for value in [0.499, 2.001, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(RANGE.check(value).is_err(), "{value}");
        }
    }
}
