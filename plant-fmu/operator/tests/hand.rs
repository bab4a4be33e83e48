//! The impedance hand against its closed form.

use fmu_export::{Log, Model, Step};
use human_operator::HumanOperator;
use human_operator::rows::Inputs;

const P_0: [f64; 3] = [0.44, 0.0, -0.24];
const OMEGA: [f64; 3] = [3.0, 5.0, 7.0];
const SWING: f64 = 0.05;

/// Motion of the handle: p, dp.
fn motion(t: f64) -> ([f64; 3], [f64; 3]) {
    (
        std::array::from_fn(|i| P_0[i] + SWING * (OMEGA[i] * t).sin()),
        std::array::from_fn(|i| SWING * OMEGA[i] * (OMEGA[i] * t).cos()),
    )
}

/// At rest at `P_0` until 0, moved from there on: largest error of the force against k_h (p_i − p) − b_h dp one delay ago.
fn worst_error(delay: f64, h: f64) -> f64 {
    let mut human = HumanOperator {
        inputs: Inputs {
            p: P_0,
            ..Inputs::default()
        },
        k_h: 300.0,
        b_h: 15.0,
        delay,
        ..HumanOperator::default()
    };
    human.initialize(0.0, &mut Log::silent()).unwrap();
    assert_eq!(human.outputs.f_h, [0.0; 3]);
    let mut worst: f64 = 0.0;
    for k in 0..(2.0 / h) as u32 {
        let t = f64::from(k) * h;
        let end = t + h;
        (human.inputs.p, human.inputs.dp) = motion(end);
        let step = Step::at(t, h);
        human.step(step, &mut Log::silent()).unwrap();
        let then = end - delay;
        let (p, dp) = motion(then);
        for i in 0..3 {
            let expected = 300.0 * (P_0[i] - p[i]) - 15.0 * dp[i];
            if then > h {
                worst = worst.max((human.outputs.f_h[i] - expected).abs());
            } else if then < 0.0 {
                assert_eq!(
                    human.outputs.f_h[i], 0.0,
                    "before the motion began it felt rest, at {end} s"
                );
            }
        }
    }
    worst
}

#[test]
fn a_hand_without_delay_is_a_spring_and_a_damper() {
    // Rounding: 300 N/m · 0.44 m · 2⁻⁵².
    assert!(worst_error(0.0, 1e-3) < 1e-13);
}

#[test]
fn a_reflex_of_whole_steps_is_the_force_of_that_many_steps_ago() {
    // What is interpolated is the rounding of k·h alone: 1e-15 s times the force's slope (120 N/s) at most.
    for delay in [1e-3, 0.12, 1.0] {
        assert!(worst_error(delay, 1e-3) < 1e-11, "{delay}");
    }
}

#[test]
fn between_samples_the_reflex_errs_in_second_order_of_the_step() {
    let (coarse, fine) = (worst_error(0.1003, 2e-3), worst_error(0.1003, 1e-3));
    // (k_h |ddp| + b_h |dddp|) h²/8, at 7 rad/s and 0.05 m: 0.33 mN at 2 ms.
    assert!(coarse < 3.5e-4 && coarse > 1e-5, "{coarse:e}");
    assert!(fine < 9e-5, "{fine:e}");
}

#[test]
fn a_reflex_far_longer_than_the_steps_needs_no_more_memory() {
    // 100 000 steps lie within the delay, of 1022 kept samples 1 ms apart: (k_h |ddp| + b_h |dddp|)·(1 ms)²/8.
    let mut human = HumanOperator {
        inputs: Inputs {
            p: P_0,
            ..Inputs::default()
        },
        k_h: 300.0,
        delay: 1.0,
        ..HumanOperator::default()
    };
    human.initialize(0.0, &mut Log::silent()).unwrap();
    let size = postcard::to_allocvec(&human).unwrap().len();
    for k in 0..200_000 {
        let t = f64::from(k) * 1e-5;
        human.inputs.p = motion(t + 1e-5).0;
        let step = Step::at(t, 1e-5);
        human.step(step, &mut Log::silent()).unwrap();
        let then = t + 1e-5 - 1.0;
        if then > 1e-3 {
            let expected = 300.0 * (P_0[2] - motion(then).0[2]);
            assert!((human.outputs.f_h[2] - expected).abs() < 1.2e-4);
        }
    }
    // Variable-length counters of the ring take up to two bytes more.
    assert!(postcard::to_allocvec(&human).unwrap().len() <= size + 4);
}

#[test]
fn the_hand_wants_to_be_where_it_starts_or_where_it_is_told() {
    let at = |intended_from_start| {
        let mut human = HumanOperator {
            inputs: Inputs {
                p: P_0,
                dp: [0.1, 0.0, 0.0],
            },
            k_h: 100.0,
            b_h: 10.0,
            p_intended: [0.54, 0.02, -0.24],
            intended_from_start,
            ..HumanOperator::default()
        };
        human.initialize(3.0, &mut Log::silent()).unwrap();
        human.outputs.f_h
    };
    assert_eq!(at(true), [-1.0, 0.0, 0.0]);
    let f_h = at(false);
    assert!((f_h[0] - 9.0).abs() < 1e-13 && (f_h[1] - 2.0).abs() < 1e-13 && f_h[2] == 0.0);
}

/// Largest force of a hand of 100 N/m and 5 N·s/m that feels the moving handle from the first step on, but nothing at
/// initialization.
fn pull_when_late(delay: f64, intended_from_start: bool) -> f64 {
    let mut human = HumanOperator {
        k_h: 100.0,
        b_h: 5.0,
        delay,
        p_intended: P_0,
        intended_from_start,
        ..HumanOperator::default()
    };
    human.initialize(0.0, &mut Log::silent()).unwrap();
    let mut largest: f64 = 0.0;
    for k in 0..200 {
        let t = f64::from(k) * 1e-3;
        human.inputs.p = motion(t * 0.1).0;
        human.step(Step::at(t, 1e-3), &mut Log::silent()).unwrap();
        largest = human
            .outputs
            .f_h
            .iter()
            .fold(largest, |a, f| a.max(f.abs()));
    }
    largest
}

#[test]
fn a_hand_that_feels_nothing_at_initialization_takes_hold_at_the_first_step() {
    for delay in [0.0, 0.05, 0.3] {
        for intended_from_start in [true, false] {
            // The handle moves 7 mm in these .2 s: .7 N. From the shoulder it would be 44 N.
            let pull = pull_when_late(delay, intended_from_start);
            assert!(pull < 0.75, "{pull} N with a delay of {delay} s");
        }
    }
}

#[test]
fn a_hand_that_is_at_rest_in_the_origin_stays_there() {
    // A rig with one axis starts at 0: the hand takes hold at the first step where it did at initialization.
    let mut human = HumanOperator {
        k_h: 100.0,
        delay: 0.01,
        ..HumanOperator::default()
    };
    human.initialize(0.0, &mut Log::silent()).unwrap();
    human.step(Step::at(0.0, 0.1), &mut Log::silent()).unwrap();
    assert_eq!(human.outputs.f_h, [0.0; 3]);
    human.inputs.p[0] = 0.01;
    for k in 1..3 {
        let step = Step::at(0.1 * f64::from(k), 0.1);
        human.step(step, &mut Log::silent()).unwrap();
    }
    assert_eq!(human.outputs.f_h, [-1.0, 0.0, 0.0]);
}

#[test]
fn profile_and_hand_are_summed() {
    let mut human = HumanOperator {
        inputs: Inputs {
            p: P_0,
            ..Inputs::default()
        },
        k_h: 50.0,
        p_intended: [0.44, 0.1, -0.24],
        intended_from_start: false,
        ..HumanOperator::default()
    };
    human.segments[4].kind = 2;
    human.segments[4].axis = 2;
    human.segments[4].amplitude = -7.0;
    human.initialize(0.0, &mut Log::silent()).unwrap();
    assert_eq!(
        (
            human.outputs.f_profile[1],
            human.outputs.f_hand[1],
            human.outputs.f_h[1]
        ),
        (-7.0, 5.0, -2.0)
    );
}

#[test]
fn a_saved_state_continues_bit_for_bit() {
    let mut human = HumanOperator {
        inputs: Inputs {
            p: P_0,
            ..Inputs::default()
        },
        k_h: 300.0,
        b_h: 15.0,
        delay: 0.05,
        ..HumanOperator::default()
    };
    human.initialize(0.0, &mut Log::silent()).unwrap();
    let run = |human: &mut HumanOperator, from: u32, to: u32| {
        for k in from..to {
            let t = f64::from(k) * 1e-3;
            (human.inputs.p, human.inputs.dp) = motion(t + 1e-3);
            let step = Step::at(t, 1e-3);
            human.step(step, &mut Log::silent()).unwrap();
        }
    };
    run(&mut human, 0, 1500);
    let mut restored: HumanOperator =
        postcard::from_bytes(&postcard::to_allocvec(&human).unwrap()).unwrap();
    run(&mut human, 1500, 3000);
    run(&mut restored, 1500, 3000);
    assert_eq!(human, restored);
}

#[test]
fn a_hand_that_lets_go_pulls_no_more_and_the_plan_goes_on() {
    let mut human = HumanOperator {
        inputs: Inputs {
            p: P_0,
            ..Inputs::default()
        },
        k_h: 300.0,
        let_go: 1.0,
        ..HumanOperator::default()
    };
    human.segments[0].kind = 2; // constant
    human.segments[0].amplitude = 3.0;
    human.initialize(0.0, &mut Log::silent()).unwrap();
    human.inputs.p[1] += 0.1;
    for (t, h, f_hand) in [
        (0.0, 0.5, -30.0),
        (0.5, 0.25, -30.0),
        (0.75, 0.25, 0.0),
        (1.0, 1.0, 0.0),
    ] {
        let step = Step::at(t, h);
        human.step(step, &mut Log::silent()).unwrap();
        // Rounding: 300 N/m · 0.1 m · 2⁻⁵².
        assert!((human.outputs.f_hand[1] - f_hand).abs() < 1e-13, "{t} s");
        assert_eq!(
            human.outputs.f_h,
            [
                3.0 + human.outputs.f_hand[0],
                human.outputs.f_hand[1],
                human.outputs.f_hand[2]
            ]
        );
    }
    let mut late = HumanOperator {
        k_h: 300.0,
        ..human
    };
    late.let_go = -1.0;
    late.initialize(0.0, &mut Log::silent()).unwrap();
    assert_eq!(late.outputs.f_hand, [0.0; 3]);
}
