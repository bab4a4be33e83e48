//! The deadband: no jump, no turn, no gain.

use crate::synthetic::Random;
use arm_law::wrench::deadband::deadband;
use nalgebra::Vector3;

#[test]
fn a_force_within_the_band_is_zero_and_one_beyond_it_loses_its_width() {
    assert_eq!(
        deadband(&Vector3::new(0.6, -0.8, 0.0), 1.0),
        Vector3::zeros()
    );
    assert_eq!(deadband(&Vector3::zeros(), 1.0), Vector3::zeros());
    let f = deadband(&Vector3::new(3.0, 0.0, -4.0), 2.0);
    assert!((f - Vector3::new(1.8, 0.0, -2.4)).amax() < 1e-15); // rounding
}

#[test]
fn there_is_no_jump_anywhere() {
    // The map is 1-Lipschitz: shortening by d is the distance to a convex ball's projection.
    let random = &mut Random(4);
    for _ in 0..10_000 {
        let a = random.vector(3.0);
        let b = a + random.vector(0.1);
        let apart = (deadband(&a, 1.0) - deadband(&b, 1.0)).norm();
        assert!(apart <= (a - b).norm() * (1.0 + 1e-12), "{a} {b}"); // rounding
    }
}

#[test]
fn the_direction_stays_and_the_length_only_shrinks() {
    let random = &mut Random(5);
    for _ in 0..10_000 {
        let force = random.vector(3.0);
        let f = deadband(&force, 1.0);
        assert!((f.norm() - (force.norm() - 1.0).max(0.0)).abs() < 1e-15 * 8.0); // rounding
        assert!(f.cross(&force).amax() < 1e-14);
        assert!(f.dot(&force) >= 0.0);
    }
}

#[test]
fn extreme_forces_give_finite_ones() {
    for length in [f64::MIN_POSITIVE, 1e-200, 1e200, f64::MAX] {
        let f = deadband(&Vector3::new(length, -length, 0.0), 1.0);
        assert!(f.iter().all(|x| x.is_finite()), "{length}");
    }
}
