//! FMU states as the importer holds them: opaque pointers, known by address, so that a pointer that was never handed out
//! or was freed already is refused instead of followed.

use crate::ffi::FmuState;
use crate::model::Model;
use crate::snapshot::Snapshot;
use std::collections::BTreeSet;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Addresses of all live states of this library, whatever the instance or thread.
static LIVE: Mutex<BTreeSet<usize>> = Mutex::new(BTreeSet::new());

fn live() -> MutexGuard<'static, BTreeSet<usize>> {
    LIVE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Hands out a snapshot.
fn new<M: Model>(snapshot: Snapshot<M>) -> FmuState {
    let state: FmuState = Box::into_raw(Box::new(snapshot)).cast();
    live().insert(state as usize);
    state
}

/// The snapshot behind a pointer, if it is one of ours.
///
/// # Safety
/// The library exports one model only, `M`; no other thread frees or overwrites the state meanwhile.
pub(crate) unsafe fn get<'a, M: Model>(state: FmuState) -> Option<&'a Snapshot<M>> {
    if !live().contains(&(state as usize)) {
        return None;
    }
    // SAFETY: a live address came from `new::<M>` and was not freed since.
    unsafe { state.cast::<Snapshot<M>>().as_ref() }
}

/// Stores a snapshot where the importer's pointer points: into the state that stands there, or as a new one.
///
/// # Safety
/// As for [`get`].
pub(crate) unsafe fn put<M: Model>(slot: &mut FmuState, snapshot: Snapshot<M>) {
    if live().contains(&(*slot as usize)) {
        // SAFETY: a live address came from `new::<M>` and was not freed since; the caller lets no other thread use it.
        unsafe { *slot.cast::<Snapshot<M>>() = snapshot };
    } else {
        *slot = new(snapshot);
    }
}

/// Frees a state; `false` when it is not one of ours.
///
/// # Safety
/// As for [`get`].
pub(crate) unsafe fn free<M: Model>(state: FmuState) -> bool {
    let known = {
        let mut live = live();
        let known = live.remove(&(state as usize));
        if live.is_empty() {
            *live = BTreeSet::new(); // an emptied tree keeps a node, which would be lost when the library is unloaded
        }
        known
    };
    if known {
        // SAFETY: the address was live, so it came from `Box::into_raw` in `new::<M>`; it was removed just now, so this
        // happens once.
        drop(unsafe { Box::from_raw(state.cast::<Snapshot<M>>()) });
    }
    known
}
