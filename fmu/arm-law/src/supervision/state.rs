//! The states.

/// What the controller is doing, as far as supervision is concerned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(i32)]
pub enum State {
    /// Not enabled. No torque.
    Off = 0,
    /// Enabled; waits until encoders, force sensor and heartbeat have been good for a while. No torque.
    Init = 1,
    /// Waits for a rising edge of `engage`. No torque.
    Ready = 2,
    /// The law runs; its authority rises from 0 to 1 first.
    Engaged = 3,
    /// The law runs with its nominal standing still: it supports what it carries and follows nobody.
    Hold = 4,
    /// The nominal stands still and the authority falls to 0.
    SoftStop = 5,
    /// Waits for an acknowledgement. No torque.
    Fault = 6,
}

impl State {
    /// All of them, by number.
    pub const ALL: [Self; 7] = [
        Self::Off,
        Self::Init,
        Self::Ready,
        Self::Engaged,
        Self::Hold,
        Self::SoftStop,
        Self::Fault,
    ];

    /// Its number in an interface.
    pub const fn number(self) -> i32 {
        self as i32
    }

    /// Its name, as in an identifier.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Off => "off",
            Self::Init => "init",
            Self::Ready => "ready",
            Self::Engaged => "engaged",
            Self::Hold => "hold",
            Self::SoftStop => "soft_stop",
            Self::Fault => "fault",
        }
    }

    /// Whether the law runs, so that there may be torque.
    pub const fn acts(self) -> bool {
        matches!(self, Self::Engaged | Self::Hold | Self::SoftStop)
    }

    /// Whether the law runs with its nominal brought to rest.
    pub const fn holds(self) -> bool {
        matches!(self, Self::Hold | Self::SoftStop)
    }
}
