//! What cannot be, and how it is said.

use crate::{ArmController, controller, initialized};
use fmu_export::{Log, Model, Step};

type Change = fn(&mut ArmController);

const LAWS: &str = "expected 1 (standard), 2 (passive), 3 (passive_applied), 4 (passive_bounded)";

fn refused(change: Change) -> String {
    controller(change)
        .initialize(0.0, &mut Log::silent())
        .expect_err("impossible parameters")
        .0
}

#[test]
fn refusals_name_the_variable_the_value_and_the_range() {
    let positive = "expected a finite value, at least 1e-6";
    let not_negative = "expected a finite value not less than 0";
    let cases: [(Change, String); 28] = [
        (
            |c| c.parameters.law = 5, // natural: a comparator, for one axis
            format!("law = 5: {LAWS}"),
        ),
        (
            |c| c.parameters.law = 6, // sliding_mode: likewise
            format!("law = 6: {LAWS}"),
        ),
        (|c| c.parameters.law = 0, format!("law = 0: {LAWS}")),
        (
            |c| c.parameters.delay = 2,
            "delay = 2: expected 0 or 1".into(),
        ),
        (|c| c.parameters.T = 0.0, format!("T = 0: {positive}")),
        (
            |c| c.parameters.alpha = -1.0,
            format!("alpha = -1: {not_negative}"),
        ),
        (
            |c| c.parameters.dp_cutoff = -1.0,
            format!("dp_cutoff = -1: {not_negative}"),
        ),
        (
            |c| c.parameters.E_0 = -1.0,
            format!("energy.E_0 = -1: {not_negative}"),
        ),
        (
            |c| c.parameters.dq_max[1] = 0.0,
            format!("dq_max[2] = 0: {positive}"),
        ),
        (
            |c| c.parameters.ddq_max[0] = f64::NAN,
            format!("ddq_max[1] = NaN: {positive}"),
        ),
        (
            |c| c.parameters.Lambda_n[1] = 0.0,
            format!("Lambda_n[2] = 0: {positive}"),
        ),
        (
            |c| c.parameters.D_n[0] = -0.5,
            format!("D_n[1] = -0.5: {not_negative}"),
        ),
        (
            |c| c.parameters.K[2] = f64::INFINITY,
            format!("K[3] = inf: {positive}"),
        ),
        (
            |c| c.parameters.K_P[0] = f64::NAN,
            format!("K_P[1] = NaN: {positive}"),
        ),
        (
            |c| c.parameters.f_max[1] = -400.0,
            format!("f_max[2] = -400: {positive}"),
        ),
        (
            |c| (c.parameters.law, c.parameters.f_max[2]) = (1, f64::NAN),
            format!("f_max[3] = NaN: {positive}"),
        ),
        (
            |c| c.parameters.tau_max[2] = 0.0,
            format!("tau_max[3] = 0: {positive}"),
        ),
        (
            |c| c.parameters.tau_max[0] = f64::NAN,
            format!("tau_max[1] = NaN: {positive}"),
        ),
        (
            |c| c.parameters.torque_limiting = 3,
            "torque_limiting = 3: expected 1 (scale), 2 (clip)".into(),
        ),
        (
            |c| c.parameters.ft.frame = 0,
            "ft.frame = 0: expected 1 (base), 2 (sensor)".into(),
        ),
        (
            |c| c.parameters.kinematics.A1 = -0.1,
            format!("kinematics.A1 = -0.1: {not_negative}"),
        ),
        (
            |c| c.parameters.kinematics.L1 = 0.0,
            format!("kinematics.L1 = 0: {positive}"),
        ),
        (
            |c| c.parameters.kinematics.handle_x = -0.36,
            format!("kinematics.handle_x = -0.36: {positive}"),
        ),
        (
            |c| c.parameters.kinematics.handle_z = f64::NAN,
            "kinematics.handle_z = NaN: expected a finite value".into(),
        ),
        (
            |c| c.parameters.singularity.sigma_slow = -0.1,
            format!("singularity.sigma_slow = -0.1: {not_negative}"),
        ),
        (
            |c| c.parameters.workspace.q_max[2] = 0.5,
            "workspace.q_max[3] = 0.5: expected a value greater than workspace.q_min".into(),
        ),
        (
            |c| c.parameters.workspace.slowing_time = 0.0009,
            "workspace.slowing_time = 0.0009: expected a value of at least T".into(),
        ),
        (
            |c| c.parameters.workspace.radius_min = -0.1,
            format!("workspace.radius_min = -0.1: {not_negative}"),
        ),
    ];
    for (change, expected) in cases {
        assert_eq!(refused(change), expected);
    }
}

#[test]
fn clipping_is_refused_where_the_nominal_feels_what_the_robot_gets() {
    let clipped: [Change; 2] = [
        |c| (c.parameters.law, c.parameters.torque_limiting) = (3, 2),
        |c| (c.parameters.law, c.parameters.torque_limiting) = (4, 2),
    ];
    for change in clipped {
        assert_eq!(
            refused(change),
            "torque_limiting = 2: expected 1 (scale) under the laws passive_applied and passive_bounded: \
             their nominal feels one share of the force"
        );
    }
    for law in [1, 2] {
        initialized(|c| (c.parameters.law, c.parameters.torque_limiting) = (law, 2));
    }
}

#[test]
fn a_step_before_initialization_is_refused() {
    let step = Step::at(0.0, 0.001);
    let refusal = controller(|_| ())
        .step(step, &mut Log::silent())
        .expect_err("not initialized");
    assert_eq!(refusal.0, "a step before initialization");
}

/// Neither a force nor a pose beyond arithmetic reaches the robot, clipped or scaled.
#[test]
fn a_result_that_is_not_finite_fails_the_step() {
    let cases: [Change; 4] = [
        |c| (c.parameters.law, c.parameters.K, c.inputs.f_h) = (1, [1e300; 3], [1e300; 3]),
        |c| {
            (
                c.parameters.law,
                c.parameters.K,
                c.inputs.f_h,
                c.parameters.torque_limiting,
            ) = (2, [1e300; 3], [1e300; 3], 2)
        },
        |c| c.inputs.q = [f64::NAN, 0.0, 0.0],
        |c| (c.inputs.q[1], c.inputs.engage) = (f64::INFINITY, 0),
    ];
    for (i, change) in cases.into_iter().enumerate() {
        // Gains before the start, the position after it: a start that is not finite is refused (see below).
        let mut c = initialized(|c| {
            change(c);
            c.inputs.q = ArmController::default().inputs.q;
        });
        let at_rest = c.outputs.tau_a;
        let changed = controller(change);
        (c.inputs.q, c.inputs.engage) = (changed.inputs.q, changed.inputs.engage);
        let step = Step::at(0.0, 0.02);
        c.inputs.q[2] += 1.0;
        let failure = c.step(step, &mut Log::silent()).expect_err("not finite");
        assert!(
            failure.0.starts_with("tick ")
                && failure.0.contains("is not finite with q = [")
                && failure.0.contains("rad and f_h = ["),
            "case {i}: {failure}"
        );
        assert_eq!((c.outputs.tau_a, at_rest), ([0.0; 3], [0.0; 3]), "case {i}");
    }
    let refusal = refused(|c| c.inputs.q[0] = f64::NAN);
    assert!(
        refusal.starts_with("the start: the law's result is not finite with q = [NaN"),
        "{refusal}"
    );
}
