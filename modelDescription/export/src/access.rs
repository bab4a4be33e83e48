//! Get and Set by value reference: checked against the rows first, written afterwards.

use crate::failure::{Failure, Outcome};
use crate::ffi::ValueReference;
use crate::instance::{Instance, refused};
use crate::kind::{Kind, TIME};
use crate::legality::Phase;
use crate::model::{Model, Refusal};
use crate::provenance::text;
pub use crate::value::Value;
use crate::value::{NoValue, boolean};
use fmu_declaration::{Access, Causality, Place, Provenance, Variable};

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
