//! Why a call was refused.

use crate::Real;
use admittance::{Law, ParameterError};
use core::ffi::c_char;
use fmu_declaration::check::Expected;
use fmu_declaration::{Access, Variable as Row};

/// What a call returns. Everything but `Ok` changed nothing, but that a tick left its outputs without torque.
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
    /// There is no variable of this number: it is beyond the last.
    NoSuchVariable = 6,
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
    name: &'static str,
    axis: i32,
    value: Real,
    expected: Expected,
}

impl Bad {
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
                expected: Expected::Text("a finite value"),
            })
    }

    /// The measured time `dt` (s) in sample periods of `T` (s); or the time, if no clock can have measured it.
    pub(crate) fn periods(dt: f64, T: Real) -> Result<Real, Self> {
        if dt >= 0.0 && dt.is_finite() {
            return Ok(dt as Real / T);
        }
        Err(Self {
            name: "dt",
            axis: 0,
            value: dt as Real,
            expected: Expected::Text("a finite time, not negative"),
        })
    }

    /// A law that is not offered.
    fn law(number: i32, expected: &'static str) -> Self {
        Self {
            name: "law",
            axis: 0,
            value: number as Real, // a small number: exact also in single precision
            expected: Expected::Text(expected),
        }
    }
}

impl From<ParameterError> for Bad {
    fn from(error: ParameterError) -> Self {
        match error {
            ParameterError::OutOfRange {
                name,
                axis,
                value,
                expected,
            } => Self {
                name,
                axis: axis.and_then(|axis| i32::try_from(axis).ok()).unwrap_or(0),
                value,
                expected,
            },
            ParameterError::NotOffered(law) => Self::law(law.number(), Law::OFFERED),
            ParameterError::NoServoForm(law) => Self::law(law.number(), Law::WITH_SERVO_FORM),
            ParameterError::UnknownLaw(number) => Self::law(number, Law::OFFERED),
        }
    }
}

impl From<Bad> for Refusal {
    fn from(bad: Bad) -> Self {
        Self {
            name: text(bad.name),
            expected: words(bad.expected),
            axis: bad.axis,
            value: bad.value,
        }
    }
}

/// The Booleans of an interface's struct: 0 is false, 1 is true, anything else is refused.
pub(crate) fn truths<M>(of: &M, rows: &[Row<M>]) -> Result<(), Bad> {
    for row in rows {
        if let Access::Boolean { at } = &row.access {
            let value = at.word(of, 0);
            if value != 0 && value != 1 {
                return Err(Bad {
                    name: row.base_name(),
                    axis: 0,
                    value: value as Real,
                    expected: Expected::Truth,
                });
            }
        }
    }
    Ok(())
}

/// The text's bytes as far as they fit, zeros behind them and at least one.
pub(crate) fn text<const N: usize>(from: &str) -> [c_char; N] {
    let mut words = Words::new();
    words.add(from);
    words.bytes
}

/// What was expected, in words.
fn words<const N: usize>(expected: Expected) -> [c_char; N] {
    let mut words = Words::new();
    match expected {
        Expected::Text(text) => words.add(text),
        Expected::Integers(low, i32::MAX) => {
            words.number(low);
            words.add(" or more");
        }
        Expected::Integers(low, high) => {
            words.number(low);
            words.add(" to ");
            words.number(high);
        }
        Expected::Truth => words.add("0 (false) or 1 (true)"),
        Expected::Item(of) => {
            for (i, item) in of.items.iter().enumerate() {
                words.add(if i == 0 { "" } else { ", " });
                words.number(item.value);
                words.add(" (");
                words.add(item.name);
                words.add(")");
            }
        }
    }
    words.bytes
}

/// A text that grows as far as it fits, without the formatting of the standard library, which can panic.
struct Words<const N: usize> {
    bytes: [c_char; N],
    length: usize,
}

impl<const N: usize> Words<N> {
    fn new() -> Self {
        Self {
            bytes: [0; N],
            length: 0,
        }
    }

    fn add(&mut self, text: &str) {
        let room = N.saturating_sub(1);
        let free = self.bytes.iter_mut().take(room).skip(self.length);
        for (to, from) in free.zip(text.bytes()) {
            *to = from as c_char;
            self.length += 1;
        }
    }

    fn number(&mut self, number: i32) {
        if number < 0 {
            self.add("-");
        }
        let size = number.unsigned_abs();
        let mut power = 1;
        while size / power >= 10 {
            power *= 10;
        }
        while power > 0 {
            let digit = DIGITS.get((size / power % 10) as usize);
            self.add(digit.copied().unwrap_or_default());
            power /= 10;
        }
    }
}

const DIGITS: [&str; 10] = ["0", "1", "2", "3", "4", "5", "6", "7", "8", "9"];
