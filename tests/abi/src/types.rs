//! C types of FMI 2.0 as an importer writes them from the standard's headers (`fmi2TypesPlatform.h`,
//! `fmi2FunctionTypes.h`): nothing here is taken from the exporter, so that a wrong layout on its side shows.

use std::ffi::{c_char, c_double, c_int, c_uint, c_void};

/// fmi2Component
pub type Component = *mut c_void;
/// fmi2FMUstate
pub type FmuState = *mut c_void;
/// fmi2ValueReference
pub type Reference = c_uint;
/// fmi2Real
pub type Real = c_double;
/// fmi2Integer
pub type Integer = c_int;
/// fmi2Boolean
pub type Boolean = c_int;
/// fmi2String
pub type FmiString = *const c_char;
/// fmi2Byte
pub type Byte = c_char;

/// fmi2Status. Not an enum: a library may return any integer.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Status(pub c_int);

impl Status {
    /// fmi2OK
    pub const OK: Self = Self(0);
    /// fmi2Warning
    pub const WARNING: Self = Self(1);
    /// fmi2Discard
    pub const DISCARD: Self = Self(2);
    /// fmi2Error
    pub const ERROR: Self = Self(3);
    /// fmi2Fatal
    pub const FATAL: Self = Self(4);
    /// fmi2Pending
    pub const PENDING: Self = Self(5);
}

/// fmi2Type: fmi2ModelExchange 0, fmi2CoSimulation 1.
pub const CO_SIMULATION: c_int = 1;

/// fmi2StatusKind: fmi2DoStepStatus
pub const DO_STEP_STATUS: c_int = 0;
/// fmi2StatusKind: fmi2PendingStatus
pub const PENDING_STATUS: c_int = 1;
/// fmi2StatusKind: fmi2LastSuccessfulTime
pub const LAST_SUCCESSFUL_TIME: c_int = 2;
/// fmi2StatusKind: fmi2Terminated
pub const TERMINATED: c_int = 3;

/// fmi2CallbackLogger without its `...`: the FMUs send finished text, so no sixth argument is ever passed.
pub type Logger = extern "C" fn(*mut c_void, FmiString, c_int, FmiString, FmiString);

/// fmi2CallbackFunctions; `None` is a null pointer.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Callbacks {
    /// logger
    pub logger: Option<Logger>,
    /// allocateMemory
    pub allocate_memory: Option<extern "C" fn(usize, usize) -> *mut c_void>,
    /// freeMemory
    pub free_memory: Option<extern "C" fn(*mut c_void)>,
    /// stepFinished
    pub step_finished: Option<extern "C" fn(*mut c_void, c_int)>,
    /// componentEnvironment
    pub environment: *mut c_void,
}
