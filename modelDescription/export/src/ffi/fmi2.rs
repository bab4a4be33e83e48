//! C types of FMI 2.0 (`fmi2TypesPlatform.h`, `fmi2FunctionTypes.h`) and the importer's callbacks.

use std::ffi::{CStr, c_char, c_double, c_int, c_void};

pub use super::{Component, FmiString, FmuState, Status, ValueReference};

/// fmi2Real
pub type Real = c_double;
/// fmi2Integer
pub type Integer = c_int;
/// fmi2Boolean: 0 is false, 1 is true; fmi2SetBoolean refuses everything else.
pub type Boolean = c_int;
/// fmi2Byte
pub type Byte = c_char;

/// fmi2StatusKind, as an integer: an importer may pass anything.
pub type StatusKind = c_int;
/// fmi2LastSuccessfulTime
pub const LAST_SUCCESSFUL_TIME: StatusKind = 2;
/// fmi2Terminated
pub const TERMINATED: StatusKind = 3;

/// fmi2Type, as an integer: fmi2CoSimulation is 1.
pub type Type = c_int;
/// fmi2CoSimulation
pub const CO_SIMULATION: Type = 1;

/// fmi2CallbackLogger, a printf-like function.
pub type Logger = unsafe extern "C" fn(*mut c_void, FmiString, c_int, FmiString, FmiString, ...);
/// fmi2CallbackAllocateMemory
pub type AllocateMemory = unsafe extern "C" fn(usize, usize) -> *mut c_void;
/// fmi2CallbackFreeMemory
pub type FreeMemory = unsafe extern "C" fn(*mut c_void);
/// fmi2StepFinished
pub type StepFinished = unsafe extern "C" fn(*mut c_void, c_int);

/// fmi2CallbackFunctions. Any function may be null; only the logger is ever used.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Callbacks {
    /// Receives messages.
    pub logger: Option<Logger>,
    /// Not used (`canNotUseMemoryManagementFunctions`).
    pub allocate_memory: Option<AllocateMemory>,
    /// Not used.
    pub free_memory: Option<FreeMemory>,
    /// Not used: steps are synchronous.
    pub step_finished: Option<StepFinished>,
    /// Handed back to the logger.
    pub component_environment: *mut c_void,
}

// SAFETY: the importer promises (section 2.1.5) that the functions and the environment stay valid for the life of the
// instance, from whichever thread it calls; this crate calls them only inside the importer's own calls.
unsafe impl Send for Callbacks {}

impl Callbacks {
    /// Sends one finished message (no printf directive in it).
    pub(crate) fn log(
        &self,
        instance_name: &CStr,
        status: Status,
        category: &CStr,
        message: &CStr,
    ) {
        if let Some(logger) = self.logger {
            // SAFETY: the importer's contract for the logger; all strings are null-terminated and outlive the call, and
            // the message holds no `%`, so no variadic argument is read.
            unsafe {
                logger(
                    self.component_environment,
                    instance_name.as_ptr(),
                    status as c_int,
                    category.as_ptr(),
                    message.as_ptr(),
                );
            }
        }
    }
}
