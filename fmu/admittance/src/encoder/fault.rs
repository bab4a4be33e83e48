//! The faults of sensed positions by number, name and sentence.

use core::fmt::{Display, Formatter};
use fmu_declaration::{Enumeration, Item};

/// What is wrong with the positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(i32)]
pub enum Fault {
    /// A position is NaN or infinite.
    NotFinite = 1,
    /// A position lies where the robot cannot be.
    OverRange = 2,
    /// A position has moved faster than the robot can, all at once.
    Jump = 3,
    /// A position stays the same while its force changes.
    Stuck = 4,
    /// The encoder says so itself.
    Invalid = 5,
}

impl Fault {
    /// All, by number.
    pub const ALL: [Self; 5] = [
        Self::NotFinite,
        Self::OverRange,
        Self::Jump,
        Self::Stuck,
        Self::Invalid,
    ];

    /// The number by which the interface knows it; 0 stands for none.
    pub const fn number(self) -> i32 {
        self as i32
    }

    /// The name by which the interface knows it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::NotFinite => "not_finite",
            Self::OverRange => "over_range",
            Self::Jump => "jump",
            Self::Stuck => "stuck",
            Self::Invalid => "invalid",
        }
    }

    /// Whether it lasts until some samples have been sound.
    pub(super) const fn lasts(self) -> bool {
        matches!(self, Self::OverRange | Self::Jump | Self::Stuck)
    }
}

const fn item(fault: Fault, about: &'static str) -> Item {
    Item::new(fault.number(), fault.name(), about)
}

/// The type of `encoder.fault`.
pub const FAULT: Enumeration = Enumeration {
    name: "EncoderFault",
    about: "What is wrong with the sensed positions",
    items: &[
        Item::new(0, "none", "nothing"),
        item(Fault::NotFinite, "one is NaN or infinite"),
        item(Fault::OverRange, "one lies beyond encoder.range"),
        item(
            Fault::Jump,
            "one has moved faster than the robot can since the last reading, and not as it moved before",
        ),
        item(
            Fault::Stuck,
            "one has stayed the same while its force changed by as much as should move it",
        ),
        item(Fault::Invalid, "encoder_valid is false"),
    ],
};

/// The item of `encoder.fault` with the number `fault`, for a message.
pub fn message(fault: i32) -> impl Display {
    let found = FAULT.items.iter().find(|item| item.value == fault);
    Message(found.unwrap_or(&FAULT.items[0]))
}

struct Message(&'static Item);

impl Display for Message {
    fn fmt(&self, f: &mut Formatter<'_>) -> core::fmt::Result {
        let Item { value, name, about } = self.0;
        write!(f, "encoder.fault = {value} ({name}): {about}")
    }
}
