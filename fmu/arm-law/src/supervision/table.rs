//! Which state follows: the one table.

use super::condition::Condition::{self, *};
use super::condition::Conditions;
use super::state::State::{self, *};

/// A row: from any of these states, when all of one list holds and none of the other, to that state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rule {
    /// States in which it applies.
    pub from: &'static [State],
    /// What must hold, all of it.
    pub when: &'static [Condition],
    /// What must not hold, none of it.
    pub unless: &'static [Condition],
    /// The state that follows.
    pub to: State,
    /// Why.
    pub why: &'static str,
}

/// What makes a fault, the first first: this order decides which of several at one tick is named.
pub const FAULTS: &[Condition] = &[
    EmergencyStop,
    EncoderInvalid,
    NotFinite,
    HeartbeatLost,
    FtInvalid,
    ForceSteady,
    ToolWeight,
];

/// The table. The first row that applies decides; where none does, the state stays.
pub const RULES: &[Rule] = &[
    Rule {
        from: &[Off, Init, Ready, Engaged, Hold, SoftStop],
        when: &[NotFinite],
        unless: &[],
        to: Fault,
        why: "no torque can be computed",
    },
    Rule {
        from: &[Init, Ready, Engaged, Hold, SoftStop],
        when: &[EmergencyStop],
        unless: &[],
        to: Fault,
        why: "somebody wants no torque, now",
    },
    Rule {
        from: &[Engaged, Hold, SoftStop],
        when: &[EncoderInvalid],
        unless: &[],
        to: Fault,
        why: "without a position not even a held nominal means anything",
    },
    Rule {
        from: &[SoftStop],
        when: &[Stopped, Latched],
        unless: &[],
        to: Fault,
        why: "a fault caused this stop, or came during it",
    },
    Rule {
        from: &[SoftStop],
        when: &[Stopped],
        unless: &[],
        to: Off,
        why: "the stop was asked for",
    },
    Rule {
        from: &[Engaged, Hold],
        when: &[HeartbeatLost],
        unless: &[],
        to: SoftStop,
        why: "nobody is known to watch; the position is good, so the load loses its support gradually",
    },
    Rule {
        from: &[Engaged, Hold],
        when: &[FtInvalid],
        unless: &[],
        to: SoftStop,
        why: "nobody can be followed; the position is good, so the load loses its support gradually",
    },
    Rule {
        from: &[Engaged, Hold],
        when: &[ForceSteady],
        unless: &[],
        to: SoftStop,
        why: "nobody is known to guide, and somebody must look at the sensor",
    },
    Rule {
        from: &[Engaged, Hold],
        when: &[ToolWeight],
        unless: &[],
        to: SoftStop,
        why: "likewise, and at the tool",
    },
    Rule {
        from: &[Engaged, Hold],
        when: &[],
        unless: &[Enabled],
        to: SoftStop,
        why: "enable was withdrawn",
    },
    Rule {
        from: &[Engaged, Hold],
        when: &[],
        unless: &[EngageOn],
        to: SoftStop,
        why: "engage was withdrawn",
    },
    Rule {
        from: &[Init, Ready],
        when: &[],
        unless: &[Enabled],
        to: Off,
        why: "enable was withdrawn; nothing was moving",
    },
    Rule {
        from: &[Ready],
        when: &[EncoderInvalid],
        unless: &[],
        to: Init,
        why: "no longer prepared; nothing was moving, so nothing is latched",
    },
    Rule {
        from: &[Ready],
        when: &[HeartbeatLost],
        unless: &[],
        to: Init,
        why: "likewise",
    },
    Rule {
        from: &[Ready],
        when: &[FtInvalid],
        unless: &[],
        to: Init,
        why: "likewise",
    },
    Rule {
        from: &[Ready],
        when: &[ForceSteady],
        unless: &[],
        to: Init,
        why: "likewise",
    },
    Rule {
        from: &[Ready],
        when: &[ToolWeight],
        unless: &[],
        to: Init,
        why: "likewise",
    },
    Rule {
        from: &[Off],
        when: &[Enabled],
        unless: &[],
        to: Init,
        why: "enable",
    },
    Rule {
        from: &[Init],
        when: &[Prepared],
        unless: FAULTS,
        to: Ready,
        why: "sensors and heartbeat have been good for init_time",
    },
    Rule {
        from: &[Ready],
        when: &[EngageRises],
        unless: &[],
        to: Engaged,
        why: "a rising edge, seen here: an engage that is stuck at true never engages",
    },
    Rule {
        from: &[Engaged],
        when: &[Quiet],
        unless: &[],
        to: Hold,
        why: "a hold is requested, or the hand is at rest",
    },
    Rule {
        from: &[Hold],
        when: &[],
        unless: &[Quiet],
        to: Engaged,
        why: "no longer",
    },
    Rule {
        from: &[Fault],
        when: &[AcknowledgeRises],
        unless: FAULTS,
        to: Off,
        why: "somebody has seen it, and nothing is wrong any more",
    },
];

impl Rule {
    /// Whether it applies in `state` under `conditions`.
    pub fn applies(&self, state: State, conditions: Conditions) -> bool {
        self.from.contains(&state)
            && conditions.contain_all(self.when)
            && !conditions.contain_any(self.unless)
    }
}

/// The row that decides in `state` under `conditions`; `None` where the state stays.
pub fn decisive(state: State, conditions: Conditions) -> Option<&'static Rule> {
    RULES.iter().find(|rule| rule.applies(state, conditions))
}

/// The state that follows `state` under `conditions`.
pub fn next(state: State, conditions: Conditions) -> State {
    decisive(state, conditions).map_or(state, |rule| rule.to)
}
