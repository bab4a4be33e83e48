//! Why K is one number in joint space: with a diagonal K that is not a multiple of I, a free robot can be unstable.
//!
//! Two ordinary arms with the elbow stretched, their pitch joints, linearised at rest, no friction, no environment:
//!
//! ```text
//! de = v_n − dq,   M_n dv_n = −D_n v_n − y,   M ddq = K y,   y = de + K_P e          (alpha = 1)
//! ```
//!
//! Without D_n, dde = −B y with B = M_n⁻¹ + M⁻¹K, so that det(s² + s B + K_P B) = 0. Its value at s = 0 is K_P² det B and it
//! grows without bound: for det B < 0 it has a positive real root. M_n⁻¹ and M⁻¹ are positive definite, but M⁻¹K is not
//! symmetric, and the determinant of the sum can be negative. For K = k·I the sum is positive definite, for every k.
#![allow(non_snake_case, reason = "the paper's symbols")]

use arm_law::kinematics::Kinematics;
use arm_law::nominal::{Link, NominalArm};
use nalgebra::{Matrix2, Matrix6, Vector2, Vector3};

const K_P: f64 = 20.0;

/// The pitch block of M of an arm whose link 3 has the mass `m` (kg) at `x` (m), the elbow stretched.
fn pitch_block(m: f64, x: f64) -> Matrix2<f64> {
    let link = |m, x| Link {
        m,
        x,
        z: 0.0,
        I_xx: 0.001,
        I_yy: 0.001,
        I_zz: 0.001,
        I_xz: 0.0,
    };
    let arm = NominalArm {
        links: [link(0.5, 0.0), link(0.5, 0.1), link(m, x)],
        rotor: [0.01; 3],
    };
    arm.check().unwrap();
    let M = arm.at(&Kinematics::default(), &Vector3::zeros()).M;
    M.fixed_view::<2, 2>(1, 1).into_owned()
}

/// Nominal: 2.5 kg near the hand. Robot: 20 kg near the elbow.
fn arms() -> (Matrix2<f64>, Matrix2<f64>) {
    (pitch_block(2.5, 0.38), pitch_block(20.0, 0.06))
}

/// B = M_n⁻¹ + M⁻¹K.
fn B(K: Matrix2<f64>) -> Matrix2<f64> {
    let (M_n, M) = arms();
    M_n.try_inverse().unwrap() + M.try_inverse().unwrap() * K
}

/// Largest real part of the eigenvalues of the free robot, 1/s, with nominal damping `D_n` (N·m·s/rad).
fn growth(K: Matrix2<f64>, D_n: f64) -> f64 {
    let (M_n, M) = arms();
    let (M_n, M) = (M_n.try_inverse().unwrap(), M.try_inverse().unwrap());
    let I = Matrix2::identity();
    let mut A = Matrix6::zeros(); // of (e, v_n, dq)
    let mut set = |i: usize, j: usize, block: Matrix2<f64>| {
        A.fixed_view_mut::<2, 2>(2 * i, 2 * j).copy_from(&block);
    };
    set(0, 1, I);
    set(0, 2, -I);
    set(1, 0, M_n * -K_P);
    set(1, 1, M_n * -(1.0 + D_n));
    set(1, 2, M_n);
    set(2, 0, M * K * K_P);
    set(2, 1, M * K);
    set(2, 2, -M * K);
    let eigenvalues = A.complex_eigenvalues();
    eigenvalues.iter().map(|s| s.re).fold(f64::MIN, f64::max)
}

const LARGE: f64 = 400.0;
const SMALL: f64 = 0.5;

#[test]
fn with_unequal_gains_a_free_robot_is_unstable() {
    let K = Matrix2::from_diagonal(&Vector2::new(LARGE, SMALL));
    let det = B(K).determinant();
    assert!(det < -1e4, "{det}");
    // The slower of the two equations' roots with the negative eigenvalue λ of B: s² + λ s + K_P λ = 0.
    let trace = B(K).trace();
    let lambda = 0.5 * (trace - (trace * trace - 4.0 * det).sqrt());
    let s = 0.5 * (-lambda + (lambda * lambda - 4.0 * K_P * lambda).sqrt());
    let found = growth(K, 0.0);
    assert!((found - s).abs() < 1e-6 * s, "{found} {s}"); // eigenvalues of a matrix of norm 1e6
    assert!(
        growth(K, 0.2) > 50.0,
        "damping of the nominal does not save it"
    );
}

#[test]
fn with_either_of_these_gains_for_all_joints_it_is_not() {
    for k in [SMALL, 5.0, 50.0, LARGE] {
        let K = Matrix2::identity() * k;
        assert!(B(K).determinant() > 0.0);
        // A free robot keeps the momentum that it has: eigenvalues at 0, to 1e-16 of a norm of 1e6.
        assert!(growth(K, 0.0) < 1e-7, "{}", growth(K, 0.0));
        assert!(growth(K, 0.2) < 1e-7);
    }
}
