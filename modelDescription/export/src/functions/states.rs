//! FMU state: section 2.1.8.

use super::known;
use crate::ffi::*;
use crate::guard::guard;
use crate::handle;
use crate::instance::refused;
use crate::legality::Function as F;
use crate::model::Model;
use crate::snapshot::Snapshot;

/// fmi2GetFMUstate
pub unsafe fn get_fmu_state<M: Model>(c: Component, state: *mut FmuState) -> Status {
    // SAFETY: the importer's contract; one model per library.
    unsafe {
        guard::<M>(c, F::fmi2GetFMUstate, |instance| {
            let slot = known(state.as_mut(), "FMUstate")?;
            handle::put(slot, instance.now.clone());
            Ok(())
        })
    }
}

/// fmi2SetFMUstate
pub unsafe fn set_fmu_state<M: Model>(c: Component, state: FmuState) -> Status {
    // SAFETY: the importer's contract; one model per library.
    unsafe {
        guard::<M>(c, F::fmi2SetFMUstate, |instance| {
            let snapshot = known(handle::get::<M>(state), "FMUstate")?;
            instance.restore(snapshot)
        })
    }
}

/// fmi2FreeFMUstate: null is allowed, also inside.
pub unsafe fn free_fmu_state<M: Model>(c: Component, state: *mut FmuState) -> Status {
    // SAFETY: the importer's contract; one model per library.
    unsafe {
        guard::<M>(c, F::fmi2FreeFMUstate, |_| match state.as_mut() {
            Some(slot) if !slot.is_null() => {
                if !handle::free::<M>(*slot) {
                    return refused(
                        "FMUstate is not a state of this FMU, or was freed before".into(),
                    );
                }
                *slot = std::ptr::null_mut();
                Ok(())
            }
            _ => Ok(()),
        })
    }
}

/// fmi2SerializedFMUstateSize
pub unsafe fn serialized_fmu_state_size<M: Model>(
    c: Component,
    state: FmuState,
    size: *mut usize,
) -> Status {
    // SAFETY: the importer's contract; one model per library.
    unsafe {
        guard::<M>(c, F::fmi2SerializedFMUstateSize, |_| {
            let size = known(size.as_mut(), "size")?;
            *size = known(handle::get::<M>(state), "FMUstate")?
                .to_bytes()?
                .len();
            Ok(())
        })
    }
}

/// fmi2SerializeFMUstate
pub unsafe fn serialize_fmu_state<M: Model>(
    c: Component,
    state: FmuState,
    bytes: *mut Byte,
    size: usize,
) -> Status {
    // SAFETY: the importer's contract; one model per library.
    unsafe {
        guard::<M>(c, F::fmi2SerializeFMUstate, |_| {
            let target = known(array_mut(bytes.cast::<u8>(), size), "serializedState")?;
            let source = known(handle::get::<M>(state), "FMUstate")?.to_bytes()?;
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

/// fmi2DeSerializeFMUstate
pub unsafe fn deserialize_fmu_state<M: Model>(
    c: Component,
    bytes: *const Byte,
    size: usize,
    state: *mut FmuState,
) -> Status {
    // SAFETY: the importer's contract; one model per library.
    unsafe {
        guard::<M>(c, F::fmi2DeSerializeFMUstate, |_| {
            let bytes = known(array(bytes.cast::<u8>(), size), "serializedState")?;
            let slot = known(state.as_mut(), "FMUstate")?;
            handle::put(slot, Snapshot::<M>::from_bytes(bytes)?);
            Ok(())
        })
    }
}
