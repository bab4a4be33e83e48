//! Values, what a row demands of them, and what is none although it was given for one.

use fmu_declaration::{Access, Brief, Enumeration, Range, Variable};
use std::convert::Infallible;

/// A value of the interface, and what a row demands of it.
pub trait Value: fmu_declaration::Value {
    /// What is wrong with the value, if anything.
    fn objection<M>(&self, row: &Variable<M>) -> Option<String>;

    /// The value as a number, if it is one that a row may bound.
    fn number(&self) -> Option<f64> {
        None
    }

    /// A constant text as a value, if this is the type for texts.
    fn of_text(_: &'static str) -> Option<Self> {
        None
    }
}

impl Value for f64 {
    #[inline]
    fn objection<M>(&self, row: &Variable<M>) -> Option<String> {
        let Access::Real { unit, range, at } = &row.access else {
            return None;
        };
        // The common case alone, so that it costs little.
        if range.contains(*self) && !at.is_single() {
            return None;
        }
        real_objection(*self, unit.name, range, at.is_single(), row.may_be_nan)
    }

    #[inline]
    fn number(&self) -> Option<f64> {
        Some(*self)
    }
}

#[inline(never)]
fn real_objection(
    value: f64,
    unit: &str,
    range: &Range,
    single: bool,
    may_be_nan: bool,
) -> Option<String> {
    // As it will be stored: what is too large for single precision is infinite there.
    let stored = f64::from(value as f32);
    let accepted = single && range.single().contains(stored);
    if accepted || (may_be_nan && !value.is_finite()) {
        return None;
    }
    if single && value.is_finite() && stored.is_infinite() {
        return Some(beyond_single(value, unit));
    }
    Some(out_of_range(value, unit, range))
}

/// A unit behind its number; nothing behind one without a dimension.
pub(crate) fn behind(unit: &str) -> String {
    match unit {
        "1" => String::new(),
        unit => format!(" {unit}"),
    }
}

#[cold]
fn beyond_single(value: f64, unit: &str) -> String {
    let largest = f32::MAX;
    format!(
        "= {value:?}{}, expected at most {largest:?} in magnitude, as single precision holds",
        behind(unit)
    )
}

#[cold]
fn out_of_range(value: f64, unit: &str, range: &Range) -> String {
    let (Range { low, high, .. }, unit) = (range, behind(unit));
    if value.is_finite() {
        let (value, low, high) = (Brief(value), Brief(*low), Brief(*high));
        format!("= {value}{unit}, expected a value from {low} to {high}")
    } else {
        format!("= {value}{unit}, expected a finite value")
    }
}

impl Value for i32 {
    fn objection<M>(&self, row: &Variable<M>) -> Option<String> {
        match &row.access {
            Access::Integer { min, max, .. } if self < min || self > max => {
                Some(format!("= {self}, expected a value from {min} to {max}"))
            }
            Access::Enumeration { of, .. } if !of.items.iter().any(|item| item.value == *self) => {
                Some(no_item((*self).into(), of))
            }
            _ => None,
        }
    }

    #[inline]
    fn number(&self) -> Option<f64> {
        Some((*self).into())
    }
}

impl Value for i128 {
    fn objection<M>(&self, row: &Variable<M>) -> Option<String> {
        match &row.access {
            Access::Wide { min, max, .. } if *self < min.get() || *self > max.get() => {
                let (min, max) = (min.get(), max.get());
                Some(format!("= {self}, expected a value from {min} to {max}"))
            }
            Access::Enumeration { of, .. }
                if !of.items.iter().any(|item| i128::from(item.value) == *self) =>
            {
                Some(no_item(*self, of))
            }
            _ => None,
        }
    }
}

#[cold]
fn no_item(value: i128, of: &Enumeration) -> String {
    let items: Vec<_> = of
        .items
        .iter()
        .map(|item| format!("{} {}", item.value, item.name))
        .collect();
    format!(
        "= {value}, expected an item of {}: {}",
        of.name,
        items.join(", ")
    )
}

impl Value for bool {
    fn objection<M>(&self, _: &Variable<M>) -> Option<String> {
        None
    }

    #[inline]
    fn number(&self) -> Option<f64> {
        Some((*self).into())
    }
}

impl Value for String {
    fn objection<M>(&self, _: &Variable<M>) -> Option<String> {
        None
    }

    fn of_text(text: &'static str) -> Option<Self> {
        Some(text.to_owned())
    }
}

impl Value for Vec<u8> {
    fn objection<M>(&self, row: &Variable<M>) -> Option<String> {
        match row.access {
            Access::Binary {
                max_size: Some(most),
                ..
            } if self.len() > most => Some(too_long(self.len(), most)),
            _ => None,
        }
    }
}

#[cold]
fn too_long(size: usize, most: usize) -> String {
    format!("has {size} bytes, expected at most {most}")
}

/// What was given for a value and is none.
pub(crate) trait NoValue {
    /// What is wrong with it as a value of this row.
    fn objection<M>(self, row: &Variable<M>) -> String;
}

/// Where all that can be given is a value.
impl NoValue for Infallible {
    fn objection<M>(self, _: &Variable<M>) -> String {
        match self {}
    }
}

/// A Boolean other than 0 and 1. 0x100 may be a word that nobody wrote, and `engage` must not be on then. The C library
/// says the same.
pub(crate) struct Word(i32);

impl NoValue for Word {
    #[cold]
    fn objection<M>(self, _: &Variable<M>) -> String {
        format!("= {}, expected 0 or 1", self.0)
    }
}

/// A null pointer to so many bytes.
pub(crate) struct NoBytes(pub usize);

impl NoValue for NoBytes {
    #[cold]
    fn objection<M>(self, _: &Variable<M>) -> String {
        format!("is null, expected {} bytes", self.0)
    }
}

/// A pointer that is null, or text in another encoding.
pub(crate) struct NoText;

impl NoValue for NoText {
    #[cold]
    fn objection<M>(self, _: &Variable<M>) -> String {
        "is null or not UTF-8, expected a UTF-8 string".into()
    }
}

/// The Boolean that a word stands for.
///
/// # Errors
/// It stands for none.
pub(crate) fn boolean(word: i32) -> Result<bool, Word> {
    match word {
        0 => Ok(false),
        1 => Ok(true),
        _ => Err(Word(word)),
    }
}
