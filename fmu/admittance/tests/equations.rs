//! Three equations of the paper in matrix form, as they must read, at random states.
#![allow(non_snake_case, reason = "the paper's symbols")]

use nalgebra::{Matrix3, SMatrix, Vector3};
use proptest::prelude::*;

fn matrix() -> impl Strategy<Value = Matrix3<f64>> {
    prop::array::uniform9(-1.0..1.0).prop_map(|c| Matrix3::from_row_slice(&c))
}

/// Symmetric, eigenvalues from 1 up.
fn inertia() -> impl Strategy<Value = Matrix3<f64>> {
    matrix().prop_map(|A| A * A.transpose() + Matrix3::identity())
}

fn vector() -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-1.0..1.0).prop_map(Vector3::from)
}

fn positive_diagonal() -> impl Strategy<Value = Matrix3<f64>> {
    prop::array::uniform3(1.0..10.0).prop_map(|d| Matrix3::from_diagonal(&Vector3::from(d)))
}

proptest! {
    /// eq:dif_dyn with de_nr, e_nr from eq:real_dyn and eq:obs_dyn. The right-hand side as printed, tau_ed, lacks
    /// M K_P de + M M_n⁻¹(C_n + D_n)K_P e − alpha M M_n⁻¹ y.
    #[test]
    fn the_difference_dynamics_need_three_more_terms(
        M in inertia(), M_n in inertia(), C in matrix(), C_n in matrix(), D_n in inertia(),
        K in positive_diagonal(), K_P in positive_diagonal(),
        q_dot in vector(), e in vector(), de in vector(), tau_h in vector(), tau_d in vector(), alpha in 0.1..2.0_f64,
    ) {
        let inverse = |A: Matrix3<f64>| A.try_inverse().unwrap();
        let y = de + K_P * e;
        let tau_a = K * y;
        let robot = inverse(M) * (tau_a + tau_h + tau_d - C * q_dot);
        let nominal = inverse(M_n) * (tau_h - alpha * y - (C_n + D_n) * (q_dot + de));
        let dde = nominal - robot;

        let X = M * inverse(M_n);
        let tau_ed = X * ((M - M_n) * inverse(M) * (-C * q_dot + tau_h + tau_d)
            + (C - C_n) * q_dot - D_n * q_dot - tau_d);
        let left: Vector3<f64> = M * (dde + K_P * de) + X * (C_n + D_n + M_n * inverse(M) * K) * y;
        let missing: Vector3<f64> = M * K_P * de + X * (C_n + D_n) * K_P * e - alpha * X * y;

        // The largest terms are inertia times gain, some 1e3, and the inversions lose another factor of 10.
        let scale = 1.0 + M.norm() * K_P.norm() * (1.0 + X.norm()) + K.norm() * X.norm();
        prop_assert!((left - tau_ed - missing).norm() < 1e-12 * scale);
        // Without them the equation is off by as much as they are, which is nothing small.
        prop_assert!(((left - tau_ed).norm() - missing.norm()).abs() < 1e-12 * scale);
    }

    /// eq:diff_dyn_alter, the equation before the Riccati one: eq:dif_dyn written another way,
    /// M(dde + K_P de) + (C + D_n)(de + K_P e) = −tau_a + w. Beside what eq:dif_dyn lacks its w lacks −D_n dq.
    #[test]
    fn the_difference_dynamics_written_with_w_lack_the_damping_of_the_robot_s_velocity_as_well(
        M in inertia(), M_n in inertia(), C in matrix(), C_n in matrix(), D_n in inertia(),
        K in positive_diagonal(), K_P in positive_diagonal(),
        q_dot in vector(), e in vector(), de in vector(), tau_h in vector(), tau_d in vector(), alpha in 0.1..2.0_f64,
    ) {
        let inverse = |A: Matrix3<f64>| A.try_inverse().unwrap();
        let y = de + K_P * e;
        let tau_a = K * y;
        let robot = inverse(M) * (tau_a + tau_h + tau_d - C * q_dot);
        let nominal = inverse(M_n) * (tau_h - alpha * y - (C_n + D_n) * (q_dot + de));
        let dde = nominal - robot;

        let X = M * inverse(M_n);
        let run = q_dot + de + K_P * e;
        let w = (M - M_n) * inverse(M_n) * (tau_h - (C_n + D_n) * run) + (C - C_n) * run - tau_d;
        let left: Vector3<f64> = M * (dde + K_P * de) + (C + D_n) * y + tau_a;
        let shared = M * K_P * de + X * (C_n + D_n) * K_P * e - alpha * X * y;
        let damping = D_n * q_dot;

        let scale = 1.0 + M.norm() * K_P.norm() * (1.0 + X.norm()) + K.norm() * X.norm();
        prop_assert!((left - w - shared + damping).norm() < 1e-12 * scale);
        prop_assert!(((left - w - shared).norm() - damping.norm()).abs() < 1e-12 * scale);
    }

    /// eq:riccati's left side is −2[K_P I]ᵀ D_n [K_P I], not 0: dV/dt's bound survives as an inequality.
    /// M K_P² is read as K_P M K_P, which is what makes P symmetric, and dM = C + Cᵀ, since dM − 2C is skew.
    #[test]
    fn the_riccati_equation_is_an_inequality(
        M in inertia(), C in matrix(), D_n in inertia(), K_P in positive_diagonal(), epsilon in 0.01..1.0_f64,
    ) {
        type Six = SMatrix<f64, 6, 6>;
        let blocks = |a: Matrix3<f64>, b: Matrix3<f64>, c: Matrix3<f64>, d: Matrix3<f64>| {
            let mut all = Six::zeros();
            for (at, block) in [((0, 0), a), ((0, 3), b), ((3, 0), c), ((3, 3), d)] {
                all.fixed_view_mut::<3, 3>(at.0, at.1).copy_from(&block);
            }
            all
        };
        let (zero, I) = (Matrix3::zeros(), Matrix3::identity());
        let inverse = M.try_inverse().unwrap();
        let dM = C + C.transpose();
        let A = blocks(zero, I, -inverse * (C + D_n) * K_P, -inverse * (C + D_n) - K_P);
        let BBt = blocks(zero, zero, zero, inverse * inverse);
        let P = blocks(K_P * M * K_P + K_P / epsilon, K_P * M, M * K_P, M);
        let dP = blocks(K_P * dM * K_P, K_P * dM, dM * K_P, dM);
        let Q = blocks(K_P * K_P / epsilon, zero, zero, I / epsilon);

        let left: Six = dP + A.transpose() * P + P * A - P * BBt * P / epsilon + Q;
        let right: Six = blocks(K_P * D_n * K_P, K_P * D_n, D_n * K_P, D_n) * -2.0;
        // Rounding of the largest products, P A and P B Bᵀ P/ε.
        let scale = P.norm() * A.norm() + (P * BBt * P).norm() / epsilon;
        prop_assert!((left - right).norm() < 1e-12 * scale);
        prop_assert!(right.norm() > 1.0, "and that is not zero: D_n ≥ I, K_P ≥ I");
    }
}
