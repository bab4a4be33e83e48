//! The handle's displacement from a pose.

#![allow(non_snake_case, reason = "the paper's symbols")]

use arm_law::displacement::Origin;
use arm_law::kinematics::Kinematics;
use nalgebra::Vector3;
use proptest::prelude::*;

fn kinematics() -> Kinematics {
    Kinematics {
        handle_z: 0.07,
        ..Kinematics::default()
    }
}

fn angles(within: f64) -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-within..within).prop_map(Vector3::from)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    #[test]
    fn the_pose_displaced_is_the_pose_there(q_0 in angles(3.0), delta in angles(3.0)) {
        let kinematics = kinematics();
        let origin = Origin::new(&kinematics, &q_0);
        let displaced = origin.displaced(&kinematics, &delta);
        let there = kinematics.at(&(q_0 + delta));
        // Lengths below 1 m; a dozen roundings each way, and one of the angle.
        let most = 1e-14;
        prop_assert!((origin.p() + displaced.p - there.p).amax() <= most);
        prop_assert!((displaced.J - there.J).amax() <= most);
        prop_assert!((displaced.R() - there.R()).amax() <= most);
        // σ_min is |det|/σ_max: near a singularity the rounding of det over σ_max ≥ 0.06 m.
        prop_assert!((displaced.sigma_min - there.sigma_min).abs() <= 1e-12);
    }

    #[test]
    fn a_small_displacement_is_J_delta_to_second_order(q_0 in angles(3.0), delta in angles(1e-6)) {
        let kinematics = kinematics();
        let displaced = Origin::new(&kinematics, &q_0).displaced(&kinematics, &delta);
        let linear = kinematics.at(&q_0).J * delta;
        // ½ δᵀ ∂²p/∂q² δ with second derivatives below 1 m, summed over nine pairs of joints. The difference of two
        // positions would be wrong by 1e-16 m, ten times of that.
        prop_assert!((displaced.p - linear).amax() <= 4.5 * delta.amax().powi(2) + 1e-21);
    }
}
