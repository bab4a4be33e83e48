//! Steps: sections 4.2 and 5.2.

use crate::ffi::fmi3::*;
use crate::functions::{known, step};
use crate::guard::guard;
use crate::instance::{Instance, refused};
use crate::kind::CLOCK;
use crate::legality::Advance;
use crate::legality::fmi3::Function as F;
use crate::model::Model;

/// fmi3DoStep: the whole step, without events.
pub unsafe fn do_step<M: Model>(
    c: Component,
    t: Float64,
    h: Float64,
    _no_set_prior: Boolean,
    event_handling_needed: *mut Boolean,
    terminate_simulation: *mut Boolean,
    early_return: *mut Boolean,
    last_successful_time: *mut Float64,
) -> Status {
    // SAFETY: the importer's contract. A step that was made was made by an instance.
    unsafe {
        let (Some(event), Some(terminate), Some(early), Some(last)) = (
            event_handling_needed.as_mut(),
            terminate_simulation.as_mut(),
            early_return.as_mut(),
            last_successful_time.as_mut(),
        ) else {
            return guard::<M, _>(c, F::fmi3DoStep, |_| {
                known(event_handling_needed.as_mut(), "eventHandlingNeeded")?;
                known(terminate_simulation.as_mut(), "terminateSimulation")?;
                known(early_return.as_mut(), "earlyReturn")?;
                known(last_successful_time.as_mut(), "lastSuccessfulTime").map(|_| ())
            });
        };
        let status = step::<M>(c, Advance::fmi3DoStep, t, h);
        if status == Status::Ok {
            (*event, *terminate, *early) = (0, 0, 0);
            *last = (*c.cast::<Instance<M>>()).now.clock.time();
        }
        status
    }
}

/// fmi3ActivateModelPartition: the tick of one sample period.
pub unsafe fn activate_model_partition<M: Model>(
    c: Component,
    clock: ValueReference,
    t: Float64,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        if clock != CLOCK {
            return guard::<M, _>(c, F::fmi3ActivateModelPartition, |_| {
                refused(format!(
                    "clockReference = {clock}, expected {CLOCK}, that of the variable clock"
                ))
            });
        }
        let period = M::DESCRIPTION.experiment.step;
        step::<M>(c, Advance::fmi3ActivateModelPartition, t, period)
    }
}
