//! Rows as the calls of FMI 2.0 want them: found by number in one look, side by side in memory. A loop over FMUs gets all
//! outputs at every step; the rows themselves, with their texts, lie a cache line or three apart.
//!
//! What a slot does not know, or does not allow, goes the long way by the row, which says why.

use crate::instance::Instance;
use crate::kind::Kind;
use crate::legality::Phase;
use crate::model::Model;
use crate::value::Value;
use fmu_declaration::description::SCALARS_PER_ROW;
use fmu_declaration::{Access, Causality, IntegerType, Place, Variable};

/// Rows with a number beyond this have no slot.
const MOST: u32 = 4096;

/// Where a row's values are.
pub enum At<M> {
    /// Of fmi2Real.
    Real(Place<M, f64>),
    /// Of fmi2Integer, items of enumerations among them.
    Whole(Place<M, i32>),
    /// Of fmi2Boolean.
    Flag(Place<M, bool>),
    /// No row, or one without a slot.
    Nothing,
}

/// A row.
pub(crate) struct Slot<M> {
    at: At<M>,
    /// its [`interval`]; low > high where it has none
    low: f64,
    high: f64,
}

/// A slot, with the place of its row's values of a type.
type Found<'a, M, K> = (&'a Slot<M>, &'a Place<M, <K as Kind>::Value>);

/// All rows of a model, by number.
pub(crate) struct Slots<M: Model>(Box<[Slot<M>]>);

impl<M> Slot<M> {
    const NOTHING: Self = Self {
        at: At::Nothing,
        low: f64::INFINITY,
        high: f64::NEG_INFINITY,
    };

    /// Whether it is an input that takes `value` (a number of its type).
    #[inline]
    fn takes(&self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }
}

/// What a row may be set to at any time (a number of its type), whatever else holds: an input's range, finite. None where its
/// row has to say: of another causality, or of a type that is smaller than its value.
pub(crate) fn interval<M>(row: &Variable<M>) -> Option<(f64, f64)> {
    let (low, high) = match &row.access {
        Access::Real { at, range, .. } if !at.is_single() => (range.low, range.high),
        Access::Integer { at, min, max } if at.integer_type() == IntegerType::Int32 => {
            ((*min).into(), (*max).into())
        }
        Access::Boolean { .. } => (0.0, 1.0),
        _ => return None,
    };
    (row.causality == Causality::Input).then_some((low.max(f64::MIN), high.min(f64::MAX)))
}

impl<M: Model> Slots<M> {
    /// Those of the model's rows.
    pub fn new() -> Self {
        let mut slots = Vec::new();
        for scalar in M::DESCRIPTION.scalars() {
            let (row, number) = (scalar.variable, scalar.row);
            if scalar.element > 0 || number > MOST {
                continue;
            }
            let at = match row.access {
                Access::Real { at, .. } => At::Real(at),
                Access::Integer { at, .. } | Access::Enumeration { at, .. } => At::Whole(at),
                Access::Boolean { at } => At::Flag(at),
                Access::String { .. } | Access::Wide { .. } | Access::Binary { .. } => continue,
            };
            let (low, high) = interval(row).unwrap_or((f64::INFINITY, f64::NEG_INFINITY));
            let place = number as usize;
            if slots.len() <= place {
                slots.resize_with(place + 1, || Slot::NOTHING);
            }
            slots[place] = Slot { at, low, high };
        }
        Self(slots.into())
    }

    /// The slot of a value reference, if its row is of this type.
    #[inline]
    fn find<K: Kind>(&self, reference: u32) -> Option<Found<'_, M, K>> {
        let slot = self.0.get((reference / SCALARS_PER_ROW) as usize)?;
        Some((slot, K::quick(&slot.at)?))
    }
}

impl<M: Model> Slots<M> {
    /// The value of a variable that has a slot.
    #[inline]
    fn get<K: Kind>(&self, model: &M, reference: u32) -> Option<K::Value> {
        let (_, at) = self.find::<K>(reference)?;
        at.find(model, reference % SCALARS_PER_ROW)
    }

    /// Sets inputs, if all references are such and all values will do; else nothing.
    #[inline]
    fn set<K: Kind, E>(
        &self,
        model: &mut M,
        references: &[u32],
        value: &impl Fn(usize) -> Result<K::Value, E>,
    ) -> bool {
        let takes = |(i, reference): (usize, &u32)| {
            let element = (reference % SCALARS_PER_ROW) as usize;
            match (self.find::<K>(*reference), value(i)) {
                (Some((slot, at)), Ok(value)) if element < at.len() => {
                    value.number().is_some_and(|number| slot.takes(number))
                }
                _ => false,
            }
        };
        if !references.iter().enumerate().all(takes) {
            return false;
        }
        for (i, reference) in references.iter().enumerate() {
            let element = (reference % SCALARS_PER_ROW) as usize;
            if let (Some((_, at)), Ok(value)) = (self.find::<K>(*reference), value(i)) {
                at.set(model, element, value);
            }
        }
        true
    }
}

impl<M: Model> Instance<M> {
    /// The value of a variable that has a slot.
    #[inline]
    pub(crate) fn quick<K: Kind>(&self, reference: u32) -> Option<K::Value> {
        self.slots.get::<K>(&self.now.model, reference)
    }

    /// Sets inputs, if all references are such and all values will do; else nothing.
    #[inline]
    pub(crate) fn set_inputs<K: Kind, E>(
        &mut self,
        references: &[u32],
        value: &impl Fn(usize) -> Result<K::Value, E>,
    ) -> bool {
        let all = (self.slots).set::<K, E>(&mut self.now.model, references, value);
        self.stale |= all && self.now.phase == Phase::InitializationMode;
        all
    }
}

#[cfg(test)]
mod tests {
    use super::Slots;
    use crate::kind::fmi2::{Boolean, Integer, Real};
    use crate::{Log, Model, Refusal, Step};
    use fmu_declaration::Variability::{Continuous, Fixed};
    use fmu_declaration::place::of_field;
    use fmu_declaration::{
        Access, Declare, Description, Experiment, Range, Stepping, Variable, real, unit,
    };

    #[derive(Clone, Default, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
    struct Mixed {
        u: [f64; 2],
        gain: f64,
        y: [f64; 3],
    }

    const WITHIN: Range = Range {
        low: -1.0,
        high: 1.0,
        expected: "a value from -1 to 1",
    };

    impl Declare for Mixed {
        const DESCRIPTION: Description<Self> = Description {
            name: "Mixed",
            about: "rows with gaps in their numbers",
            stepping: Stepping::Exact,
            experiment: Experiment {
                start: 0.0,
                stop: 1.0,
                tolerance: 1e-6,
                step: 0.1,
            },
            variables: &[
                Variable::new(
                    "u[i]",
                    Access::Real {
                        unit: unit::NEWTON,
                        range: WITHIN,
                        at: of_field(core::mem::offset_of!(Self, u), |m: &Self| &m.u),
                    },
                )
                .input(Continuous)
                .numbered(0),
                real!(gain, unit::NEWTON).parameter(Fixed).numbered(5),
                real!(y[3], unit::NEWTON).output(Continuous).numbered(7),
            ],
        };
    }

    impl Model for Mixed {
        fn initialize(&mut self, _: f64, _: &mut Log<'_>) -> Result<(), Refusal> {
            Ok(())
        }

        fn step(&mut self, _: Step, _: &mut Log<'_>) -> Result<(), Refusal> {
            Ok(())
        }
    }

    const MODEL: Mixed = Mixed {
        u: [0.25, -0.5],
        gain: 3.0,
        y: [7.0, 8.0, 9.0],
    };

    #[test]
    fn a_slot_shows_what_its_row_shows_and_no_reference_beside_one_shows_anything() {
        let slots = Slots::<Mixed>::new();
        for scalar in Mixed::DESCRIPTION.scalars() {
            let Access::Real { at, .. } = scalar.variable.access else {
                panic!("a Real")
            };
            let shown = slots.get::<Real>(&MODEL, scalar.reference());
            assert_eq!(shown, Some(at.get(&MODEL, scalar.element)));
            assert_eq!(slots.get::<Integer>(&MODEL, scalar.reference()), None);
            assert_eq!(slots.get::<Boolean>(&MODEL, scalar.reference()), None);
        }
        for reference in [
            2,
            255,
            256,
            5 * 256 + 1,
            6 * 256,
            7 * 256 + 3,
            8 * 256,
            u32::MAX,
        ] {
            assert_eq!(slots.get::<Real>(&MODEL, reference), None, "{reference}");
        }
    }

    #[test]
    fn inputs_are_set_together_or_not_at_all() {
        let slots = Slots::<Mixed>::new();
        let set = |references: &[u32], values: &[f64]| {
            let mut model = MODEL;
            let value = |i: usize| Ok::<_, ()>(values[i]);
            let all = slots.set::<Real, ()>(&mut model, references, &value);
            (all, model)
        };
        let (all, model) = set(&[1, 0], &[1.0, -1.0]);
        assert!(all && model.u == [-1.0, 1.0]);
        // Out of its range, no number, a parameter, an output, no element, no row: the row has to say why.
        for (reference, value) in [
            (1, 1.5),
            (1, f64::NAN),
            (1, f64::INFINITY),
            (5 * 256, 0.5),
            (7 * 256, 0.5),
            (2, 0.5),
            (3 * 256, 0.5),
        ] {
            assert_eq!(
                set(&[0, reference], &[0.75, value]),
                (false, MODEL),
                "{reference} {value}"
            );
        }
    }
}
