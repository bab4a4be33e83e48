//! The frame of the force sensor.

use crate::axes::world;
use crate::{T, initialized, tick};
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
    let mut sensor = initialized(|c| c.parameters.ft.frame = 2);
    for k in 0..1000 {
        let (q, f_h) = world(k);
        let f_h = Vector3::from(f_h) + Vector3::new(1.0, -2.0, 3.0);
        (base.inputs.q, base.inputs.f_h) = (q, f_h.into());
        (sensor.inputs.q, sensor.inputs.f_h) = (q, (link_3(q).inverse() * f_h).into());
        tick(&mut base, k);
        tick(&mut sensor, k);
        for i in 0..3 {
            // Rounding of the rotation, 1e-15 N, amplified by K/(2 Lambda_n/T) and K K_P.
            assert!(
                (base.outputs.f_a[i] - sensor.outputs.f_a[i]).abs() < 1e-11,
                "tick {k}"
            );
        }
    }
    assert!(
        base.outputs.f_a.iter().all(|f_a| f_a.abs() > 1.0),
        "{:?}",
        base.outputs.f_a
    );
}

#[test]
fn the_frame_turns_with_the_link() {
    // Elbow bent so that link 3 points straight up: its x is the base's z, its z the base's −x.
    let q = [0.0, 0.2, std::f64::consts::FRAC_PI_2 - 0.2];
    let mut controller = initialized(|c| {
        (c.inputs.q, c.parameters.ft.frame, c.inputs.f_h) = (q, 2, [7.0, 0.0, 0.0]);
    });
    tick(&mut controller, 0);
    assert!(controller.outputs.f_a[2] > 0.1);
    assert!(controller.outputs.f_a[0].abs() < 1e-15 && controller.outputs.f_a[1] == 0.0); // rounding of π/2
}

#[test]
fn a_broken_sensor_is_named_and_the_law_goes_on_without_force() {
    let mut broken = initialized(|_| ());
    let mut untouched = initialized(|_| ());
    for k in 0..200 {
        let bad = k == 50;
        broken.inputs.f_h = [if bad { f64::NAN } else { 0.0 }, 0.0, 0.0];
        tick(&mut broken, k);
        tick(&mut untouched, k);
        // 0.1 s of recovery, counted from the first sound sample.
        let expected = i32::from((50..150).contains(&k));
        assert_eq!(broken.outputs.ft_fault, expected, "tick {k}");
        assert_eq!(broken.outputs.tau_a, untouched.outputs.tau_a, "tick {k}");
    }
}

#[test]
fn a_tare_takes_the_bias_off_and_keeps_the_arm_where_it_is() {
    let mut controller = initialized(|c| c.inputs.f_h = [0.0, 1.0, 0.0]);
    for k in 0..2000 {
        controller.inputs.ft_tare = (k == 0).into();
        tick(&mut controller, k);
        let running = k < 499;
        assert_eq!(
            controller.outputs.ft_tare_state,
            if running { 1 } else { 2 }
        );
        assert_eq!(controller.outputs.ft_f_h, [0.0; 3]);
        assert_eq!(
            controller.outputs.ft_bias_force,
            [0.0, if running { 0.0 } else { 1.0 }, 0.0]
        );
    }
    assert_eq!(controller.outputs.p_n, controller.outputs.p);

    let mut untared = initialized(|c| c.inputs.f_h = [0.0, 1.0, 0.0]);
    (0..2000).for_each(|k| tick(&mut untared, k));
    // The robot does not move here: the nominal leans on the coupling until joint 1 delivers no more, tau_max at p_x.
    let (tau_max, lever) = (untared.parameters.tau_max[0], untared.outputs.p[0]);
    let leans = tau_max / lever / (untared.parameters.K[1] * untared.parameters.K_P[1]);
    // The nominal slips at no more than f_h/D_n, which is 0.05 mm a tick.
    assert!((untared.outputs.e_nr[1] - leans).abs() < T * 1.0 / 20.0);
    assert!(leans > 0.017);
}

#[test]
fn a_tare_that_fails_says_why() {
    let mut controller = initialized(|c| {
        c.inputs.f_h = [0.0, 0.0, 25.0];
        c.inputs.ft_tare = 1;
    });
    (0..500).for_each(|k| tick(&mut controller, k));
    assert_eq!(
        (
            controller.outputs.ft_tare_state,
            controller.outputs.ft_tare_failure
        ),
        (3, 4)
    );
    assert_eq!(controller.outputs.ft_bias_force, [0.0; 3]);
}

#[test]
fn a_six_axis_sensor_is_turned_unloaded_and_moved_to_the_handle() {
    let (mount, handle) = ([0.4, -0.7, 1.9], Vector3::new(0.02, -0.03, 0.11));
    let (mass, cog) = (0.7, Vector3::new(0.01, 0.02, 0.06));
    let mut controller = initialized(|c| {
        c.parameters.ft.source = 2;
        (c.parameters.ft.mount, c.parameters.ft.handle) = (mount, handle.into());
        (c.parameters.ft.tool.mass, c.parameters.ft.tool.cog) = (mass, cog.into());
        c.inputs.f_h = [100.0; 3]; // not looked at
    });
    for k in 0..100 {
        let (q, _) = world(k);
        let R = link_3(q) * Rotation3::from_euler_angles(mount[0], mount[1], mount[2]);
        let (force, moment) = (Vector3::new(5.0, -3.0, 2.0), Vector3::new(0.3, 0.1, -0.2));
        let weight = Vector3::new(0.0, 0.0, -9.81) * mass;
        let torque = moment + (R * handle).cross(&force) + (R * cog).cross(&weight);
        controller.inputs.q = q;
        controller.inputs.ft_force = R.inverse_transform_vector(&(force + weight)).into();
        controller.inputs.ft_torque = R.inverse_transform_vector(&torque).into();
        tick(&mut controller, k);
        // Rounding of 10 N through a dozen operations.
        assert!((Vector3::from(controller.outputs.ft_f_h) - force).amax() < 1e-14);
        assert!((Vector3::from(controller.outputs.ft_moment) - moment).amax() < 1e-14);
    }
}

#[test]
fn before_the_first_tick_nothing_was_sensed() {
    let controller = initialized(|c| {
        c.inputs.f_h = [f64::NAN; 3];
        c.inputs.ft_tare = 1;
    });
    assert_eq!(
        (
            controller.outputs.ft_fault,
            controller.outputs.ft_tare_state
        ),
        (0, 0)
    );
    assert_eq!(controller.outputs.ft_f_h, [0.0; 3]);
}
