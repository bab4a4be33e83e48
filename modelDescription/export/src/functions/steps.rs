//! The step, which three functions make: fmi2DoStep, fmi3DoStep and fmi3ActivateModelPartition.
//!
//! It is compiled once: a model's step is the largest part of a library. As a C function it would cost more: what may not
//! unwind gets no model's step inlined (four instructions for a hundred).

use crate::ffi::{Component, Status};
use crate::guard::guard;
use crate::legality::Advance;
use crate::model::Model;

/// Makes the step from `t` of `h` (s).
#[inline(never)]
pub unsafe fn step<M: Model>(c: Component, t: f64, h: f64) -> Status {
    // SAFETY: the importer's contract.
    unsafe { guard::<M, _>(c, Advance, |instance| instance.step(t, h)) }
}
