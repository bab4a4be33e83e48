//! The law in joint space, as a choice of the interface.

use crate::robot::{Robot, close_the_loop};
use crate::{ArmController, controller, initialized, tick};
use arm_law::nominal::NominalArm;
use fmu_export::{Log, Model};
use nalgebra::{Matrix3, Vector3};

const JOINT: i32 = 2;

type Change = fn(&mut ArmController);

fn refused(change: fn(&mut ArmController)) -> String {
    controller(change)
        .initialize(0.0, &mut Log::silent())
        .expect_err("impossible parameters")
        .0
}

#[test]
fn refusals_name_the_variable_in_either_space() {
    let positive = "expected a finite value, at least 1e-6";
    let cases: [(Change, String); 8] = [
        (
            |c| c.parameters.space = 3,
            "space = 3: expected 1 (task), 2 (joint)".into(),
        ),
        (
            |c| c.parameters.joint.K = 0.0,
            format!("joint.K = 0: {positive}"),
        ),
        (
            |c| c.parameters.joint.K_P[1] = -1.0,
            format!("joint.K_P[2] = -1: {positive}"),
        ),
        (
            |c| c.parameters.joint.D_n[2] = -1.0,
            "joint.D_n[3] = -1: expected a finite value not less than 0".into(),
        ),
        (
            |c| c.parameters.nominal.rotor[0] = 0.0,
            format!("nominal.rotor[1] = 0: {positive}"),
        ),
        (
            |c| c.parameters.nominal.links[1].I_xz = 1.0,
            "nominal.I_xz[2] = 1: expected at most sqrt(I_xx I_zz) in absolute value".into(),
        ),
        (
            |c| c.parameters.joint.dq_n_max[1] = -1.0,
            "joint.dq_n_max[2] = -1: expected a finite value not less than 0".into(),
        ),
        (
            |c| {
                c.parameters.joint.q_n_box = 1;
                c.parameters.joint.q_n_max[0] = -2.0;
            },
            "joint.q_n_max[1] = -2: expected a value greater than the least one".into(),
        ),
    ];
    for (change, expected) in cases {
        assert_eq!(refused(change), expected);
        if !expected.starts_with("space") {
            let mut joint = controller(change);
            joint.parameters.space = JOINT;
            assert_eq!(
                joint.initialize(0.0, &mut Log::silent()).unwrap_err().0,
                expected
            );
        }
    }
}

#[test]
fn every_number_of_the_nominal_arm_arrives_in_M_n() {
    let arm = |c: &ArmController| Matrix3::from_row_slice(&c.outputs.M_n);
    let start = arm(&initialized(|c| c.parameters.space = JOINT));
    let kinematics = ArmController::default().parameters.kinematics;
    let q = Vector3::from(ArmController::default().inputs.q);
    assert_eq!(start, NominalArm::default().at(&kinematics, &q).M);

    let changes: [fn(&mut ArmController, usize); 8] = [
        |c, i| c.parameters.nominal.links[i].m *= 2.0,
        |c, i| c.parameters.nominal.links[i].x += 0.1,
        |c, i| c.parameters.nominal.links[i].z += 0.1,
        |c, i| c.parameters.nominal.links[i].I_xx += 0.1,
        |c, i| c.parameters.nominal.links[i].I_yy += 0.1,
        |c, i| c.parameters.nominal.links[i].I_zz += 0.1,
        |c, i| c.parameters.nominal.links[i].I_xz += 1e-3,
        |c, i| c.parameters.nominal.rotor[i] += 0.1,
    ];
    // Link 1 only turns about the vertical axis: what lies along it does not count.
    let counts = |number: usize, i: usize| i > 0 || [0, 1, 5, 7].contains(&number);
    for (number, change) in changes.into_iter().enumerate() {
        for i in 0..3 {
            let changed = arm(&initialized(|c| {
                c.parameters.space = JOINT;
                change(c, i);
            }));
            assert_eq!(changed != start, counts(number, i), "{number} of link {i}");
        }
    }
}

#[test]
fn in_task_space_the_joints_nominal_is_the_robot_itself() {
    let mut c = initialized(|c| c.inputs.f_h = [3.0, 2.0, 5.0]);
    (0..50).for_each(|k| tick(&mut c, k));
    assert_eq!(
        (c.outputs.q_n, c.outputs.dq_n, c.outputs.e_q, c.outputs.M_n),
        (c.inputs.q, [0.0; 3], [0.0; 3], [0.0; 9])
    );
    assert!(c.outputs.e_nr[0] > 0.0);
}

/// A robot that is twenty times as heavy as the nominal arm follows it: the error halves when K doubles (thm:pm).
#[test]
fn a_heavy_robot_follows_and_its_error_halves_when_K_doubles() {
    let largest_error = |K: f64| {
        let mut c = initialized(|c| {
            c.parameters.space = JOINT;
            c.parameters.joint.K = K;
        });
        let mut robot = Robot::at_the_start();
        let mut largest = 0.0_f64;
        for k in 0..6000 {
            let t = 1e-3 * f64::from(k);
            let f_h = [0.0, 0.0, 6.0 * (2.5 * t).sin()];
            close_the_loop(&mut c, &mut robot, k, f_h);
            if t > 3.0 {
                largest = c
                    .outputs
                    .e_q
                    .iter()
                    .fold(largest, |most, e| most.max(e.abs()));
            }
        }
        assert!(c.outputs.tank >= 10.0 - 1e-9, "{}", c.outputs.tank); // rounding of its sums
        largest
    };
    let errors = [100.0, 200.0, 400.0].map(largest_error);
    for pair in errors.windows(2) {
        assert!((1.85..2.15).contains(&(pair[0] / pair[1])), "{errors:?}");
    }
}

/// In task space an arm that is pulled straight is slowed; in joint space there is nothing to slow down for.
#[test]
fn a_singularity_does_not_slow_the_joints() {
    for (space, slowed) in [(1, true), (JOINT, false)] {
        let mut c = initialized(|c| {
            c.parameters.space = space;
            c.inputs.q = [0.0, -0.3, 0.1];
            c.inputs.f_h = [5.0, 0.0, 5.0];
        });
        (0..5).for_each(|k| tick(&mut c, k));
        assert!(c.outputs.sigma_min < c.parameters.singularity.sigma_slow);
        assert_eq!(c.outputs.slowed != 0, slowed);
        assert!(Vector3::from(c.outputs.tau_a).norm() > 0.0);
    }
}
