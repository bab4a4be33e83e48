//! The controller's kinematics, dp = J(q) dq of sec:task_space_control, against facts, finite differences and another decomposition.
#![allow(non_snake_case, reason = "the paper's symbols")]

use arm_law::kinematics::{Kinematics, Pose};
use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;
use std::f64::consts::FRAC_PI_2;

const START: [f64; 3] = [0.0, -1.48096, 1.70138];

fn arm() -> Kinematics {
    Kinematics::default()
}

/// An arm whose handle does not lie on link 3's axis, so that every term counts.
fn crooked() -> Kinematics {
    Kinematics {
        A1: 0.11,
        L1: 0.29,
        handle_x: 0.33,
        handle_z: -0.07,
    }
}

fn at(kinematics: Kinematics, q: [f64; 3]) -> Pose {
    kinematics.at(&q.into())
}

#[test]
fn at_the_start_pose_the_handle_is_where_the_specification_says() {
    let p = at(arm(), START).p;
    // The pose is given with five decimals, which is 5e-6 rad over 0.4 m.
    assert!((p - Vector3::new(0.44, 0.0, -0.24)).amax() < 5e-6, "{p}");
}

#[test]
fn positive_pitch_lifts_and_positive_yaw_turns_to_the_left() {
    let level = at(arm(), [0.0; 3]).p;
    assert_eq!(level, Vector3::new(0.06 + 0.32 + 0.36, 0.0, 0.0));
    assert!(at(arm(), [0.0, 0.1, 0.0]).p.z > 0.0);
    assert!(at(arm(), [0.0, 0.0, 0.1]).p.z > 0.0);
    assert!(at(arm(), [0.1, 0.0, 0.0]).p.y > 0.0);
    let left = at(arm(), [FRAC_PI_2, 0.0, 0.0]).p;
    assert!((left - Vector3::new(0.0, 0.74, 0.0)).amax() < 1e-16); // rounding of π/2
}

fn poses() -> impl Strategy<Value = (Kinematics, [f64; 3])> {
    let angle = -3.2..3.2_f64;
    (
        prop_oneof![Just(arm()), Just(crooked())],
        [angle.clone(), angle.clone(), angle],
    )
}

proptest! {
    #[test]
    fn J_is_the_derivative_of_p((kinematics, q) in poses()) {
        let J = at(kinematics, q).J;
        let h = 1e-5;
        for i in 0..3 {
            let p = |h: f64| {
                let mut q = q;
                q[i] += h;
                at(kinematics, q).p
            };
            let difference = (p(h) - p(-h)) / (2.0 * h);
            // h²/6 times a third derivative of at most 0.8 m, and 1e-16 m of rounding over 2h.
            prop_assert!((difference - J.column(i)).amax() < 4e-11, "column {i}: {difference} {J}");
        }
    }

    #[test]
    fn sigma_min_is_the_smallest_singular_value((kinematics, q) in poses()) {
        let Pose { J, sigma_min, .. } = at(kinematics, q);
        let expected = J.singular_values().min();
        prop_assert!((sigma_min - expected).abs() < 1e-14, "{sigma_min} {expected}"); // of a J of norm 1
    }

    #[test]
    fn R_is_link_3s_frame((kinematics, q) in poses()) {
        let pose = at(kinematics, q);
        let (p, R) = (pose.p, pose.R());
        prop_assert!((R.transpose() * R - Matrix3::identity()).amax() < 1e-15);
        prop_assert!((R.determinant() - 1.0).abs() < 1e-15);
        // From the elbow, which no elbow angle moves, to the handle.
        let elbow = Kinematics { handle_x: 0.0, handle_z: 0.0, ..kinematics };
        let h = Vector3::new(kinematics.handle_x, 0.0, kinematics.handle_z);
        prop_assert!((at(elbow, q).p + R * h - p).amax() < 1e-15);
    }
}

#[test]
fn sigma_min_vanishes_with_a_straight_arm_and_with_the_handle_on_the_yaw_axis() {
    assert_eq!(at(arm(), [0.3, -0.7, 0.0]).sigma_min, 0.0);
    let near = at(arm(), [0.3, -0.7, 1e-9]).sigma_min;
    // |det|/σ_max: the pitch block is nearly [r₁ r₂] along one direction, σ_max = √((L1 + L2)² + L2²).
    let expected = 0.32 * 0.36 * 1e-9 / f64::hypot(0.68, 0.36);
    assert!((near / expected - 1.0).abs() < 1e-8, "{near}"); // the next order is q₃² and q₃
    // Elbow at right angles, shoulder such that A1 + x = 0.
    let beta = (0.06_f64 / 0.36).asin() + FRAC_PI_2;
    let overhead = Kinematics {
        A1: 0.06,
        L1: 0.32,
        handle_x: 0.36,
        handle_z: 0.0,
    };
    let pose = at(overhead, [0.5, FRAC_PI_2, beta - FRAC_PI_2]);
    assert!(pose.sigma_min < 1e-16, "{}", pose.sigma_min);
}
