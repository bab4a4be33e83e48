//! The C boundary: the only unsafe code.
//!
//! A function here checks what can be checked of a pointer, null and alignment, and relies for the rest on the caller's
//! contract, which the header states: a pointer that is not null points to an object of its type that nothing else uses
//! during the call.

use crate::refusal::{Bad, Refusal, Status};
use crate::storage::{Cell, Storage};
use core::ops::Range;

/// Checks a pointer.
fn check<T>(pointer: *const T) -> Result<(), Status> {
    if pointer.is_null() {
        Err(Status::Null)
    } else if !pointer.is_aligned() {
        Err(Status::Misaligned)
    } else {
        Ok(())
    }
}

/// What the caller gives to read.
pub(crate) fn read<T: Copy>(pointer: *const T) -> Result<T, Status> {
    check(pointer)?;
    // SAFETY: not null and aligned; that an object is there is the caller's contract. All types of the interface are
    // numbers, so that any bytes are one.
    Ok(unsafe { pointer.read() })
}

/// A place that the caller gives to write.
pub(crate) struct Place<T>(*mut T);

impl<T> Place<T> {
    /// The place behind the pointer.
    pub(crate) fn at(pointer: *mut T) -> Result<Self, Status> {
        check(pointer)?;
        Ok(Self(pointer))
    }

    /// Writes it.
    pub(crate) fn write(self, value: T) {
        // SAFETY: checked by `at`; that an object is there is the caller's contract.
        unsafe { self.0.write(value) }
    }
}

/// Writes zeros over the fields `at` (bytes from the begin of the struct), all numbers, where there is a struct.
#[inline]
pub(crate) fn zero<T>(outputs: *mut T, at: &[Range<usize>]) {
    let Ok(Place(outputs)) = Place::at(outputs) else {
        return;
    };
    for at in at {
        if at.start <= at.end && at.end <= size_of::<T>() {
            // SAFETY: within the object that is there by the caller's contract. Nothing is read: it may be uninitialized.
            unsafe {
                let begin = outputs.cast::<u8>().add(at.start);
                begin.write_bytes(0, at.end - at.start);
            }
        }
    }
}

/// Puts a law into its memory.
pub(crate) fn initialize<S: Storage>(state: Place<S>, law: S::Law) {
    // SAFETY: the memory is large and aligned enough (`Storage`'s contract).
    unsafe {
        state
            .0
            .cast::<Cell<S::Law>>()
            .write(Cell::new(S::MARK, law))
    }
}

/// The law in its memory, for the time of `work`.
pub(crate) fn with_law<S: Storage, R>(
    state: *mut S,
    work: impl FnOnce(&mut S::Law) -> Result<R, Cause>,
) -> Result<R, Cause> {
    let Place(state) = Place::at(state)?;
    // SAFETY: the memory is large and aligned enough (`Storage`'s contract); that nothing else uses it meanwhile is the
    // caller's.
    let cell = unsafe { &mut *state.cast::<Cell<S::Law>>() };
    cell.law_mut(S::MARK)
        .map_or(Err(Status::NotInitialized.into()), work)
}

/// The status of a call that may refuse a value; which one is written where the caller asks for it, if it does.
pub(crate) fn refusing(refusal: *mut Refusal, work: impl FnOnce() -> Result<(), Cause>) -> Status {
    let place = match Place::at(refusal) {
        Ok(place) => Some(place),
        Err(Status::Null) => None,
        Err(status) => return status,
    };
    let (status, which) = match work() {
        Ok(()) => (Status::Ok, Refusal::default()),
        Err(Cause::Status(status)) => (status, Refusal::default()),
        Err(Cause::Value(bad)) => (Status::Refused, bad.into()),
    };
    if let Some(place) = place {
        place.write(which);
    }
    status
}

/// Why a call that takes values failed.
pub(crate) enum Cause {
    Status(Status),
    Value(Bad),
}

impl From<Status> for Cause {
    fn from(status: Status) -> Self {
        Self::Status(status)
    }
}

impl From<Bad> for Cause {
    fn from(bad: Bad) -> Self {
        Self::Value(bad)
    }
}

/// The status of a call that refuses no value.
pub(crate) fn status(result: Result<(), Status>) -> Status {
    match result {
        Ok(()) => Status::Ok,
        Err(status) => status,
    }
}
