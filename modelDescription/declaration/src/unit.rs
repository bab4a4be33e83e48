//! Units with their SI base exponents (FMI 2.0, section 2.2.2).

/// Exponents of the SI base units.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Base {
    /// kilogram
    pub kg: i8,
    /// metre
    pub m: i8,
    /// second
    pub s: i8,
    /// radian (FMI treats the angle as a base unit)
    pub rad: i8,
}

/// A unit in which a variable may be displayed: `display = factor · value`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Display {
    /// Name, for instance `deg`.
    pub name: &'static str,
    /// Factor from the SI value to the displayed value.
    pub factor: f64,
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

const fn unit(name: &'static str, kg: i8, m: i8, s: i8, rad: i8) -> Unit {
    Unit {
        name,
        base: Base { kg, m, s, rad },
        display: None,
    }
}

/// Dimensionless.
pub const NONE: Unit = unit("1", 0, 0, 0, 0);
/// metre
pub const METRE: Unit = unit("m", 0, 1, 0, 0);
/// metre per second
pub const METRE_PER_SECOND: Unit = unit("m/s", 0, 1, -1, 0);
/// metre per second squared
pub const METRE_PER_SECOND_SQUARED: Unit = unit("m/s2", 0, 1, -2, 0);
/// radian, displayed in degrees
pub const RADIAN: Unit = Unit {
    display: Some(Display {
        name: "deg",
        factor: 180.0 / core::f64::consts::PI,
    }),
    ..unit("rad", 0, 0, 0, 1)
};
/// radian per second
pub const RADIAN_PER_SECOND: Unit = unit("rad/s", 0, 0, -1, 1);
/// radian per second squared
pub const RADIAN_PER_SECOND_SQUARED: Unit = unit("rad/s2", 0, 0, -2, 1);
/// metre per radian
pub const METRE_PER_RADIAN: Unit = unit("m/rad", 0, 1, 0, -1);
/// kilogram
pub const KILOGRAM: Unit = unit("kg", 1, 0, 0, 0);
/// kilogram square metre
pub const KILOGRAM_SQUARE_METRE: Unit = unit("kg.m2", 1, 2, 0, 0);
/// newton
pub const NEWTON: Unit = unit("N", 1, 1, -2, 0);
/// newton metre
pub const NEWTON_METRE: Unit = unit("N.m", 1, 2, -2, 0);
/// newton metre per second
pub const NEWTON_METRE_PER_SECOND: Unit = unit("N.m/s", 1, 2, -3, 0);
/// newton metre second per radian
pub const NEWTON_METRE_SECOND_PER_RADIAN: Unit = unit("N.m.s/rad", 1, 2, -1, -1);
/// newton per second
pub const NEWTON_PER_SECOND: Unit = unit("N/s", 1, 1, -3, 0);
/// newton per metre
pub const NEWTON_PER_METRE: Unit = unit("N/m", 1, 0, -2, 0);
/// newton second per metre
pub const NEWTON_SECOND_PER_METRE: Unit = unit("N.s/m", 1, 0, -1, 0);
/// joule
pub const JOULE: Unit = unit("J", 1, 2, -2, 0);
/// second
pub const SECOND: Unit = unit("s", 0, 0, 1, 0);
/// one per second
pub const PER_SECOND: Unit = unit("1/s", 0, 0, -1, 0);
/// hertz
pub const HERTZ: Unit = unit("Hz", 0, 0, -1, 0);
