//! Life cycle and steps: sections 2.1.5, 2.1.6 and 4.2.2.

use crate::ffi::fmi2::*;
use crate::ffi::string;
use crate::guard::{guard, install_panic_hook, made};
use crate::identity::Identity;
use crate::instance::{Instance, instance_name};
use crate::legality::Interface;
use crate::legality::fmi2::Function as F;
use crate::log::{Enabled, Log, Sink};
use crate::model::Model;
use crate::resource;
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
        let sink = Sink::Fmi2(*callbacks);
        let mut log = Log::new(&sink, &label, enabled);
        let Some(own) = made("fmi2Instantiate", &mut log, Identity::of::<M>) else {
            return std::ptr::null_mut();
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
            log.error(format_args!("fmi2Instantiate: {objection}"));
            return std::ptr::null_mut();
        }
        let resources = location.map(resource::path).transpose();
        if let Err(reason) = &resources {
            log.warning(format_args!("fmi2Instantiate: {reason}; ignored"));
        }
        let resources = resources.ok().flatten();
        let name = label.clone();
        let new = || Instance::<M>::new(sink, name, enabled, resources, Interface::Fmi2);
        made("fmi2Instantiate", &mut log, || Ok(Box::new(new())))
            .map_or(std::ptr::null_mut(), |instance| {
                Box::into_raw(instance).cast()
            })
    }))
    .unwrap_or(std::ptr::null_mut())
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
        guard::<M, _>(c, F::fmi2SetupExperiment, |instance| {
            instance.setup_experiment(tolerance, start_time, stop)
        })
    }
}
