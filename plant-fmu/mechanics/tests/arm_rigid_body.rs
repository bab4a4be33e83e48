//! M, C, g (eq:real_dyn), positions and Jacobians against a derivation that knows nothing of the arm's plane:
//! three rigid bodies in space, M = Σ m Jᵥᵀ Jᵥ + J_ωᵀ R I Rᵀ J_ω, Christoffel symbols and gravity by central differences.

#![allow(
    non_snake_case,
    reason = "the symbols of mechanics with their capitals: M, C, J"
)]

use mechanics::arm::kinematics::{InPlane, Lengths, Pose};
use mechanics::arm::rigid_body::{Link, Masses, RigidBody};
use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;

#[derive(Clone, Copy, Debug)]
struct Case {
    lengths: Lengths,
    masses: Masses,
    payload: f64,
    q: Vector3<f64>,
    v: Vector3<f64>,
}

fn vector(range: std::ops::Range<f64>) -> impl Strategy<Value = Vector3<f64>> {
    [range.clone(), range.clone(), range].prop_map(Vector3::from)
}

fn point() -> impl Strategy<Value = InPlane> {
    (0.01..0.6, -0.3..0.3).prop_map(|(x, z)| InPlane { x, z })
}

fn link() -> impl Strategy<Value = Link> {
    (
        0.1..6.0,
        -0.4..0.4,
        -0.2..0.2,
        [1e-3..0.05, 1e-3..0.05, 1e-3..0.05],
        -1e-3..1e-3,
    )
        .prop_map(|(m, x, z, [I_xx, I_yy, I_zz], I_xz)| Link {
            m,
            x,
            z,
            I_xx,
            I_yy,
            I_zz,
            I_xz,
        })
}

prop_compose! {
    fn cases()(
        A_1 in 0.0..0.2, L_1 in 0.1..0.6, handle in point(), pad in point(), links in [link(), link(), link()],
        rotor in vector(0.0..1e-4), gear in vector(1.0..600.0), gravity in vector(-10.0..10.0),
        payload in prop_oneof![Just(0.0), 0.1..30.0], q in vector(-3.0..3.0), v in vector(-3.0..3.0),
    ) -> Case {
        Case {
            lengths: Lengths { A_1, L_1, handle_x: handle.x, handle_z: handle.z, pad_x: pad.x, pad_z: pad.z },
            masses: Masses { links, rotor: rotor.into(), gear: gear.into(), gravity: gravity.into() },
            payload, q, v,
        }
    }
}

/// Rotation of each link, origin of each joint.
fn frames(lengths: &Lengths, q: &Vector3<f64>) -> [(Rotation3<f64>, Vector3<f64>); 3] {
    let yaw = Rotation3::from_axis_angle(&Vector3::z_axis(), q[0]);
    let pitch = |angle| Rotation3::from_axis_angle(&-Vector3::y_axis(), angle);
    let shoulder = yaw * Vector3::new(lengths.A_1, 0.0, 0.0);
    let upper = yaw * pitch(q[1]);
    let elbow = shoulder + upper * Vector3::new(lengths.L_1, 0.0, 0.0);
    [
        (yaw, Vector3::zeros()),
        (upper, shoulder),
        (upper * pitch(q[2]), elbow),
    ]
}

/// Position of a point of link `i`, and how it and the link move: J_v = axis × lever, J_ω = axis of every joint before it.
fn moving(
    lengths: &Lengths,
    q: &Vector3<f64>,
    i: usize,
    point: InPlane,
) -> (Vector3<f64>, Matrix3<f64>, Matrix3<f64>) {
    let frames = frames(lengths, q);
    let p = frames[i].1 + frames[i].0 * Vector3::new(point.x, 0.0, point.z);
    let (mut J_v, mut J_w) = (Matrix3::zeros(), Matrix3::zeros());
    for joint in 0..=i {
        let axis = if joint == 0 {
            Vector3::z()
        } else {
            frames[0].0 * -Vector3::y()
        };
        J_v.set_column(joint, &axis.cross(&(p - frames[joint].1)));
        J_w.set_column(joint, &axis);
    }
    (p, J_v, J_w)
}

fn bodies(case: &Case) -> [(usize, Link); 4] {
    let [one, two, three] = case.masses.links;
    let InPlane { x, z } = case.lengths.pad();
    let held = Link {
        m: case.payload,
        x,
        z,
        I_xx: 0.0,
        I_yy: 0.0,
        I_zz: 0.0,
        I_xz: 0.0,
    };
    [(0, one), (1, two), (2, three), (2, held)]
}

fn mass_matrix(case: &Case, q: &Vector3<f64>) -> Matrix3<f64> {
    let mut M = Matrix3::zeros();
    for i in 0..3 {
        M[(i, i)] = case.masses.rotor[i] * case.masses.gear[i].powi(2);
    }
    for (i, link) in bodies(case) {
        let (_, J_v, J_w) = moving(&case.lengths, q, i, link.centre());
        let R = *frames(&case.lengths, q)[i].0.matrix();
        let Link {
            I_xx,
            I_yy,
            I_zz,
            I_xz,
            ..
        } = link;
        let I = R * Matrix3::new(I_xx, 0.0, I_xz, 0.0, I_yy, 0.0, I_xz, 0.0, I_zz) * R.transpose();
        M += J_v.transpose() * J_v * link.m + J_w.transpose() * I * J_w;
    }
    M
}

/// What the elements of M are made of, before they cancel (kg·m²): every mass a metre away.
fn size(case: &Case) -> f64 {
    let rotors: f64 = (0..3)
        .map(|i| case.masses.rotor[i] * case.masses.gear[i].powi(2))
        .sum();
    rotors + bodies(case).iter().map(|(_, link)| link.m).sum::<f64>()
}

fn potential(case: &Case, q: &Vector3<f64>) -> f64 {
    let gravity = Vector3::from(case.masses.gravity);
    bodies(case)
        .iter()
        .map(|(i, link)| -link.m * gravity.dot(&moving(&case.lengths, q, *i, link.centre()).0))
        .sum()
}

/// Central difference of `f` along joint `j`: error h²/6 f''' + ε f/h, about 1e-10 of f for h = 1e-5.
fn slope<T: std::ops::Sub<Output = T> + std::ops::Div<f64, Output = T>>(
    q: &Vector3<f64>,
    j: usize,
    f: impl Fn(&Vector3<f64>) -> T,
) -> T {
    let h = 1e-5;
    let step = Vector3::ith(j, h);
    (f(&(q + step)) - f(&(q - step))) / (2.0 * h)
}

fn body(case: &Case, q: &Vector3<f64>) -> RigidBody {
    RigidBody::at(&Pose::at(q), &case.lengths, &case.masses, case.payload)
}

proptest! {
    #[test]
    fn mass_matrix_is_that_of_three_bodies_in_space(case in cases()) {
        let (closed, general) = (body(&case, &case.q).M, mass_matrix(&case, &case.q));
        // Some hundred roundings of the largest term.
        prop_assert!((closed - general).amax() <= 1e-14 * size(&case), "{closed}{general}");
        prop_assert_eq!(closed, closed.transpose());
    }

    #[test]
    fn coriolis_matrix_is_that_of_the_christoffel_symbols(case in cases()) {
        let slopes = [0, 1, 2].map(|j| slope(&case.q, j, |q| mass_matrix(&case, q)));
        let C = Matrix3::from_fn(|i, j| {
            (0..3).map(|k| 0.5 * (slopes[k][(i, j)] + slopes[j][(i, k)] - slopes[i][(j, k)]) * case.v[k]).sum()
        });
        let closed = body(&case, &case.q).C(&case.v);
        // The difference quotient: 1e-10 of the size of M, times velocities of 5 rad/s and sums of nine terms.
        prop_assert!((closed - C).amax() <= 1e-8 * size(&case), "{closed}{C}");
    }

    #[test]
    fn change_of_M_minus_twice_C_is_skew(case in cases()) {
        // dM/dt along v, from the closed form itself; exact up to the difference quotient.
        let h = 1e-5;
        let rate = (body(&case, &(case.q + case.v * h)).M - body(&case, &(case.q - case.v * h)).M) / (2.0 * h);
        let N = rate - body(&case, &case.q).C(&case.v) * 2.0;
        // h² |v|³ M‴/6 = 5e-9 and ε M/h = 1e-10 of the size of M, for 5 rad/s.
        prop_assert!((N + N.transpose()).amax() <= 1e-8 * size(&case), "{N}");
    }

    #[test]
    fn gravity_is_the_gradient_of_the_potential_in_any_direction(case in cases()) {
        let closed = body(&case, &case.q);
        let gradient = Vector3::from_fn(|j, _| slope(&case.q, j, |q| potential(&case, q)));
        // The difference quotient: 1e-10 of the potential.
        let scale = 10.0 * size(&case);
        prop_assert!((closed.g - gradient).amax() <= 1e-8 * scale, "{} {gradient}", closed.g);
        prop_assert!((closed.potential - potential(&case, &case.q)).abs() <= 1e-14 * scale);
    }

    #[test]
    fn points_of_link_3_are_where_rotation_matrices_put_them(case in cases()) {
        let pose = Pose::at(&case.q);
        for point in [case.lengths.handle(), case.lengths.pad()] {
            let closed = pose.point(&case.lengths, point);
            let (p, J_v, _) = moving(&case.lengths, &case.q, 2, point);
            // Ten roundings of a metre.
            prop_assert!((closed.p - p).amax() < 2e-15 && (closed.J - J_v).amax() < 2e-15, "{closed:?}{p}{J_v}");
        }
    }

    #[test]
    fn turning_gravity_and_arm_about_the_yaw_axis_changes_nothing_in_the_joints(case in cases(), turn in -3.0..3.0) {
        let mut turned = case;
        turned.q[0] += turn;
        turned.masses.gravity = (Rotation3::from_axis_angle(&Vector3::z_axis(), turn) * Vector3::from(case.masses.gravity)).into();
        let (one, two) = (body(&case, &case.q), body(&turned, &turned.q));
        prop_assert_eq!(one.M, two.M);
        // Sines and cosines of two angles: a rounding each of some 100 N·m.
        prop_assert!((one.g - two.g).amax() < 1e-12 && (one.potential - two.potential).abs() < 1e-12);
    }
}

#[test]
fn the_default_arm_is_the_one_of_the_specification() {
    let mechanics::arm::Parameters {
        lengths, masses, ..
    } = Default::default();
    let q = Vector3::from(mechanics::arm::Start::default().q);
    let pose = Pose::at(&q);
    let body = RigidBody::at(&pose, &lengths, &masses, 0.0);
    let (handle, pad) = (
        pose.point(&lengths, lengths.handle()),
        pose.point(&lengths, lengths.pad()),
    );

    // Each figure to the digits that the specification gives; its start pose is rounded to 5e-6 rad.
    assert!(
        (handle.p - Vector3::new(0.44, 0.0, -0.24)).amax() < 5e-6,
        "{}",
        handle.p
    );
    assert!((pad.p.z + 0.35710).abs() < 5e-6, "{}", pad.p.z);
    assert!(
        body.g[0] == 0.0 && (body.g[1] - 6.1).abs() < 0.05 && (body.g[2] - 4.5).abs() < 0.05,
        "{}",
        body.g
    );
    let Lambda = (handle.J * body.M.try_inverse().unwrap() * handle.J.transpose())
        .try_inverse()
        .unwrap();
    assert!(
        (Lambda.diagonal() - Vector3::new(99.9, 14.3, 15.6)).amax() < 0.05,
        "{Lambda}"
    );
    // Reflected rotor inertia to four digits.
    let reflected = Vector3::from_fn(|i, _| masses.rotor[i] * masses.gear[i] * masses.gear[i]);
    assert!(
        (reflected - Vector3::new(2.506, 7.200, 2.506)).amax() < 5e-4,
        "{reflected}"
    );
}
