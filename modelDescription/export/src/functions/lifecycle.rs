//! Life cycle and steps: sections 2.1.5, 2.1.6 and 4.2.2.

use super::known;
use crate::ffi::*;
use crate::guard::{guard, install_panic_hook};
use crate::identity::Identity;
use crate::instance::{Instance, instance_name};
use crate::legality::Function as F;
use crate::log::{Enabled, Log};
use crate::model::Model;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// fmi2Instantiate: null when refused, with the reason logged if logging is on.
pub unsafe fn instantiate<M: Model>(
    name: FmiString,
    kind: Type,
    guid: FmiString,
    location: FmiString,
    callbacks: *const Callbacks,
    _visible: Boolean,
    logging: Boolean,
) -> Component {
    install_panic_hook();
    catch_unwind(AssertUnwindSafe(|| {
        // SAFETY: the importer's contract, for all four pointers.
        let (name, guid, location, callbacks) = unsafe {
            (
                string(name),
                string(guid),
                string(location),
                callbacks.as_ref(),
            )
        };
        let Some(callbacks) = callbacks else {
            return std::ptr::null_mut();
        };
        let (enabled, label) = (Enabled::all(logging != 0), instance_name(name));
        let Ok(own) = Identity::of::<M>() else {
            return std::ptr::null_mut(); // a model that cannot be serialized: no test lets it be built
        };
        let own = own.guid();
        let objection = if name.is_none_or(str::is_empty) {
            Some("instanceName is null, empty or not UTF-8, expected a name".to_owned())
        } else if kind != CO_SIMULATION {
            Some(format!("fmuType = {kind}, expected fmi2CoSimulation (1)"))
        } else if guid != Some(own) {
            Some(format!(
                "fmuGUID = {}, expected {own}",
                guid.unwrap_or("(null or not UTF-8)")
            ))
        } else {
            None
        };
        if let Some(objection) = objection {
            Log::new(callbacks, &label, enabled)
                .error(format_args!("fmi2Instantiate: {objection}"));
            return std::ptr::null_mut();
        }
        Box::into_raw(Box::new(Instance::<M>::new(
            *callbacks, label, enabled, location,
        )))
        .cast()
    }))
    .unwrap_or(std::ptr::null_mut())
}

/// fmi2FreeInstance: null is allowed.
pub unsafe fn free_instance<M: Model>(component: Component) {
    if !component.is_null() {
        // SAFETY: the component came from `Box::into_raw` in `instantiate::<M>` and is freed once, by contract. Dropping a
        // model runs no code of its own that could panic; should it, the panic ends here.
        let _ = catch_unwind(|| drop(unsafe { Box::from_raw(component.cast::<Instance<M>>()) }));
    }
}

/// fmi2SetDebugLogging
pub unsafe fn set_debug_logging<M: Model>(
    c: Component,
    on: Boolean,
    n: usize,
    names: *const FmiString,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M>(c, F::fmi2SetDebugLogging, |instance| {
            let names = known(array(names, n), "categories")?;
            instance.set_debug_logging(on != 0, names.iter().map(|&name| string(name)))
        })
    }
}

/// fmi2SetupExperiment
pub unsafe fn setup_experiment<M: Model>(
    c: Component,
    tolerance_defined: Boolean,
    tolerance: Real,
    start_time: Real,
    stop_time_defined: Boolean,
    stop_time: Real,
) -> Status {
    let tolerance = (tolerance_defined != 0).then_some(tolerance);
    let stop = (stop_time_defined != 0).then_some(stop_time);
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M>(c, F::fmi2SetupExperiment, |instance| {
            instance.setup_experiment(tolerance, start_time, stop)
        })
    }
}

macro_rules! plain {
    ($($(#[$doc:meta])* $name:ident: $function:ident => $method:ident;)*) => {$(
        $(#[$doc])*
        pub unsafe fn $name<M: Model>(c: Component) -> Status {
            // SAFETY: the importer's contract.
            unsafe { guard::<M>(c, F::$function, Instance::$method) }
        }
    )*};
}

plain! {
    /// fmi2EnterInitializationMode
    enter_initialization_mode: fmi2EnterInitializationMode => enter_initialization_mode;
    /// fmi2ExitInitializationMode
    exit_initialization_mode: fmi2ExitInitializationMode => exit_initialization_mode;
    /// fmi2Terminate
    terminate: fmi2Terminate => terminate;
    /// fmi2Reset
    reset: fmi2Reset => reset;
}

/// fmi2DoStep
pub unsafe fn do_step<M: Model>(c: Component, t: Real, h: Real, _no_set_prior: Boolean) -> Status {
    // SAFETY: the importer's contract.
    unsafe { guard::<M>(c, F::fmi2DoStep, |instance| instance.do_step(t, h)) }
}
