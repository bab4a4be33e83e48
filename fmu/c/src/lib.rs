//! The admittance laws as a C library for a real-time controller: one axis, and the arm.
//!
//! It is a shell around the packages `admittance` and `arm-law`, as the FMUs are: the same structs, the same ticks, bit for bit. The package
//! `exo-law-f32` is the same in single precision. `include/exo_law.h` is generated from this source.
//!
//! | module | what |
//! |---|---|
//! | [`arm`] | `exo_arm_*`: the law of ArmController.fmu |
//! | [`axis`] | `exo_axis_*`: one axis, the law of TestbedController.fmu without its comparators |
//! | [`refusal`] | status, and which value was refused |
//! | [`storage`] | memory that the caller provides for a law |
//! | [`variable`] | the structs' variables by name |
//! | [`mod@pointer`] | the C boundary: null, alignment, initialization. All the unsafe code is there |
//!
//! Rules of the interface:
//! * Names, units, signs and start values are those of the FMU's variables, whose documentation describes each.
//! * Choices and Booleans are `int32_t`, as in the FMU; 0 is false, 1 is true, anything else is refused.
//! * Positions that are sensed are `double` in both precisions.
//! * No function allocates, blocks, keeps a pointer, or has memory of its own. A state belongs to one thread at a time.
//! * A call that is refused says so by its [`Status`](refusal::Status) and leaves the state as it was; a tick's outputs then hold
//!   no torque.

#![no_std]
#![allow(
    non_snake_case,
    reason = "the paper's symbols with its capitals: K_P, Lambda_n"
)]

pub mod arm;
pub mod axis;
mod panic;
pub mod pointer;
pub mod refusal;
pub mod storage;
pub mod variable;

pub use admittance::Real;

use core::ffi::{CStr, c_char};

/// Version of the library, as text: `EXO_LAW_VERSION` of the header that belongs to it.
#[unsafe(no_mangle)]
pub extern "C" fn exo_law_version() -> *const c_char {
    const VERSION: &CStr =
        match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
            Ok(version) => version,
            Err(_) => c"",
        };
    VERSION.as_ptr()
}

/// Size of the number that the library was built with, in bytes: `sizeof(exo_real)`.
#[unsafe(no_mangle)]
pub extern "C" fn exo_law_real_size() -> usize {
    size_of::<Real>()
}
