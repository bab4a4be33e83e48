//! Units with their SI base exponents (FMI 2.0, section 2.2.2).
//!
//! A unit that is missing here is one line:
//!
//! ```
//! use fmu_declaration::unit::{Base, Unit};
//!
//! const VOLT_PER_KELVIN: Unit = Unit::new("V/K", Base { kg: 1, m: 2, s: -3, A: -1, K: -1, ..Base::NONE });
//! ```
//!
//! A row names it by its path: `unit = self::VOLT_PER_KELVIN`.

/// Exponents of the SI base units.
#[allow(non_snake_case, reason = "symbols of the SI: A, K")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Base {
    /// kilogram
    pub kg: i8,
    /// metre
    pub m: i8,
    /// second
    pub s: i8,
    /// ampere
    pub A: i8,
    /// kelvin
    pub K: i8,
    /// mole
    pub mol: i8,
    /// candela
    pub cd: i8,
    /// radian (FMI treats the angle as a base unit)
    pub rad: i8,
}

impl Base {
    /// Of what has no dimension.
    pub const NONE: Self = Self {
        kg: 0,
        m: 0,
        s: 0,
        A: 0,
        K: 0,
        mol: 0,
        cd: 0,
        rad: 0,
    };

    /// Symbol and exponent of each base unit, in the standard's order.
    pub const fn exponents(&self) -> [(&'static str, i8); 8] {
        [
            ("kg", self.kg),
            ("m", self.m),
            ("s", self.s),
            ("A", self.A),
            ("K", self.K),
            ("mol", self.mol),
            ("cd", self.cd),
            ("rad", self.rad),
        ]
    }
}

/// A unit in which a variable may be displayed: `display = factor · value + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Display {
    /// Name, for instance `deg`.
    pub name: &'static str,
    /// Factor from the SI value to the displayed value.
    pub factor: f64,
    /// What is added then.
    pub offset: f64,
}

/// A unit: its name and its SI base exponents; values are SI, so factor 1 and offset 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Unit {
    /// Name as in the XML, for instance `N.s/m`.
    pub name: &'static str,
    /// SI base exponents.
    pub base: Base,
    /// Preferred display unit, if it differs.
    pub display: Option<Display>,
}

impl Unit {
    /// A unit without another one for display.
    pub const fn new(name: &'static str, base: Base) -> Self {
        Self {
            name,
            base,
            display: None,
        }
    }

    /// The same, displayed in another unit: `factor · value + offset`.
    #[must_use]
    pub const fn shown_in(self, name: &'static str, factor: f64, offset: f64) -> Self {
        Self {
            display: Some(Display {
                name,
                factor,
                offset,
            }),
            ..self
        }
    }
}

/// Exponents of kg, m, s, rad.
const fn mechanical(name: &'static str, [kg, m, s, rad]: [i8; 4]) -> Unit {
    Unit::new(
        name,
        Base {
            kg,
            m,
            s,
            rad,
            ..Base::NONE
        },
    )
}

/// Exponents of kg, m, s, A.
const fn electrical(name: &'static str, [kg, m, s, ampere]: [i8; 4]) -> Unit {
    Unit::new(
        name,
        Base {
            kg,
            m,
            s,
            A: ampere,
            ..Base::NONE
        },
    )
}

/// Exponents of kg, m, s, K.
const fn thermal(name: &'static str, [kg, m, s, kelvin]: [i8; 4]) -> Unit {
    Unit::new(
        name,
        Base {
            kg,
            m,
            s,
            K: kelvin,
            ..Base::NONE
        },
    )
}

/// Dimensionless.
pub const NONE: Unit = mechanical("1", [0, 0, 0, 0]);
/// metre
pub const METRE: Unit = mechanical("m", [0, 1, 0, 0]);
/// metre per second
pub const METRE_PER_SECOND: Unit = mechanical("m/s", [0, 1, -1, 0]);
/// metre per second squared
pub const METRE_PER_SECOND_SQUARED: Unit = mechanical("m/s2", [0, 1, -2, 0]);
/// radian, displayed in degrees
pub const RADIAN: Unit =
    mechanical("rad", [0, 0, 0, 1]).shown_in("deg", 180.0 / core::f64::consts::PI, 0.0);
/// radian per second
pub const RADIAN_PER_SECOND: Unit = mechanical("rad/s", [0, 0, -1, 1]);
/// radian per second squared
pub const RADIAN_PER_SECOND_SQUARED: Unit = mechanical("rad/s2", [0, 0, -2, 1]);
/// metre per radian
pub const METRE_PER_RADIAN: Unit = mechanical("m/rad", [0, 1, 0, -1]);
/// kilogram
pub const KILOGRAM: Unit = mechanical("kg", [1, 0, 0, 0]);
/// kilogram square metre
pub const KILOGRAM_SQUARE_METRE: Unit = mechanical("kg.m2", [1, 2, 0, 0]);
/// newton
pub const NEWTON: Unit = mechanical("N", [1, 1, -2, 0]);
/// newton metre
pub const NEWTON_METRE: Unit = mechanical("N.m", [1, 2, -2, 0]);
/// newton metre per second
pub const NEWTON_METRE_PER_SECOND: Unit = mechanical("N.m/s", [1, 2, -3, 0]);
/// newton metre second per radian
pub const NEWTON_METRE_SECOND_PER_RADIAN: Unit = mechanical("N.m.s/rad", [1, 2, -1, -1]);
/// newton per second
pub const NEWTON_PER_SECOND: Unit = mechanical("N/s", [1, 1, -3, 0]);
/// newton per metre
pub const NEWTON_PER_METRE: Unit = mechanical("N/m", [1, 0, -2, 0]);
/// newton second per metre
pub const NEWTON_SECOND_PER_METRE: Unit = mechanical("N.s/m", [1, 0, -1, 0]);
/// joule
pub const JOULE: Unit = mechanical("J", [1, 2, -2, 0]);
/// second
pub const SECOND: Unit = mechanical("s", [0, 0, 1, 0]);
/// one per second
pub const PER_SECOND: Unit = mechanical("1/s", [0, 0, -1, 0]);
/// hertz
pub const HERTZ: Unit = mechanical("Hz", [0, 0, -1, 0]);
/// square metre
pub const SQUARE_METRE: Unit = mechanical("m2", [0, 2, 0, 0]);
/// cubic metre
pub const CUBIC_METRE: Unit = mechanical("m3", [0, 3, 0, 0]);
/// cubic metre per second
pub const CUBIC_METRE_PER_SECOND: Unit = mechanical("m3/s", [0, 3, -1, 0]);
/// kilogram per second
pub const KILOGRAM_PER_SECOND: Unit = mechanical("kg/s", [1, 0, -1, 0]);
/// kilogram per cubic metre
pub const KILOGRAM_PER_CUBIC_METRE: Unit = mechanical("kg/m3", [1, -3, 0, 0]);
/// newton metre per radian
pub const NEWTON_METRE_PER_RADIAN: Unit = mechanical("N.m/rad", [1, 2, -2, -1]);
/// pascal, displayed in bar
pub const PASCAL: Unit = mechanical("Pa", [1, -1, -2, 0]).shown_in("bar", 1e-5, 0.0);
/// pascal second
pub const PASCAL_SECOND: Unit = mechanical("Pa.s", [1, -1, -1, 0]);
/// watt
pub const WATT: Unit = mechanical("W", [1, 2, -3, 0]);
/// ampere
pub const AMPERE: Unit = electrical("A", [0, 0, 0, 1]);
/// coulomb
pub const COULOMB: Unit = electrical("C", [0, 0, 1, 1]);
/// volt
pub const VOLT: Unit = electrical("V", [1, 2, -3, -1]);
/// ohm
pub const OHM: Unit = electrical("Ohm", [1, 2, -3, -2]);
/// farad
pub const FARAD: Unit = electrical("F", [-1, -2, 4, 2]);
/// henry
pub const HENRY: Unit = electrical("H", [1, 2, -2, -2]);
/// weber
pub const WEBER: Unit = electrical("Wb", [1, 2, -2, -1]);
/// tesla
pub const TESLA: Unit = electrical("T", [1, 0, -2, -1]);
/// newton metre per ampere
pub const NEWTON_METRE_PER_AMPERE: Unit = electrical("N.m/A", [1, 2, -2, -1]);
/// kelvin, displayed in degrees Celsius
pub const KELVIN: Unit = thermal("K", [0, 0, 0, 1]).shown_in("degC", 1.0, -273.15);
/// watt per kelvin
pub const WATT_PER_KELVIN: Unit = thermal("W/K", [1, 2, -3, -1]);
/// watt per metre and kelvin
pub const WATT_PER_METRE_KELVIN: Unit = thermal("W/(m.K)", [1, 1, -3, -1]);
/// joule per kelvin
pub const JOULE_PER_KELVIN: Unit = thermal("J/K", [1, 2, -2, -1]);
/// joule per kilogram and kelvin
pub const JOULE_PER_KILOGRAM_KELVIN: Unit = thermal("J/(kg.K)", [0, 2, -2, -1]);
/// joule per kilogram
pub const JOULE_PER_KILOGRAM: Unit = thermal("J/kg", [0, 2, -2, 0]);
/// mole
pub const MOLE: Unit = Unit::new(
    "mol",
    Base {
        mol: 1,
        ..Base::NONE
    },
);
/// mole per cubic metre
pub const MOLE_PER_CUBIC_METRE: Unit = Unit::new(
    "mol/m3",
    Base {
        mol: 1,
        m: -3,
        ..Base::NONE
    },
);
/// candela
pub const CANDELA: Unit = Unit::new(
    "cd",
    Base {
        cd: 1,
        ..Base::NONE
    },
);
