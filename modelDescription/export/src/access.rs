//! Get and Set by value reference: checked against the rows first, written afterwards.

use crate::failure::{Failure, Outcome};
use crate::ffi::ValueReference;
use crate::instance::{Instance, refused};
use crate::legality::Phase;
use crate::model::{Model, Refusal};
use crate::provenance::text;
use fmu_declaration::{Access, Causality, Of, Place, Provenance, Range, Variable};

/// A type of the interface: its name, and what a row demands of a value.
pub trait Value: fmu_declaration::Value {
    /// Name in the standard.
    const TYPE: &'static str;

    /// Where the row's values are, if the row is of this type.
    fn at<M>(access: &Access<M>) -> Option<&Place<M, Self>>;

    /// What is wrong with the value, if anything.
    fn objection<M>(&self, row: &Variable<M>) -> Option<String>;

    /// A constant text as a value, if this is the type for texts.
    fn of_text(_: &'static str) -> Option<Self> {
        None
    }
}

impl Value for f64 {
    const TYPE: &'static str = "Real";

    fn at<M>(access: &Access<M>) -> Option<&Place<M, Self>> {
        Self::of(access)
    }

    #[inline]
    fn objection<M>(&self, row: &Variable<M>) -> Option<String> {
        let Access::Real { unit, range, .. } = &row.access else {
            return None;
        };
        if range.contains(*self) || (row.may_be_nan && !self.is_finite()) {
            return None;
        }
        Some(out_of_range(*self, unit.name, range))
    }
}

#[cold]
fn out_of_range(value: f64, unit: &str, range: &Range) -> String {
    let Range { low, high, .. } = range;
    if value.is_finite() {
        format!("= {value} {unit}, expected a value from {low} to {high}")
    } else {
        format!("= {value} {unit}, expected a finite value")
    }
}

impl Value for i32 {
    const TYPE: &'static str = "Integer";

    fn at<M>(access: &Access<M>) -> Option<&Place<M, Self>> {
        Self::of(access)
    }

    fn objection<M>(&self, row: &Variable<M>) -> Option<String> {
        match &row.access {
            Access::Integer { min, max, .. } if self < min || self > max => {
                Some(format!("= {self}, expected a value from {min} to {max}"))
            }
            Access::Enumeration { of, .. } if !of.items.iter().any(|item| item.value == *self) => {
                let items: Vec<_> = of
                    .items
                    .iter()
                    .map(|item| format!("{} {}", item.value, item.name))
                    .collect();
                Some(format!(
                    "= {self}, expected an item of {}: {}",
                    of.name,
                    items.join(", ")
                ))
            }
            _ => None,
        }
    }
}

impl Value for bool {
    const TYPE: &'static str = "Boolean";

    fn at<M>(access: &Access<M>) -> Option<&Place<M, Self>> {
        Self::of(access)
    }

    fn objection<M>(&self, _: &Variable<M>) -> Option<String> {
        None
    }
}

impl Value for String {
    const TYPE: &'static str = "String";

    fn at<M>(access: &Access<M>) -> Option<&Place<M, Self>> {
        Self::of(access)
    }

    fn objection<M>(&self, _: &Variable<M>) -> Option<String> {
        None
    }

    fn of_text(text: &'static str) -> Option<Self> {
        Some(text.to_owned())
    }
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
            Access::Boolean { at } => {
                (0..row.len).find_map(|i| Some((i, boolean(at.word(model, i)).err()?.to_string())))
            }
            Access::String { .. } => None,
        };
        if let Some((i, objection)) = objection {
            return Err(Refusal(format!("{} {objection}", row.element_name(i))));
        }
    }
    Ok(())
}

/// What was given for a value and is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NoValue {
    /// A Boolean other than 0 and 1. 0x100 may be a word that nobody wrote, and `engage` must not be on then. The C library
    /// says the same.
    Word(i32),
    /// A pointer that is null, or text in another encoding.
    Text,
}

impl core::fmt::Display for NoValue {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Word(word) => write!(f, "= {word}, expected 0 or 1"),
            Self::Text => f.write_str("is null or not UTF-8, expected a UTF-8 string"),
        }
    }
}

/// The Boolean that a word stands for.
///
/// # Errors
/// It stands for none.
pub(crate) fn boolean(word: i32) -> Result<bool, NoValue> {
    match word {
        0 => Ok(false),
        1 => Ok(true),
        _ => Err(NoValue::Word(word)),
    }
}

/// Why what the model computes is refused.
const COMPUTED: &str = "is computed by the model: it cannot be set";

/// The text of a variable that says what the library was built from; an error where `reference` is none of them.
#[cold]
fn constant<M: Model, V: Value>(reference: ValueReference) -> Result<V, Failure> {
    match Provenance::find(reference) {
        None => unknown::<_, M>(reference),
        Some(of) => match V::of_text(text(of)) {
            Some(value) => Ok(value),
            None => another_type::<_, V>(of.name(), reference),
        },
    }
}

#[cold]
fn unknown<T, M: Model>(reference: ValueReference) -> Result<T, Failure> {
    refused(format!(
        "value reference {reference} is not one of {}",
        M::DESCRIPTION.name
    ))
}

#[cold]
fn another_type<T, V: Value>(name: &str, reference: ValueReference) -> Result<T, Failure> {
    refused(format!(
        "{name} (value reference {reference}) is not of type {}",
        V::TYPE
    ))
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
    /// fmi2GetReal, fmi2GetInteger, fmi2GetBoolean, fmi2GetString: calls `put(i, value)` for each reference.
    pub(crate) fn get<V: Value>(
        &mut self,
        references: &[ValueReference],
        mut put: impl FnMut(usize, V),
    ) -> Outcome {
        if self.now.phase == Phase::InitializationMode {
            // All are looked up before anything is computed: a refused Get changes nothing.
            for &reference in references {
                match M::DESCRIPTION.find(reference) {
                    Some((row, element)) if V::at(&row.access).is_none() => {
                        return another_type::<_, V>(&row.element_name(element), reference);
                    }
                    Some(_) => {}
                    None => drop(constant::<M, V>(reference)?),
                }
            }
            // What cannot be initialized yet still shows its values; fmi2ExitInitializationMode says what is wrong.
            let _ = self.initialize();
        }
        for (i, &reference) in references.iter().enumerate() {
            match M::DESCRIPTION.find(reference) {
                Some((variable, element)) => match V::at(&variable.access) {
                    Some(at) => put(i, at.get(&self.now.model, element)),
                    None => {
                        return another_type::<_, V>(&variable.element_name(element), reference);
                    }
                },
                None => put(i, constant::<M, V>(reference)?),
            }
        }
        Ok(())
    }

    /// fmi2SetReal, fmi2SetInteger, fmi2SetBoolean, fmi2SetString. `value(i)` is the i-th value, or why it is none. All
    /// values are checked before the first is written.
    pub(crate) fn set<V: Value>(
        &mut self,
        references: &[ValueReference],
        value: impl Fn(usize) -> Result<V, NoValue>,
    ) -> Outcome {
        let phase = self.now.phase;
        let mut tuned = false;
        for (i, &reference) in references.iter().enumerate() {
            let Some((variable, element)) = M::DESCRIPTION.find(reference) else {
                return match Provenance::find(reference) {
                    Some(of) => refused(format!("{} {COMPUTED}", of.name())),
                    None => unknown::<_, M>(reference),
                };
            };
            if V::at(&variable.access).is_none() {
                return another_type::<_, V>(&variable.element_name(element), reference);
            }
            let objection = match (not_settable(variable, phase), value(i)) {
                (Some(reason), _) => Some(reason.to_owned()),
                (None, Err(none)) => Some(none.to_string()),
                (None, Ok(value)) => value.objection(variable),
            };
            if let Some(objection) = objection {
                return refused(format!("{} {objection}", variable.element_name(element)));
            }
            tuned |= variable.is_tunable();
        }
        let tuned_in_run = tuned && phase == Phase::StepComplete;
        let before = tuned_in_run.then(|| self.now.model.clone());
        for (i, &reference) in references.iter().enumerate() {
            let place = M::DESCRIPTION.find(reference);
            let place = place.and_then(|(row, element)| Some((V::at(&row.access)?, element)));
            if let (Some((at, element)), Ok(value)) = (place, value(i)) {
                at.set(&mut self.now.model, element, value);
            }
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
