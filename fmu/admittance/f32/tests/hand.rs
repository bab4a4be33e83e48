//! The stiff-hand detector decides the same in single as in double precision.
#![allow(non_snake_case, reason = "the paper's symbols")]

use admittance::hand as double;
use admittance_f32::hand as single;
use std::f64::consts::TAU;

const T: f64 = 0.001;

#[test]
fn a_swing_that_grows_and_ends_is_seen_and_left_at_the_same_ticks() {
    let hand = double::StiffHand {
        active: 1,
        ..double::StiffHand::default()
    };
    let in_double = double::Watch::new(hand, T).expect("valid parameters");
    let hand = single::StiffHand {
        active: 1,
        ..single::StiffHand::default()
    };
    let in_single = single::Watch::new(hand, T as f32).expect("valid parameters");

    for (k_h, frequency, sigma) in [(460.0, 1.8, 0.73), (700.0, 2.0, 2.23), (1000.0, 2.2, 3.45)] {
        let mut a = double::Detector::default();
        let mut b = single::Detector::default();
        let (mut decisions_a, mut decisions_b) = (Vec::new(), Vec::new());
        for k in 0..12_000_u32 {
            let t = f64::from(k) * T;
            let grown = if t < 6.0 {
                (sigma * (t - 5.0)).exp()
            } else {
                0.0
            };
            // About the arm's handle, 0.44 m from the shoulder, which the operator moves at 0.25 Hz.
            let q = 0.44 + 0.1 * (1.57 * t).sin() + 0.01 * grown * (TAU * frequency * t).sin();
            let f_h = -0.01 * k_h * grown * (TAU * frequency * t).sin();
            let was = (a.detected(), b.detected());
            a = a.sensed(q, f_h, &in_double);
            b = b.sensed(q as f32, f_h as f32, &in_single);
            if a.detected() != was.0 {
                decisions_a.push((k, a.detected()));
            }
            if b.detected() != was.1 {
                decisions_b.push((k, b.detected()));
            }
            // Single precision knows 0.44 m to 3e-8 m: 1e-3 of a swing, a tick or two at a crossing of zero, once a decision.
            assert!(
                (a.D() - f64::from(b.D())).abs() <= 3.0 * 2000.0 * T,
                "{k_h} N/m, tick {k}"
            );
        }
        assert_eq!(decisions_a.len(), 2, "{k_h} N/m: {decisions_a:?}");
        assert_eq!(decisions_b.len(), 2, "{k_h} N/m: {decisions_b:?}");
        for ((k_a, what_a), (k_b, what_b)) in decisions_a.into_iter().zip(decisions_b) {
            assert!(
                what_a == what_b && k_a.abs_diff(k_b) <= 2,
                "{k_h} N/m: {k_a}, {k_b}"
            );
        }
    }
}
