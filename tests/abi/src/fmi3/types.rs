//! C types of FMI 3.0 as an importer writes them from the standard's headers (`fmi3PlatformTypes.h`,
//! `fmi3FunctionTypes.h`), where they are not those of FMI 2.0.

pub use crate::types::{Component, FmiString, FmuState, Reference, Status};
use std::ffi::{c_int, c_void};

/// fmi3Boolean and fmi3Clock: C's `bool`, a byte of which only 0 and 1 are values.
pub type Boolean = u8;
/// fmi3Binary
pub type Binary = *const u8;
/// fmi3IntervalQualifier: fmi3IntervalNotYetKnown 0, fmi3IntervalUnchanged 1, fmi3IntervalChanged 2.
pub type Qualifier = c_int;
/// fmi3LogMessageCallback
pub type LogMessage = extern "C" fn(*mut c_void, c_int, FmiString, FmiString);
/// A callback of another signature, which is always null here.
pub type Callback = Option<extern "C" fn()>;
/// The value reference of the clock that scheduled execution has.
pub const CLOCK: Reference = 0xFFFF_FFFE;
/// The value reference of the independent variable.
pub const TIME: Reference = 0xFFFF_FFFF;
