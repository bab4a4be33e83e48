//! Why the law does not simply run.

use super::condition::Condition;

/// A reason. Of several at one tick a fault is named before a warning, then the one with the smallest number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(i32)]
pub enum Diagnostic {
    /// Nothing to say: the law runs, or holds.
    None = 0,
    /// Fault: the emergency stop is pressed.
    EmergencyStop = 1,
    /// Fault: the joint angles have one: marked invalid, not finite, over range, a jump, stuck.
    EncoderInvalid = 2,
    /// Fault: the law's result is not finite.
    NotFinite = 3,
    /// Fault: the heartbeat has not changed within its timeout, or never did.
    HeartbeatLost = 4,
    /// Fault: the human's force cannot be trusted.
    FtInvalid = 5,
    /// Warning: motion beyond the stated bounds took more energy than the tank had; no torque until it is repaid.
    EnergyDebt = 6,
    /// Warning: the motion since the last tick exceeds the bounds of the passivity argument, or is not known.
    OutsideBounds = 7,
    /// Warning: the force or torque limits have been acting for longer than `saturation_time`.
    Saturated = 8,
    /// A fault's cause is gone; it waits for a rising edge of `acknowledge`.
    NotAcknowledged = 9,
    /// `enable` is false.
    NotEnabled = 10,
    /// Sensors and heartbeat are good, not yet for `init_time`.
    Preparing = 11,
    /// `engage` is false.
    NotEngaged = 12,
    /// `engage` is true, but has not risen since the controller was ready: it must go to false first.
    EngageStuck = 13,
    /// Warning: a force that nobody varies moves the nominal, or would; after `drift_stop_time` a fault.
    ForceSteady = 14,
    /// The same, and it is what a wrong tool mass leaves of the tool's weight.
    ToolWeight = 15,
}

impl Diagnostic {
    /// All of them, by number.
    pub const ALL: [Self; 16] = [
        Self::None,
        Self::EmergencyStop,
        Self::EncoderInvalid,
        Self::NotFinite,
        Self::HeartbeatLost,
        Self::FtInvalid,
        Self::EnergyDebt,
        Self::OutsideBounds,
        Self::Saturated,
        Self::NotAcknowledged,
        Self::NotEnabled,
        Self::Preparing,
        Self::NotEngaged,
        Self::EngageStuck,
        Self::ForceSteady,
        Self::ToolWeight,
    ];

    /// Its number in an interface.
    pub const fn number(self) -> i32 {
        self as i32
    }

    /// Its name, as in an identifier.
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::EmergencyStop => "emergency_stop",
            Self::EncoderInvalid => "encoder_invalid",
            Self::NotFinite => "not_finite",
            Self::HeartbeatLost => "heartbeat_lost",
            Self::FtInvalid => "ft_invalid",
            Self::EnergyDebt => "energy_debt",
            Self::OutsideBounds => "outside_bounds",
            Self::Saturated => "saturated",
            Self::NotAcknowledged => "not_acknowledged",
            Self::NotEnabled => "not_enabled",
            Self::Preparing => "preparing",
            Self::NotEngaged => "not_engaged",
            Self::EngageStuck => "engage_stuck",
            Self::ForceSteady => "force_steady",
            Self::ToolWeight => "tool_weight",
        }
    }

    /// The fault that `condition` makes; `None` for one that is no fault.
    pub const fn of(condition: Condition) -> Self {
        match condition {
            Condition::EmergencyStop => Self::EmergencyStop,
            Condition::EncoderInvalid => Self::EncoderInvalid,
            Condition::NotFinite => Self::NotFinite,
            Condition::HeartbeatLost => Self::HeartbeatLost,
            Condition::FtInvalid => Self::FtInvalid,
            Condition::ForceSteady => Self::ForceSteady,
            Condition::ToolWeight => Self::ToolWeight,
            _ => Self::None,
        }
    }
}
