//! Steps: sections 4.2 and 5.2.

use crate::ffi::fmi3::*;
use crate::functions::known;
use crate::guard::guard;
use crate::instance::refused;
use crate::kind::CLOCK;
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
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M, _>(c, F::fmi3DoStep, |instance| {
            let event_handling_needed =
                known(event_handling_needed.as_mut(), "eventHandlingNeeded")?;
            let terminate_simulation = known(terminate_simulation.as_mut(), "terminateSimulation")?;
            let early_return = known(early_return.as_mut(), "earlyReturn")?;
            let last_successful_time = known(last_successful_time.as_mut(), "lastSuccessfulTime")?;
            instance.do_step(t, h)?;
            *event_handling_needed = 0;
            *terminate_simulation = 0;
            *early_return = 0;
            *last_successful_time = instance.now.clock.time();
            Ok(())
        })
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
        guard::<M, _>(c, F::fmi3ActivateModelPartition, |instance| {
            if clock != CLOCK {
                return refused(format!(
                    "clockReference = {clock}, expected {CLOCK}, that of the variable clock"
                ));
            }
            instance.activate(t)
        })
    }
}
