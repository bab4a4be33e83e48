//! Limits inside the law, and gains that ramp, on the arm.

use crate::robot::{Robot, close_the_loop};
use crate::{ArmController, T, initialized, tick};
use fmu_export::{Log, Model};
use nalgebra::Vector3;

/// Pushed with `f_h` (N) for `ticks` ticks on the crude arm; `see` is shown every tick.
fn push(
    change: impl FnOnce(&mut ArmController),
    f_h: [f64; 3],
    ticks: u32,
    mut see: impl FnMut(&ArmController),
) {
    let mut c = initialized(change);
    let mut robot = Robot::at_the_start();
    for k in 0..ticks {
        close_the_loop(&mut c, &mut robot, k, f_h);
        see(&c);
    }
}

#[test]
fn the_nominal_obeys_its_speed_limit_and_reaches_it() {
    let (mut fastest, mut held) = (0.0_f64, false);
    let limited = |c: &mut ArmController| c.parameters.dp_n_max = [0.05; 3];
    push(limited, [0.0, 8.0, 0.0], 3000, |c| {
        fastest = fastest.max(c.outputs.dp_n[1]);
        held |= c.outputs.held != 0;
    });
    // v_m is limited, v_n is it once the stop has acted; on the way there it may be ahead by T f_h/(2 Lambda_n).
    assert!(
        held && (fastest - 0.05).abs() <= T * 8.0 / 10.0,
        "{fastest} m/s"
    );
}

#[test]
fn the_nominal_stays_in_its_box_and_gets_to_the_edge() {
    let mut highest = f64::MIN;
    let limited = |c: &mut ArmController| {
        (c.parameters.dp_n_max, c.parameters.p_n_box) = ([0.1; 3], 1);
        (c.parameters.p_n_min, c.parameters.p_n_max) = ([-1.0; 3], [1.0, 0.04, 1.0]);
    };
    push(limited, [0.0, 8.0, 0.0], 3000, |c| {
        highest = highest.max(c.outputs.p_n[1])
    });
    assert!((highest - 0.04).abs() < 1e-12, "{highest} m"); // q + e, rounded
}

#[test]
fn torques_change_no_faster_than_they_may_and_as_fast() {
    let most = 2000.0 * T;
    let (mut last, mut fastest) = (None::<Vector3<f64>>, 0.0_f64);
    let limited = |c: &mut ArmController| c.parameters.tau_rate_max = [2000.0; 3];
    push(limited, [0.0, 8.0, -8.0], 3000, |c| {
        let tau = Vector3::from(c.outputs.tau_a);
        fastest = fastest.max((tau - last.unwrap_or_default()).amax());
        last = Some(tau);
        assert_eq!(c.outputs.share, 1.0); // the budget alone may be faster
    });
    assert!(fastest <= most * (1.0 + 1e-12), "{fastest} N·m"); // the way's rounding
    assert!(
        fastest > 0.99 * most,
        "{fastest} N·m: the limit was not met"
    );
}

#[test]
fn hold_keeps_the_nominal_where_it_is_under_a_steady_push() {
    let mut c = initialized(|c| c.inputs.f_h = [0.0, 0.0, 4.0]);
    (0..200).for_each(|k| tick(&mut c, k));
    c.inputs.hold = 1;
    tick(&mut c, 200);
    let held = c.outputs.p_n;
    (201..400).for_each(|k| tick(&mut c, k));
    assert!(c.outputs.held != 0);
    let away = Vector3::from(c.outputs.p_n) - Vector3::from(held);
    assert!(away.amax() < 1e-15, "{away}"); // q + e, rounded
}

/// Gains are wanted at once and come over 0.1 s: K on a straight line, while nothing moves but the force.
#[test]
fn changed_gains_come_into_force_over_the_tuning_time() {
    let force_after = |tuning_time: f64, ticks: u32| {
        let mut c = initialized(|c| {
            (c.inputs.f_h, c.parameters.tuning_time) = ([0.0, 0.0, 4.0], tuning_time)
        });
        (0..50).for_each(|k| tick(&mut c, k));
        let before = c.outputs.f_a[2];
        (c.parameters.K, c.parameters.D_n) = ([2000.0; 3], [40.0; 3]);
        c.tune(&mut Log::silent()).expect("valid gains");
        (50..50 + ticks).for_each(|k| tick(&mut c, k));
        (c.outputs.f_a[2] - before).abs()
    };
    assert!(force_after(0.1, 1) < 0.1 * force_after(0.0, 1));
}

#[test]
fn a_bad_limit_is_refused_by_name_value_and_range() {
    type Change = fn(&mut ArmController);
    let cases: [(Change, &str); 3] = [
        (
            |c| c.parameters.dp_n_max[1] = -1.0,
            "dp_n_max[2] = -1: expected a finite value not less than 0",
        ),
        (
            |c| c.parameters.tau_rate_max[0] = -5.0,
            "tau_rate_max[1] = -5: expected a finite value not less than 0",
        ),
        (
            |c| {
                (
                    c.parameters.p_n_box,
                    c.parameters.p_n_min[2],
                    c.parameters.p_n_max[2],
                ) = (1, 0.5, 0.5)
            },
            "p_n_max[3] = 0.5: expected a value greater than the least one",
        ),
    ];
    for (change, expected) in cases {
        let mut c = ArmController::default();
        change(&mut c);
        let refusal = c
            .initialize(0.0, &mut Log::silent())
            .expect_err("impossible");
        assert_eq!(refusal.0, expected);
    }
}
