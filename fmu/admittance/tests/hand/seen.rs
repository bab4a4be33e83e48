//! Swings of a hand that are seen, and what is none.

use super::{Noise, ON, T, detection, watch};
use crate::meant::{Meant, shake};
use admittance::hand::Detector;
use std::f64::consts::TAU;

#[test]
fn a_swing_that_grows_is_seen_within_four_periods_after_it_has_reached_f_min() {
    for frequency in [1.2, 1.8, 2.5, 4.0, 7.0] {
        for growth in [1.15, 1.5, 3.0] {
            let sigma = frequency * f64::ln(growth);
            let k_h = 600.0;
            let seen = detection(20.0, |t| {
                let q = 0.5 / k_h * (sigma * t).exp() * (TAU * frequency * t).sin();
                (q, -k_h * q)
            });
            // In the band, a swing near its edges is at least a third of what it is outside.
            let reached = f64::ln(3.0 / 0.5) / sigma;
            let seen = seen.expect("detected");
            assert!(
                seen < reached.max(0.0) + 4.0 / frequency,
                "{frequency} Hz, {growth} a period: {seen} s, f_min at {reached} s"
            );
        }
    }
}

#[test]
fn the_stiffness_of_the_hand_is_measured_through_friction_free_and_noisy_sensors() {
    let watch = watch();
    let mut noise = Noise(7);
    let mut detector = Detector::default();
    for k in 0..5000 {
        let t = T * f64::from(k);
        let q = 2e-3 * (0.5 * t).exp() * (TAU * 1.8 * t).sin();
        detector = detector.sensed(
            q + 1e-5 * noise.next(),
            -460.0 * q + 0.2 * noise.next(),
            &watch,
        );
    }
    // Half a period averages 280 samples of noise that is 2 % of the force at its least: far below 1 %.
    assert!(
        (detector.k_h() / 460.0 - 1.0).abs() < 0.01,
        "{}",
        detector.k_h()
    );
}

#[test]
fn a_swing_of_a_hand_that_neither_grows_nor_shrinks_is_seen() {
    // Damping turns f_h by up to 52°, a reflex by up to 30° the other way.
    for (frequency, b) in [
        (1.2, 0.0),
        (1.5, 20.0),
        (2.3, 50.0),
        (2.6, 80.0),
        (2.3, -20.0),
        (5.0, 0.0),
    ] {
        let (k_h, A, omega) = (1000.0, 0.017, TAU * frequency);
        let seen = detection(20.0, |t| {
            (
                A * (omega * t).sin(),
                -A * (k_h * (omega * t).sin() + b * omega * (omega * t).cos()),
            )
        });
        // The band pass settles within two periods at its lower edge, then three that last and two of the probe.
        let seen = seen.expect("detected");
        assert!(
            seen < 2.0 + (f64::from(ON.periods) + 2.5) / frequency,
            "{frequency} Hz, {b} N·s/m: {seen} s"
        );
    }
}

#[test]
fn a_swing_of_a_hand_that_shrinks_is_none() {
    for shrinking in [0.85, 0.7, 0.3] {
        for frequency in [1.2, 2.0, 5.0] {
            let seen = detection(30.0, |t| {
                let q = 0.02 * f64::powf(shrinking, frequency * t) * (TAU * frequency * t).sin();
                (q, -600.0 * q)
            });
            assert_eq!(seen, None, "{shrinking} a period at {frequency} Hz");
        }
    }
}

#[test]
fn a_swing_that_grows_below_f_min_is_none() {
    let seen = detection(4.0, |t| {
        let q = 1e-5 * (1.0 * t).exp() * (TAU * 2.0 * t).sin();
        (q, -600.0 * q) // ends at 0.33 N
    });
    assert_eq!(seen, None);
}

#[test]
fn a_swing_that_grows_because_it_is_pushed_is_none() {
    // f_h in step with the velocity: the operator drives it; against the velocity: the hand damps it; with q: no spring.
    for phase in [0.25, -0.25, 0.0] {
        let seen = detection(6.0, |t| {
            let swing = |turn: f64| (1.0 * t).exp() * (TAU * (2.0 * t + turn)).sin();
            (1e-3 * swing(0.0), 0.6 * swing(phase))
        });
        assert_eq!(seen, None, "{phase} of a turn");
    }
}

#[test]
fn a_lost_payload_a_knock_and_a_ramp_are_none() {
    // A jump of 17 mm that rings down at 6 Hz, against a hand of 600 N/m; a push of 20 N for 0.2 s; a force of 20 N in 0.5 s.
    let lost = |t: f64| {
        let q = if t < 1.0 {
            0.0
        } else {
            0.017 * (1.0 - (-(t - 1.0) / 0.1).exp() * (TAU * 6.0 * (t - 1.0)).cos())
        };
        (q, -600.0 * q)
    };
    let knocked = |t: f64| {
        let f_h = if (1.0..1.2).contains(&t) { 20.0 } else { 0.0 };
        (0.04 * (t - 1.0).clamp(0.0, 0.2), f_h)
    };
    let pressed = |t: f64| {
        (
            -0.001 * ((t - 1.0) / 0.5).clamp(0.0, 1.0),
            20.0 * ((t - 1.0) / 0.5).clamp(0.0, 1.0),
        )
    };
    assert_eq!(detection(10.0, lost), None);
    assert_eq!(detection(10.0, knocked), None);
    assert_eq!(detection(10.0, pressed), None);
}

#[test]
fn ten_minutes_of_sensor_noise_are_none() {
    let (mut position, mut force) = (Noise(1), Noise(2));
    let watch = watch();
    let mut detector = Detector::default();
    for k in 0..600_000 {
        // 0.5 N and 50 µm, as one noise in opposite directions half of the time: the worst correlation.
        let (x, f) = (position.next(), force.next());
        let common = if (k / 50_000) % 2 == 0 { x } else { f };
        detector = detector.sensed(5e-5 * x, -0.5 * common, &watch);
        assert!(!detector.detected(), "tick {k}");
    }
}

#[test]
fn a_stiff_hand_is_seen_while_the_operator_moves_it_about() {
    let mut meant = Meant::new(shake(0.4, 7.0, 2.0));
    let seen = detection(20.0, |t| {
        let (q, f_h) = meant.at(t, 0.0);
        let swing = 1e-4 * (0.7 * t).exp() * (TAU * 1.8 * t).sin();
        (q + swing, f_h - 460.0 * swing)
    });
    // 7 N at 0.4 Hz leave 1 N and 16 mm in the band. The swing is three times that from 8.9 s on, so that its hand is the same
    // within 0.3; then three half swings of one hand, and four of the probe: 1.95 s.
    assert!(seen.expect("detected") < 8.9 + 7.0 * 0.278, "{seen:?}");
}

#[test]
fn a_millimetre_of_position_noise_does_not_break_a_swing_up() {
    let sigma = 1.8 * f64::ln(1.5);
    for seed in 1..20 {
        let mut noise = Noise(seed);
        let seen = detection(10.0, |t| {
            let q = 2e-3 * (sigma * t).exp() * (TAU * 1.8 * t).sin();
            (q + 1e-3 * noise.next(), -460.0 * q)
        });
        // The first half swing has 0.9 N; six are needed, four of the probe, and the noise may cost three at the beginning.
        assert!(seen.expect("detected") < 6.5 / 1.8, "{seen:?}");
    }
}

#[test]
fn a_motion_below_the_band_does_not_keep_the_damping() {
    // A swing that grows for 3 s, then 20 N at 0.4 Hz of which 3 N pass the filter, opposing q like a spring.
    let watch = watch();
    let mut detector = Detector::default();
    let mut damped = 0.0;
    for k in 0..10_000 {
        let t = T * f64::from(k);
        let q = if t < 3.0 {
            1e-3 * (1.0 * t).exp() * (TAU * 2.0 * t).sin()
        } else {
            20.0 / 600.0 * (TAU * 0.4 * (t - 3.0)).sin()
        };
        detector = detector.sensed(q, -600.0 * q, &watch);
        damped = f64::max(damped, detector.D());
    }
    assert_eq!((damped, detector.D()), (ON.D_max, 0.0));
}
