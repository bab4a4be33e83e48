//! Unilateral Kelvin–Voigt contact whose surface has a deflection of its own.

use crate::FLOOR;
use fmu_declaration::{Rows, Start};

/// A wall at `q` that pushes back along −q when a body presses its surface in by s ≥ 0.
///
/// ```text
/// λ = k s + c ds/dt,    0 ≤ λ ⟂ s − pen ≥ 0,    pen = position of the body − q
/// ```
///
/// The surface is a state: it follows the body while pressed and relaxes by itself (λ = 0, time constant c/k) when the
/// body leaves faster than it can. So the contact never pulls, and its force needs no clipping that would lose energy. The
/// start values are those of the testbed.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Wall {
    /// position of the wall, 1e9: no wall
    #[parameter(3, name = "wall.q", unit = METRE, range = -1e9..=1e9, start = 0.3)]
    pub q: f64,
    /// stiffness of the wall
    #[parameter(4, name = "wall.k", unit = NEWTON_PER_METRE, range = 1.0..=1e9, start = 1e5)]
    pub k: f64,
    /// damping of the wall
    #[parameter(5, name = "wall.c", unit = NEWTON_SECOND_PER_METRE, range = 0.0..=1e9, start = 300.0)]
    pub c: f64,
}

impl Wall {
    /// Position (m) that stands for "no wall".
    pub const NONE: f64 = 1e9;

    /// Deflection (m) to which the free surface relaxes from `s` (m) within `dt` (s), backward Euler:
    ///
    /// ```text
    /// 0 = k s⁺ + c (s⁺ − s)/dt    ⇒    s⁺ = s c/(k dt + c)
    /// ```
    pub fn relaxed(&self, s: f64, dt: f64) -> f64 {
        let relaxed = s * (self.c / self.impedance(dt));
        if relaxed < FLOOR { 0.0 } else { relaxed }
    }

    /// κ = k dt + c (N·s/m): impulse per metre by which a body ends a step of `dt` (s) beyond the relaxed surface:
    ///
    /// ```text
    /// λ dt = κ (pen⁺ − s_free)
    /// ```
    pub fn impedance(&self, dt: f64) -> f64 {
        self.k * dt + self.c
    }

    /// Longest substep (s) of which backward Euler costs a mass `m` (kg) no more than the share `lost` of its rebound speed. The
    /// spring's oscillation at ω = √(k/m) shrinks by 1/√(1 + (ω dt)²) a substep, and contact lasts half a period:
    ///
    /// ```text
    /// 1 − lost = exp(−π ω dt/2)
    /// ```
    ///
    /// up to terms of second order in ω dt; what the damper takes is not counted.
    pub fn longest_substep(&self, m: f64, lost: f64) -> f64 {
        -2.0 * libm::log(1.0 - lost) / (core::f64::consts::PI * libm::sqrt(self.k / m))
    }

    /// Share of its rebound speed that a substep of `dt` (s) costs a mass `m` (kg), by the same formula.
    pub fn rebound_lost(&self, m: f64, dt: f64) -> f64 {
        1.0 - libm::exp(-0.5 * core::f64::consts::PI * libm::sqrt(self.k / m) * dt)
    }

    /// Energy stored in the deflection `s` (m), in J: ½ k s².
    pub fn energy(&self, s: f64) -> f64 {
        0.5 * self.k * s * s
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WALL: Wall = Wall {
        q: 0.0,
        k: 1e5,
        c: 300.0,
    };

    #[test]
    fn the_free_surface_relaxes_with_time_constant_c_over_k() {
        let n = 10_000;
        let dt = 2.0 * (WALL.c / WALL.k) / f64::from(n);
        let s = (0..n).fold(1e-3, |s, _| WALL.relaxed(s, dt));
        // Backward Euler, first order: relative error (t/τ)·dt/(2τ) = 2 · 1e-4.
        let exact = 1e-3 * 0.135_335_283_236_612_7;
        assert!((s / exact - 1.0 - 2e-4).abs() < 1e-7, "{s}");
    }

    #[test]
    fn an_undamped_surface_relaxes_at_once() {
        assert_eq!(Wall { c: 0.0, ..WALL }.relaxed(1e-3, 8e-5), 0.0);
    }

    #[test]
    fn relaxation_ends_at_zero_without_denormal_numbers() {
        let mut s: f64 = 1e-3;
        for _ in 0..20_000 {
            s = WALL.relaxed(s, 8e-5);
            assert!(s == 0.0 || s.is_normal());
        }
        assert_eq!(s, 0.0);
    }
}
