//! The impulse between the halves, held against rigid-body algebra and against a second solver.

#![allow(non_snake_case, reason = "the symbols of the equations")]

use mechanics::arm::gauss_seidel;
use mechanics::arm::guess::Guess;
use mechanics::arm::problem::{Contact, Joint, Problem};
use mechanics::pair::coupling::{Coupling, ROUNDS, SIGNS};
use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;

fn vector(size: f64) -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-size..size).prop_map(Vector3::from)
}

fn matrix(size: f64) -> impl Strategy<Value = Matrix3<f64>> {
    prop::array::uniform9(-size..size).prop_map(|m| Matrix3::from_row_slice(&m))
}

/// A substep of 0.1 ms of some arm; `friction` scales its friction, `push` the table.
fn problem(friction: f64, push: f64) -> impl Strategy<Value = Problem> {
    (
        matrix(1.5),
        vector(0.5),
        prop::array::uniform3(0.0..0.3),
        matrix(0.6),
        -0.02..0.02_f64,
    )
        .prop_map(move |(root, b, limits, J, gap)| Problem {
            A: root * root.transpose() + Matrix3::identity(),
            b,
            joints: limits.map(|limit| Joint {
                against: [limit * friction, 0.8 * limit * friction],
                low: -1e3,
                high: 1e3,
            }),
            J: J + Matrix3::identity() * 0.4,
            contacts: [gap * push - (1.0 - push), -1.0].map(|push| Contact {
                push,
                kappa_dt: 0.031,
                mu: 0.4,
            }),
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn without_friction_and_contact_lambda_is_the_multiplier_of_the_rigid_closed_chain(
        left in problem(0.0, 0.0), right in problem(0.0, 0.0)
    ) {
        // w_L = w_R:  (J_L A_L⁻¹ J_Lᵀ + J_R A_R⁻¹ J_Rᵀ) Λ = J_R A_R⁻¹ b_R − J_L A_L⁻¹ b_L
        let inverse = [left, right].map(|side| side.A.try_inverse().expect("positive definite"));
        let W = left.J * inverse[0] * left.J.transpose() + right.J * inverse[1] * right.J.transpose();
        prop_assume!(W.symmetric_eigenvalues().min() > 1e-2);
        let free = left.J * inverse[0] * left.b - right.J * inverse[1] * right.b;
        let expected = W.try_inverse().expect("positive definite") * -free;

        let coupling = Coupling { push: Vector3::zeros(), kappa_dt: 1e10 };
        let coupled = coupling.solve([&left, &right], &mut [Guess::default(); 2], &Vector3::zeros());
        // The bond gives way by 1/(κ dt W) = 1e-8 at most.
        prop_assert!((coupled.impulse - expected).norm() < 2e-8 * expected.norm() + 1e-12);
    }

    #[test]
    fn with_friction_and_contact_the_bond_and_both_arms_agree(
        left in problem(1.0, 1.0), right in problem(1.0, 1.0), gap in vector(1e-2), start in vector(1.0)
    ) {
        let coupling = Coupling { push: gap, kappa_dt: 11.0 };
        let coupled = coupling.solve([&left, &right], &mut [Guess::default(); 2], &start);
        prop_assert!(coupled.rounds < ROUNDS, "{}", coupled.rounds);
        let v = [(&left, 0), (&right, 1)].map(|(side, i)| {
            let loaded = Problem { b: side.b + side.J.tr_mul(&(coupled.impulse * SIGNS[i])), ..*side };
            gauss_seidel::solve(&loaded, 100_000).v
        });
        for (solution, v) in coupled.solutions.iter().zip(v) {
            // Gauss–Seidel stops at 1e-15 changes of up to 1e-3 of what is left.
            prop_assert!((solution.v - v).amax() < 1e-10, "{}", solution.v - v);
        }
        let w = left.J * v[0] - right.J * v[1];
        let error = coupled.impulse - (gap - w * 11.0);
        prop_assert!(error.amax() < 1e-8, "{error}");
    }
}
