//! What can hold at a tick.

/// A condition on which a transition may depend.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Condition {
    /// The emergency stop is pressed.
    EmergencyStop,
    /// The joint angles cannot be trusted.
    EncoderInvalid,
    /// The law's result at this tick is not finite.
    NotFinite,
    /// The heartbeat has not changed for too long, or never did.
    HeartbeatLost,
    /// The human's force cannot be trusted.
    FtInvalid,
    /// A force that nobody varies has been there for too long.
    ForceSteady,
    /// Such a force, and it is what a wrong tool mass leaves of the tool's weight.
    ToolWeight,
    /// `enable` is true.
    Enabled,
    /// `engage` is true.
    EngageOn,
    /// `engage` is true and was false at the tick before.
    EngageRises,
    /// `acknowledge` is true and was false at the tick before.
    AcknowledgeRises,
    /// Nothing has been wrong for `init_time`.
    Prepared,
    /// A hold is requested, the human's hand is at rest, or nobody is seen to guide the nominal.
    Quiet,
    /// The authority has come down to 0.
    Stopped,
    /// A fault is latched.
    Latched,
}

impl Condition {
    /// All of them, by bit.
    pub const ALL: [Self; 15] = [
        Self::EmergencyStop,
        Self::EncoderInvalid,
        Self::NotFinite,
        Self::HeartbeatLost,
        Self::FtInvalid,
        Self::ForceSteady,
        Self::ToolWeight,
        Self::Enabled,
        Self::EngageOn,
        Self::EngageRises,
        Self::AcknowledgeRises,
        Self::Prepared,
        Self::Quiet,
        Self::Stopped,
        Self::Latched,
    ];

    /// Its name in words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::EmergencyStop => "emergency stop",
            Self::EncoderInvalid => "encoder invalid",
            Self::NotFinite => "result not finite",
            Self::HeartbeatLost => "heartbeat lost",
            Self::FtInvalid => "F/T invalid",
            Self::ForceSteady => "force steady",
            Self::ToolWeight => "tool weight wrong",
            Self::Enabled => "enabled",
            Self::EngageOn => "engage",
            Self::EngageRises => "engage rises",
            Self::AcknowledgeRises => "acknowledge rises",
            Self::Prepared => "prepared",
            Self::Quiet => "quiet",
            Self::Stopped => "stopped",
            Self::Latched => "fault latched",
        }
    }

    const fn bit(self) -> u16 {
        1 << self as u8
    }
}

/// A set of conditions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Conditions(u16);

impl Conditions {
    /// The set of those that `bits` names; bit i stands for [`Condition::ALL`]`[i]`.
    pub const fn from_bits(bits: u16) -> Self {
        Self(bits & ((1 << Condition::ALL.len()) - 1))
    }

    /// This set, with `condition` if it `holds`.
    #[must_use]
    pub const fn with(self, condition: Condition, holds: bool) -> Self {
        if holds {
            Self(self.0 | condition.bit())
        } else {
            self
        }
    }

    /// Whether `condition` is in it.
    pub const fn contain(self, condition: Condition) -> bool {
        self.0 & condition.bit() != 0
    }

    /// Whether all of `conditions` are in it; true if there are none.
    pub fn contain_all(self, conditions: &[Condition]) -> bool {
        conditions.iter().all(|condition| self.contain(*condition))
    }

    /// Whether any of `conditions` is in it; false if there are none.
    pub fn contain_any(self, conditions: &[Condition]) -> bool {
        conditions.iter().any(|condition| self.contain(*condition))
    }
}
