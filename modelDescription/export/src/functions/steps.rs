//! The step, which three functions make: fmi2DoStep, fmi3DoStep and fmi3ActivateModelPartition.
//!
//! It is compiled once: a model's step is the largest part of a library.

use crate::ffi::{Component, Status};
use crate::guard::guard;
use crate::legality::Advance;
use crate::model::Model;

/// Makes the step from `t` of `h` (s).
pub unsafe fn step<M: Model>(c: Component, function: Advance, t: f64, h: f64) -> Status {
    // SAFETY: the importer's contract.
    unsafe { guard::<M, _>(c, function, |instance| instance.step(function, t, h)) }
}
