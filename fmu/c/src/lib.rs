//! The admittance laws as a C library for a real-time controller: one axis, and the arm.
//!
//! It is a shell around the packages `admittance` and `arm-law`, as the FMUs are: the same structs, the same ticks, bit for bit. The package
//! `exo-law-f32` is the same in single precision. `include/exo_law.h` is generated from this source.
//!
//! | module | what |
//! |---|---|
//! | [`arm`] | `exo_arm_*`: the law of ArmController.fmu |
//! | [`axis`] | `exo_axis_*`: one axis, the law of TestbedController.fmu in torque form |
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
//! * A call that is refused says so by its [`Status`](refusal::Status) and leaves state and outputs as they were.

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

/// Size of the number that the library was built with, in bytes: must equal `sizeof(exo_real)`. Where it does not, the
/// header was read with the other setting of `EXO_LAW_F32`.
#[unsafe(no_mangle)]
pub extern "C" fn exo_law_real_size() -> usize {
    size_of::<Real>()
}
