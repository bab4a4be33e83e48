//! Encoder and force sensor: what they show of a known state.

mod arm;

use arm::{run, started, started_at, step};
use core::f64::consts::PI;
use exoskeleton_arm::ExoskeletonArm;
use exoskeleton_arm::encoder::{JOINT, MOTOR};
use exoskeleton_arm::force_sensor::{BASE, DROPOUT, NAN, OVER_RANGE, SENSOR, STUCK};
use exoskeleton_arm::noise::normal;
use fmu_export::{Clock, Log, Model, Step};
use nalgebra::{Matrix3, Vector3};

#[test]
fn an_encoder_shows_the_nearest_of_its_counts() {
    let counts = |kind, counts, bits| {
        [0, 1, 2].map(|i| {
            let gear: f64 = [354.0, 600.0, 354.0][i];
            if kind == MOTOR {
                f64::from(counts) * gear
            } else {
                f64::from(1 << bits)
            }
        })
    };
    for (kind, n, bits) in [
        (MOTOR, 2000, 17),
        (MOTOR, 500, 17),
        (JOINT, 2000, 17),
        (JOINT, 2000, 14),
    ] {
        let mut arm = started(|arm| {
            arm.encoder.kind = kind;
            arm.encoder.counts = n;
            arm.encoder.bits = bits;
            arm.start.q = [0.2, -1.3, 1.1];
        });
        arm.inputs.f_h = [150.0, 80.0, 90.0];
        let mut seen = 0;
        for k in 0..200 {
            step(&mut arm, f64::from(k) * 1e-3, 1e-3);
            for (i, per_turn) in counts(kind, n, bits).into_iter().enumerate() {
                let turns = arm.outputs.q_joint[i] * per_turn / (2.0 * PI);
                let count = arm.outputs.q[i] * per_turn / (2.0 * PI);
                // 2e6 counts in double precision.
                assert!((count - count.round()).abs() < 1e-9, "{count}");
                assert!((count - turns).abs() <= 0.5 + 1e-9, "{count} {turns}");
                seen += i32::from((count - turns).abs() > 0.25);
            }
        }
        assert!(
            seen > 50,
            "{seen} of 600 readings were off by a quarter of a count or more"
        );
    }
}

#[test]
fn resolutions_are_those_of_the_specification() {
    let resolution = |change: fn(&mut ExoskeletonArm)| {
        let arm = started(change);
        [0, 1, 2].map(|i| arm.encoder.resolution(arm.parameters.masses.gear[i]))
    };
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a / b - 1.0).abs() < 1e-15);
    let motor = [708_000.0, 1_200_000.0, 708_000.0].map(|n| 2.0 * PI / n);
    assert!(near(resolution(|arm| arm.encoder.kind = MOTOR), motor));
    assert!(near(
        resolution(|arm| arm.encoder.kind = JOINT),
        [2.0 * PI / 131_072.0; 3]
    ));
    assert_eq!(resolution(|_| ()), [0.0; 3]);
}

/// Link 3's axes in the base frame, as columns: yaw q₁ about z, then pitch q₂ + q₃ about −y.
fn link_3(q: [f64; 3]) -> Matrix3<f64> {
    let (s, c) = q[0].sin_cos();
    let yaw = Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0);
    let (s, c) = (q[1] + q[2]).sin_cos();
    yaw * Matrix3::new(c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c)
}

#[test]
fn in_its_own_frame_the_sensor_turns_with_link_3() {
    let f_h = [60.0, -90.0, 120.0];
    let mut arm = started(|arm| {
        arm.ft.frame = SENSOR;
        arm.ft.bias = [0.1, 0.2, 0.3];
        arm.start.q = [0.4, -1.2, 1.0];
        arm.inputs.f_h = f_h;
    });
    let first = arm.outputs.f_h_measured;
    for k in 0..300 {
        let expected = link_3(arm.outputs.q_joint).transpose() * Vector3::from(f_h)
            + Vector3::new(0.1, 0.2, 0.3);
        // Rounding of 162 N.
        assert!((Vector3::from(arm.outputs.f_h_measured) - expected).amax() < 1e-12);
        step(&mut arm, f64::from(k) * 1e-3, 1e-3);
    }
    assert!((arm.outputs.f_h_measured[0] - first[0]).abs() > 5.0); // it did turn
}

#[test]
fn in_the_base_frame_the_reading_does_not_turn() {
    let mut arm = started(|arm| arm.inputs.f_h = [60.0, -90.0, 120.0]);
    run(&mut arm, 0, 300);
    assert!((arm.outputs.q_joint[0] - arm.start.q[0]).abs() > 0.01);
    assert_eq!(arm.outputs.f_h_measured, [60.0, -90.0, 120.0]);
}

#[test]
fn noise_has_its_mean_deviation_and_seed() {
    const N: u32 = 20_000;
    let readings = |seed| {
        let mut arm = started(|arm| {
            arm.ft.noise = 0.2;
            arm.ft.bias = [0.5, 0.0, 0.0];
            arm.ft.seed = seed;
            arm.inputs.f_h[1] = 1.0;
        });
        (0..N)
            .map(|k| {
                step(&mut arm, f64::from(k) * 1e-3, 1e-3);
                arm.outputs.f_h_measured
            })
            .collect::<Vec<_>>()
    };
    let one = readings(1);
    for (axis, expected) in [0.5, 1.0, 0.0].into_iter().enumerate() {
        let mean = one.iter().map(|f| f[axis]).sum::<f64>() / f64::from(N);
        let square = one
            .iter()
            .map(|f| (f[axis] - expected).powi(2))
            .sum::<f64>()
            / f64::from(N);
        // Five standard deviations: 0.2/√N of the mean, 0.2/√(2N) of the deviation.
        assert!(
            (mean - expected).abs() < 5.0 * 0.2 / f64::from(N).sqrt(),
            "{mean}"
        );
        assert!((square.sqrt() - 0.2).abs() < 5.0 * 0.2 / f64::from(2 * N).sqrt());
    }
    assert_eq!(one, readings(1));
    assert_ne!(one, readings(2));
}

#[test]
fn samples_belong_to_the_sensors_clock_whatever_the_steps() {
    // At rest: friction bears 1 N. A reading is a function of the number of the latest sample alone.
    for (period, h) in [
        (1e-3, 1e-3),
        (1e-3, 2.5e-4),
        (1e-3, 1e-3 / 3.0),
        (1e-3, 7e-3),
        (2e-3, 1e-3),
        (0.7e-3, 1e-3),
    ] {
        for accumulated in [false, true] {
            let mut arm = started(|arm| {
                arm.ft.noise = 1.0;
                arm.ft.T = period;
                arm.inputs.f_h = [1.0; 3];
            });
            let mut t = 0.0;
            for k in 0..(0.3 / h) as u32 {
                let begin = if accumulated { t } else { f64::from(k) * h };
                step(&mut arm, begin, h);
                t += h;
                let sample = (f64::from(k + 1) * h / period + 1e-6).floor() as u64;
                let expected: [f64; 3] = [0, 1, 2].map(|axis| 1.0 + normal(1, sample, axis));
                assert_eq!(
                    arm.outputs.f_h_measured, expected,
                    "T = {period}, h = {h}, step {k}"
                );
            }
        }
    }
}

#[test]
fn between_samples_the_reading_holds() {
    let mut arm = started(|arm| arm.ft.T = 0.01);
    for k in 0..40 {
        arm.inputs.f_h[0] = f64::from(k); // held in the step that begins at k ms
        step(&mut arm, f64::from(k) * 1e-3, 1e-3);
        let sampled = if k < 9 { 0 } else { (k + 1) / 10 * 10 - 1 };
        assert_eq!(arm.outputs.f_h_measured[0], f64::from(sampled), "{k}");
    }
}

#[test]
fn a_sample_inside_a_long_step_sees_the_pose_of_its_instant() {
    let swinging = || {
        started(|arm| {
            arm.ft.frame = SENSOR;
            arm.inputs.f_h = [60.0, -90.0, 120.0];
            arm.start.dq = [1.0, 0.5, -0.5];
        })
    };
    let (mut long, mut short) = (swinging(), swinging());
    step(&mut long, 0.0, 1.5e-3);
    step(&mut short, 0.0, 1e-3);
    assert_eq!(long.outputs.f_h_measured, short.outputs.f_h_measured); // both of sample 1, at 1 ms, substeps of 0.1 ms
    let at_end = link_3(long.outputs.q_joint).transpose() * Vector3::from(long.inputs.f_h);
    assert!((Vector3::from(long.outputs.f_h_measured) - at_end).amax() > 1e-3);
}

#[test]
fn readings_end_at_the_range() {
    let mut arm = started(|arm| arm.ft.range = 20.0);
    arm.inputs.f_h = [30.0, -25.0, 19.0];
    run(&mut arm, 0, 1);
    assert_eq!(arm.outputs.f_h_measured, [20.0, -20.0, 19.0]);
}

#[test]
fn each_failure_begins_at_its_sample_and_shows_what_it_says() {
    for failure in [STUCK, NAN, OVER_RANGE, DROPOUT] {
        let mut arm = started(|arm| {
            arm.ft.failure = failure;
            arm.ft.t_failure = 0.010;
            arm.ft.range = 50.0;
        });
        for k in 1..=20 {
            arm.inputs.f_h = [f64::from(k), -f64::from(k), 1.0];
            step(&mut arm, f64::from(k - 1) * 1e-3, 1e-3);
            let (sound, shown) = (arm.inputs.f_h, arm.outputs.f_h_measured);
            match failure {
                _ if k < 10 => assert_eq!(shown, sound),
                STUCK => assert_eq!(shown, [9.0, -9.0, 1.0]),
                NAN => assert!(shown.iter().all(|f| f.is_nan())),
                OVER_RANGE => assert_eq!(shown, [50.0, -50.0, 50.0]),
                _ => assert_eq!(shown, [0.0; 3]),
            }
        }
        // The plant feels the force itself.
        assert!(
            arm.outputs
                .p
                .iter()
                .chain(&arm.outputs.dq)
                .all(|x| x.is_finite())
        );
    }
}

#[test]
fn a_failure_can_be_there_from_the_start() {
    let shown = |failure| {
        started(|arm| {
            arm.ft.failure = failure;
            arm.inputs.f_h = [4.0, -4.0, 0.0];
        })
        .outputs
        .f_h_measured
    };
    assert_eq!(shown(STUCK), [4.0, -4.0, 0.0]);
    assert!(shown(NAN).iter().all(|f| f.is_nan()));
    assert_eq!(shown(OVER_RANGE), [500.0, -500.0, 500.0]);
    assert_eq!(shown(DROPOUT), [0.0; 3]);
}

#[test]
fn the_error_of_a_drifting_sensor_grows_with_the_time_of_its_samples() {
    let mut arm = started_at(100.0, |arm| {
        arm.ft.drift = [0.1, -0.2, 0.0];
        arm.ft.bias = [0.0, 1.0, 0.0];
        arm.ft.T = 0.01;
    })
    .unwrap();
    for k in 1..=400 {
        let mut step = Step::at(f64::from(k - 1) * 1e-3, 1e-3);
        (step.t, step.start_time) = (step.t + 100.0, 100.0);
        arm.step(step, &mut Log::silent()).unwrap();
        let age = f64::from(k / 10) * 0.01;
        let shown = arm.outputs.f_h_measured;
        assert!((shown[0] - 0.1 * age).abs() < 1e-12, "{shown:?} at {age} s");
        assert!((shown[1] - (1.0 - 0.2 * age)).abs() < 1e-12);
        assert_eq!(shown[2], 0.0);
    }
}

#[test]
fn a_push_leaves_the_hysteresis_behind_and_a_small_change_passes() {
    const H: f64 = 2.0;
    const L: f64 = 20.0;
    let mut arm = started(|arm| {
        arm.ft.hysteresis = H;
        arm.ft.hysteresis_span = L;
    });
    // Up to 80 N and back in steps of the sensor's clock; the error by its differential equation, in steps of 1 mN.
    let up_and_down = (0..=80).chain((0..80).rev()).map(f64::from);
    let (mut force, mut lag) = (0.0, 0.0);
    for (k, next) in (0..).zip(up_and_down) {
        arm.inputs.f_h[1] = next;
        step(&mut arm, f64::from(k) * 1e-3, 1e-3);
        for _ in 0..if next == force { 0 } else { 1000 } {
            let by = (next - force).signum();
            lag -= (lag + H * by) / L * 1e-3;
        }
        force = next;
        let shown = arm.outputs.f_h_measured;
        // Euler's error of first order: 1e-3/L of H.
        assert!(
            (shown[1] - (force + lag)).abs() < 1e-4,
            "{shown:?} at {force} N"
        );
        assert_eq!((shown[0], shown[2]), (0.0, 0.0));
    }
    let left = arm.outputs.f_h_measured[1];
    assert!((1.9..2.0).contains(&left), "{left} N of 2 N are left");
    arm.inputs.f_h[1] = 0.5;
    step(&mut arm, 0.161, 1e-3);
    let passed = (arm.outputs.f_h_measured[1] - left) / 0.5;
    assert!((0.75..0.85).contains(&passed), "{passed}"); // 1 − 2H/L
}

#[test]
fn the_weight_of_a_tool_turns_with_the_sensor_and_not_in_the_base_frame() {
    let down = Vector3::new(0.0, 0.0, -9.81 * 1.2);
    for q in [[0.4, -1.2, 1.0], [-0.3, -0.6, 1.9]] {
        let shown = |frame| {
            let arm = started(|arm| {
                arm.ft.tool_m = 1.2;
                arm.ft.frame = frame;
                arm.start.q = q;
            });
            Vector3::from(arm.outputs.f_h_measured)
        };
        assert!((shown(SENSOR) - link_3(q).transpose() * down).amax() < 1e-12);
        assert!((shown(BASE) - down).amax() < 1e-12);
    }
}

#[test]
fn sensors_do_not_touch_the_plant() {
    let mut ideal = started(|arm| arm.inputs.f_h = [40.0, -50.0, 60.0]);
    let mut bad = started(|arm| {
        arm.inputs.f_h = [40.0, -50.0, 60.0];
        arm.encoder.kind = JOINT;
        arm.encoder.bits = 14;
        arm.ft.noise = 3.0;
        arm.ft.failure = NAN;
        arm.ft.frame = SENSOR;
        arm.ft.T = 3.3e-4;
        arm.ft.drift = [1.0; 3];
        arm.ft.hysteresis = 2.0;
        arm.ft.tool_m = 3.0;
    });
    run(&mut ideal, 0, 300);
    run(&mut bad, 0, 300);
    assert_eq!(ideal.plant, bad.plant);
    assert!(ideal.outputs.energy.work_f_h > 0.1);
}

#[test]
fn a_number_of_samples_that_is_not_that_of_the_time_is_refused_by_name() {
    let mut arm = started(|_| ());
    let mut clock = Clock::at_start(0.0);
    for k in 0..20 {
        step(&mut arm, f64::from(k) * 1e-3, 1e-3);
        clock.advance(&Step::at(0.0, 1e-3));
    }
    assert_eq!(arm.fits(&clock), Ok(()));
    // A sensor that is ahead of the time would take no sample any more.
    arm.reading.k = u64::MAX;
    let refusal = arm.fits(&clock).unwrap_err();
    let named = "number of force samples = 18446744073709551615, expected 20 periods of 0.001 s";
    assert!(refusal.0.starts_with(named), "{refusal}");
}
