//! What each parameter of the arm may be: name in the interface, unit, bounds.

use crate::Range;

const fn range(variable: &'static str, unit: &'static str, low: f64, high: f64) -> Range {
    Range {
        variable,
        unit,
        low,
        high,
    }
}

/// The same range for all three joints, links or axes: `name[1]` to `name[3]`.
macro_rules! each {
    ($name:literal, $unit:literal, $low:expr, $high:expr) => {
        [
            range(concat!($name, "[1]"), $unit, $low, $high),
            range(concat!($name, "[2]"), $unit, $low, $high),
            range(concat!($name, "[3]"), $unit, $low, $high),
        ]
    };
}

impl Range {
    /// The part of the range from `low` on.
    pub(crate) fn at_least(self, low: f64) -> Self {
        Self {
            low: self.low.max(low),
            ..self
        }
    }

    /// The part of the range up to `high`.
    pub(crate) fn at_most(self, high: f64) -> Self {
        Self {
            high: self.high.min(high),
            ..self
        }
    }
}

/// Ranges of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceRanges {
    /// Position (m); besides, the pad must not start inside.
    pub position: Range,
    /// Stiffness (N/m).
    pub k: Range,
    /// Damping (N·s/m).
    pub c: Range,
    /// Coefficient of friction. More than 1 could jam the arm rigidly (Painlevé), where Coulomb's law has no solution.
    pub mu: Range,
}

macro_rules! surface {
    ($name:literal, $axis:literal) => {
        SurfaceRanges {
            position: range(concat!($name, ".", $axis), "m", -1e3, 1e3),
            k: range(concat!($name, ".k"), "N/m", 1.0, 1e7),
            c: range(concat!($name, ".c"), "N.s/m", 0.0, 1e5),
            mu: range(concat!($name, ".mu"), "1", 0.0, 1.0),
        }
    };
}

/// A_1 (m).
pub const A_1: Range = range("A1", "m", 0.0, 10.0);
/// L_1 (m).
pub const L_1: Range = range("L1", "m", 1e-2, 10.0);
/// Handle, along link 3 (m).
pub const HANDLE_X: Range = range("handle.x", "m", 1e-2, 10.0);
/// Handle, across link 3 (m).
pub const HANDLE_Z: Range = range("handle.z", "m", -10.0, 10.0);
/// Pad, along link 3 (m).
pub const PAD_X: Range = range("pad.x", "m", 1e-2, 10.0);
/// Pad, across link 3 (m).
pub const PAD_Z: Range = range("pad.z", "m", -10.0, 10.0);
/// Masses of the links (kg).
pub const LINK_M: [Range; 3] = each!("link.m", "kg", 1e-3, 1e4);
/// Centres of mass along the links (m).
pub const LINK_X: [Range; 3] = each!("link.x", "m", -10.0, 10.0);
/// Centres of mass across the links (m).
pub const LINK_Z: [Range; 3] = each!("link.z", "m", -10.0, 10.0);
/// Moments of inertia about x (kg·m²).
pub const LINK_I_XX: [Range; 3] = each!("link.I_xx", "kg.m2", 1e-9, 1e4);
/// Moments of inertia about y (kg·m²); besides, |I_xx − I_zz| ≤ I_yy ≤ I_xx + I_zz.
pub const LINK_I_YY: [Range; 3] = each!("link.I_yy", "kg.m2", 1e-9, 1e4);
/// Moments of inertia about z (kg·m²).
pub const LINK_I_ZZ: [Range; 3] = each!("link.I_zz", "kg.m2", 1e-9, 1e4);
/// Elements xz of the inertia matrices (kg·m²); besides, I_xz² ≤ I_xx I_zz.
pub const LINK_I_XZ: [Range; 3] = each!("link.I_xz", "kg.m2", -1e4, 1e4);
/// Inertias of the rotors (kg·m²).
pub const ROTOR: [Range; 3] = each!("rotor.I", "kg.m2", 0.0, 1.0);
/// Gear ratios.
pub const GEAR: [Range; 3] = each!("gear", "1", 1.0, 1e4);
/// Gravity (m/s²).
pub const GRAVITY: [Range; 3] = each!("gravity", "m/s2", -1e3, 1e3);
/// Coulomb friction (N·m).
pub const F_C: [Range; 3] = each!("friction.F_c", "N.m", 0.0, 1e6);
/// Stiction (N·m); besides, at least F_c.
pub const F_S: [Range; 3] = each!("friction.F_s", "N.m", 0.0, 1e6);
/// Stribeck velocities (rad/s).
pub const V_S: [Range; 3] = each!("friction.v_s", "rad/s", 1e-4, 1e3);
/// Viscous friction (N·m·s/rad).
pub const B: [Range; 3] = each!("friction.b", "N.m.s/rad", 0.0, 1e6);
/// Lower stops (rad).
pub const STOP_MIN: [Range; 3] = each!("stop.min", "rad", -10.0, 10.0);
/// Upper stops (rad); besides, at least the lower.
pub const STOP_MAX: [Range; 3] = each!("stop.max", "rad", -10.0, 10.0);
/// Start angles (rad); besides, between the stops.
pub const Q_START: [Range; 3] = each!("q_start", "rad", -10.0, 10.0);
/// Start velocities (rad/s).
pub const DQ_START: [Range; 3] = each!("dq_start", "rad/s", -100.0, 100.0);
/// Corner frequency of the drive (Hz).
pub const DRIVE_CUTOFF: Range = range("drive.cutoff", "Hz", 0.0, 1e6);
/// Mass of the payload (kg).
pub const PAYLOAD_M: Range = range("payload.m", "kg", 0.0, 1e4);
/// Pull that breaks the bond (N).
pub const F_MAX: Range = range("vacuum.F_max", "N", 0.0, 1e9);
/// Contact force at which the cup grips (N).
pub const F_ATTACH: Range = range("vacuum.F_attach", "N", 0.0, 1e9);
/// The table.
pub const TABLE: SurfaceRanges = surface!("table", "z");
/// The wall.
pub const WALL: SurfaceRanges = surface!("wall", "x");
