//! Positions that cannot be: what reaches the robot.

use crate::{initialized, tick};
use admittance::encoder::Fault;
use testbed_controller::TestbedController;

/// A mass of 6 kg without friction in the loop for a second, pushed with 2 N; then the position reads `error` (m) too much
/// for `samples` samples. The forces from there on, and the controller.
fn misread(law: i32, error: f64, samples: u32) -> (Vec<f64>, TestbedController) {
    let mut c = initialized(|c| (c.parameters.law, c.inputs.tau_h) = (law, 2.0));
    let (mut q, mut dq) = (0.0, 0.0);
    let mut forces = Vec::new();
    for k in 0..520 {
        c.inputs.q = q + error * f64::from(u8::from((500..500 + samples).contains(&k)));
        tick(&mut c, k);
        dq += (c.outputs.tau_a + 2.0) / 6.0 * 0.002;
        q += dq * 0.002;
        if k >= 500 {
            forces.push(c.outputs.tau_a);
        }
    }
    (forces, c)
}

#[test]
fn one_wrong_position_changes_no_force_by_more_than_its_motion_would() {
    for law in 1..=4 {
        let (right, _) = misread(law, 0.0, 0);
        // It goes on at its last velocity. After n samples that is wrong by a n T, and the way back is a (n T)²/2 in one
        // sample: K a T (n + n²/2), with K a T = 30 N·s/m · 0.4 m/s² · 2 ms = 0.024 N.
        for (error, samples, most) in [(0.5, 1, 0.036), (-0.03, 1, 0.036), (1e3, 4, 0.288)] {
            let (forces, c) = misread(law, error, samples);
            for (force, right) in forces.iter().zip(&right) {
                assert!(
                    (force - right).abs() < most,
                    "law {law}, {error} m: {force} N, {right} N"
                );
            }
            assert_eq!((c.outputs.encoder_fault, c.outputs.debt), (0, 0));
        }
    }
}

#[test]
fn a_position_that_stays_wrong_takes_the_force_and_the_law_engages_anew() {
    for law in 1..=4 {
        let (forces, c) = misread(law, 0.5, 20);
        assert!(forces[..4].iter().all(|force| force.abs() > 0.0));
        assert_eq!(forces[4..9], [0.0; 5]);
        assert!(forces[9].abs() < 0.1, "{forces:?}"); // from rest, pushed with 2 N; then it brakes the moving mass
        assert_eq!((c.outputs.engaged, c.outputs.encoder_fault), (1, 0));
    }
}

#[test]
fn a_position_marked_invalid_gives_no_force_and_says_why() {
    let (_, mut c) = misread(4, 0.0, 0);
    c.inputs.encoder_valid = 0;
    tick(&mut c, 520);
    assert_eq!((c.outputs.tau_a, c.outputs.engaged), (0.0, 0));
    assert_eq!(c.outputs.encoder_fault, Fault::Invalid.number());
    c.inputs.q = 1e300;
    c.inputs.encoder_valid = 1;
    tick(&mut c, 521);
    assert_eq!(c.outputs.encoder_fault, Fault::OverRange.number());
}

#[test]
fn in_servo_form_a_drive_whose_position_is_not_known_is_told_to_stand_where_it_last_was() {
    let mut c = initialized(|c| (c.parameters.form, c.inputs.tau_h) = (2, 2.0));
    for k in 0..100 {
        c.inputs.q = 1e-4 * f64::from(k);
        tick(&mut c, k);
    }
    assert!(c.outputs.dq_d > 0.0 && c.outputs.engaged == 1);
    (c.inputs.encoder_valid, c.inputs.q) = (0, 0.5);
    tick(&mut c, 100);
    assert_eq!((c.outputs.q_d, c.outputs.dq_d), (99e-4, 0.0));
    assert_eq!(
        (c.outputs.engaged, c.outputs.encoder_fault),
        (0, Fault::Invalid.number())
    );
    (c.inputs.encoder_valid, c.inputs.q) = (1, 1e-2);
    (101..110).for_each(|k| tick(&mut c, k));
    assert_eq!((c.outputs.engaged, c.outputs.encoder_fault), (1, 0));
    assert!(c.outputs.q_d > 1e-2);
}

#[test]
fn in_servo_form_a_measured_force_that_is_no_number_is_refused_by_name() {
    use fmu_export::{Log, Model, Step};
    let mut c = initialized(|c| (c.parameters.form, c.inputs.tau_h) = (2, 2.0));
    tick(&mut c, 0);
    c.inputs.tau_a_measured = f64::NAN;
    let step = Step::at(0.002, 0.002);
    let failure = c.step(step, &mut Log::silent()).expect_err("no number");
    assert!(
        failure.0.ends_with("and tau_a_measured = NaN N"),
        "{failure}"
    );
    // In torque form nobody looks at it.
    let mut c = initialized(|c| c.inputs.tau_a_measured = f64::NAN);
    tick(&mut c, 0);
}
