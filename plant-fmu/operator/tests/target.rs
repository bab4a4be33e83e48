//! The moving target of the hand, and what the hand does with it axis by axis.

use fmu_export::{Log, Model, Step};
use human_operator::HumanOperator;
use human_operator::rows::Inputs;
use human_operator::target::{MINIMUM_JERK, Motion, Point, SINE, TABLE, Target};

const P_0: [f64; 3] = [0.44, 0.0, -0.24];

fn sine() -> Target {
    Target {
        kind: SINE,
        amplitude: [0.2, -0.1, 0.05],
        frequency: [0.325, 0.6, 0.7],
        phase: [0.0, 0.4, -1.0],
        t_on: 1.0,
        t_off: 8.0,
        ramp: 2.0,
        ..Target::default()
    }
}

fn through(kind: i32, places: &[(f64, [f64; 3])]) -> Target {
    let mut target = Target {
        kind,
        used: i32::try_from(places.len()).unwrap(),
        ..Target::default()
    };
    for (point, &(t, [x, y, z])) in target.points.iter_mut().zip(places) {
        *point = Point { t, x, y, z };
    }
    target
}

fn points(kind: i32) -> Target {
    through(
        kind,
        &[
            (1.0, [0.0; 3]),
            (2.5, [0.3, -0.1, 0.0]),
            (3.0, [0.1, 0.2, 0.05]),
        ],
    )
}

#[test]
fn in_the_open_window_the_target_is_a_sine_along_each_axis_and_outside_it_rests() {
    let target = sine();
    for t in [3.0, 4.7, 8.0] {
        let p = target.at(t).p;
        for (i, p) in p.iter().enumerate() {
            let turn = 2.0 * std::f64::consts::PI * target.frequency[i] * t + target.phase[i];
            assert!((p - target.amplitude[i] * turn.sin()).abs() < 1e-15); // rounding
        }
    }
    for t in [0.0, 1.0, 10.0, 1e6] {
        assert!(
            target.at(t).p.iter().all(|p| p.abs() < 1e-15),
            "{t} s: {:?}",
            target.at(t)
        );
    }
}

#[test]
fn the_velocity_of_the_target_is_the_slope_of_its_place() {
    let h = 1e-5;
    for target in [sine(), points(MINIMUM_JERK), points(TABLE)] {
        let mut fastest: f64 = 0.0;
        for k in 0..1100 {
            let t = 0.01 * f64::from(k) + 0.003; // beside the corners of the table
            let (before, now, after) = (target.at(t - h), target.at(t), target.at(t + h));
            for i in 0..3 {
                let slope = (after.p[i] - before.p[i]) / (2.0 * h);
                // h²/6 times the third derivative, at most 60 · 0.3 m/(0.5 s)³, and rounding.
                assert!((now.dp[i] - slope).abs() < 1e-7, "{t} s, axis {i}");
                fastest = fastest.max(now.dp[i].abs());
            }
        }
        assert!(fastest > 0.3);
    }
}

#[test]
fn a_movement_of_minimum_jerk_has_the_shape_that_flash_and_hogan_give() {
    // Their movement from 0 to 1 in 1 s: halfway at half time, fastest there with 15/8 of the mean speed, and the
    // sixth derivative vanishes, which is what least jerk means: every sixth difference is 0.
    let target = through(MINIMUM_JERK, &[(2.0, [0.0; 3]), (3.0, [1.0, 0.0, 0.0])]);
    let Motion { p, dp } = target.at(2.5);
    assert!((p[0] - 0.5).abs() < 1e-15 && (dp[0] - 1.875).abs() < 1e-14);
    let x: Vec<f64> = (0..=6)
        .map(|k| target.at(2.1 + 0.1 * f64::from(k)).p[0])
        .collect();
    let sixth: f64 = x
        .iter()
        .zip([1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0])
        .map(|(x, c)| x * c)
        .sum();
    let fifth: f64 = x
        .iter()
        .zip([-1.0, 5.0, -10.0, 10.0, -5.0, 1.0])
        .map(|(x, c)| x * c)
        .sum();
    assert!(sixth.abs() < 1e-13, "{sixth:e}");
    assert!((fifth - 720e-5).abs() < 1e-13, "{fifth:e}"); // 5! · 6 · (0.1)⁵
    // At rest at both ends, velocity and acceleration: 10 s³ of .3 ms is 3e-10.
    for (t, there) in [(2.0, 0.0), (3.0, 1.0)] {
        for near in [t - 3e-4, t, t + 3e-4] {
            assert!((target.at(near).p[0] - there).abs() < 3e-10, "{near} s");
        }
    }
}

#[test]
fn the_target_is_in_each_point_at_its_time_and_stays_in_the_last() {
    for kind in [MINIMUM_JERK, TABLE] {
        let target = points(kind);
        for (t, there) in [
            (-5.0, [0.0; 3]),
            (1.0, [0.0; 3]),
            (2.5, [0.3, -0.1, 0.0]),
            (3.0, [0.1, 0.2, 0.05]),
            (9.0, [0.1, 0.2, 0.05]),
        ] {
            for (p, there) in target.at(t).p.iter().zip(there) {
                assert!((p - there).abs() < 1e-15, "{kind} {t} s");
            }
        }
        assert_eq!(target.at(9.0).dp, [0.0; 3]);
    }
    let third = points(TABLE).at(1.5);
    assert!((third.p[0] - 0.1).abs() < 1e-15 && (third.dp[0] - 0.2).abs() < 1e-15);
}

fn human(target: Target) -> HumanOperator {
    let mut human = HumanOperator {
        inputs: Inputs {
            p: P_0,
            ..Inputs::default()
        },
        k_h: 100.0,
        b_h: 10.0,
        k_h_factor: [0.266, 2.0, 0.0],
        b_h_factor: [0.6, 0.0, 3.0],
        target,
        ..HumanOperator::default()
    };
    human.initialize(0.0, &mut Log::silent()).unwrap();
    human
}

#[test]
fn each_axis_has_a_stiffness_and_a_damping_of_its_own() {
    let mut human = human(Target::default());
    human.inputs.p = [P_0[0] + 0.1, P_0[1] + 0.1, P_0[2] + 0.1];
    human.inputs.dp = [0.5, 0.5, 0.5];
    human.step(Step::at(0.0, 0.01), &mut Log::silent()).unwrap();
    for (f, expected) in human.outputs.f_hand.iter().zip([
        -26.6 * 0.1 - 6.0 * 0.5,
        -200.0 * 0.1,
        -30.0 * 0.5, // a damper alone
    ]) {
        assert!((f - expected).abs() < 1e-12, "{f} {expected}");
    }
}

#[test]
fn a_handle_that_moves_with_the_target_feels_no_force_and_one_that_rests_feels_spring_and_damper() {
    let (mut along, mut at_rest) = (human(sine()), human(sine()));
    let mut strongest = 0.0_f64;
    for k in 0..600 {
        let step = Step::at(0.01 * f64::from(k), 0.01);
        let t = step.t + step.h;
        let Motion { p, dp } = sine().at(t);
        along.inputs.p = std::array::from_fn(|i| P_0[i] + p[i]);
        along.inputs.dp = dp;
        along.step(step, &mut Log::silent()).unwrap();
        at_rest.step(step, &mut Log::silent()).unwrap();
        for i in 0..3 {
            assert!(along.outputs.f_h[i].abs() < 1e-12, "{t} s");
            assert!((along.outputs.p_target[i] - along.inputs.p[i]).abs() < 1e-15);
            let pull = 100.0 * at_rest.k_h_factor[i] * p[i] + 10.0 * at_rest.b_h_factor[i] * dp[i];
            assert!((at_rest.outputs.f_h[i] - pull).abs() < 1e-12, "{t} s");
        }
        strongest = strongest.max(at_rest.outputs.f_h[0].abs());
    }
    assert!(strongest > 1.0);
}

#[test]
fn a_target_counts_from_where_a_late_hand_took_hold() {
    // Nothing is wired at initialization: the hand takes hold at the first step, and its target starts from there.
    let mut human = HumanOperator {
        k_h: 100.0,
        target: points(TABLE),
        ..HumanOperator::default()
    };
    human.initialize(0.0, &mut Log::silent()).unwrap();
    human.inputs.p = P_0;
    human.step(Step::at(0.0, 2.5), &mut Log::silent()).unwrap();
    for (f, expected) in human.outputs.f_h.iter().zip([30.0, -10.0, 0.0]) {
        assert!((f - expected).abs() < 1e-12, "{f}");
    }
}
