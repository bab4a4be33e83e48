//! Steps: sections 4.2 and 5.2.

use crate::ffi::fmi3::*;
use crate::functions::{known, step};
use crate::guard::guard;
use crate::instance::{Instance, refused};
use crate::kind::CLOCK;
use crate::legality::Interface;
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
        let targets = (
            event_handling_needed.as_mut(),
            terminate_simulation.as_mut(),
            early_return.as_mut(),
            last_successful_time.as_mut(),
        );
        let (Some(event), Some(terminate), Some(early), Some(last), true) = (
            targets.0,
            targets.1,
            targets.2,
            targets.3,
            is::<M>(c, Interface::CoSimulation),
        ) else {
            return guard::<M, _>(c, F::fmi3DoStep, |_| {
                known(event_handling_needed.as_mut(), "eventHandlingNeeded")?;
                known(terminate_simulation.as_mut(), "terminateSimulation")?;
                known(early_return.as_mut(), "earlyReturn")?;
                known(last_successful_time.as_mut(), "lastSuccessfulTime")?;
                refused(OTHER.into())
            });
        };
        let status = step::<M>(c, t, h);
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
        if clock == CLOCK && is::<M>(c, Interface::ScheduledExecution) {
            return step::<M>(c, t, M::DESCRIPTION.experiment.step);
        }
        guard::<M, _>(c, F::fmi3ActivateModelPartition, |_| match clock {
            CLOCK => refused(OTHER.into()),
            _ => refused(format!(
                "clockReference = {clock}, expected {CLOCK}, that of the variable clock"
            )),
        })
    }
}

/// Why an instance of FMI 2.0 is refused, which is in the right state.
const OTHER: &str = "the instance was made by another version of the standard";

/// Whether there is an instance, of this interface.
///
/// # Safety
/// As for [`guard`].
unsafe fn is<M: Model>(c: Component, interface: Interface) -> bool {
    // SAFETY: this function's contract.
    unsafe { c.cast::<Instance<M>>().as_ref() }.is_some_and(|one| one.interface() == interface)
}
