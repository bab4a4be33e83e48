//! The row: one variable of a model, or one vector of them.

use crate::integer::Bound;
use crate::place::Place;
use crate::range::Range;
use crate::{Unit, Value};

/// Who computes the variable (FMI 2.0, section 2.2.7).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Causality {
    /// Set by the importer before the run (or, if tunable, during it).
    Parameter,
    /// Computed from parameters.
    CalculatedParameter,
    /// Provided by another model.
    Input,
    /// Provided to other models.
    Output,
    /// Internal, readable.
    Local,
}

impl Causality {
    /// All of them, in the order in which an interface is shown: what goes in, what comes out, what can be set.
    pub const IN_ORDER: [Self; 5] = [
        Self::Input,
        Self::Output,
        Self::Parameter,
        Self::CalculatedParameter,
        Self::Local,
    ];

    /// Its place in [`IN_ORDER`](Self::IN_ORDER), from 0.
    pub const fn position(self) -> usize {
        match self {
            Self::Input => 0,
            Self::Output => 1,
            Self::Parameter => 2,
            Self::CalculatedParameter => 3,
            Self::Local => 4,
        }
    }
}

/// When the variable may change (FMI 2.0, section 2.2.7).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Variability {
    /// After initialization never.
    Fixed,
    /// Between steps, set by the importer.
    Tunable,
    /// At ticks only.
    Discrete,
    /// At any time.
    Continuous,
}

/// One item of an enumeration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Item {
    /// Value in the interface, from 1.
    pub value: i32,
    /// Name in the interface.
    pub name: &'static str,
    /// What it means.
    pub about: &'static str,
}

impl Item {
    /// An item.
    pub const fn new(value: i32, name: &'static str, about: &'static str) -> Self {
        Self { value, name, about }
    }
}

/// An enumeration type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Enumeration {
    /// Name of the type.
    pub name: &'static str,
    /// What it is.
    pub about: &'static str,
    /// Its items, in ascending order of value.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read_back::items"))]
    pub items: &'static [Item],
}

/// How the XML declares a variable that takes the items of an enumeration. The C interface is that of an Integer either
/// way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Declared {
    /// As an Enumeration with a type: tools that know enumerations offer the items by name. Some co-simulation masters
    /// know none and drop such a variable, so that it cannot be set there.
    Enumeration,
    /// As an Integer with bounds and the items in its description: can be set everywhere.
    Integer,
}

/// Type of a variable and where it lives in the model `M`.
pub enum Access<M> {
    /// fmi2Real
    Real {
        /// Unit of the value.
        unit: Unit,
        /// What it may be.
        range: Range,
        /// Where the values are.
        at: Place<M, f64>,
    },
    /// fmi2Integer. A smaller type has the bounds of its own at least.
    Integer {
        /// Smallest accepted value; the type's: none.
        min: i32,
        /// Largest accepted value; the type's: none.
        max: i32,
        /// Where the values are.
        at: Place<M, i32>,
    },
    /// An integer of a type that fmi2Integer does not hold: FMI 3.0 alone has it.
    Wide {
        /// Smallest accepted value; the type's: none.
        min: Bound,
        /// Largest accepted value; the type's: none.
        max: Bound,
        /// Where the values are.
        at: Place<M, i128>,
    },
    /// fmi2Boolean
    Boolean {
        /// Where the values are.
        at: Place<M, bool>,
    },
    /// fmi2String
    #[cfg(feature = "std")]
    String {
        /// Where the values are.
        at: Place<M, String>,
    },
    /// Bytes, which FMI 3.0 alone has.
    #[cfg(feature = "std")]
    Binary {
        /// What they are: a media type (RFC 2045), for instance `application/json`.
        mime_type: &'static str,
        /// Most bytes that are accepted.
        max_size: Option<usize>,
        /// Where the values are.
        at: Place<M, Vec<u8>>,
    },
    /// fmi2Integer restricted to the items of an enumeration
    Enumeration {
        /// The type.
        of: &'static Enumeration,
        /// How the XML declares it.
        declared: Declared,
        /// Where the values are.
        at: Place<M, i32>,
    },
}

impl<M> Clone for Access<M> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<M> Copy for Access<M> {}

impl<M> Access<M> {
    /// How many values there are.
    #[allow(clippy::len_without_is_empty, reason = "a row has a value")]
    pub const fn len(&self) -> usize {
        match self {
            Self::Real { at, .. } => at.len(),
            Self::Integer { at, .. } | Self::Enumeration { at, .. } => at.len(),
            Self::Wide { at, .. } => at.len(),
            Self::Boolean { at } => at.len(),
            #[cfg(feature = "std")]
            Self::String { at } => at.len(),
            #[cfg(feature = "std")]
            Self::Binary { at, .. } => at.len(),
        }
    }

    /// Whether the type of the field holds the bounds.
    const fn holds_bounds(&self) -> bool {
        match self {
            Self::Integer { min, max, at } => {
                let of = at.integer_type();
                of.low() <= *min as i128 && *max as i128 <= of.high()
            }
            Self::Wide { min, max, at } => {
                let of = at.integer_type();
                of.low() <= min.get() && max.get() <= of.high()
            }
            Self::Real { range, at, .. } if at.is_single() => range.is_single(),
            _ => true,
        }
    }
}

/// What the bytes of a Binary are whose row does not say it: the default of FMI 3.0.
pub const ANY_BYTES: &str = "application/octet-stream";

/// One row: a scalar (`len == 1`), or a vector whose name contains `[i]` and which expands to `[1]` … `[len]`.
pub struct Variable<M: 'static> {
    /// Number of the row, which decides its value reference; [`IN_ORDER`]: its position in the description.
    pub number: u32,
    /// What comes before the name: that of the part that it belongs to, with its dot; empty for most.
    pub prefix: &'static str,
    /// Name, the paper's symbol where there is one.
    pub name: &'static str,
    /// Name of the field, where the derive has written the row of the struct that has it; empty elsewhere.
    pub field: &'static str,
    /// Number of scalars.
    pub len: usize,
    /// Type and place.
    pub access: Access<M>,
    /// Causality.
    pub causality: Causality,
    /// Variability.
    pub variability: Variability,
    /// Inputs and parameters on which an output's value right after initialization depends, by row name.
    pub initially_from: &'static [&'static str],
    /// Whether a sensor's failure may pass here: NaN out of the model, NaN and infinity into it. Elsewhere they fail the
    /// step, or the Set.
    pub may_be_nan: bool,
    /// What it is: sign, frame, equation label.
    pub about: &'static str,
}

impl<M> Clone for Variable<M> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<M> Copy for Variable<M> {}

/// The number of a row that bears none: its position counts.
pub const IN_ORDER: u32 = u32::MAX;

impl<M> Variable<M> {
    /// No row: what a list is filled with before its rows are written.
    #[doc(hidden)]
    pub const NOTHING: Self = Self::new("", Access::Boolean { at: Place::NOTHING });

    /// A row with its place; the causality is said by the next call.
    ///
    /// # Panics
    /// When the type of the field does not hold the bounds (at compile time: rows are constants).
    pub const fn new(name: &'static str, access: Access<M>) -> Self {
        assert!(
            access.holds_bounds(),
            "a bound is beyond the type of the field"
        );
        let len = access.len();
        Self {
            number: IN_ORDER,
            prefix: "",
            name,
            field: "",
            len,
            access,
            causality: Causality::Local,
            variability: Variability::Discrete,
            initially_from: &[],
            may_be_nan: false,
            about: "",
        }
    }

    /// With a number, which must stay when others come: it decides the value reference.
    pub const fn numbered(mut self, number: u32) -> Self {
        self.number = number;
        self
    }

    /// Of the struct's field with this name.
    #[doc(hidden)]
    pub const fn of_field(mut self, field: &'static str) -> Self {
        self.field = field;
        self
    }

    const fn as_(mut self, causality: Causality, variability: Variability) -> Self {
        self.causality = causality;
        self.variability = variability;
        self
    }

    /// An input.
    pub const fn input(self, variability: Variability) -> Self {
        self.as_(Causality::Input, variability)
    }

    /// An output.
    pub const fn output(self, variability: Variability) -> Self {
        self.as_(Causality::Output, variability)
    }

    /// A parameter, fixed or tunable.
    pub const fn parameter(self, variability: Variability) -> Self {
        self.as_(Causality::Parameter, variability)
    }

    /// A parameter that the model computes from others.
    pub const fn calculated_parameter(self, variability: Variability) -> Self {
        self.as_(Causality::CalculatedParameter, variability)
    }

    /// An internal variable that can be read.
    pub const fn local(self, variability: Variability) -> Self {
        self.as_(Causality::Local, variability)
    }

    /// The description.
    pub const fn about(mut self, about: &'static str) -> Self {
        self.about = about;
        self
    }

    /// What the value right after initialization depends on.
    pub const fn initially_from(mut self, names: &'static [&'static str]) -> Self {
        self.initially_from = names;
        self
    }

    /// A sensor that can fail so: NaN may leave the model here, or NaN and infinity may enter it, which the model then
    /// handles. For outputs and inputs of type Real.
    ///
    /// # Panics
    /// When the row is not a Real that the model computes or reads (at compile time: rows are constants).
    pub const fn may_be_nan(mut self) -> Self {
        let passes = self.is_calculated() || matches!(self.causality, Causality::Input);
        if !(passes && matches!(self.access, Access::Real { .. })) {
            panic!("may_be_nan() is for Real rows that the model computes or reads");
        }
        self.may_be_nan = true;
        self
    }

    /// The name with its prefix; `[i]` stands for the element.
    #[cfg(feature = "std")]
    pub fn full_name(&self) -> String {
        [self.prefix, self.name].concat()
    }

    /// Name of one element, counted from 0 here and from 1 in the name: `[i]` becomes `[1]`, `[2]`, …
    #[cfg(feature = "std")]
    pub fn element_name(&self, element: usize) -> String {
        self.full_name()
            .replace("[i]", &format!("[{}]", element + 1))
    }

    /// The name without the `[i]` at its end.
    pub fn base_name(&self) -> &'static str {
        self.name.strip_suffix("[i]").unwrap_or(self.name)
    }

    /// The value of element `i`, from 0, if the row is of this type.
    pub fn value<V: Of<M>>(&self, model: &M, i: usize) -> Option<V> {
        V::of(&self.access).map(|at| at.get(model, i))
    }

    /// Whether the importer may still set it during the run.
    pub const fn is_tunable(&self) -> bool {
        matches!(
            (self.causality, self.variability),
            (Causality::Parameter, Variability::Tunable)
        )
    }

    /// Whether the model computes it, so that it has no start value.
    pub const fn is_calculated(&self) -> bool {
        matches!(
            self.causality,
            Causality::Output | Causality::CalculatedParameter | Causality::Local
        )
    }
}

/// A type of value, and where a row of that type has it.
pub trait Of<M>: Value {
    /// The place, if the row is of this type. An enumeration is an Integer.
    fn of(access: &Access<M>) -> Option<&Place<M, Self>>;
}

impl<M> Of<M> for f64 {
    fn of(access: &Access<M>) -> Option<&Place<M, Self>> {
        match access {
            Access::Real { at, .. } => Some(at),
            _ => None,
        }
    }
}

impl<M> Of<M> for i32 {
    fn of(access: &Access<M>) -> Option<&Place<M, Self>> {
        match access {
            Access::Integer { at, .. } | Access::Enumeration { at, .. } => Some(at),
            _ => None,
        }
    }
}

impl<M> Of<M> for i128 {
    fn of(access: &Access<M>) -> Option<&Place<M, Self>> {
        match access {
            Access::Wide { at, .. } => Some(at),
            _ => None,
        }
    }
}

impl<M> Of<M> for bool {
    fn of(access: &Access<M>) -> Option<&Place<M, Self>> {
        match access {
            Access::Boolean { at } => Some(at),
            _ => None,
        }
    }
}

#[cfg(feature = "std")]
impl<M> Of<M> for String {
    fn of(access: &Access<M>) -> Option<&Place<M, Self>> {
        match access {
            Access::String { at } => Some(at),
            _ => None,
        }
    }
}

#[cfg(feature = "std")]
impl<M> Of<M> for Vec<u8> {
    fn of(access: &Access<M>) -> Option<&Place<M, Self>> {
        match access {
            Access::Binary { at, .. } => Some(at),
            _ => None,
        }
    }
}
