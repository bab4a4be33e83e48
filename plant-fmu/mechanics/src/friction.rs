//! Coulomb friction, set-valued, with viscous friction.

use crate::{FLOOR, Sum};
use fmu_declaration::{Rows, Start};

/// Friction of one axis. On the moving part acts τ_f, with −τ_f ∈ F_c Sgn(v) + b v, Sgn(0) = \[−1, 1\].
///
/// Stiction equals Coulomb friction. At v = 0 friction is whatever holds the part, up to F_c: it truly sticks. (Smooth
/// substitutes, tanh or LuGre, creep under any load.) The start values are those of the paper's testbed.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Friction {
    /// Coulomb friction, equal to stiction
    #[parameter(1, unit = NEWTON, range = 0.0..=1e6, start = 0.64)]
    pub F_c: f64,
    /// viscous friction
    #[parameter(2, unit = NEWTON_SECOND_PER_METRE, range = 0.0..=1e6, start = 0.19)]
    pub b: f64,
}

impl Friction {
    /// One implicit step of `dt` (s): the new velocity v (m/s) and the impulse j_f (N·s) with which Coulomb friction
    /// opposes it, from the velocity `v_0` (m/s), the impulse `i` (N·s) of all else and the mass `m` (kg) that resists:
    ///
    /// ```text
    /// m (v − v_0) = i − j_f,  j_f ∈ F_c dt Sgn(v)    ⇒    p = m v_0 + i,  j_f = clip(p, ±F_c dt),  m v = p − j_f
    /// ```
    ///
    /// Where friction can hold the part, v is exactly zero. Else it is v_0 + (i − j_f)/m, not (p − j_f)/m: the roundings
    /// of m and of the quotient then weigh on the change only.
    pub fn step(&self, v_0: Sum, m: f64, i: f64, dt: f64) -> (Sum, f64) {
        let most = self.F_c * dt;
        let p = m * v_0.value() + i;
        let j_f = p.max(-most).min(most);
        let v = v_0.plus((i - j_f) / m);
        // What friction leaves, p − j_f, has the sign of v in exact numbers; if not, v is rounding, and zero.
        let moves = (p - j_f) * v.value() > 0.0 && v.value().abs() > FLOOR;
        (if moves { v } else { Sum::default() }, j_f)
    }

    /// Force on a part that moves at `v` (m/s), in N: −F_c sgn(v) − b v; 0 at rest, where it follows from the other
    /// forces and not from v.
    pub fn at(&self, v: f64) -> f64 {
        if v == 0.0 {
            0.0
        } else {
            -(self.F_c.copysign(v) + self.b * v)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRICTION: Friction = Friction { F_c: 2.0, b: 0.5 };

    fn step(v_0: f64, m: f64, i: f64) -> (f64, f64) {
        let (v, j_f) = FRICTION.step(v_0.into(), m, i, 0.125); // F_c dt = 0.25
        (v.value(), j_f)
    }

    #[test]
    fn a_part_that_friction_can_hold_stops_exactly() {
        for (v_0, i) in [
            (0.0, 0.25),
            (0.0, -0.25),
            (0.1, 0.0),
            (0.1, -0.35),
            (-0.1, 0.349_999),
            (0.0, 0.0),
        ] {
            assert_eq!(step(v_0, 1.0, i), (0.0, v_0 + i));
        }
    }

    #[test]
    fn beyond_the_limit_the_impulse_is_the_limit_and_opposes_the_motion() {
        assert_eq!(step(1.0, 4.0, 1.25), (1.25, 0.25));
        assert_eq!(step(-1.0, 4.0, -1.25), (-1.25, -0.25));
        assert_eq!(step(1.0, 4.0, -6.25), (-0.5, -0.25)); // turned round by the rest
    }

    #[test]
    fn friction_never_reverses_the_motion_not_by_rounding_either() {
        // Momentum within a rounding of what friction can take: p − j_f > 0 may meet v_0 + (i − j_f)/m < 0.
        let dt = 0.1;
        let most = FRICTION.F_c * dt;
        for k in 1..10_000 {
            let (m, i) = (1.0 + f64::from(k) * 1e-3, -0.3 - f64::from(k) * 1e-4);
            let near = ((most - i) / m).to_bits();
            for v_0 in (near - 2..=near + 2).map(f64::from_bits) {
                let (v, j_f) = FRICTION.step(v_0.into(), m, i, dt);
                assert!(
                    v.value() >= 0.0 && j_f > 0.0,
                    "m = {m}, v_0 = {v_0:e}: {v:?}"
                );
            }
        }
    }

    #[test]
    fn force_opposes_the_velocity_and_vanishes_at_rest() {
        assert_eq!(FRICTION.at(3.0), -3.5);
        assert_eq!(FRICTION.at(-3.0), 3.5);
        assert_eq!(FRICTION.at(0.0), 0.0);
        assert_eq!(FRICTION.at(-0.0), 0.0);
    }
}
