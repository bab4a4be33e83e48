//! One instance in a sequence: calls, checks, journal.

use super::call::{Call, SLOTS};
use super::expected::{Expected, Forecast, function};
use super::journal::{Done, perform, repeat};
use super::slot::{self, Slot};
use super::{Subject, Tally};
use crate::types::LAST_SUCCESSFUL_TIME;
use crate::{Instance, Message, Phase, Status};
use std::ptr::null_mut;

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

    /// The instance, for what outlives its calls.
    pub fn instance(&self) -> &Instance {
        &self.instance
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
            Call::Save(slot) => slot::save(&mut slots[slot], &self.instance, self.expected),
            Call::Restore(slot) => self.restore(slots[slot].as_ref(), tally)?,
            Call::Free(slot) => match slots[slot].take() {
                Some(slot) => slot.free(&self.instance).map(|()| Status::OK)?,
                None => self.instance.free_state(&mut null_mut()),
            },
            Call::ThroughBytes(slot) => slot::through_bytes(slots[slot].as_mut(), &self.instance)?,
            Call::Damaged(slot, byte) => slot::damaged(slots[slot].as_ref(), &self.instance, byte)?,
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

    fn restore(&mut self, slot: Option<&Slot>, tally: &mut Tally) -> Result<Status, String> {
        let Some(slot) = slot else {
            return Ok(self.instance.set_state(null_mut()));
        };
        let status = slot.restore(&self.instance)?;
        self.expected = slot.expected;
        self.journal = vec![Done::State(slot.bytes.clone())];
        tally.restored += 1;
        Ok(status)
    }
}
