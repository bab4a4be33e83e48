//! One instance in a sequence: calls, checks, journal.

use super::call::{Call, SLOTS};
use super::expected::{Expected, Forecast, function};
use super::journal::{Done, perform, repeat};
use super::{Subject, Tally};
use crate::types::{FmuState, LAST_SUCCESSFUL_TIME};
use crate::{Instance, Message, Phase, Status};
use std::ptr::null_mut;

/// A saved FMU state, with what is known of it.
pub struct Slot {
    state: FmuState,
    bytes: Vec<u8>,
    expected: Expected,
}

impl Slot {
    /// Frees the state through any instance.
    ///
    /// # Errors
    /// When that is refused.
    pub fn free(mut self, player: &Player<'_>) -> Result<(), String> {
        match player.instance.free_state(&mut self.state) {
            Status::OK if self.state.is_null() => Ok(()),
            status => Err(format!("a saved state is not freed: {status:?}")),
        }
    }
}

/// One instance.
pub struct Player<'a> {
    subject: &'a Subject,
    instance: Instance,
    logging: bool,
    journal: Vec<Done>,
    /// Where it should be.
    pub expected: Expected,
}

impl<'a> Player<'a> {
    /// A new instance that logs.
    pub fn new(subject: &'a Subject) -> Self {
        Self {
            subject,
            instance: subject.fmu.instantiate(),
            logging: true,
            journal: Vec::new(),
            expected: Expected::NEW,
        }
    }

    /// Compares the instance with one that is alone.
    ///
    /// # Errors
    /// When they differ.
    pub fn settle(&mut self) -> Result<(), String> {
        let alone = repeat(self.subject, &self.journal)?;
        self.journal.clear();
        if self.instance.bytes() == alone {
            Ok(())
        } else {
            Err("the state differs from that of a run alone".into())
        }
    }

    /// One call with all its checks.
    ///
    /// # Errors
    /// What is not as it should be.
    pub fn play(
        &mut self,
        call: Call,
        slots: &mut [Option<Slot>; SLOTS],
        tally: &mut Tally,
    ) -> Result<(), String> {
        if matches!(call, Call::Reset | Call::Renew)
            || matches!(call, Call::Restore(slot) if slots[slot].is_some())
        {
            self.settle()?;
        }
        let saved = slots.each_ref().map(Option::is_some);
        let forecast = self.expected.forecast(self.subject, call, &saved);
        let before = self.expected;
        self.instance.messages();
        let status = match call {
            Call::Renew => {
                *self = Self::new(self.subject);
                Status::OK
            }
            Call::Save(slot) => self.save(&mut slots[slot]),
            Call::Restore(slot) => self.restore(slots[slot].as_ref(), tally)?,
            Call::Free(slot) => match slots[slot].take() {
                Some(slot) => slot.free(self).map(|()| Status::OK)?,
                None => self.instance.free_state(&mut null_mut()),
            },
            Call::ThroughBytes(slot) => self.through_bytes(slots[slot].as_mut())?,
            Call::Damaged(slot, byte) => self.damaged(slots[slot].as_ref(), byte)?,
            _ => perform(self.subject, &self.instance, call, before.time),
        };
        let log = self.instance.messages();
        match (status, forecast) {
            (Status::OK, Forecast::Accepted | Forecast::Objectionable | Forecast::Breakable) => {
                self.expected.accept(self.subject, call);
                tally.accepted += 1;
            }
            (Status::ERROR, Forecast::Refused) => {}
            (Status::ERROR, Forecast::Objectionable) => tally.objected += 1,
            (Status::ERROR, Forecast::Breakable) => {
                self.expected.phase = Phase::Error;
                tally.broken += 1;
            }
            _ => {
                return Err(format!(
                    "{status:?}, expected {forecast:?} of {before:?}; log {log:?}"
                ));
            }
        }
        self.check_log(call, status, &log)?;
        self.note(call, before, status);
        self.check_time()
    }

    fn check_log(&mut self, call: Call, status: Status, log: &[Message]) -> Result<(), String> {
        if let (Call::Logging(on), Status::OK) = (call, status) {
            self.logging = on;
        }
        let errors: Vec<_> = log
            .iter()
            .filter(|m| m.category == "logStatusError")
            .collect();
        let expected = usize::from(status == Status::ERROR && self.logging);
        let prefix = format!("{}: ", function(self.subject, call));
        let named = errors.iter().all(|m| m.text.starts_with(&prefix));
        if errors.len() == expected && named && (self.logging || log.is_empty()) {
            return Ok(());
        }
        Err(format!(
            "{status:?}, logging {}: expected {expected} errors of {prefix}, got {log:?}",
            self.logging
        ))
    }

    /// Keeps what an instance alone needs to get here. A reading in Initialization Mode computes initial values.
    fn note(&mut self, call: Call, before: Expected, status: Status) {
        let failed = self.expected.phase == Phase::Error && before.phase != Phase::Error;
        let matters = match call {
            Call::Setup(_) | Call::Enter | Call::Exit | Call::Terminate | Call::Reset => true,
            Call::Set(..) | Call::Ruin | Call::Step(..) => true,
            Call::Get(_) => before.phase == Phase::InitializationMode,
            _ => false,
        };
        if matters && (status == Status::OK || failed) {
            self.journal.push(Done::Call(call, before.time, status));
        }
    }

    /// The last successful time, where it can be asked for.
    fn check_time(&self) -> Result<(), String> {
        let mut time = f64::NAN;
        let (l, c) = (self.instance.library(), self.instance.component());
        // SAFETY: a live instance and a local.
        let status = unsafe { (l.fmi2GetRealStatus)(c, LAST_SUCCESSFUL_TIME, &raw mut time) };
        let run = !matches!(
            self.expected.phase,
            Phase::Instantiated | Phase::InitializationMode
        );
        let good = match status {
            Status::OK => run && time == self.expected.time,
            Status::ERROR => !run,
            _ => false,
        };
        if good {
            return Ok(());
        }
        Err(format!(
            "fmi2GetRealStatus {status:?}, {time} s; expected {:?}",
            self.expected
        ))
    }

    fn save(&self, slot: &mut Option<Slot>) -> Status {
        let mut state = slot.take().map_or(null_mut(), |slot| slot.state);
        let (l, c) = (self.instance.library(), self.instance.component());
        // SAFETY: null or a live state of this library, which is then overwritten.
        let status = unsafe { (l.fmi2GetFMUstate)(c, &raw mut state) };
        if !state.is_null() {
            *slot = Some(Slot {
                state,
                bytes: self.instance.serialize(state),
                expected: self.expected,
            });
        }
        status
    }

    fn restore(&mut self, slot: Option<&Slot>, tally: &mut Tally) -> Result<Status, String> {
        let Some(slot) = slot else {
            return Ok(self.instance.set_state(null_mut()));
        };
        let status = self.instance.set_state(slot.state);
        if self.instance.bytes() != slot.bytes {
            return Err("the restored state is not the saved one".into());
        }
        self.expected = slot.expected;
        self.journal = vec![Done::State(slot.bytes.clone())];
        tally.restored += 1;
        Ok(status)
    }

    fn through_bytes(&self, slot: Option<&mut Slot>) -> Result<Status, String> {
        let (l, c) = (self.instance.library(), self.instance.component());
        let Some(slot) = slot else {
            let mut size = 0;
            // SAFETY: a null state is what is tried; the size is a local.
            return Ok(unsafe { (l.fmi2SerializedFMUstateSize)(c, null_mut(), &raw mut size) });
        };
        let bytes = self.instance.serialize(slot.state);
        let size = bytes.len();
        // SAFETY: the bytes of a state, into the live state of the slot.
        let status = unsafe {
            (l.fmi2DeSerializeFMUstate)(c, bytes.as_ptr().cast(), size, &raw mut slot.state)
        };
        if bytes != slot.bytes || self.instance.serialize(slot.state) != bytes {
            return Err("bytes there and back again differ".into());
        }
        Ok(status)
    }

    fn damaged(&self, slot: Option<&Slot>, byte: usize) -> Result<Status, String> {
        let mut bytes = slot.map_or_else(|| vec![0x5a; 100], |slot| slot.bytes.clone());
        let at = byte % bytes.len();
        bytes[at] ^= 0x5a;
        match self.instance.deserialize(&bytes) {
            Ok(_) => Err(format!("byte {at} is damaged, yet a state came of it")),
            Err(status) => Ok(status),
        }
    }
}
