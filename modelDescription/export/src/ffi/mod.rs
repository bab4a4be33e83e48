//! C types that both versions of the standard have, and what an importer's pointers stand for.
//!
//! The rest is in [`fmi2`] (`fmi2TypesPlatform.h`, `fmi2FunctionTypes.h`) and [`fmi3`] (`fmi3PlatformTypes.h`,
//! `fmi3FunctionTypes.h`).

pub mod fmi2;
pub mod fmi3;

use std::ffi::{CStr, c_char, c_void};

/// fmi2Component, fmi3Instance: an opaque instance.
pub type Component = *mut c_void;
/// fmi2FMUstate, fmi3FMUState: an opaque snapshot of an instance.
pub type FmuState = *mut c_void;
/// fmi2ValueReference, fmi3ValueReference
pub type ValueReference = u32;
/// fmi2String, fmi3String: null-terminated UTF-8.
pub type FmiString = *const c_char;

/// fmi2Status, fmi3Status: the values that this crate returns, with the same numbers in both.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// fmi2OK, fmi3OK
    Ok = 0,
    /// fmi2Warning, fmi3Warning: only as the status of a log message.
    Warning = 1,
    /// fmi2Error, fmi3Error
    Error = 3,
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
