//! One instance of an FMU by FMI 3.0; freed when dropped.

use super::fmu::{Row, Type, Value};
use super::library::Library;
use super::types::*;
use crate::both::{call, calls_of_both};
use crate::messages::{Message, Messages, log_message, owned};
use std::ffi::CString;
use std::ptr::null;
use std::sync::Arc;

/// Which function makes an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interface {
    /// fmi3InstantiateModelExchange
    ModelExchange,
    /// fmi3InstantiateCoSimulation
    CoSimulation,
    /// fmi3InstantiateScheduledExecution
    ScheduledExecution,
}

/// What is passed to it.
#[derive(Clone, Debug)]
pub struct Setup {
    /// Which function.
    pub interface: Interface,
    /// instanceName
    pub name: String,
    /// instantiationToken
    pub token: String,
    /// resourcePath; `None` is null.
    pub resources: Option<String>,
    /// loggingOn
    pub logging: bool,
    /// Whether a logger is given at all.
    pub logger: bool,
    /// eventModeUsed
    pub event_mode: bool,
    /// requiredIntermediateVariables
    pub intermediate: Vec<Reference>,
}

impl Setup {
    /// Co-simulation, no resources, everything logged.
    pub fn new(name: &str, token: &str) -> Self {
        Self {
            interface: Interface::CoSimulation,
            name: name.into(),
            token: token.into(),
            resources: None,
            logging: true,
            logger: true,
            event_mode: false,
            intermediate: Vec::new(),
        }
    }
}

/// An instance. Every method is one call of the C function of its name, unless it says otherwise.
pub struct Instance {
    library: Arc<Library>,
    component: Component,
    // Boxed: its address is known to the library.
    messages: Box<Messages>,
}

calls_of_both! {
    free fmi3FreeInstance; debug fmi3SetDebugLogging; leave fmi3ExitInitializationMode; end fmi3Terminate; reset fmi3Reset;
    state fmi3GetFMUState fmi3SetFMUState fmi3FreeFMUState;
    bytes fmi3SerializedFMUStateSize fmi3SerializeFMUState fmi3DeserializeFMUState;
}

fn c(text: &str) -> CString {
    CString::new(text).expect("no null byte in a test's string")
}

impl Instance {
    /// The function of the interface.
    ///
    /// # Errors
    /// What was logged, when null was returned.
    pub fn new(library: &Arc<Library>, setup: &Setup) -> Result<Self, Vec<Message>> {
        let messages = Box::new(Messages::default());
        let (name, token) = (c(&setup.name), c(&setup.token));
        let (name, token) = (name.as_ptr(), token.as_ptr());
        let resources = setup.resources.as_deref().map(c);
        let resources = resources.as_ref().map_or(null(), |path| path.as_ptr());
        let environment = (&raw const *messages).cast_mut().cast();
        let logger = setup.logger.then_some(log_message as LogMessage);
        let on = setup.logging.into();
        // SAFETY: all strings live during the call; the environment lives as long as the instance.
        let component = unsafe {
            match setup.interface {
                Interface::ModelExchange => (library.fmi3InstantiateModelExchange)(
                    name,
                    token,
                    resources,
                    0,
                    on,
                    environment,
                    logger,
                ),
                Interface::CoSimulation => (library.fmi3InstantiateCoSimulation)(
                    name,
                    token,
                    resources,
                    0,
                    on,
                    setup.event_mode.into(),
                    1,
                    setup.intermediate.as_ptr(),
                    setup.intermediate.len(),
                    environment,
                    logger,
                    None,
                ),
                Interface::ScheduledExecution => (library.fmi3InstantiateScheduledExecution)(
                    name,
                    token,
                    resources,
                    0,
                    on,
                    environment,
                    logger,
                    None,
                    None,
                    None,
                ),
            }
        };
        if component.is_null() {
            return Err(messages.take());
        }
        Ok(Self {
            library: Arc::clone(library),
            component,
            messages,
        })
    }

    /// fmi3EnterInitializationMode without tolerance; `None` as stop time is undefined.
    pub fn enter_initialization_mode(&self, start: f64, stop: Option<f64>) -> Status {
        let (defined, stop) = (stop.is_some().into(), stop.unwrap_or_default());
        call!(self.fmi3EnterInitializationMode(0, 0.0, start, defined, stop))
    }

    /// From *Instantiated* through Initialization Mode.
    ///
    /// # Panics
    /// When a call is refused.
    pub fn initialize(&self, start: f64) {
        let entered = self.enter_initialization_mode(start, None);
        assert_eq!(entered, Status::OK, "{:?}", self.messages());
        let left = self.exit_initialization_mode();
        assert_eq!(left, Status::OK, "{:?}", self.messages());
    }

    /// fmi3DoStep.
    ///
    /// # Panics
    /// When a step that was made reports an event, an end, an early return, or another time than its end.
    pub fn step(&self, t: f64, h: f64) -> Status {
        let (mut event, mut terminate, mut early, mut last) = (7, 7, 7, f64::NAN);
        let status = call!(self.fmi3DoStep(
            t,
            h,
            1,
            &raw mut event,
            &raw mut terminate,
            &raw mut early,
            &raw mut last
        ));
        if status == Status::OK {
            assert_eq!((event, terminate, early), (0, 0, 0), "at {t} s");
            assert_eq!(last.to_bits(), (t + h).to_bits(), "at {t} s");
        }
        status
    }

    /// fmi3ActivateModelPartition of the clock.
    pub fn activate(&self, t: f64) -> Status {
        call!(self.fmi3ActivateModelPartition(CLOCK, t))
    }

    /// The function that gets values of the row's type.
    ///
    /// # Errors
    /// The status that is not fmi3OK.
    pub fn read(&self, row: &Row) -> Result<Vec<Value>, Status> {
        let (n, vr) = (row.len(), &raw const row.reference);
        macro_rules! get {
            ($function:ident, $zero:expr, $value:expr) => {{
                let mut values = vec![$zero; n];
                let status = call!(self.$function(vr, 1, values.as_mut_ptr(), n));
                (status, values.into_iter().map($value).collect())
            }};
        }
        let (status, values) = match row.kind {
            Type::Float32 => get!(fmi3GetFloat32, 0.0, |value: f32| Value::Number(
                value.into()
            )),
            Type::Float64 => get!(fmi3GetFloat64, 0.0, Value::Number),
            Type::Int8 => get!(fmi3GetInt8, 0, |value: i8| Value::Integer(value.into())),
            Type::UInt8 => get!(fmi3GetUInt8, 0, |value: u8| Value::Integer(value.into())),
            Type::Int16 => get!(fmi3GetInt16, 0, |value: i16| Value::Integer(value.into())),
            Type::UInt16 => get!(fmi3GetUInt16, 0, |value: u16| Value::Integer(value.into())),
            Type::Int32 => get!(fmi3GetInt32, 0, |value: i32| Value::Integer(value.into())),
            Type::UInt32 => get!(fmi3GetUInt32, 0, |value: u32| Value::Integer(value.into())),
            Type::Int64 | Type::Enumeration => {
                get!(fmi3GetInt64, 0, |value: i64| Value::Integer(value.into()))
            }
            Type::UInt64 => get!(fmi3GetUInt64, 0, |value: u64| Value::Integer(value.into())),
            Type::Binary => {
                let (mut sizes, mut values) = (vec![usize::MAX; n], vec![null(); n]);
                let (to, lengths) = (values.as_mut_ptr(), sizes.as_mut_ptr());
                let status = call!(self.fmi3GetBinary(vr, 1, lengths, to, n));
                let mut bytes = Vec::new();
                if status == Status::OK {
                    for (value, size) in values.into_iter().zip(sizes) {
                        assert!(!value.is_null(), "{}: no address", row.name);
                        // SAFETY: so many bytes of the library's, until its next call.
                        let part = unsafe { std::slice::from_raw_parts(value, size) };
                        bytes.push(Value::Bytes(part.to_vec()));
                    }
                }
                (status, bytes)
            }
            Type::Boolean => get!(fmi3GetBoolean, 7, Value::Truth),
            Type::Text => get!(fmi3GetString, null(), |text| Value::Text(owned(text))),
        };
        match status {
            Status::OK => Ok(values),
            status => Err(status),
        }
    }

    /// The function that sets values of the row's type.
    ///
    /// # Panics
    /// When the values are of another type.
    pub fn write(&self, row: &Row, values: &[Value]) -> Status {
        let (n, vr) = (values.len(), &raw const row.reference);
        let number = |value: &Value| match value {
            Value::Number(value) => *value,
            other => panic!("{} = {other:?}", row.name),
        };
        let integer = |value: &Value| match value {
            Value::Integer(value) => *value,
            Value::Truth(value) => (*value).into(),
            other => panic!("{} = {other:?}", row.name),
        };
        macro_rules! set {
            ($function:ident, $C:ty) => {{
                let values: Vec<_> = values.iter().map(|value| integer(value) as $C).collect();
                call!(self.$function(vr, 1, values.as_ptr(), n))
            }};
        }
        match row.kind {
            Type::Float64 => {
                let values: Vec<_> = values.iter().map(number).collect();
                call!(self.fmi3SetFloat64(vr, 1, values.as_ptr(), n))
            }
            Type::Float32 => {
                let values: Vec<_> = values.iter().map(|value| number(value) as f32).collect();
                call!(self.fmi3SetFloat32(vr, 1, values.as_ptr(), n))
            }
            Type::Int8 => set!(fmi3SetInt8, i8),
            Type::UInt8 => set!(fmi3SetUInt8, u8),
            Type::Int16 => set!(fmi3SetInt16, i16),
            Type::UInt16 => set!(fmi3SetUInt16, u16),
            Type::Int32 => set!(fmi3SetInt32, i32),
            Type::UInt32 => set!(fmi3SetUInt32, u32),
            Type::Int64 | Type::Enumeration => set!(fmi3SetInt64, i64),
            Type::UInt64 => set!(fmi3SetUInt64, u64),
            Type::Binary => {
                let bytes = values.iter().map(|value| match value {
                    Value::Bytes(bytes) => bytes.as_slice(),
                    other => panic!("{} = {other:?}", row.name),
                });
                let bytes: Vec<_> = bytes.collect();
                let sizes: Vec<_> = bytes.iter().map(|bytes| bytes.len()).collect();
                let pointers: Vec<_> = bytes.iter().map(|bytes| bytes.as_ptr()).collect();
                call!(self.fmi3SetBinary(vr, 1, sizes.as_ptr(), pointers.as_ptr(), n))
            }
            Type::Boolean => {
                let values: Vec<_> = values.iter().map(|value| integer(value) as u8).collect();
                call!(self.fmi3SetBoolean(vr, 1, values.as_ptr(), n))
            }
            Type::Text => {
                let texts = values.iter().map(|value| match value {
                    Value::Text(text) => c(text),
                    other => panic!("{} = {other:?}", row.name),
                });
                let texts: Vec<_> = texts.collect();
                let pointers: Vec<_> = texts.iter().map(|text| text.as_ptr()).collect();
                call!(self.fmi3SetString(vr, 1, pointers.as_ptr(), n))
            }
        }
    }

    /// fmi3GetFloat64 of the independent variable.
    ///
    /// # Panics
    /// When it is refused.
    pub fn time(&self) -> f64 {
        let (reference, mut time) = (TIME, f64::NAN);
        let status = call!(self.fmi3GetFloat64(&raw const reference, 1, &raw mut time, 1));
        assert_eq!(status, Status::OK, "{:?}", self.messages());
        time
    }
}
