//! One scalar variable of an interface.

use fmu_declaration::{Brief, Causality, Declared, Enumeration, IntegerType, Unit, Variability};
use serde::{Deserialize, Serialize};
use std::fmt;

/// One scalar variable.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Entry {
    /// Name, the element's number in it.
    pub name: String,
    /// Name of its row: as `name`, with `[i]` where a vector has the element's number.
    pub row: String,
    /// Value reference.
    pub reference: u32,
    /// Who computes it.
    pub causality: Causality,
    /// When it may change.
    pub variability: Variability,
    /// Type, bounds and start value.
    pub kind: Kind,
    /// Positions (from 0, ascending, unique) of the inputs and parameters that decide its value at initialization.
    pub initially_from: Vec<usize>,
    /// Description.
    pub about: &'static str,
}

/// Type, bounds and start value. Bounds are `None` where there are none.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Kind {
    /// fmi2Real
    Real {
        /// Whether it has single precision: Float32 in FMI 3.0.
        single: bool,
        /// Unit of the three values.
        unit: Unit,
        /// Start value.
        start: f64,
        /// Smallest accepted value.
        min: Option<f64>,
        /// Largest accepted value.
        max: Option<f64>,
    },
    /// An integer of any size
    Integer {
        /// Its type in FMI 3.0.
        of: IntegerType,
        /// Start value.
        start: i128,
        /// Smallest accepted value, where the type has smaller ones.
        min: Option<i128>,
        /// Largest accepted value, where the type has larger ones.
        max: Option<i128>,
    },
    /// fmi2Boolean
    Boolean {
        /// Start value.
        start: bool,
    },
    /// fmi2String
    String {
        /// Start value.
        start: String,
    },
    /// Bytes, in FMI 3.0
    Binary {
        /// What they are.
        mime_type: &'static str,
        /// Most bytes that are accepted.
        max_size: Option<usize>,
        /// Start value.
        start: Vec<u8>,
    },
    /// fmi2Integer that takes the values of an enumeration's items
    Enumeration {
        /// The type.
        #[serde(deserialize_with = "fmu_declaration::read_back::enumeration")]
        of: &'static Enumeration,
        /// How the XML declares it.
        declared: Declared,
        /// Start value.
        start: i32,
    },
}

impl Kind {
    /// Whether FMI 2.0 has a type for it.
    pub const fn is_in_fmi2(&self) -> bool {
        match self {
            Self::Integer { of, .. } => of.is_in_fmi2(),
            Self::Binary { .. } => false,
            Self::Real { .. }
            | Self::Boolean { .. }
            | Self::String { .. }
            | Self::Enumeration { .. } => true,
        }
    }
}

/// The start value, and the bounds.
impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Real {
                unit,
                start,
                min,
                max,
                ..
            } => {
                let (min, max) = (min.map(Brief), max.map(Brief));
                write!(f, "{} {}{}", Brief(*start), unit.name, Bounds(min, max))
            }
            Self::Integer {
                start, min, max, ..
            } => write!(f, "{start}{}", Bounds(*min, *max)),
            Self::Boolean { start } => write!(f, "{start}"),
            Self::String { start } => write!(f, "{start:?}"),
            Self::Binary {
                max_size, start, ..
            } => write!(f, "{} bytes{}", start.len(), Bounds(None, *max_size)),
            Self::Enumeration { of, start, .. } => {
                write!(f, "{start}, which is no item of {}", of.name)
            }
        }
    }
}

/// Smallest and largest value, where there are any.
struct Bounds<T>(Option<T>, Option<T>);

impl<T: fmt::Display> fmt::Display for Bounds<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(min, max) = self;
        if let Some(min) = min {
            write!(f, ", at least {min}")?;
        }
        if let Some(max) = max {
            write!(f, ", at most {max}")?;
        }
        Ok(())
    }
}

impl Entry {
    /// Whether the model computes it, so that it has no start value.
    pub fn is_calculated(&self) -> bool {
        matches!(
            self.causality,
            Causality::Output | Causality::CalculatedParameter | Causality::Local
        )
    }

    /// Whether it stands in the XML's InitialUnknowns: calculated outputs and calculated parameters (2.2.8).
    pub fn is_initial_unknown(&self) -> bool {
        matches!(
            self.causality,
            Causality::Output | Causality::CalculatedParameter
        )
    }
}
