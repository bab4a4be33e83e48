//! What is measured of a half swing, against the closed form of a sine.

use super::{T, watch};
use admittance::hand::{HalfSwing, Swing};
use std::f64::consts::TAU;

/// The last half swing of a sine of `frequency` (Hz) and 10 mm at a hand of `k_h` (N/m) and `b_h` (N·s/m), with `offset`
/// (m, N) added, as the band pass would leave them.
fn measured(frequency: f64, k_h: f64, b_h: f64, offset: (f64, f64)) -> HalfSwing {
    let (watch, omega) = (watch(), TAU * frequency);
    let mut swing = Swing::default();
    let mut last = None;
    for k in 0..(4.3 / frequency / T) as u32 {
        let (sin, cos) = (omega * T * f64::from(k)).sin_cos();
        let (x, f) = (0.01 * sin, -0.01 * (k_h * sin + b_h * omega * cos));
        let ended;
        (swing, ended) = swing.sampled(x + offset.0, f + offset.1, &watch);
        last = ended.or(last);
    }
    last.expect("a half swing that has ended")
}

#[test]
fn stiffness_and_damping_of_the_hand_are_measured_over_a_period_whatever_is_added_to_it() {
    for (frequency, k_h, b_h) in [(1.5, 400.0, 0.0), (2.3, 1000.0, 50.0), (3.0, 700.0, -10.0)] {
        for offset in [(0.0, 0.0), (0.003, -2.0), (-0.002, 5.0)] {
            let HalfSwing { hand, residual, .. } = measured(frequency, k_h, b_h, offset);
            // A period is counted in whole samples: 1/n of it, times the offset over the amplitude.
            let magnitude = k_h.hypot(TAU * frequency * b_h);
            let within = 0.02 * magnitude;
            let omega = TAU * frequency;
            assert!(
                (hand.k - k_h).abs() < within,
                "{frequency} Hz, {offset:?}: {hand:?}"
            );
            assert!(
                (hand.b - b_h).abs() * omega < within,
                "{frequency} Hz, {offset:?}: {hand:?}"
            );
            assert!(
                (hand.omega - omega).abs() < 0.01 * omega,
                "{frequency} Hz, {offset:?}: {hand:?}"
            );
            assert!(
                residual.abs() < 0.02,
                "{frequency} Hz, {offset:?}: {residual}"
            );
        }
    }
}

#[test]
fn a_force_with_a_harmonic_that_the_position_lacks_is_not_of_a_hand() {
    let watch = watch();
    let mut swing = Swing::default();
    for k in 0..3000_u32 {
        let phase = TAU * 2.0 * T * f64::from(k);
        let f = -6.0 * phase.sin() - 3.0 * (3.0 * phase).sin();
        let ended;
        (swing, ended) = swing.sampled(0.01 * phase.sin(), f, &watch);
        if let Some(half) = ended.filter(|half| !half.is_too_short(&watch)) {
            // 3²/(6² + 3²)
            assert!(
                (half.residual - 0.2).abs() < 0.02 && !half.is_of_a_hand(&watch),
                "{half:?}"
            );
        }
    }
}
