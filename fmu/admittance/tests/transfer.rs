//! The sampled loop against the transfer functions from the human force to the robot's velocity.
//!
//! N(s) = M_n s + D_n, P(s) = (s + K_P)/s. The loop without friction is
//!
//! ```text
//! N V_n = F − alpha Y,   Y = P (V_n − V),   M s V = F + K Y
//! ```
//!
//! Eliminating V_n: Y = P F (M s − N)/(N M s + P(alpha M s + K N)), hence, times s,
//!
//! ```text
//! V   N s + (K + alpha)(s + K_P)                 alpha = 0: eq:admittance_standard as printed
//! - = --------------------------------------     alpha = 1: eq:admittance_proposed with (K + 1)s in the numerator, where
//! F   N M s² + (s + K_P)(alpha M s + K N)                   the print has (K + D_n)s
//! ```
//!
//! Its value at s = 0 is (1 + alpha/K)/D_n.
#![allow(non_snake_case, reason = "the paper's symbols")]

mod robot;
use admittance::{Gains, Law};
use core::f64::consts::TAU;
use nalgebra::{Complex, Matrix3, Vector3};
use robot::{Mass, tick};

const M: f64 = 6.0;
/// Neither M_n = M nor D_n = 1, so that no wrong term hides.
const GAINS: Gains = Gains {
    M_n: 1.5,
    D_n: 3.0,
    K: 4.0,
    K_P: 10.0,
    f_max: f64::INFINITY,
};

/// Numerator with `damping` in (K + damping)s, denominator as above.
fn velocity_per_force(alpha: f64, damping: f64, gains: &Gains, omega: f64) -> Complex<f64> {
    let Gains {
        M_n, D_n, K, K_P, ..
    } = *gains;
    let s = Complex::new(0.0, omega);
    let N = s * M_n + D_n;
    let numerator = N * s + s * (K + damping) + (K + alpha) * K_P;
    let denominator = N * s * s * M + (s + K_P) * (s * alpha * M + N * K);
    numerator / denominator
}

/// V/F and E/F of the sampled loop at `omega` (rad/s): a sine of 1 N, sampled `n` times a period and held. After the
/// transient one period is fitted with sine, cosine and constant.
fn sampled(which: Law, gains: Gains, omega: f64, n: u32) -> [Complex<f64>; 2] {
    let T = TAU / omega / f64::from(n);
    let mut law = robot::law(which, T, gains);
    let mut mass = Mass::new(M);
    let transient = (40.0 * omega / TAU).ceil() as u32; // 40 s: the slowest mode here decays with 1/3 s⁻¹, e^−13
    let (mut normal, mut q, mut e) = (Matrix3::zeros(), Vector3::zeros(), Vector3::zeros());
    for k in 0..(transient + 1) * n {
        let phase = TAU * f64::from(k % n) / f64::from(n);
        let f_h = phase.sin();
        let tick = tick(&mut law, mass.q, f_h);
        if k >= transient * n {
            let basis = Vector3::new(phase.sin(), phase.cos(), 1.0);
            normal += basis * basis.transpose();
            q += basis * mass.q;
            e += basis * tick.e_nr.x;
        }
        mass.hold(tick.f.x + f_h, T);
    }
    let inverse = normal
        .try_inverse()
        .expect("sine, cosine and one are independent");
    let phasor = |sums: Vector3<f64>| {
        let fit = inverse * sums;
        Complex::new(fit.x, fit.y)
    };
    [phasor(q) * Complex::new(0.0, omega), phasor(e)]
}

fn relative(found: Complex<f64>, expected: Complex<f64>) -> f64 {
    (found - expected).norm() / expected.norm()
}

/// The held force and the backward difference are late by a fraction of a sample: first order in T.
#[test]
fn the_sampled_loop_converges_to_the_transfer_function_with_first_order() {
    for (which, alpha) in [(Law::Standard, 0.0), (Law::Passive, 1.0)] {
        for omega in [0.5, 2.0, 8.0] {
            let expected = velocity_per_force(alpha, alpha, &GAINS, omega);
            let error = |n| relative(sampled(which, GAINS, omega, n)[0], expected);
            let (coarse, fine) = (error(2000), error(4000));
            assert!(fine < 2e-3, "{which:?} at {omega} rad/s: {fine}");
            // 2 but for the second order, which is (error of the coarse)/2 relative to it
            assert!(
                (coarse / fine - 2.0).abs() < 0.05,
                "{which:?} at {omega} rad/s: {coarse} then {fine}"
            );
        }
    }
}

#[test]
fn the_printed_numerator_of_the_proposed_law_does_not_fit() {
    let omega = 8.0;
    let printed = velocity_per_force(1.0, GAINS.D_n, &GAINS, omega);
    for n in [2000, 4000] {
        let error = relative(sampled(Law::Passive, GAINS, omega, n)[0], printed);
        assert!(error > 0.1, "(K + D_n)s fits within {error}");
    }
}

/// At 0.005 rad/s what remains of the dynamics is of the order ω M_n/D_n = 2.5e-3, squared in the magnitude.
#[test]
fn a_slow_force_moves_the_robot_with_one_plus_alpha_over_K_by_D_n() {
    let gain = sampled(Law::Passive, GAINS, 0.005, 100_000)[0].norm();
    let expected = (1.0 + 1.0 / GAINS.K) / GAINS.D_n;
    assert!(
        (gain / expected - 1.0).abs() < 1e-4,
        "{gain} instead of {expected}"
    );
}

/// def:MS_property: as K → ∞ the robot answers like 1/(M_n s + D_n), and the rest is of first order in 1/K.
#[test]
fn the_robot_becomes_the_nominal_model_as_K_grows() {
    let omega = 3.0;
    let nominal = Complex::new(GAINS.D_n, GAINS.M_n * omega).inv();
    for which in [Law::Standard, Law::Passive] {
        let error = |K| {
            relative(
                sampled(which, Gains { K, ..GAINS }, omega, 10_000)[0],
                nominal,
            )
        };
        let errors = [200.0, 400.0, 800.0].map(error);
        for pair in errors.windows(2) {
            // 1/K² terms: M ω/K = 0.09 at K = 200, with a share that depends on the phase
            assert!(
                (pair[0] / pair[1] - 2.0).abs() < 0.1,
                "{which:?}: {errors:?}"
            );
        }
        assert!(errors[2] < 0.02, "{which:?}: {errors:?}");
    }
}

/// thm:pm: |e_nr| ∝ ε = 1/K.
#[test]
fn the_error_halves_when_K_doubles() {
    let omega = 2.3;
    let error = |K| sampled(Law::Passive, Gains { K, ..GAINS }, omega, 20_000)[1].norm();
    let errors = [15.0, 30.0, 60.0, 120.0].map(error);
    for pair in errors.windows(2) {
        // The next order, 1/K², is 0.026 of the ratio at the smallest gain and falls with it.
        assert!((pair[0] / pair[1] - 2.0).abs() < 0.03, "{errors:?}");
    }
}
