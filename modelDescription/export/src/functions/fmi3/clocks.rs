//! The one clock of a sampled model: section 2.2.9. It is periodic and constant, and its first activation is at the start time.

use crate::failure::Outcome;
use crate::ffi::fmi3::*;
use crate::ffi::{array, array_mut};
use crate::functions::known;
use crate::guard::guard;
use crate::instance::{Instance, refused};
use crate::kind::CLOCK;
use crate::legality::Interface;
use crate::legality::fmi3::Function as F;
use crate::model::Model;

/// Refuses references that are none of a clock.
fn clocks<M: Model>(instance: &Instance<M>, references: &[ValueReference]) -> Outcome {
    let other = references.iter().find(|&&reference| {
        reference != CLOCK || instance.interface() != Interface::ScheduledExecution
    });
    other.map_or(Ok(()), |reference| {
        refused(format!(
            "value reference {reference} is not that of a clock of {}",
            M::DESCRIPTION.name
        ))
    })
}

/// fmi3GetIntervalDecimal: the sample period (s), which never changes.
pub unsafe fn get_interval<M: Model>(
    c: Component,
    references: *const ValueReference,
    n: usize,
    intervals: *mut Float64,
    qualifiers: *mut IntervalQualifier,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M, _>(c, F::fmi3GetIntervalDecimal, |instance| {
            clocks(instance, known(array(references, n), "valueReferences")?)?;
            let intervals = known(array_mut(intervals, n), "intervals")?;
            let qualifiers = known(array_mut(qualifiers, n), "qualifiers")?;
            intervals.fill(M::DESCRIPTION.experiment.step);
            qualifiers.fill(INTERVAL_UNCHANGED);
            Ok(())
        })
    }
}

/// fmi3GetShiftDecimal: 0 s.
pub unsafe fn get_shift<M: Model>(
    c: Component,
    references: *const ValueReference,
    n: usize,
    shifts: *mut Float64,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M, _>(c, F::fmi3GetShiftDecimal, |instance| {
            clocks(instance, known(array(references, n), "valueReferences")?)?;
            known(array_mut(shifts, n), "shifts")?.fill(0.0);
            Ok(())
        })
    }
}
