//! Parameters, samples that are none, and whatever else it may be shown.

use super::{ON, T, watch};
use admittance::ParameterError;
use admittance::hand::{Detector, StiffHand, Watch};
use proptest::prelude::*;
use std::f64::consts::TAU;

#[test]
fn a_sample_that_is_no_number_is_skipped_and_a_detection_runs_on() {
    let watch = watch();
    let shown = |t: f64| {
        let q = 1e-3 * (1.0 * t).exp() * (TAU * 2.0 * t).sin();
        (q, -600.0 * q)
    };
    let mut detector = Detector::default();
    for k in 0..6000 {
        let (q, f_h) = shown(f64::from(k) * T);
        detector = match k {
            4000 => detector.sensed(f64::NAN, f_h, &watch),
            4001 => detector.sensed(q, f64::INFINITY, &watch),
            _ => detector.sensed(q, f_h, &watch),
        };
        if k > 3900 {
            assert!(detector.detected() && detector.D() == ON.D_max, "tick {k}");
        }
    }
    assert!(
        (detector.k_h() / 600.0 - 1.0).abs() < 1e-6,
        "both signals pass the same filter"
    );
}

#[test]
fn off_it_does_nothing() {
    let off = Watch::new(StiffHand::default(), T).expect("valid parameters");
    let mut detector = Detector::default();
    for k in 0..5000 {
        let t = f64::from(k) * T;
        let q = 1e-3 * (2.0 * t).exp() * (TAU * 2.0 * t).sin();
        detector = detector.sensed(q, -600.0 * q, &off);
        assert_eq!(detector, Detector::default());
    }
}

#[test]
fn a_bad_parameter_is_refused_by_name() {
    type Change = fn(&mut StiffHand);
    let changes: [(&str, Change); 15] = [
        ("stiff_hand.D_max", |hand| hand.D_max = -1.0),
        ("stiff_hand.f_low", |hand| hand.f_low = 0.0),
        ("stiff_hand.f_high", |hand| hand.f_high = f64::NAN),
        ("stiff_hand.f_high", |hand| hand.f_high = 1.0), // f_low
        ("stiff_hand.f_high", |hand| hand.f_high = 126.0), // 1/(8 T) = 125 Hz
        ("stiff_hand.f_min", |hand| hand.f_min = 0.0),
        ("stiff_hand.growth", |hand| hand.growth = 1.0),
        ("stiff_hand.growth", |hand| hand.growth = f64::INFINITY),
        ("stiff_hand.attack", |hand| hand.attack = 0.0),
        ("stiff_hand.quiet", |hand| hand.quiet = f64::NAN),
        ("stiff_hand.release", |hand| hand.release = -1.0),
        ("stiff_hand.periods", |hand| hand.periods = 1),
        ("stiff_hand.periods", |hand| hand.periods = 101),
        ("stiff_hand.probe", |hand| hand.probe = 0.0),
        ("stiff_hand.pause", |hand| hand.pause = f64::NAN),
    ];
    for (expected, change) in changes {
        let mut hand = ON;
        change(&mut hand);
        match Watch::new(hand, T) {
            Err(ParameterError::OutOfRange { name, .. }) => assert_eq!(name, expected),
            other => panic!("{expected}: {other:?}"),
        }
    }
    assert!(Watch::new(ON, 0.0).is_err());
}

proptest! {
    /// Whatever it is shown, D is a damping within [0, D_max] that ramps: all that the energy argument asks of it.
    #[test]
    fn the_damping_is_one_for_any_signal(
        samples in prop::collection::vec((prop::num::f64::ANY, prop::num::f64::ANY, 1_u32..400), 1..40),
    ) {
        let watch = watch();
        let mut detector = Detector::default();
        for (q, f_h, repeated) in samples {
            for k in 0..repeated {
                let sign = if k % 100 < 50 { 1.0 } else { -1.0 };
                let before = detector.D();
                detector = detector.sensed(sign * q, f_h, &watch);
                prop_assert!((0.0..=ON.D_max).contains(&detector.D()));
                prop_assert!(detector.D() - before <= ON.D_max * T / ON.attack + 1e-9); // rounding of a sum
            }
        }
    }
}
