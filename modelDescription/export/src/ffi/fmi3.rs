//! C types of FMI 3.0 (`fmi3PlatformTypes.h`, `fmi3FunctionTypes.h`) and the importer's logger.

use std::ffi::{CStr, c_double, c_int, c_void};

pub use super::{Component, FmiString, FmuState, Status, ValueReference};

/// fmi3Float64
pub type Float64 = c_double;
/// fmi3Boolean and fmi3Clock, C's `bool`, as a byte: an importer may pass any. 0 is false, 1 is true.
pub type Boolean = u8;
/// fmi3Byte
pub type Byte = u8;
/// fmi3Binary
pub type Binary = *const Byte;
/// fmi3IntervalQualifier
pub type IntervalQualifier = c_int;
/// fmi3IntervalUnchanged
pub const INTERVAL_UNCHANGED: IntervalQualifier = 1;

/// fmi3LogMessageCallback
pub type LogMessage = unsafe extern "C" fn(*mut c_void, c_int, FmiString, FmiString);
/// A callback that is never called, whatever its arguments are.
pub type Uncalled = Option<unsafe extern "C" fn()>;

/// What an instance was given to log with. The function may be null.
#[derive(Clone, Copy)]
pub struct Logger {
    /// logMessage
    pub log_message: Option<LogMessage>,
    /// instanceEnvironment, handed back to it.
    pub environment: *mut c_void,
}

// SAFETY: the importer promises that function and environment stay valid for the life of the instance, from whichever
// thread it calls; this crate calls it only inside the importer's own calls.
unsafe impl Send for Logger {}

impl Logger {
    /// Sends one message.
    pub(crate) fn log(&self, status: Status, category: &CStr, message: &CStr) {
        if let Some(log_message) = self.log_message {
            // SAFETY: the importer's contract for the logger; both strings are null-terminated and outlive the call.
            unsafe {
                log_message(
                    self.environment,
                    status as c_int,
                    category.as_ptr(),
                    message.as_ptr(),
                );
            }
        }
    }
}
