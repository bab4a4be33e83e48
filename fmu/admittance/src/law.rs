//! The laws: one row each. Whatever depends on the law reads it from here.

use crate::ParameterError;
use crate::listed::{Text, laws};
use fmu_declaration::{Enumeration, Item};

/// The laws. What is fed back to the nominal once the force is limited decides everything; the paper is silent on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(i32)]
pub enum Law {
    /// The admittance filter alone (eq:admittance_standard).
    Standard = 1,
    /// The paper's law (eq:obs_dyn, eq:dob_input), with y as it was before any limit.
    Passive = 2,
    /// The same with what the limits left of y. Passive in continuous time, with the storage Φ of
    /// [`storage`](crate::storage).
    PassiveApplied = 3,
    /// The same with a spring that slips. Passive, also sampled, and |K K_P e_nr| ≤ f_max always.
    PassiveBounded = 4,
    /// Natural admittance control (Dohring and Newman): [`natural`](crate::natural).
    Natural = 5,
    /// Sliding-mode inner loop under a standard proxy (Kikuuwe): [`sliding_mode`](crate::sliding_mode).
    SlidingMode = 6,
}

/// What a law is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    /// Name in interfaces.
    pub name: &'static str,
    /// What it is, in half a sentence.
    pub text: &'static str,
    /// What its nominal feels.
    pub felt: Felt,
    /// What gives way where its spring alone would exceed the limit.
    pub spring: Yields,
    /// Whether the tank is kept ≥ 0. Under the other laws it is observed.
    pub keeps_tank: bool,
    /// Whether [`Admittance`](crate::Admittance) computes it, and an arm can have it. The others are comparators, on one
    /// axis.
    pub offered: bool,
    /// Whether it can be run through a position drive: [`servo`](crate::servo).
    pub servo: bool,
    /// Whether its model has the mass M_n, and not the robot's own.
    pub nominal_mass: bool,
}

/// What the nominal feels of the coupling.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Felt {
    /// Nothing.
    Nothing,
    /// alpha y, whatever the robot gets.
    Coupling,
    /// alpha f/K with the force f that the robot gets.
    Delivered,
}

/// What gives way where the coupling's spring alone would exceed f_max.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Yields {
    /// Nothing: ½ k e² whatever its extension.
    Never,
    /// Its force, which stays at the limit while the extension grows: Φ(e).
    Force,
    /// Its extension: it slips, and q_n with it, |k e| ≤ f_max.
    Slips,
}

/// The items of a choice among the `N` laws, or among those that are offered.
const fn items<const N: usize>(all: bool) -> [Item; N] {
    let mut items = [Law::Standard.item(); N];
    let (mut n, mut i) = (0, 0);
    while i < Law::ALL.len() {
        if all || Law::ALL[i].row().offered {
            items[n] = Law::ALL[i].item();
            n += 1;
        }
        i += 1;
    }
    items
}

const ABOUT: &str = "Admittance law: which reaction the nominal feels once the force is limited";

/// The type of `law` where all laws are offered: on one axis.
pub const LAW: Enumeration = Enumeration {
    name: "Law",
    about: ABOUT,
    items: &items::<{ Law::ALL.len() }>(true),
};

/// The type of `law` where the comparators are not.
pub const OFFERED_LAW: Enumeration = Enumeration {
    name: "Law",
    about: ABOUT,
    items: &items::<{ offered() }>(false),
};

/// How many laws are offered.
const fn offered() -> usize {
    let (mut n, mut i) = (0, 0);
    while i < Law::ALL.len() {
        if Law::ALL[i].row().offered {
            n += 1;
        }
        i += 1;
    }
    n
}

impl Row {
    /// Whether the nominal feels what the robot gets.
    pub const fn feels_what_is_delivered(&self) -> bool {
        match self.felt {
            Felt::Delivered => true,
            Felt::Nothing | Felt::Coupling => false,
        }
    }

    /// Whether the spring slips, so that f_max bounds it.
    pub const fn slips(&self) -> bool {
        match self.spring {
            Yields::Slips => true,
            Yields::Never | Yields::Force => false,
        }
    }
}

impl Law {
    /// The law as an item of a choice.
    const fn item(self) -> Item {
        Item {
            value: self.number(),
            name: self.name(),
            about: self.row().text,
        }
    }

    /// All laws, in the order of their numbers.
    pub const ALL: [Self; 6] = [
        Self::Standard,
        Self::Passive,
        Self::PassiveApplied,
        Self::PassiveBounded,
        Self::Natural,
        Self::SlidingMode,
    ];

    /// `1 (standard), 2 (passive), …`: the laws that are [offered](Row::offered).
    pub const OFFERED: &str = const { &Text::numbered(&laws!(row if row.offered)) }.as_str();
    /// Likewise those that have a [servo form](Row::servo).
    pub const WITH_SERVO_FORM: &str = const { &Text::numbered(&laws!(row if row.servo)) }.as_str();

    /// What it is: the table of the laws.
    pub const fn row(self) -> &'static Row {
        match self {
            Self::Standard => &Row {
                name: "standard",
                text: "admittance filter alone, no reaction on the nominal; sticks to walls",
                felt: Felt::Nothing,
                spring: Yields::Never,
                keeps_tank: false,
                offered: true,
                servo: true,
                nominal_mass: true,
            },
            Self::Passive => &Row {
                name: "passive",
                text: "the paper's law: the nominal feels the unlimited coupling; creates energy once saturated",
                felt: Felt::Coupling,
                spring: Yields::Never,
                keeps_tank: false,
                offered: true,
                servo: false, // what a drive measures is what was delivered
                nominal_mass: true,
            },
            Self::PassiveApplied => &Row {
                name: "passive_applied",
                text: "the nominal feels what the limits leave of the force; the spring winds up and sticks to walls",
                felt: Felt::Delivered,
                spring: Yields::Force,
                keeps_tank: false,
                offered: true,
                servo: true,
                nominal_mass: true,
            },
            Self::PassiveBounded => &Row {
                name: "passive_bounded",
                text: "the nominal feels the limited force and the spring slips at the limit; passive and bounded",
                felt: Felt::Delivered,
                spring: Yields::Slips,
                keeps_tank: true,
                offered: true,
                servo: true,
                nominal_mass: true,
            },
            Self::Natural => &Row {
                name: "natural",
                text: "natural admittance control (Dohring and Newman), to compare with: comparator.M in place of M_n; sticks to walls",
                felt: Felt::Nothing,
                spring: Yields::Never,
                keeps_tank: false,
                offered: false,
                servo: false,
                nominal_mass: false,
            },
            Self::SlidingMode => &Row {
                name: "sliding_mode",
                text: "sliding-mode position control under a standard proxy (Kikuuwe), to compare with; sticks to walls",
                felt: Felt::Nothing,
                spring: Yields::Slips, // the one between inner proxy and robot
                keeps_tank: false,
                offered: false,
                servo: false,
                nominal_mass: true,
            },
        }
    }

    /// Number in interfaces, from 1.
    pub const fn number(self) -> i32 {
        self as i32
    }

    /// Name in interfaces.
    pub const fn name(self) -> &'static str {
        self.row().name
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
