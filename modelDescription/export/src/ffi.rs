//! C types of FMI 2.0 (`fmi2TypesPlatform.h`, `fmi2FunctionTypes.h`) and the importer's callbacks.

use std::ffi::{CStr, c_char, c_double, c_int, c_uint, c_void};

/// fmi2Component: an opaque instance.
pub type Component = *mut c_void;
/// fmi2FMUstate: an opaque snapshot of an instance.
pub type FmuState = *mut c_void;
/// fmi2ValueReference
pub type ValueReference = c_uint;
/// fmi2Real
pub type Real = c_double;
/// fmi2Integer
pub type Integer = c_int;
/// fmi2Boolean: 0 is false, 1 is true; fmi2SetBoolean refuses everything else.
pub type Boolean = c_int;
/// fmi2String: null-terminated UTF-8.
pub type FmiString = *const c_char;
/// fmi2Byte
pub type Byte = c_char;

/// fmi2Status; the values that this crate returns.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// fmi2OK
    Ok = 0,
    /// fmi2Warning: only as the status of a log message.
    Warning = 1,
    /// fmi2Error
    Error = 3,
}

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

/// Whether no array of `n` elements can exist.
fn exceeds_memory<T>(n: usize) -> bool {
    n > isize::MAX as usize / size_of::<T>().max(1)
}

/// An importer's array of `n` elements; `None` when the pointer is null although `n > 0`, or when no
/// array can have `n` elements.
///
/// # Safety
/// Unless null, `pointer` is valid for reading `n` elements during `'a` (the contract of every FMI array argument).
pub(crate) unsafe fn array<'a, T>(pointer: *const T, n: usize) -> Option<&'a [T]> {
    match (pointer.is_null() || exceeds_memory::<T>(n), n) {
        (_, 0) => Some(&[]),
        (true, _) => None,
        // SAFETY: not null, and valid for n elements by this function's contract.
        (false, _) => Some(unsafe { std::slice::from_raw_parts(pointer, n) }),
    }
}

/// Like [`array`], for writing.
///
/// # Safety
/// Unless null, `pointer` is valid for writing `n` elements during `'a`, and nothing else refers to them.
pub(crate) unsafe fn array_mut<'a, T>(pointer: *mut T, n: usize) -> Option<&'a mut [T]> {
    match (pointer.is_null() || exceeds_memory::<T>(n), n) {
        (_, 0) => Some(&mut []),
        (true, _) => None,
        // SAFETY: not null, and valid for n elements by this function's contract.
        (false, _) => Some(unsafe { std::slice::from_raw_parts_mut(pointer, n) }),
    }
}

/// An importer's string as UTF-8; `None` when null or not UTF-8.
///
/// # Safety
/// Unless null, `pointer` is a null-terminated string that stays valid during `'a`.
pub(crate) unsafe fn string<'a>(pointer: FmiString) -> Option<&'a str> {
    if pointer.is_null() {
        return None;
    }
    // SAFETY: not null, null-terminated by this function's contract.
    unsafe { CStr::from_ptr(pointer) }.to_str().ok()
}
