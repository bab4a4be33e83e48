//! FMU states that a sequence has saved.

use super::expected::Expected;
use crate::types::FmuState;
use crate::{Instance, Status};
use std::ptr::null_mut;

/// A saved FMU state, with what is known of it.
pub struct Slot {
    state: FmuState,
    /// It as bytes, when it was saved.
    pub bytes: Vec<u8>,
    /// Where the instance was.
    pub expected: Expected,
}

impl Slot {
    /// Frees the state through any instance.
    ///
    /// # Errors
    /// When that is refused.
    pub fn free(mut self, instance: &Instance) -> Result<(), String> {
        match instance.free_state(&mut self.state) {
            Status::OK if self.state.is_null() => Ok(()),
            status => Err(format!("a saved state is not freed: {status:?}")),
        }
    }

    /// fmi2SetFMUstate
    ///
    /// # Errors
    /// When the instance is then not what was saved, bit for bit.
    pub fn restore(&self, instance: &Instance) -> Result<Status, String> {
        let status = instance.set_state(self.state);
        if instance.bytes() == self.bytes {
            Ok(status)
        } else {
            Err("the restored state is not the saved one".into())
        }
    }
}

/// fmi2GetFMUstate into a slot that is empty or holds a state.
pub fn save(slot: &mut Option<Slot>, instance: &Instance, expected: Expected) -> Status {
    let mut state = slot.take().map_or(null_mut(), |slot| slot.state);
    let (l, c) = (instance.library(), instance.component());
    // SAFETY: null or a live state of this library, which is then overwritten.
    let status = unsafe { (l.fmi2GetFMUstate)(c, &raw mut state) };
    if !state.is_null() {
        *slot = Some(Slot {
            state,
            bytes: instance.serialize(state),
            expected,
        });
    }
    status
}

/// fmi2SerializedFMUstateSize, fmi2SerializeFMUstate and fmi2DeSerializeFMUstate into the same slot.
///
/// # Errors
/// When other bytes come back.
pub fn through_bytes(slot: Option<&mut Slot>, instance: &Instance) -> Result<Status, String> {
    let (l, c) = (instance.library(), instance.component());
    let Some(slot) = slot else {
        let mut size = 0;
        // SAFETY: a null state is what is tried; the size is a local.
        return Ok(unsafe { (l.fmi2SerializedFMUstateSize)(c, null_mut(), &raw mut size) });
    };
    let bytes = instance.serialize(slot.state);
    let size = bytes.len();
    // SAFETY: the bytes of a state, into the live state of the slot.
    let status =
        unsafe { (l.fmi2DeSerializeFMUstate)(c, bytes.as_ptr().cast(), size, &raw mut slot.state) };
    if bytes != slot.bytes || instance.serialize(slot.state) != bytes {
        return Err("bytes there and back again differ".into());
    }
    Ok(status)
}

/// fmi2DeSerializeFMUstate of a slot's bytes, or of noise, with one byte changed.
///
/// # Errors
/// When a state comes of it.
pub fn damaged(slot: Option<&Slot>, instance: &Instance, byte: usize) -> Result<Status, String> {
    let mut bytes = slot.map_or_else(|| vec![0x5a; 100], |slot| slot.bytes.clone());
    let at = byte % bytes.len();
    bytes[at] ^= 0x5a;
    match instance.deserialize(&bytes) {
        Ok(_) => Err(format!("byte {at} is damaged, yet a state came of it")),
        Err(status) => Ok(status),
    }
}
