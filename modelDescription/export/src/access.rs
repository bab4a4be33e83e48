//! Get and Set by value reference: checked against the rows first, written afterwards.

use crate::failure::{Failure, Outcome};
use crate::ffi::ValueReference;
use crate::instance::{Instance, refused};
use crate::kind::{Kind, TIME};
use crate::legality::Phase;
use crate::model::{Model, Refusal};
use crate::provenance::text;
use fmu_declaration::{Access, Brief, Causality, Enumeration, Place, Provenance, Range, Variable};
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

/// Checks every parameter against its row, as Set does: for models that are also used without the C interface, whose
/// fields anyone can write.
///
/// # Errors
/// A [`Refusal`] that names the first parameter outside of its row's bounds, its value and what was expected.
pub fn check_parameters<M: Model>(model: &M) -> Result<(), Refusal> {
    check(model, Causality::Parameter)
}

/// Checks every variable of a causality against its row, as Set does.
///
/// # Errors
/// As for [`check_parameters`].
pub(crate) fn check<M: Model>(model: &M, causality: Causality) -> Result<(), Refusal> {
    fn first<M, V: Value>(
        model: &M,
        at: &Place<M, V>,
        row: &Variable<M>,
    ) -> Option<(usize, String)> {
        let objections = at.values(model).map(|value| value.objection(row));
        objections.enumerate().find_map(|(i, o)| Some((i, o?)))
    }
    for row in M::DESCRIPTION.variables {
        if row.causality != causality {
            continue;
        }
        let objection = match &row.access {
            Access::Real { at, .. } => first(model, at, row),
            Access::Integer { at, .. } | Access::Enumeration { at, .. } => first(model, at, row),
            Access::Wide { at, .. } => first(model, at, row),
            Access::Binary { at, .. } => first(model, at, row),
            Access::Boolean { at } => (0..row.len)
                .find_map(|i| Some((i, boolean(at.word(model, i)).err()?.objection(row)))),
            Access::String { .. } => None,
        };
        if let Some((i, objection)) = objection {
            return Err(Refusal(format!("{} {objection}", row.element_name(i))));
        }
    }
    Ok(())
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

/// Why what the model computes is refused.
const COMPUTED: &str = "is computed by the model: it cannot be set";

#[cold]
fn unknown<T, M: Model>(reference: ValueReference) -> Result<T, Failure> {
    refused(format!(
        "value reference {reference} is not one of {}",
        M::DESCRIPTION.name
    ))
}

#[cold]
fn another_type<T, K: Kind>(name: &str, reference: ValueReference) -> Result<T, Failure> {
    refused(format!(
        "{name} (value reference {reference}) is not of type {}",
        K::NAME
    ))
}

/// The row that a value reference stands for in the interface of `K`, and its first element.
#[inline]
pub(crate) fn find<K: Kind, M: Model>(
    reference: ValueReference,
) -> Option<(&'static Variable<M>, usize)> {
    M::DESCRIPTION
        .find(reference)
        .filter(|&(_, element)| K::SCALAR || element == 0)
}

/// Why a variable cannot be set in this phase, if it cannot.
fn not_settable<M>(variable: &Variable<M>, phase: Phase) -> Option<&'static str> {
    match variable.causality {
        Causality::Input => None,
        Causality::Parameter if variable.is_tunable() || phase != Phase::StepComplete => None,
        Causality::Parameter => {
            Some("is a fixed parameter: it can be set before the end of Initialization Mode only")
        }
        Causality::Output | Causality::Local | Causality::CalculatedParameter => Some(COMPUTED),
    }
}

impl<M: Model> Instance<M> {
    /// The value of a variable that has no row: what the library was built from, or the time. An error where `reference` is
    /// none of them.
    #[cold]
    fn without_row<K: Kind>(&self, reference: ValueReference) -> Result<K::Value, Failure> {
        let (name, value) = match Provenance::find(reference) {
            Some(of) => (of.name(), K::Value::of_text(text(of))),
            None if reference == TIME && !K::SCALAR => ("time", K::of_time(self.time())),
            None => return unknown::<_, M>(reference),
        };
        value.map_or_else(|| another_type::<_, K>(name, reference), Ok)
    }

    /// How many values the references stand for.
    ///
    /// # Errors
    /// The first that stands for none, or for values of another type.
    pub(crate) fn count<K: Kind>(&self, references: &[ValueReference]) -> Result<usize, Failure> {
        let mut count = 0;
        for &reference in references {
            count += match find::<K, M>(reference) {
                Some((row, _)) if K::is(&row.access) => K::len(row),
                Some((row, element)) => {
                    return another_type::<_, K>(&shown::<K, M>(row, element), reference);
                }
                None => self.without_row::<K>(reference).map(|_| 1)?,
            };
        }
        Ok(count)
    }

    /// The functions that get: calls `put(i, value)` for each value, in the order of the references.
    pub(crate) fn get<K: Kind>(
        &mut self,
        references: &[ValueReference],
        mut put: impl FnMut(usize, K::Value),
    ) -> Outcome {
        if self.now.phase == Phase::InitializationMode {
            // All are looked up before anything is computed: a refused Get changes nothing.
            self.count::<K>(references)?;
            // What cannot be initialized yet still shows its values; leaving Initialization Mode says what is wrong.
            let _ = self.initialize();
        }
        let mut next = 0;
        for (i, &reference) in references.iter().enumerate() {
            let first = if K::SCALAR { i } else { next };
            if let Some(value) = self.quick::<K>(reference) {
                put(first, value);
                next = first + 1;
                continue;
            }
            let Some((row, element)) = find::<K, M>(reference) else {
                put(first, self.without_row::<K>(reference)?);
                next = first + 1;
                continue;
            };
            let Some(at) = K::at(&row.access) else {
                return another_type::<_, K>(&shown::<K, M>(row, element), reference);
            };
            K::visit(row, element, first, |element, i| {
                put(i, at.get(&self.now.model, element));
                None::<()>
            });
            next = first + K::len(row);
        }
        Ok(())
    }

    /// The functions that set. `value(i)` is the i-th value in the order of the references, or why it is none. All values
    /// are checked before the first is written.
    pub(crate) fn set<K: Kind, E: NoValue>(
        &mut self,
        references: &[ValueReference],
        value: impl Fn(usize) -> Result<K::Value, E>,
    ) -> Outcome {
        if self.set_inputs::<K, E>(references, &value) {
            return Ok(());
        }
        let phase = self.now.phase;
        let mut tuned = false;
        let mut next = 0;
        for (i, &reference) in references.iter().enumerate() {
            let Some((variable, element)) = find::<K, M>(reference) else {
                return match Provenance::find(reference) {
                    Some(of) => refused(format!("{} {COMPUTED}", of.name())),
                    None if reference == TIME && !K::SCALAR => {
                        refused("time is the independent variable: it cannot be set".into())
                    }
                    None => unknown::<_, M>(reference),
                };
            };
            if !K::is(&variable.access) {
                return another_type::<_, K>(&shown::<K, M>(variable, element), reference);
            }
            let first = if K::SCALAR { i } else { next };
            next = first + K::len(variable);
            let objection = K::visit(variable, element, first, |element, i| {
                let objection = match (not_settable(variable, phase), value(i)) {
                    (Some(reason), _) => Some(reason.to_owned()),
                    (None, Err(none)) => Some(none.objection(variable)),
                    (None, Ok(value)) => value.objection(variable),
                };
                objection.map(|objection| (element, objection))
            });
            if let Some((element, objection)) = objection {
                return refused(format!("{} {objection}", variable.element_name(element)));
            }
            tuned |= variable.is_tunable();
        }
        let tuned_in_run = tuned && phase == Phase::StepComplete;
        let before = tuned_in_run.then(|| self.now.model.clone());
        let mut next = 0;
        for (i, &reference) in references.iter().enumerate() {
            let Some((row, element)) = find::<K, M>(reference) else {
                continue;
            };
            let first = if K::SCALAR { i } else { next };
            next = first + K::len(row);
            K::visit(row, element, first, |element, i| {
                if let (Ok(value), Some(at)) = (value(i), K::at(&row.access)) {
                    at.set(&mut self.now.model, element, value);
                }
                None::<()>
            });
        }
        self.stale |= phase == Phase::InitializationMode;
        if let Some(before) = before {
            let (model, mut log) = self.model_and_log();
            if let Err(refusal) = model.tune(&mut log) {
                self.now.model = before;
                return refused(refusal.0);
            }
        }
        Ok(())
    }
}

/// The name of what a value reference stands for.
#[cold]
fn shown<K: Kind, M: Model>(row: &Variable<M>, element: usize) -> String {
    if K::SCALAR {
        row.element_name(element)
    } else {
        row.full_name().trim_end_matches("[i]").to_owned()
    }
}
