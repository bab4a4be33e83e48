//! FMU states.

use super::known;
use crate::ffi::{Component, FmuState, Status, array, array_mut};
use crate::guard::guard;
use crate::handle;
use crate::instance::refused;
use crate::legality::Call;
use crate::model::Model;
use crate::snapshot::Snapshot;

/// fmi2GetFMUstate, fmi3GetFMUState
pub unsafe fn get_fmu_state<M: Model, F: Call>(
    c: Component,
    function: F,
    state: *mut FmuState,
) -> Status {
    // SAFETY: the importer's contract; one model per library.
    unsafe {
        guard::<M, F>(c, function, |instance| {
            let slot = known(state.as_mut(), instance.interface().fmu_state())?;
            handle::put(slot, instance.now.clone());
            Ok(())
        })
    }
}

/// fmi2SetFMUstate, fmi3SetFMUState
pub unsafe fn set_fmu_state<M: Model, F: Call>(
    c: Component,
    function: F,
    state: FmuState,
) -> Status {
    // SAFETY: the importer's contract; one model per library.
    unsafe {
        guard::<M, F>(c, function, |instance| {
            let snapshot = known(handle::get::<M>(state), instance.interface().fmu_state())?;
            instance.restore(snapshot)
        })
    }
}

/// fmi2FreeFMUstate, fmi3FreeFMUState: null is allowed, also inside.
pub unsafe fn free_fmu_state<M: Model, F: Call>(
    c: Component,
    function: F,
    state: *mut FmuState,
) -> Status {
    // SAFETY: the importer's contract; one model per library.
    unsafe {
        guard::<M, F>(c, function, |instance| match state.as_mut() {
            Some(slot) if !slot.is_null() => {
                if !handle::free::<M>(*slot) {
                    return refused(format!(
                        "{} is not a state of this FMU, or was freed before",
                        instance.interface().fmu_state()
                    ));
                }
                *slot = std::ptr::null_mut();
                Ok(())
            }
            _ => Ok(()),
        })
    }
}

/// fmi2SerializedFMUstateSize, fmi3SerializedFMUStateSize
pub unsafe fn serialized_fmu_state_size<M: Model, F: Call>(
    c: Component,
    function: F,
    state: FmuState,
    size: *mut usize,
) -> Status {
    // SAFETY: the importer's contract; one model per library.
    unsafe {
        guard::<M, F>(c, function, |instance| {
            let size = known(size.as_mut(), "size")?;
            *size = known(handle::get::<M>(state), instance.interface().fmu_state())?
                .to_bytes()?
                .len();
            Ok(())
        })
    }
}

/// fmi2SerializeFMUstate, fmi3SerializeFMUState
pub unsafe fn serialize_fmu_state<M: Model, F: Call>(
    c: Component,
    function: F,
    state: FmuState,
    bytes: *mut u8,
    size: usize,
) -> Status {
    // SAFETY: the importer's contract; one model per library.
    unsafe {
        guard::<M, F>(c, function, |instance| {
            let target = known(array_mut(bytes, size), "serializedState")?;
            let source =
                known(handle::get::<M>(state), instance.interface().fmu_state())?.to_bytes()?;
            let Some(target) = target.get_mut(..source.len()) else {
                return refused(format!(
                    "size = {size}, expected at least {} bytes",
                    source.len()
                ));
            };
            target.copy_from_slice(&source);
            Ok(())
        })
    }
}

/// fmi2DeSerializeFMUstate, fmi3DeserializeFMUState
pub unsafe fn deserialize_fmu_state<M: Model, F: Call>(
    c: Component,
    function: F,
    bytes: *const u8,
    size: usize,
    state: *mut FmuState,
) -> Status {
    // SAFETY: the importer's contract; one model per library.
    unsafe {
        guard::<M, F>(c, function, |instance| {
            let bytes = known(array(bytes, size), "serializedState")?;
            let slot = known(state.as_mut(), instance.interface().fmu_state())?;
            handle::put(slot, Snapshot::<M>::from_bytes(bytes)?);
            Ok(())
        })
    }
}
