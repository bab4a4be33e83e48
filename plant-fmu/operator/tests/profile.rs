//! The planned force against its closed form.

use core::f64::consts::PI;
use fmu_export::{Log, Model, Step};
use human_operator::HumanOperator;
use human_operator::profile::{CONSTANT, SINE, window};

/// axis, kind, t_on, t_off, ramp, amplitude, frequency, phase
type Segment = (i32, i32, f64, f64, f64, f64, f64, f64);

/// A human with these segments, initialized at `start`.
fn human(start: f64, segments: &[Segment]) -> HumanOperator {
    let mut human = HumanOperator::default();
    for (i, &(axis, kind, t_on, t_off, ramp, amplitude, frequency, phase)) in
        segments.iter().enumerate()
    {
        human.segments[i].axis = axis;
        human.segments[i].kind = kind;
        human.segments[i].t_on = t_on;
        human.segments[i].t_off = t_off;
        human.segments[i].ramp = ramp;
        human.segments[i].amplitude = amplitude;
        human.segments[i].frequency = frequency;
        human.segments[i].phase = phase;
    }
    human.initialize(start, &mut Log::silent()).unwrap();
    human
}

fn step(human: &mut HumanOperator, t: f64, h: f64) {
    let step = Step::at(t, h);
    human.step(step, &mut Log::silent()).unwrap();
}

/// The window of the specification, w(t; a, b) with ramps of 0.5 s.
fn w(t: f64, a: f64, b: f64) -> f64 {
    ((t - a) / 0.5).clamp(0.0, 1.0) - ((t - b) / 0.5).clamp(0.0, 1.0)
}

#[test]
fn the_profile_of_experiment_2_is_its_closed_form() {
    // Sines (7, 5, 4) N of (0.8, 0.6, 0.7) Hz, phase from 5 s, in w(5, 25) and w(41, 50); −20 N and +10 N along z.
    let sines = [(1, 7.0, 0.8), (2, 5.0, 0.6), (3, 4.0, 0.7)];
    let mut segments = vec![
        (3, CONSTANT, 25.0, 40.0, 0.5, -20.0, 0.0, 0.0),
        (3, CONSTANT, 40.0, 41.0, 0.5, 10.0, 0.0, 0.0),
    ];
    for (axis, amplitude, f) in sines {
        for (on, off) in [(5.0, 25.0), (41.0, 50.0)] {
            segments.push((axis, SINE, on, off, 0.5, amplitude, f, -2.0 * PI * f * 5.0));
        }
    }
    let mut human = human(0.0, &segments);
    assert_eq!(human.outputs.f_h, [0.0; 3]);
    let mut strongest: f64 = 0.0;
    for k in 0..60_000 {
        step(&mut human, f64::from(k) * 1e-3, 1e-3);
        let t = f64::from(k) * 1e-3 + 1e-3;
        let active = w(t, 5.0, 25.0) + w(t, 41.0, 50.0);
        let sine = |amplitude: f64, f: f64| amplitude * (2.0 * PI * f * (t - 5.0)).sin() * active;
        let expected = [
            sine(7.0, 0.8),
            sine(5.0, 0.6),
            sine(4.0, 0.7) - 20.0 * w(t, 25.0, 40.0) + 10.0 * w(t, 40.0, 41.0),
        ];
        for (axis, expected) in expected.into_iter().enumerate() {
            // The sine's argument reaches 300 rad: 7 N · 300 · 2⁻⁵² twice over.
            assert!(
                (human.outputs.f_h[axis] - expected).abs() < 1e-12,
                "{t} {axis}"
            );
            strongest = strongest.max(expected.abs());
        }
    }
    assert!(strongest > 19.0);
}

#[test]
fn a_window_opens_and_closes_over_its_ramp() {
    for (t, expected) in [
        (0.9, 0.0),
        (1.0, 0.0),
        (1.25, 0.5),
        (1.5, 1.0),
        (3.0, 1.0),
        (3.25, 0.5),
        (3.5, 0.0),
        (9.0, 0.0),
    ] {
        assert_eq!(window(t, 1.0, 3.0, 0.5), expected, "{t}");
    }
    // Cut short: it got to 0.4 of its height.
    assert!((window(1.3, 1.0, 1.2, 0.5) - 0.4).abs() < 1e-15);
}

#[test]
fn without_a_ramp_the_window_is_a_step_that_rounding_does_not_shift() {
    // Steps of 10 ms, accumulated: after 12 of them the time falls short of 0.12 s by a rounding.
    let mut human = human(0.0, &[(2, CONSTANT, 0.12, 0.5, 0.0, 8.0, 0.0, 0.0)]);
    let mut t = 0.0;
    for k in 1..=100 {
        step(&mut human, t, 0.01);
        t += 0.01;
        assert!(k != 12 || t < 0.12, "{t:?}");
        let expected = if (12..50).contains(&k) { 8.0 } else { 0.0 };
        assert_eq!(human.outputs.f_h, [0.0, expected, 0.0], "{k}");
    }
}

#[test]
fn the_force_after_initialization_is_that_at_the_start_time() {
    let segments = [
        (1, SINE, 0.0, 100.0, 0.0, 3.0, 0.25, PI / 6.0),
        (1, CONSTANT, 5.0, 9.0, 4.0, 2.0, 0.0, 0.0),
        (3, CONSTANT, 0.0, 6.0, 0.0, -1.5, 0.0, 0.0),
    ];
    let human = human(6.0, &segments);
    // 3 sin(2π·0.25·6 + π/6) = −3 sin(π/6) = −1.5; 2·(6 − 5)/4 = 0.5; the third has just closed.
    assert!(
        (human.outputs.f_h[0] + 1.0).abs() < 1e-14,
        "{:?}",
        human.outputs.f_h
    );
    assert_eq!((human.outputs.f_h[1], human.outputs.f_h[2]), (0.0, 0.0));
}

#[test]
fn many_small_steps_and_one_large_one_show_the_same_force() {
    let segments = [
        (1, SINE, 0.2, 0.9, 0.3, 3.0, 1.7, 0.4),
        (2, CONSTANT, 0.1, 0.4, 0.2, 2.0, 0.0, 0.0),
    ];
    let (mut small, mut large) = (human(0.0, &segments), human(0.0, &segments));
    for k in 0..8 {
        let t = f64::from(k) * 0.125; // powers of two: no rounding
        for i in 0..128 {
            step(&mut small, t + f64::from(i) / 1024.0, 1.0 / 1024.0);
        }
        step(&mut large, t, 0.125);
        assert_eq!(small.outputs.f_h, large.outputs.f_h);
        assert_ne!(small.outputs.f_h, [0.0; 3]);
    }
}

#[test]
fn all_sixteen_segments_are_summed() {
    let segments: Vec<_> = (0..16)
        .map(|i| {
            (
                1 + i % 3,
                CONSTANT,
                0.0,
                1.0,
                0.0,
                f64::from(1 << i),
                0.0,
                0.0,
            )
        })
        .collect();
    let sum = |axis: i32| -> f64 {
        (0..16)
            .filter(|i| i % 3 == axis)
            .map(|i| f64::from(1 << i))
            .sum()
    };
    assert_eq!(
        human(0.5, &segments).outputs.f_profile,
        [sum(0), sum(1), sum(2)]
    );
}
