//! The nominal arm, M_n(q) and C_n(q, dq) of eq:obs_dyn, against Jacobians of its links, finite
//! differences, and the motion of a free body.
#![allow(non_snake_case, reason = "the paper's symbols")]

use arm_law::ParameterError;
use arm_law::kinematics::Kinematics;
use arm_law::nominal::transport::transported;
use arm_law::nominal::{Link, NominalArm, RigidBody};
use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;

/// An arm of which every number counts, and is positive definite without its rotors as well.
fn arms() -> impl Strategy<Value = NominalArm> {
    let link = (
        0.1..5.0,
        (-0.1..0.4, -0.1..0.1),
        (0.001..0.05, 0.001..0.05, 0.001..0.05),
        -0.9..0.9,
    )
        .prop_map(
            |(m, (x, z), (I_xx, I_yy, I_zz), share): (f64, _, (f64, f64, f64), f64)| Link {
                m,
                x,
                z,
                I_xx,
                I_yy,
                I_zz,
                I_xz: share * (I_xx * I_zz).sqrt(),
            },
        );
    (
        [link.clone(), link.clone(), link],
        [0.01..1.0, 0.01..1.0, 0.01..1.0_f64],
    )
        .prop_map(|(links, rotor)| NominalArm { links, rotor })
}

fn vectors(most: f64) -> impl Strategy<Value = Vector3<f64>> {
    [-most..most, -most..most, -most..most].prop_map(Vector3::from)
}

fn geometry() -> Kinematics {
    Kinematics::default()
}

fn at(arm: &NominalArm, q: &Vector3<f64>) -> RigidBody {
    arm.at(&geometry(), q)
}

/// M_n from the velocities of the links' centres of mass and the links' angular velocities: Σ m J_cᵀ J_c + J_ωᵀ R I Rᵀ J_ω.
fn from_jacobians(arm: &NominalArm, q: &Vector3<f64>) -> Matrix3<f64> {
    let Kinematics { A1, L1, .. } = geometry();
    let yaw = Rotation3::from_axis_angle(&Vector3::z_axis(), q[0]);
    let pitched = |angle: f64| yaw * Rotation3::from_axis_angle(&Vector3::y_axis(), -angle);
    let frames = [yaw, pitched(q[1]), pitched(q[1] + q[2])];
    let shoulder = yaw * Vector3::new(A1, 0.0, 0.0);
    let elbow = shoulder + frames[1] * Vector3::new(L1, 0.0, 0.0);
    let origins = [Vector3::zeros(), shoulder, elbow];
    let pitch_axis = yaw * Vector3::new(0.0, -1.0, 0.0);
    let axes = [Vector3::z(), pitch_axis, pitch_axis];

    let mut M = Matrix3::from_diagonal(&arm.rotor.into());
    for (i, link) in arm.links.iter().enumerate() {
        let centre = origins[i] + frames[i] * Vector3::new(link.x, 0.0, link.z);
        let (mut J_c, mut J_w) = (Matrix3::zeros(), Matrix3::zeros());
        for joint in 0..=i {
            J_c.set_column(joint, &axes[joint].cross(&(centre - origins[joint])));
            J_w.set_column(joint, &axes[joint]);
        }
        #[rustfmt::skip]
        let I = Matrix3::new(
            link.I_xx, 0.0,       link.I_xz,
            0.0,       link.I_yy, 0.0,
            link.I_xz, 0.0,       link.I_zz,
        );
        let R = frames[i].matrix();
        M += J_c.tr_mul(&J_c) * link.m + J_w.tr_mul(&(R * I * R.transpose() * J_w));
    }
    M
}

/// C_ij = Σ_k ½ (∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i) dq_k by central differences.
fn christoffel(arm: &NominalArm, q: &Vector3<f64>, dq: &Vector3<f64>) -> Matrix3<f64> {
    let h = 1e-5;
    let slope = [0, 1, 2].map(|k| {
        let step = Vector3::ith(k, h);
        (at(arm, &(q + step)).M - at(arm, &(q - step)).M) / (2.0 * h)
    });
    Matrix3::from_fn(|i, j| {
        (0..3)
            .map(|k| 0.5 * (slope[k][(i, j)] + slope[j][(i, k)] - slope[i][(j, k)]) * dq[k])
            .sum()
    })
}

proptest! {
    #[test]
    fn M_is_the_sum_over_the_links_Jacobians(arm in arms(), q in vectors(3.2)) {
        let (found, expected) = (at(&arm, &q).M, from_jacobians(&arm, &q));
        // Some fifty roundings of numbers of the size of M.
        prop_assert!((found - expected).amax() < 1e-14 * expected.amax(), "{found}{expected}");
    }

    #[test]
    fn M_is_symmetric_and_at_least_the_rotors(arm in arms(), q in vectors(3.2)) {
        let M = at(&arm, &q).M;
        prop_assert_eq!(M, M.transpose());
        let least = (M - Matrix3::from_diagonal(&arm.rotor.into())).symmetric_eigenvalues().min();
        prop_assert!(least > -1e-14 * M.amax(), "{least}"); // rounding of the eigenvalues
    }

    #[test]
    fn C_is_that_of_the_Christoffel_symbols(arm in arms(), q in vectors(3.2), dq in vectors(5.0)) {
        let (found, expected) = (at(&arm, &q).C(&dq), christoffel(&arm, &q, &dq));
        // h²/6 times a third derivative of the size of 8 M, and 1e-16 M of rounding over 2h; both times dq.
        let scale = at(&arm, &q).M.amax() * dq.amax();
        prop_assert!((found - expected).amax() < 1e-9 * scale, "{found}{expected}");
    }

    /// dM_n/dt − 2 C_n is skew-symmetric, dM_n/dt being a difference quotient and not the model's own.
    #[test]
    fn the_rate_of_M_less_twice_C_is_skew(arm in arms(), q in vectors(3.2), dq in vectors(5.0)) {
        let (h, body) = (1e-6, at(&arm, &q));
        let rate = (at(&arm, &(q + dq * h)).M - at(&arm, &(q - dq * h)).M) / (2.0 * h);
        let N = rate - body.C(&dq) * 2.0;
        let scale = body.M.amax() * dq.amax();
        // (h |dq|)²/6 of a third derivative of 8 M, and 1e-16 M of rounding over 2h.
        prop_assert!((N + N.transpose()).amax() < 2e-9 * scale, "{N}");
        prop_assert!((rate - body.half_rate(&dq) * 2.0).amax() < 2e-9 * scale);
        prop_assert_eq!(body.S(&dq), -body.S(&dq).transpose());
    }

    /// The torsion-free property, on which the meaning of [`transported`] rests: C_n(q, u) v = C_n(q, v) u.
    #[test]
    fn C_is_symmetric_in_its_two_velocities(arm in arms(), q in vectors(3.2), u in vectors(5.0), v in vectors(5.0)) {
        let body = at(&arm, &q);
        let difference = body.C(&u) * v - body.C(&v) * u;
        prop_assert!(difference.amax() < 1e-13 * body.M.amax() * u.amax() * v.amax()); // rounding of six products
    }

    /// For any two poses, however far apart.
    #[test]
    fn transport_keeps_the_kinetic_energy(arm in arms(), from in vectors(3.2), to in vectors(3.2), v in vectors(5.0)) {
        let (before, now) = (at(&arm, &from), at(&arm, &to));
        let carried = transported(&before, &now, &(to - from), &v);
        let energy = before.kinetic(&v);
        prop_assert!((now.kinetic(&carried) - energy).abs() < 1e-14 * energy); // a square root and its square
    }

    #[test]
    fn transport_to_the_same_pose_changes_nothing(arm in arms(), q in vectors(3.2), v in vectors(5.0)) {
        let body = at(&arm, &q);
        let carried = transported(&body, &body, &Vector3::zeros(), &v);
        prop_assert!((carried - v).amax() < 1e-13 * v.amax()); // one solution with a well-conditioned matrix
    }
}

/// A free body: M ddq + C(q, dq) dq = 0 from q, dq over `t` in `n` steps of RK4. All (q, dq) on the way.
fn free_motion(
    arm: &NominalArm,
    start: (Vector3<f64>, Vector3<f64>),
    t: f64,
    n: usize,
) -> Vec<(Vector3<f64>, Vector3<f64>)> {
    let f = |(q, dq): (Vector3<f64>, Vector3<f64>)| {
        let body = at(arm, &q);
        (dq, -body.M.lu().solve(&(body.C(&dq) * dq)).unwrap())
    };
    let h = t / n as f64;
    let mut way = vec![start];
    let (mut q, mut dq) = start;
    for _ in 0..n {
        let k1 = f((q, dq));
        let k2 = f((q + k1.0 * (h / 2.0), dq + k1.1 * (h / 2.0)));
        let k3 = f((q + k2.0 * (h / 2.0), dq + k2.1 * (h / 2.0)));
        let k4 = f((q + k3.0 * h, dq + k3.1 * h));
        q += (k1.0 + k2.0 * 2.0 + k3.0 * 2.0 + k4.0) * (h / 6.0);
        dq += (k1.1 + k2.1 * 2.0 + k3.1 * 2.0 + k4.1) * (h / 6.0);
        way.push((q, dq));
    }
    way
}

/// A free body carries its own velocity: transported along its motion, dq(0) becomes dq(t). The error is of second order.
#[test]
fn a_free_bodys_velocity_is_transported_along_its_motion() {
    let arm = NominalArm {
        rotor: [0.02; 3],
        ..NominalArm::default()
    };
    let start = (
        Vector3::new(0.0, -1.48096, 1.70138),
        Vector3::new(2.0, -1.5, 3.0),
    );
    // The elbow turns about once within the time, and the rotors are light: C matters. RK4's error is below 1e-9.
    let way = free_motion(&arm, start, 2.0, 3200);
    let errors = [16, 8, 4].map(|every| {
        let mut v = start.1;
        for pair in way.iter().step_by(every).collect::<Vec<_>>().windows(2) {
            let (q, next) = (pair[0].0, pair[1].0);
            v = transported(&at(&arm, &q), &at(&arm, &next), &(next - q), &v);
        }
        (v - way.last().unwrap().1).amax()
    });
    assert!(
        (way.last().unwrap().1 - start.1).amax() > 1.0,
        "dq must have changed"
    );
    assert!(errors[0] < 1e-3, "{errors:?}");
    for pair in errors.windows(2) {
        assert!((3.9..4.1).contains(&(pair[0] / pair[1])), "{errors:?}");
    }
}

#[test]
fn at_the_start_pose_the_nominal_arm_is_as_its_documentation_says() {
    let M = at(
        &NominalArm::default(),
        &Vector3::new(0.0, -1.48096, 1.70138),
    )
    .M;
    #[rustfmt::skip]
    let expected = Matrix3::new(
        0.53, 0.0,  0.0,
        0.0,  0.68, 0.06,
        0.0,  0.06, 0.46,
    );
    assert!((M - expected).amax() < 0.006, "{M}"); // two decimals
}

#[test]
fn an_impossible_arm_is_refused_with_link_and_value() {
    let refused = |change: fn(&mut NominalArm)| {
        let mut arm = NominalArm::default();
        change(&mut arm);
        match arm.check() {
            Err(ParameterError::OutOfRange {
                name, axis, value, ..
            }) => (name, axis.unwrap(), value),
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(refused(|arm| arm.links[1].m = -1.0), ("nominal.m", 2, -1.0));
    assert_eq!(refused(|arm| arm.rotor[2] = 0.0), ("nominal.rotor", 3, 0.0));
    assert_eq!(
        refused(|arm| arm.links[0].x = f64::INFINITY),
        ("nominal.x", 1, f64::INFINITY)
    );
    assert_eq!(
        refused(|arm| arm.links[2].I_yy = -1e-3),
        ("nominal.I_yy", 3, -1e-3)
    );
    assert_eq!(
        refused(|arm| arm.links[2].I_xz = -0.006),
        ("nominal.I_xz", 3, -0.006)
    );
    assert!(NominalArm::default().check().is_ok());
}
