//! Life cycle: section 2.3.

use crate::ffi::fmi3::*;
use crate::ffi::string;
use crate::guard::{guard, install_panic_hook};
use crate::identity::Identity;
use crate::instance::{Instance, instance_name};
use crate::legality::Interface;
use crate::legality::fmi3::Function as F;
use crate::log::{Enabled, Log, Sink};
use crate::model::Model;
use fmu_declaration::Stepping;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

/// What all three functions that instantiate are given.
pub struct Common {
    /// instanceName
    pub name: FmiString,
    /// instantiationToken
    pub token: FmiString,
    /// resourcePath
    pub resources: FmiString,
    /// loggingOn
    pub logging: Boolean,
    /// instanceEnvironment and logMessage
    pub logger: Logger,
}

/// fmi3InstantiateCoSimulation: null when refused, with the reason logged.
pub unsafe fn instantiate_co_simulation<M: Model>(
    common: Common,
    event_mode_used: Boolean,
    intermediate_variables: usize,
) -> Component {
    let objection = if event_mode_used != 0 {
        Some("eventModeUsed is true, expected false (hasEventMode is false)".to_owned())
    } else if intermediate_variables > 0 {
        Some(format!(
            "nRequiredIntermediateVariables = {intermediate_variables}, expected 0: no variable has intermediateUpdate"
        ))
    } else {
        None
    };
    // SAFETY: the importer's contract.
    unsafe {
        instantiate::<M>(
            "fmi3InstantiateCoSimulation",
            &common,
            objection,
            Interface::CoSimulation,
        )
    }
}

/// fmi3InstantiateScheduledExecution: null when refused, with the reason logged.
pub unsafe fn instantiate_scheduled_execution<M: Model>(common: Common) -> Component {
    let sampled = M::DESCRIPTION.stepping == Stepping::Sampled;
    let objection = (!sampled).then(|| "there is no clock: the model has no sample period".into());
    // SAFETY: the importer's contract.
    unsafe {
        instantiate::<M>(
            "fmi3InstantiateScheduledExecution",
            &common,
            objection,
            Interface::ScheduledExecution,
        )
    }
}

/// fmi3InstantiateModelExchange: null, with the reason logged.
pub unsafe fn instantiate_model_exchange<M: Model>(common: Common) -> Component {
    let objection = Some("there is no Model Exchange, expected Co-Simulation".into());
    // SAFETY: the importer's contract.
    unsafe {
        instantiate::<M>(
            "fmi3InstantiateModelExchange",
            &common,
            objection,
            Interface::CoSimulation,
        )
    }
}

unsafe fn instantiate<M: Model>(
    function: &str,
    common: &Common,
    objection: Option<String>,
    interface: Interface,
) -> Component {
    install_panic_hook();
    catch_unwind(AssertUnwindSafe(|| {
        // SAFETY: the importer's contract, for all three pointers.
        let (name, token, resources) = unsafe {
            (
                string(common.name),
                string(common.token),
                string(common.resources),
            )
        };
        let label = instance_name(name);
        let enabled = Enabled::all(common.logging != 0);
        let sink = Sink::Fmi3(common.logger);
        let mut log = Log::new(&sink, &label, enabled);
        let Ok(own) = Identity::of::<M>() else {
            return std::ptr::null_mut(); // a model that cannot be serialized: no test lets it be built
        };
        let own = own.guid();
        let objection = if name.is_none_or(|name| name.trim().is_empty()) {
            Some("instanceName is null, blank or not UTF-8, expected a name".to_owned())
        } else if token != Some(own) {
            Some(format!(
                "instantiationToken = {}, expected {own}",
                token.unwrap_or("(null or not UTF-8)")
            ))
        } else {
            objection
        };
        if let Some(objection) = objection {
            log.error(format_args!("{function}: {objection}"));
            return std::ptr::null_mut();
        }
        let resources = match resources {
            Some(uri) if uri.starts_with("file:") => {
                log.warning(format_args!(
                    "{function}: resourcePath = {uri}, expected a path, not a URI; ignored"
                ));
                None
            }
            path => path.map(folder),
        };
        Box::into_raw(Box::new(Instance::<M>::new(
            sink, label, enabled, resources, interface,
        )))
        .cast()
    }))
    .unwrap_or(std::ptr::null_mut())
}

/// A path without the separator at its end.
fn folder(path: &str) -> PathBuf {
    Path::new(path).components().collect()
}

/// fmi3EnterInitializationMode
pub unsafe fn enter_initialization_mode<M: Model>(
    c: Component,
    tolerance_defined: Boolean,
    tolerance: Float64,
    start_time: Float64,
    stop_time_defined: Boolean,
    stop_time: Float64,
) -> Status {
    let tolerance = (tolerance_defined != 0).then_some(tolerance);
    let stop = (stop_time_defined != 0).then_some(stop_time);
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M, _>(c, F::fmi3EnterInitializationMode, |instance| {
            instance.setup_experiment(tolerance, start_time, stop)?;
            instance.enter_initialization_mode()
        })
    }
}
