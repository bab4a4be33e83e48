//! Which reaction the nominal feels.

use crate::ParameterError;

/// The laws. What is fed back to the nominal once the force is limited decides everything; the paper is silent on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(i32)]
pub enum Law {
    /// The admittance filter alone (eq:admittance_standard): no reaction on the nominal. Sticks to walls.
    Standard = 1,
    /// The paper's law (eq:obs_dyn, eq:dob_input): the nominal feels the unlimited y, also while the robot feels less.
    /// Creates energy once saturated.
    Passive = 2,
    /// The nominal feels the limited force divided by K: passive in continuous time, with the storage Φ of
    /// [`storage`](crate::storage), but the spring winds up and sticks to walls.
    PassiveApplied = 3,
    /// The nominal feels the limited force, and the spring slips where it alone would exceed the limit: passive, and
    /// |K K_P e_nr| ≤ f_max always.
    PassiveBounded = 4,
    /// Natural admittance (Dohring and Newman), one axis: [`natural`](crate::natural).
    Natural = 5,
    /// Sliding-mode inner loop under a standard proxy (Kikuuwe), one axis: [`sliding_mode`](crate::sliding_mode).
    SlidingMode = 6,
}

impl Law {
    /// All laws, in the order of their numbers.
    pub const ALL: [Self; 6] = [
        Self::Standard,
        Self::Passive,
        Self::PassiveApplied,
        Self::PassiveBounded,
        Self::Natural,
        Self::SlidingMode,
    ];

    /// Number in interfaces, from 1.
    pub const fn number(self) -> i32 {
        self as i32
    }

    /// Name in interfaces.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Standard => "standard",
            Self::Passive => "passive",
            Self::PassiveApplied => "passive_applied",
            Self::PassiveBounded => "passive_bounded",
            Self::Natural => "natural",
            Self::SlidingMode => "sliding_mode",
        }
    }

    /// Whether it is there to be compared with, on one axis, and not one of [`Admittance`](crate::Admittance)'s.
    pub const fn is_comparator(self) -> bool {
        matches!(self, Self::Natural | Self::SlidingMode)
    }

    /// Whether [`Admittance`](crate::Admittance) computes it.
    pub const fn is_offered(self) -> bool {
        !self.is_comparator()
    }
}

impl TryFrom<i32> for Law {
    type Error = ParameterError;

    fn try_from(number: i32) -> Result<Self, ParameterError> {
        Self::ALL
            .into_iter()
            .find(|law| law.number() == number)
            .ok_or(ParameterError::UnknownLaw(number))
    }
}
