//! A struct's values held against its rows.

use crate::unit::NONE;
use crate::{Access, Causality, Enumeration, Variable};

/// A value that its row does not accept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Objection {
    /// The row's name, without `[i]`.
    pub name: &'static str,
    /// The element, from 1; `None` for a scalar.
    pub element: Option<usize>,
    /// The value; of a Binary its size.
    pub value: f64,
    /// What was expected.
    pub expected: Expected,
    /// Unit of the value and of the bounds.
    pub unit: &'static str,
    /// Smallest value that the row accepts.
    pub low: f64,
    /// Largest value that the row accepts.
    pub high: f64,
}

/// What a row accepts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expected {
    /// A number, in words.
    Text(&'static str),
    /// An integer from the first to the second.
    Integers(i32, i32),
    /// 0 or 1.
    Truth,
    /// One of an enumeration's items.
    Item(&'static Enumeration),
}

/// The first value in `model` that one of its `rows` does not accept, of the rows with this `causality`; of those that can
/// be tuned alone if `tunable`.
///
/// # Errors
/// The row, the value and what was expected.
pub fn first<M>(
    model: &M,
    rows: &[Variable<M>],
    causality: Causality,
    tunable: bool,
) -> Result<(), Objection> {
    for row in rows {
        if row.causality != causality || (tunable && !row.is_tunable()) {
            continue;
        }
        for i in 0..row.len {
            let Some((value, expected)) = objection(model, row, i) else {
                continue;
            };
            let (unit, low, high) = bounds(row);
            return Err(Objection {
                name: row.base_name(),
                element: (row.len > 1).then_some(i + 1),
                value,
                expected,
                unit,
                low,
                high,
            });
        }
    }
    Ok(())
}

/// Unit, smallest and largest accepted value of a row.
fn bounds<M>(row: &Variable<M>) -> (&'static str, f64, f64) {
    match &row.access {
        Access::Real { unit, range, .. } => (unit.name, range.low, range.high),
        Access::Integer { min, max, .. } => (NONE.name, (*min).into(), (*max).into()),
        Access::Wide { min, max, .. } => (NONE.name, min.get() as f64, max.get() as f64),
        Access::Enumeration { of, .. } => {
            let item = |item: Option<&crate::Item>| item.map_or(f64::NAN, |item| item.value.into());
            (NONE.name, item(of.items.first()), item(of.items.last()))
        }
        Access::Boolean { .. } => (NONE.name, 0.0, 1.0),
        #[cfg(feature = "std")]
        Access::String { .. } => (NONE.name, f64::NAN, f64::NAN),
        #[cfg(feature = "std")]
        Access::Binary { max_size, .. } => (
            NONE.name,
            0.0,
            max_size.map_or(f64::INFINITY, |most| most as f64),
        ),
    }
}

/// The value of element `i` and what was expected, if the row does not accept it.
fn objection<M>(model: &M, row: &Variable<M>, i: usize) -> Option<(f64, Expected)> {
    match &row.access {
        Access::Real { range, at, .. } => {
            let value = at.get(model, i);
            let range = if at.is_single() {
                range.single()
            } else {
                *range
            };
            let accepted = range.contains(value) || (row.may_be_nan && !value.is_finite());
            (!accepted).then_some((value, Expected::Text(range.expected)))
        }
        Access::Integer { min, max, at } => {
            let value = at.get(model, i);
            let accepted = (*min..=*max).contains(&value);
            (!accepted).then_some((f64::from(value), Expected::Integers(*min, *max)))
        }
        Access::Wide { min, max, at } => {
            let value = at.get(model, i);
            let accepted = (min.get()..=max.get()).contains(&value);
            (!accepted).then_some((value as f64, Expected::Text("an integer within the bounds")))
        }
        Access::Boolean { at } => {
            let word = at.word(model, i);
            let accepted = word == 0 || word == 1;
            (!accepted).then_some((f64::from(word), Expected::Truth))
        }
        #[cfg(feature = "std")]
        Access::String { .. } => None,
        #[cfg(feature = "std")]
        Access::Binary { max_size, at, .. } => {
            let most = max_size.unwrap_or(usize::MAX);
            let size = at.get(model, i).len();
            (size > most).then_some((size as f64, Expected::Text("no more bytes than the bound")))
        }
        Access::Enumeration { of, at, .. } => {
            let value = at.get(model, i);
            let accepted = of.items.iter().any(|item| item.value == value);
            (!accepted).then_some((f64::from(value), Expected::Item(of)))
        }
    }
}

impl From<&'static str> for Expected {
    fn from(text: &'static str) -> Self {
        Self::Text(text)
    }
}

impl core::fmt::Display for Expected {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Text(text) => f.write_str(text),
            Self::Integers(low, i32::MAX) => write!(f, "{low} or more"),
            Self::Integers(low, high) if *high == low + 1 => write!(f, "{low} or {high}"),
            Self::Integers(low, high) => write!(f, "{low} to {high}"),
            Self::Truth => f.write_str("0 or 1"),
            Self::Item(of) => {
                for (i, item) in of.items.iter().enumerate() {
                    let separator = if i == 0 { "" } else { ", " };
                    write!(f, "{separator}{} ({})", item.value, item.name)?;
                }
                Ok(())
            }
        }
    }
}
