//! Dry friction of a geared joint that grips harder at rest, and viscous friction.

use fmu_declaration::Rows;

/// Friction of one joint. On the joint acts τ_f, with −τ_f ∈ F(v) Sgn(v) + b v, Sgn(0) = \[−1, 1\] and
///
/// ```text
/// F(v) = F_c + (F_s − F_c) exp(−(v/v_s)²)
/// ```
///
/// At rest friction is whatever holds the joint, up to F_s: it does not creep.
#[derive(Clone, Copy, Debug, PartialEq, Rows)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Stribeck {
    /// Coulomb friction of the joint
    #[parameter(16, name = "friction.F_c[i]", unit = NEWTON_METRE, range = 0.0..=1e6)]
    pub F_c: f64,
    /// stiction of the joint, at least friction.F_c
    #[parameter(17, name = "friction.F_s[i]", unit = NEWTON_METRE, range = 0.0..=1e6)]
    pub F_s: f64,
    /// Stribeck velocity: F_c + (F_s - F_c) exp(-(dq/v_s)^2)
    #[parameter(18, name = "friction.v_s[i]", unit = RADIAN_PER_SECOND, range = 1e-4..=1e3)]
    pub v_s: f64,
    /// viscous friction of the joint
    #[parameter(19, name = "friction.b[i]", unit = NEWTON_METRE_SECOND_PER_RADIAN, range = 0.0..=1e6)]
    pub b: f64,
}

impl Stribeck {
    /// Beyond this (v/v_s)² the exponential is a denormal number or zero: it is taken as zero.
    const GONE: f64 = 700.0;
    /// Beyond this a peak F_s − F_c of at most F_c is lost in the rounding of F_c: exp(−40) is a thirteenth of half a unit
    /// in its last place.
    const LOST: f64 = 40.0;

    /// F(v) (N·m) at `v` (rad/s). A substep takes it at the velocity at its begin: F decreases with |v|, and implicit it
    /// would allow two velocities at once.
    pub fn limit(&self, v: f64) -> f64 {
        if v == 0.0 {
            return self.F_s;
        }
        let ratio = v / self.v_s;
        let square = ratio * ratio;
        let peak = self.F_s - self.F_c;
        if peak == 0.0 || square > Self::GONE || (square > Self::LOST && peak <= self.F_c) {
            return self.F_c; // as the sum below, without the exponential
        }
        self.F_c + peak * libm::exp(-square)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const JOINT: Stribeck = Stribeck {
        F_c: 12.0,
        F_s: 16.0,
        v_s: 0.03,
        b: 8.0,
    };

    #[test]
    fn friction_is_stiction_at_rest_and_coulomb_far_from_it() {
        assert_eq!(JOINT.limit(0.0), 16.0);
        assert_eq!(JOINT.limit(-0.0), 16.0);
        assert_eq!(JOINT.limit(1.0), 12.0);
        assert_eq!(JOINT.limit(f64::MAX), 12.0);
    }

    #[test]
    fn at_the_stribeck_velocity_one_part_in_e_of_the_excess_is_left() {
        let expected = 12.0 + 4.0 * 0.367_879_441_171_442_33; // 1/e; one rounding of 16
        assert!((JOINT.limit(0.03) - expected).abs() < 4e-15);
        assert_eq!(JOINT.limit(-0.03), JOINT.limit(0.03));
    }

    #[test]
    fn where_the_exponential_is_left_out_it_would_not_show_in_any_bit() {
        let flat = Stribeck { F_s: 12.0, ..JOINT };
        let steep = Stribeck { F_s: 24.0, ..JOINT };
        let steeper = Stribeck { F_s: 25.0, ..JOINT };
        for (joint, k) in [flat, JOINT, steep, steeper]
            .iter()
            .flat_map(|joint| (1..3000).map(move |k| (joint, k)))
        {
            let v = f64::from(k) * 1e-4; // to 10 v_s: (v/v_s)² from 1e-5 to 100
            let ratio = v / joint.v_s;
            let full = joint.F_c + (joint.F_s - joint.F_c) * libm::exp(-ratio * ratio);
            assert_eq!(joint.limit(v).to_bits(), full.to_bits(), "{v} {joint:?}");
        }
    }

    #[test]
    fn the_limit_never_comes_from_a_denormal_exponential() {
        let bare = Stribeck { F_c: 0.0, ..JOINT };
        for k in 0..4000 {
            let limit = bare.limit(f64::from(k) * 2.5e-4);
            assert!(limit == 0.0 || limit.is_normal(), "{k}: {limit:e}");
        }
    }
}
