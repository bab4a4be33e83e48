//! One instance of an FMU, with slices for arrays; freed when dropped.

use crate::both::{call, calls_of_both};
use crate::library::Library;
use crate::messages::{Message, Messages, logger, owned};
use crate::types::*;
use std::ffi::{CString, c_int};
use std::path::Path;
use std::sync::Arc;

/// What is passed to fmi2Instantiate.
#[derive(Clone, Debug)]
pub struct Setup {
    /// instanceName
    pub name: String,
    /// fmuGUID
    pub guid: String,
    /// fmuResourceLocation; `None` is null.
    pub location: Option<String>,
    /// loggingOn
    pub logging: bool,
    /// Whether a logger is given at all.
    pub logger: bool,
}

impl Setup {
    /// No resources, everything logged.
    pub fn new(name: &str, guid: &str) -> Self {
        Self {
            name: name.into(),
            guid: guid.into(),
            location: None,
            logging: true,
            logger: true,
        }
    }

    /// With a resource location.
    #[must_use]
    pub fn at(self, location: &str) -> Self {
        Self {
            location: Some(location.into()),
            ..self
        }
    }

    /// With logging off.
    #[must_use]
    pub fn silent(self) -> Self {
        Self {
            logging: false,
            ..self
        }
    }
}

/// An instance. Every method is one call of the C function of its name.
pub struct Instance {
    library: Arc<Library>,
    component: Component,
    // Boxed: their addresses are known to the library.
    messages: Box<Messages>,
    _callbacks: Box<Callbacks>,
}

fn c(text: &str) -> CString {
    CString::new(text).expect("no null byte in a test's string")
}

calls_of_both! {
    free fmi2FreeInstance; debug fmi2SetDebugLogging; leave fmi2ExitInitializationMode; end fmi2Terminate; reset fmi2Reset;
    state fmi2GetFMUstate fmi2SetFMUstate fmi2FreeFMUstate;
    bytes fmi2SerializedFMUstateSize fmi2SerializeFMUstate fmi2DeSerializeFMUstate;
}

macro_rules! get_and_set {
    ($type:ty: $get:ident $fmi2Get:ident $one:ident, $set:ident $fmi2Set:ident) => {
        #[doc = concat!("`", stringify!($fmi2Get), "`: the values, or the status that is not fmi2OK.")]
        pub fn $get(&self, references: &[Reference]) -> Result<Vec<$type>, Status> {
            let mut values = vec![<$type>::default(); references.len()];
            match call!(self.$fmi2Get(references.as_ptr(), references.len(), values.as_mut_ptr())) {
                Status::OK => Ok(values),
                status => Err(status),
            }
        }

        #[doc = concat!("`", stringify!($fmi2Get), "` of one variable.\n\n# Panics\nWhen it is refused.")]
        pub fn $one(&self, reference: Reference) -> $type {
            self.$get(&[reference])
                .unwrap_or_else(|_| panic!("{reference}: {:?}", self.messages()))[0]
        }

        #[doc = concat!("`", stringify!($fmi2Set), "`\n\n# Panics\nWhen the slices differ in length.")]
        pub fn $set(&self, references: &[Reference], values: &[$type]) -> Status {
            assert_eq!(references.len(), values.len());
            call!(self.$fmi2Set(references.as_ptr(), references.len(), values.as_ptr()))
        }
    };
}

impl Instance {
    /// fmi2Instantiate.
    ///
    /// # Errors
    /// What was logged, when null was returned.
    pub fn new(library: &Arc<Library>, setup: &Setup) -> Result<Self, Vec<Message>> {
        let messages = Box::new(Messages::default());
        let callbacks = Box::new(Callbacks {
            logger: setup.logger.then_some(logger),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            environment: (&raw const *messages).cast_mut().cast(),
        });
        let (name, guid) = (c(&setup.name), c(&setup.guid));
        let location = setup.location.as_deref().map(c);
        // SAFETY: all strings live during the call; callbacks and environment live as long as the instance.
        let component = unsafe {
            (library.fmi2Instantiate)(
                name.as_ptr(),
                CO_SIMULATION,
                guid.as_ptr(),
                location.as_ref().map_or(std::ptr::null(), |l| l.as_ptr()),
                &raw const *callbacks,
                0,
                setup.logging.into(),
            )
        };
        if component.is_null() {
            return Err(messages.take());
        }
        Ok(Self {
            library: Arc::clone(library),
            component,
            messages,
            _callbacks: callbacks,
        })
    }

    /// fmi2SetupExperiment without tolerance; `None` as stop time is undefined.
    pub fn setup_experiment(&self, start: f64, stop: Option<f64>) -> Status {
        call!(self.fmi2SetupExperiment(
            0,
            0.0,
            start,
            stop.is_some().into(),
            stop.unwrap_or_default()
        ))
    }

    /// fmi2EnterInitializationMode
    pub fn enter_initialization_mode(&self) -> Status {
        call!(self.fmi2EnterInitializationMode())
    }

    /// From *instantiated* through Initialization Mode.
    ///
    /// # Panics
    /// When a call is refused.
    pub fn initialize(&self, start: f64) {
        for status in [
            self.setup_experiment(start, None),
            self.enter_initialization_mode(),
            self.exit_initialization_mode(),
        ] {
            assert_eq!(status, Status::OK, "{:?}", self.messages());
        }
    }

    /// fmi2DoStep
    pub fn step(&self, t: f64, h: f64) -> Status {
        call!(self.fmi2DoStep(t, h, 1))
    }

    get_and_set!(f64: get_real fmi2GetReal real, set_real fmi2SetReal);
    get_and_set!(c_int: get_integer fmi2GetInteger integer, set_integer fmi2SetInteger);
    get_and_set!(Boolean: get_boolean fmi2GetBoolean boolean, set_boolean fmi2SetBoolean);

    /// fmi2GetString of one variable, copied.
    ///
    /// # Panics
    /// When it is refused.
    pub fn string(&self, reference: Reference) -> String {
        let mut value = std::ptr::null();
        let status = call!(self.fmi2GetString(&raw const reference, 1, &raw mut value));
        assert_eq!(status, Status::OK, "{:?}", self.messages());
        owned(value)
    }

    /// fmi2SetString of one variable.
    pub fn set_string(&self, reference: Reference, value: &str) -> Status {
        let value = c(value);
        let pointer = value.as_ptr();
        call!(self.fmi2SetString(&raw const reference, 1, &raw const pointer))
    }

    /// `file:` URI of an absolute path, with percent escapes for all but letters, digits and `/-_.~`.
    pub fn uri(path: &Path) -> String {
        let mut uri = String::from("file://");
        for byte in path.to_string_lossy().bytes() {
            if byte.is_ascii_alphanumeric() || b"/-_.~".contains(&byte) {
                uri.push(char::from(byte));
            } else {
                uri.push_str(&format!("%{byte:02X}"));
            }
        }
        uri
    }
}
