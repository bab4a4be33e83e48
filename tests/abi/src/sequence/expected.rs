//! What a call should come to: the standard's table and rights, the bounds of the rows, the times.

use super::Subject;
use super::call::{Call, SLOTS};
use crate::standard::{Verdict, verdict};
use crate::{Kind, Phase, rights};

/// What is known of one instance without asking it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// Where it is in its life.
    pub phase: Phase,
    /// Its communication point (s).
    pub time: f64,
    /// Something was set after which the model may object at the end of initialization, or fail in a step.
    pub wild: bool,
}

/// How a call should end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Forecast {
    /// fmi2OK
    Accepted,
    /// fmi2Error, nothing changed
    Refused,
    /// fmi2OK, or the model has a reason of its own to refuse
    Objectionable,
    /// fmi2OK, or fmi2Error and the error phase
    Breakable,
}

impl Expected {
    /// A new instance.
    pub const NEW: Self = Self {
        phase: Phase::Instantiated,
        time: 0.0,
        wild: false,
    };

    /// How `call` should end on this instance, with these states saved.
    pub fn forecast(&self, subject: &Subject, call: Call, saved: &[bool; SLOTS]) -> Forecast {
        let legal = |function: &str| verdict(function, self.phase) == Verdict::Accepted;
        let accepted = match call {
            Call::Renew | Call::Reset | Call::Logging(_) | Call::Save(_) | Call::Free(_) => true,
            Call::Setup(start) => legal("fmi2SetupExperiment") && start.is_finite(),
            Call::Enter => legal("fmi2EnterInitializationMode"),
            Call::Terminate => legal("fmi2Terminate"),
            Call::Exit if legal("fmi2ExitInitializationMode") && self.wild => {
                return Forecast::Objectionable;
            }
            Call::Exit => legal("fmi2ExitInitializationMode"),
            Call::Set(position, value) => {
                let variable = subject.variable(position);
                let good =
                    rights::settable(variable, self.phase) && subject.allows(position, value);
                let tuned = variable.causality == "parameter" && self.phase == Phase::StepComplete;
                if good && tuned && (self.wild || subject.is_wild(position, value)) {
                    return Forecast::Objectionable;
                }
                good
            }
            Call::Ruin => legal("fmi2SetReal"),
            Call::Get(position) => rights::readable(subject.variable(position), self.phase),
            Call::GetUnknown(_) | Call::Null | Call::Damaged(..) => false,
            Call::Step(beside, h) => {
                let good = legal("fmi2DoStep") && beside == 0.0 && h.is_normal() && h > 0.0;
                if good && self.wild {
                    return Forecast::Breakable;
                }
                good
            }
            Call::Restore(slot) | Call::ThroughBytes(slot) => saved[slot],
            Call::Other(function) => legal(function),
        };
        if accepted {
            Forecast::Accepted
        } else {
            Forecast::Refused
        }
    }

    /// The effect of a call that ended with fmi2OK. States are the caller's.
    pub fn accept(&mut self, subject: &Subject, call: Call) {
        match call {
            Call::Renew | Call::Reset => *self = Self::NEW,
            Call::Setup(start) => self.time = start,
            Call::Enter => self.phase = Phase::InitializationMode,
            Call::Exit => self.phase = Phase::StepComplete,
            Call::Terminate => self.phase = Phase::Terminated,
            Call::Set(position, value) => self.wild |= subject.is_wild(position, value),
            Call::Ruin => self.wild = true,
            Call::Step(_, h) => self.time += h,
            _ => {}
        }
    }
}

/// The C function that a call is about, as its refusal names it.
pub fn function(subject: &Subject, call: Call) -> &'static str {
    let by_kind = |position: usize, names: [&'static str; 4]| match subject.variable(position).kind
    {
        Kind::Real {} => names[0],
        Kind::Integer {} | Kind::Enumeration {} => names[1],
        Kind::Boolean {} => names[2],
        Kind::String {} => names[3],
    };
    match call {
        Call::Renew => "fmi2Instantiate",
        Call::Setup(_) => "fmi2SetupExperiment",
        Call::Enter => "fmi2EnterInitializationMode",
        Call::Exit => "fmi2ExitInitializationMode",
        Call::Terminate => "fmi2Terminate",
        Call::Reset => "fmi2Reset",
        Call::Set(position, _) => by_kind(
            position,
            [
                "fmi2SetReal",
                "fmi2SetInteger",
                "fmi2SetBoolean",
                "fmi2SetString",
            ],
        ),
        Call::Get(position) => by_kind(
            position,
            [
                "fmi2GetReal",
                "fmi2GetInteger",
                "fmi2GetBoolean",
                "fmi2GetString",
            ],
        ),
        Call::GetUnknown(_) => "fmi2GetReal",
        Call::Null | Call::Ruin => "fmi2SetReal",
        Call::Step(..) => "fmi2DoStep",
        Call::Save(_) => "fmi2GetFMUstate",
        Call::Restore(_) => "fmi2SetFMUstate",
        Call::Free(_) => "fmi2FreeFMUstate",
        Call::ThroughBytes(_) => "fmi2SerializedFMUstateSize",
        Call::Damaged(..) => "fmi2DeSerializeFMUstate",
        Call::Logging(_) => "fmi2SetDebugLogging",
        Call::Other(function) => function,
    }
}
