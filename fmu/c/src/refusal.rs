//! Why a call was refused.

use crate::Real;
use admittance::{Law, ParameterError};
use core::ffi::c_char;

/// What a call returns; everything but `Ok` changed nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum Status {
    /// Done.
    Ok = 0,
    /// A pointer is null.
    Null = 1,
    /// A pointer is not aligned as its type asks.
    Misaligned = 2,
    /// The state has not been initialized by the function that belongs to it.
    NotInitialized = 3,
    /// A value is out of its range, or an input not finite: the refusal says which.
    Refused = 4,
    /// The tick's result is not finite: numbers overflow.
    NotFinite = 5,
}

/// Which value was refused. All texts end with a zero byte.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Refusal {
    /// The variable, by its name in the FMU; empty if none was refused.
    pub name: [c_char; 40],
    /// What it should have been.
    pub expected: [c_char; 120],
    /// Its axis or joint, from 1; 0 if it has none.
    pub axis: i32,
    /// Its value.
    pub value: Real,
}

impl Default for Refusal {
    /// Nothing.
    fn default() -> Self {
        Self {
            name: [0; 40],
            expected: [0; 120],
            axis: 0,
            value: 0.0,
        }
    }
}

/// A value out of its range, inside the library.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bad {
    pub(crate) name: &'static str,
    pub(crate) axis: i32,
    pub(crate) value: Real,
    pub(crate) expected: &'static str,
}

impl Bad {
    /// The choice `name` with the number `value`, which is none of those `expected`.
    pub(crate) fn choice(name: &'static str, value: i32, expected: &'static str) -> Self {
        Self {
            name,
            axis: 0,
            value: value as Real, // choices are small numbers: exact also in single precision
            expected,
        }
    }

    /// The first of the sensed values that is not finite.
    pub(crate) fn sensed(name: &'static str, values: &[Real]) -> Option<Self> {
        let axis = |axis| if values.len() > 1 { axis } else { 0 };
        (1..)
            .zip(values)
            .find(|(_, value)| !value.is_finite())
            .map(|(number, value)| Self {
                name,
                axis: axis(number),
                value: *value,
                expected: "a finite value",
            })
    }

    /// A parameter error under the names of the interface, which `rename` knows.
    pub(crate) fn from_law(
        error: ParameterError,
        rename: fn(&'static str) -> &'static str,
    ) -> Self {
        let law = |law: Law| Self::choice("law", law.number(), Law::OFFERED);
        match error {
            ParameterError::OutOfRange {
                name,
                axis,
                value,
                expected,
            } => Self {
                name: rename(name),
                axis: axis.and_then(|axis| i32::try_from(axis).ok()).unwrap_or(0),
                value,
                expected,
            },
            ParameterError::NotOffered(comparator) => law(comparator),
            ParameterError::NoServoForm(without) => law(without),
            ParameterError::UnknownLaw(number) => Self::choice("law", number, Law::OFFERED),
        }
    }
}

impl From<Bad> for Refusal {
    fn from(bad: Bad) -> Self {
        Self {
            name: text(bad.name),
            expected: text(bad.expected),
            axis: bad.axis,
            value: bad.value,
        }
    }
}

/// The text's bytes as far as they fit, zeros behind them and at least one.
fn text<const N: usize>(from: &str) -> [c_char; N] {
    let mut bytes = [0; N];
    let room = N.saturating_sub(1);
    for (to, from) in bytes.iter_mut().take(room).zip(from.bytes()) {
        *to = from as c_char;
    }
    bytes
}

/// A Boolean of the interface.
pub(crate) fn truth(name: &'static str, value: i32) -> Result<bool, Bad> {
    match value {
        0 => Ok(false),
        1 => Ok(true),
        other => Err(Bad::choice(name, other, "0 (false) or 1 (true)")),
    }
}
