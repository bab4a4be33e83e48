//! Motor and gear as a first-order lag of the torque.

use nalgebra::Vector3;

use super::floored;

/// dτ/dt = ω (τ_a − τ), solved exactly over a substep in which τ_a is held: τ⁺ = τ_a + (τ − τ_a) exp(−ω dt).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// exp(−ω dt): what is left of the difference after one substep; 0 without lag.
    keep: f64,
}

impl Drive {
    /// Lag with the corner frequency `cutoff` (Hz; 0 = no lag) in substeps of `dt` (s).
    pub fn new(cutoff: f64, dt: f64) -> Self {
        let keep = if cutoff > 0.0 {
            floored(libm::exp(-2.0 * core::f64::consts::PI * cutoff * dt))
        } else {
            0.0
        };
        Self { keep }
    }

    /// Torque (N·m) one substep later, from the torque `tau` now and the demand `tau_a`. It acts through the whole
    /// substep: backward Euler takes forces at the end.
    pub fn step(&self, tau: &Vector3<f64>, tau_a: &Vector3<f64>) -> Vector3<f64> {
        tau.zip_map(tau_a, |tau, tau_a| {
            floored(tau_a + (tau - tau_a) * self.keep)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lag_is_exact_for_any_substep() {
        let (from, to) = (Vector3::new(1.0, -20.0, 0.0), Vector3::new(50.0, 3.0, -7.0));
        for n in [1, 7, 100] {
            let drive = Drive::new(318.0, 1e-3 / f64::from(n));
            let tau = (0..n).fold(from, |tau, _| drive.step(&tau, &to));
            let left = (-2.0 * core::f64::consts::PI * 318.0 * 1e-3_f64).exp();
            // n roundings of 50 N·m: 100 · 7e-15 at most.
            assert!((tau - (to + (from - to) * left)).amax() < 1e-12, "{n}");
        }
    }

    #[test]
    fn without_cutoff_the_torque_is_the_demand_bit_for_bit() {
        let demand = Vector3::new(0.1, -0.2, 1e300);
        assert_eq!(
            Drive::new(0.0, 1e-4).step(&Vector3::new(5.0, 6.0, 7.0), &demand),
            demand
        );
    }

    #[test]
    fn a_torque_that_dies_out_ends_at_zero_without_denormal_numbers() {
        let drive = Drive::new(318.0, 1e-4);
        let mut tau = Vector3::new(1.0, -1.0, 1e-3);
        for _ in 0..10_000 {
            tau = drive.step(&tau, &Vector3::zeros());
            assert!(tau.iter().all(|x| *x == 0.0 || x.is_normal()));
        }
        assert_eq!(tau, Vector3::zeros());
    }
}
