//! What an instance told its logger.

use crate::types::{FmiString, Status};
use std::ffi::{CStr, c_int, c_void};
use std::sync::Mutex;

/// One call of the logger.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// Instance name.
    pub instance: String,
    /// Status.
    pub status: Status,
    /// Category.
    pub category: String,
    /// Text.
    pub text: String,
}

/// Collects messages; its address is the logger's environment, so it must not move while an instance lives.
#[derive(Default)]
pub struct Messages(Mutex<Vec<Message>>);

impl Messages {
    /// Takes everything that was logged so far.
    pub fn take(&self) -> Vec<Message> {
        std::mem::take(&mut *self.0.lock().expect("no panic while logging"))
    }
}

/// The logger. Not variadic, while the standard's is: on the calling conventions in use here (System V x86-64, AAPCS64 on
/// Linux, Microsoft x64) a variadic caller passes its five fixed pointer and integer arguments exactly like any caller,
/// and the callee never looks further.
pub extern "C" fn logger(
    environment: *mut c_void,
    instance: FmiString,
    status: c_int,
    category: FmiString,
    text: FmiString,
) {
    // SAFETY: the environment is the address of the `Messages` that was given to fmi2Instantiate and is kept alive for
    // as long as the instance.
    let messages = unsafe { &*environment.cast_const().cast::<Messages>() };
    let message = Message {
        instance: owned(instance),
        status: Status(status),
        category: owned(category),
        text: owned(text),
    };
    messages
        .0
        .lock()
        .expect("no panic while logging")
        .push(message);
}

/// The logger of FMI 3.0, which says no instance name.
pub extern "C" fn log_message(
    environment: *mut c_void,
    status: c_int,
    category: FmiString,
    text: FmiString,
) {
    logger(environment, c"".as_ptr(), status, category, text);
}

/// A copy of a C string, which must be UTF-8; null is shown as such, so that an assertion on the text fails.
#[allow(
    clippy::not_unsafe_ptr_arg_deref,
    reason = "tests pass on what a library under test returned"
)]
pub fn owned(text: FmiString) -> String {
    if text.is_null() {
        return "(null)".into();
    }
    // SAFETY: not null, and null-terminated by the standard's contract for fmi2String.
    let text = unsafe { CStr::from_ptr(text) };
    text.to_str()
        .map_or_else(|_| "(not UTF-8)".into(), Into::into)
}
