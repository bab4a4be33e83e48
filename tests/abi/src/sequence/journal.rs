//! What was done to one instance, so that it can be done again to one that is alone.

use super::Subject;
use super::call::{Call, TEXTS, Value};
use crate::{Instance, Kind, Status};
use std::ptr::null;

/// One entry.
#[derive(Clone, Debug)]
pub enum Done {
    /// A call at this communication point (s), and how it ended.
    Call(Call, f64, Status),
    /// A state that was set, as bytes.
    State(Vec<u8>),
}

/// Does it all again on a new instance; its state then, as bytes.
///
/// # Errors
/// The call that ended otherwise than the first time.
pub fn repeat(subject: &Subject, journal: &[Done]) -> Result<Vec<u8>, String> {
    let alone = subject.fmu.instantiate_as(&subject.fmu.setup().silent());
    for done in journal {
        match done {
            Done::Call(call, time, status) => {
                let again = perform(subject, &alone, *call, *time);
                if again != *status {
                    return Err(format!("{call:?} alone: {again:?} instead of {status:?}"));
                }
            }
            Done::State(bytes) => {
                let mut state = alone
                    .deserialize(bytes)
                    .map_err(|status| format!("saved bytes alone: {status:?}"))?;
                let statuses = [alone.set_state(state), alone.free_state(&mut state)];
                if statuses != [Status::OK; 2] {
                    return Err(format!("a saved state alone: {statuses:?}"));
                }
            }
        }
    }
    Ok(alone.bytes())
}

/// One call that takes no state, on an instance whose communication point is `time` (s).
///
/// # Panics
/// When the call is one that takes a state or replaces the instance.
pub fn perform(subject: &Subject, instance: &Instance, call: Call, time: f64) -> Status {
    let (l, c) = (instance.library(), instance.component());
    match call {
        Call::Setup(start) => instance.setup_experiment(start, None),
        Call::Enter => instance.enter_initialization_mode(),
        Call::Exit => instance.exit_initialization_mode(),
        Call::Terminate => instance.terminate(),
        Call::Reset => instance.reset(),
        Call::Set(position, value) => {
            let r = subject.variable(position).reference;
            match value {
                Value::Real(value) => instance.set_real(&[r], &[value]),
                Value::Integer(value) => instance.set_integer(&[r], &[value]),
                Value::Boolean(value) => instance.set_boolean(&[r], &[value.into()]),
                Value::Text(text) => instance.set_string(r, TEXTS[text]),
            }
        }
        Call::Ruin => instance.set_real(&subject.ruin.0, &subject.ruin.1),
        Call::Get(position) => {
            let variable = subject.variable(position);
            let r = [variable.reference];
            let status = |failure: Option<Status>| failure.unwrap_or(Status::OK);
            match variable.kind {
                Kind::Real {} => status(instance.get_real(&r).err()),
                Kind::Integer {} | Kind::Enumeration {} => status(instance.get_integer(&r).err()),
                Kind::Boolean {} => status(instance.get_boolean(&r).err()),
                Kind::String {} => {
                    let mut text = null();
                    // SAFETY: a live instance, one element each.
                    unsafe { (l.fmi2GetString)(c, r.as_ptr(), 1, &raw mut text) }
                }
            }
        }
        Call::GetUnknown(position) => {
            let references = [subject.variable(position).reference, u32::MAX];
            instance.get_real(&references).err().unwrap_or(Status::OK)
        }
        // SAFETY: a live instance; null pointers are what is tried.
        Call::Null => unsafe { (l.fmi2SetReal)(c, null(), 1, null()) },
        Call::Step(beside, h) => instance.step(time + beside, h),
        Call::Logging(on) => instance.set_debug_logging(on, &[]),
        Call::Other(function) => crate::calls::call(function, &subject.fmu, instance),
        Call::Renew
        | Call::Save(_)
        | Call::Restore(_)
        | Call::Free(_)
        | Call::ThroughBytes(_)
        | Call::Damaged(..) => panic!("{call:?} is no call on one instance alone"),
    }
}
