//! Life cycle: section 2.3.

use crate::ffi::fmi3::*;
use crate::ffi::string;
use crate::guard::{guard, install_panic_hook, made};
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
        let Some(own) = made(function, &mut log, Identity::of::<M>) else {
            return std::ptr::null_mut();
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
        let name = label.clone();
        let new = || Instance::<M>::new(sink, name, enabled, resources, interface);
        made(function, &mut log, || Ok(Box::new(new()))).map_or(std::ptr::null_mut(), |instance| {
            Box::into_raw(instance).cast()
        })
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Refusal, Step};
    use fmu_declaration::{Declare, Description, Experiment};
    use std::ffi::{CStr, CString, c_int, c_void};
    use std::path::Path;

    /// A model that finds nothing where it is told to look.
    #[derive(Clone, Default, serde::Serialize, serde::Deserialize)]
    struct Lost;

    impl Declare for Lost {
        const DESCRIPTION: Description<Self> = Description {
            name: "Lost",
            about: "panics when it is located",
            stepping: Stepping::Exact,
            experiment: Experiment {
                start: 0.0,
                stop: 1.0,
                tolerance: 1e-6,
                step: 0.1,
            },
            variables: &[],
        };
    }

    impl Model for Lost {
        fn located(&mut self, _: Option<&Path>) {
            panic!("no table to read");
        }

        fn initialize(&mut self, _: f64, _: &mut Log<'_>) -> Result<(), Refusal> {
            Ok(())
        }

        fn step(&mut self, _: Step, _: &mut Log<'_>) -> Result<(), Refusal> {
            Ok(())
        }
    }

    unsafe extern "C" fn keep(
        environment: *mut c_void,
        _: c_int,
        _: FmiString,
        message: FmiString,
    ) {
        // SAFETY: the environment is the test's vector, the message a text that ends with 0.
        unsafe {
            let said = &mut *environment.cast::<Vec<String>>();
            said.push(CStr::from_ptr(message).to_string_lossy().into_owned());
        }
    }

    #[test]
    fn a_model_that_panics_before_it_is_an_instance_is_no_instance_and_says_why() {
        let token = CString::new(Lost::DESCRIPTION.guid()).expect("no zero in it");
        let mut said: Vec<String> = Vec::new();
        let common = Common {
            name: c"lost".as_ptr(),
            token: token.as_ptr(),
            resources: std::ptr::null(),
            logging: 0,
            logger: Logger {
                log_message: Some(keep),
                environment: (&raw mut said).cast(),
            },
        };
        // SAFETY: pointers to texts that live, and to the vector that `keep` writes to.
        let component = unsafe { instantiate_co_simulation::<Lost>(common, 0, 0) };
        assert!(component.is_null());
        let expected = "fmi3InstantiateCoSimulation: panic in the model: no table to read at ";
        assert!(said.len() == 1 && said[0].starts_with(expected), "{said:?}");
    }
}
