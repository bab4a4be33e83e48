//! The frame of the force sensor.

use crate::axes::world;
use crate::{initialized, tick};
use nalgebra::{Rotation3, Vector3};

/// Link 3's frame, by rotations about the joints' axes.
fn link_3(q: [f64; 3]) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&Vector3::z_axis(), q[0])
        * Rotation3::from_axis_angle(&-Vector3::y_axis(), q[1])
        * Rotation3::from_axis_angle(&-Vector3::y_axis(), q[2])
}

#[test]
fn a_force_in_the_sensors_frame_acts_like_the_same_force_in_the_base_frame() {
    let mut base = initialized(|_| ());
    let mut sensor = initialized(|c| c.ft.frame = 2);
    for k in 0..1000 {
        let (q, f_h) = world(k);
        let f_h = Vector3::from(f_h) + Vector3::new(1.0, -2.0, 3.0);
        (base.q, base.f_h) = (q, f_h.into());
        (sensor.q, sensor.f_h) = (q, (link_3(q).inverse() * f_h).into());
        tick(&mut base, k);
        tick(&mut sensor, k);
        for i in 0..3 {
            // Rounding of the rotation, 1e-15 N, amplified by K/(2 Lambda_n/T) and K K_P.
            assert!((base.f_a[i] - sensor.f_a[i]).abs() < 1e-11, "tick {k}");
        }
    }
    assert!(base.f_a.iter().all(|f_a| f_a.abs() > 1.0), "{:?}", base.f_a);
}

#[test]
fn the_frame_turns_with_the_link() {
    // Elbow bent so that link 3 points straight up: its x is the base's z, its z the base's −x.
    let q = [0.0, 0.2, std::f64::consts::FRAC_PI_2 - 0.2];
    let mut controller = initialized(|c| {
        (c.q, c.ft.frame, c.f_h) = (q, 2, [7.0, 0.0, 0.0]);
    });
    tick(&mut controller, 0);
    assert!(controller.f_a[2] > 0.1);
    assert!(controller.f_a[0].abs() < 1e-15 && controller.f_a[1] == 0.0); // rounding of π/2
}
