//! Rows as the calls of FMI 2.0 want them: found by number in one look, side by side in memory. A loop over FMUs gets all
//! outputs at every step; the rows themselves, with their texts, lie a cache line or three apart.
//!
//! What a slot does not know, or does not allow, goes the long way by the row, which says why.

use crate::access::Value;
use crate::instance::Instance;
use crate::kind::Kind;
use crate::legality::Phase;
use crate::model::Model;
use fmu_declaration::description::SCALARS_PER_ROW;
use fmu_declaration::{Access, Causality, Place};

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
    /// What a Real may be set to at any time: an input's range, finite. Else low > high.
    low: f64,
    high: f64,
}

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

impl<M: Model> Slots<M> {
    /// Those of the model's rows.
    pub fn new() -> Self {
        let mut slots = Vec::new();
        for scalar in M::DESCRIPTION.scalars() {
            let (row, number) = (scalar.variable, scalar.row);
            if scalar.element > 0 || number > MOST {
                continue;
            }
            let (at, low, high) = match row.access {
                Access::Real { at, range, .. } => (At::Real(at), range.low, range.high),
                Access::Integer { at, min, max } => (At::Whole(at), min.into(), max.into()),
                Access::Enumeration { at, .. } => (At::Whole(at), 1.0, 0.0),
                Access::Boolean { at } => (At::Flag(at), 0.0, 1.0),
                Access::String { .. } => continue,
            };
            let is_input = row.causality == Causality::Input;
            let place = number as usize;
            if slots.len() <= place {
                slots.resize_with(place + 1, || Slot::NOTHING);
            }
            slots[place] = Slot {
                at,
                low: if is_input {
                    low.max(f64::MIN)
                } else {
                    f64::INFINITY
                },
                high: high.min(f64::MAX),
            };
        }
        Self(slots.into())
    }

    /// The slot of a value reference, with the place of its row's values of this type.
    #[inline]
    fn find<K: Kind>(&self, reference: u32) -> Option<(&Slot<M>, &Place<M, K::Value>)> {
        let slot = self.0.get((reference / SCALARS_PER_ROW) as usize)?;
        Some((slot, K::quick(&slot.at)?))
    }
}

impl<M: Model> Instance<M> {
    /// The value of a variable that has a slot.
    #[inline]
    pub(crate) fn quick<K: Kind>(&self, reference: u32) -> Option<K::Value> {
        let (_, at) = self.slots.find::<K>(reference)?;
        at.find(&self.now.model, reference % SCALARS_PER_ROW)
    }

    /// Sets inputs, if all references are such and all values will do; else nothing.
    #[inline]
    pub(crate) fn set_inputs<K: Kind, E>(
        &mut self,
        references: &[u32],
        value: &impl Fn(usize) -> Result<K::Value, E>,
    ) -> bool {
        let slots = &self.slots;
        let takes = |(i, reference): (usize, &u32)| {
            let element = (reference % SCALARS_PER_ROW) as usize;
            match (slots.find::<K>(*reference), value(i)) {
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
            if let (Some((_, at)), Ok(value)) = (slots.find::<K>(*reference), value(i)) {
                at.set(&mut self.now.model, element, value);
            }
        }
        self.stale |= self.now.phase == Phase::InitializationMode;
        true
    }
}
