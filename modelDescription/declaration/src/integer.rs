//! The types of integers that a field can have.

use crate::place::Stored;

/// A type of integer, with the name that FMI 3.0 gives it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum IntegerType {
    /// `i8`
    Int8,
    /// `u8`
    UInt8,
    /// `i16`
    Int16,
    /// `u16`
    UInt16,
    /// `i32`
    Int32,
    /// `u32`
    UInt32,
    /// `i64`
    Int64,
    /// `u64`
    UInt64,
}

impl IntegerType {
    /// All of them, each before those that hold more.
    pub const ALL: [Self; 8] = [
        Self::Int8,
        Self::UInt8,
        Self::Int16,
        Self::UInt16,
        Self::Int32,
        Self::UInt32,
        Self::Int64,
        Self::UInt64,
    ];

    /// In which type the values of a row lie that shows integers.
    pub(crate) const fn of(stored: Stored) -> Self {
        match stored {
            Stored::Integer(of) => of,
            Stored::AsIs | Stored::Single | Stored::Word => Self::Int32,
        }
    }

    /// Smallest value.
    pub const fn low(self) -> i128 {
        match self {
            Self::Int8 => i8::MIN as i128,
            Self::Int16 => i16::MIN as i128,
            Self::Int32 => i32::MIN as i128,
            Self::Int64 => i64::MIN as i128,
            Self::UInt8 | Self::UInt16 | Self::UInt32 | Self::UInt64 => 0,
        }
    }

    /// Largest value.
    pub const fn high(self) -> i128 {
        match self {
            Self::Int8 => i8::MAX as i128,
            Self::UInt8 => u8::MAX as i128,
            Self::Int16 => i16::MAX as i128,
            Self::UInt16 => u16::MAX as i128,
            Self::Int32 => i32::MAX as i128,
            Self::UInt32 => u32::MAX as i128,
            Self::Int64 => i64::MAX as i128,
            Self::UInt64 => u64::MAX as i128,
        }
    }

    /// Whether an fmi2Integer, 32 bits with a sign, holds all of its values.
    pub const fn is_in_fmi2(self) -> bool {
        Self::Int32.low() <= self.low() && self.high() <= Self::Int32.high()
    }

    /// Its name in FMI 3.0.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Int8 => "Int8",
            Self::UInt8 => "UInt8",
            Self::Int16 => "Int16",
            Self::UInt16 => "UInt16",
            Self::Int32 => "Int32",
            Self::UInt32 => "UInt32",
            Self::Int64 => "Int64",
            Self::UInt64 => "UInt64",
        }
    }
}

/// A bound of an integer of any type. It is aligned as a number of 64 bits, so that rows that have none do not grow by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(Rust, packed(8))]
pub struct Bound(i128);

impl Bound {
    /// This number.
    pub const fn new(value: i128) -> Self {
        Self(value)
    }

    /// The number.
    pub const fn get(self) -> i128 {
        self.0
    }
}
