//! Frames, lever arm and mounting.

use crate::synthetic::Random;
use arm_law::wrench::{Conditioner, Mount, Sample, Sensor, Tool, Wrench};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::FRAC_PI_2;

#[test]
fn a_force_at_the_end_of_a_lever_reads_as_force_and_moment() {
    // 10 N upwards, 0.2 m in front of the sensor: a moment about −y, and none about the handle.
    let at_the_sensor = Wrench {
        force: Vector3::new(0.0, 0.0, 10.0),
        torque: Vector3::new(0.0, -2.0, 0.0),
    };
    let at_the_handle = at_the_sensor.about(&Vector3::new(0.2, 0.0, 0.0));
    assert_eq!(at_the_handle.torque, Vector3::zeros());
    assert_eq!(at_the_handle.force, at_the_sensor.force);
}

#[test]
fn the_power_of_a_wrench_on_a_moving_body_is_the_same_about_every_point_and_in_every_frame() {
    let random = &mut Random(1);
    for _ in 0..1000 {
        let wrench = Wrench {
            force: random.vector(50.0),
            torque: random.vector(5.0),
        };
        let (v, omega) = (random.vector(1.0), random.vector(3.0));
        let power = wrench.force.dot(&v) + wrench.torque.dot(&omega);

        let (r, R) = (random.vector(0.3), random.orientation());
        let moved = wrench.about(&r).turned(&R);
        let (v, omega) = (R * (v + omega.cross(&r)), R * omega);
        let again = moved.force.dot(&v) + moved.torque.dot(&omega);
        assert!((power - again).abs() < 1e-13 * 200.0); // rounding of sums of up to 200 W
    }
}

#[test]
fn the_moment_about_the_handle_has_the_lever_arm_taken_off() {
    let handle = Vector3::new(0.01, -0.02, 0.15);
    let mut conditioner = Conditioner::new(
        Sensor {
            handle: handle.into(),
            ..Sensor::default()
        },
        0.001,
    )
    .unwrap();
    let (force, torque) = (Vector3::new(3.0, -7.0, 11.0), Vector3::new(0.1, 0.2, -0.3));
    let wrench = Wrench {
        force,
        torque: torque + handle.cross(&force),
    };
    let hand = conditioner
        .step(&Sample {
            wrench,
            ..Sample::default()
        })
        .hand;
    assert_eq!(hand.force, force);
    assert!((hand.torque - torque).amax() < 1e-15); // rounding of 2 N·m
}

#[test]
fn the_mounting_turns_roll_first_and_yaw_last_about_fixed_axes() {
    let turn = |rpy: [f64; 3]| Mount { rpy: rpy.into() }.R();
    let quarter = FRAC_PI_2;
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let near = |a: Vector3<f64>, b: Vector3<f64>| (a - b).amax() < 1e-15; // rounding of π/2
    assert!(near(turn([quarter, 0.0, 0.0]) * y, z));
    assert!(near(turn([0.0, quarter, 0.0]) * z, x));
    assert!(near(turn([0.0, 0.0, quarter]) * x, y));
    // Roll takes y to z, pitch z to x, yaw x to y: y stays.
    assert!(near(turn([quarter; 3]) * y, y));

    let random = &mut Random(2);
    for _ in 0..100 {
        let [r, p, w] = random.vector(3.0).into();
        let product = turn([0.0, 0.0, w]) * turn([0.0, p, 0.0]) * turn([r, 0.0, 0.0]);
        let R = turn([r, p, w]);
        assert!((R - product).amax() < 1e-15); // rounding
        assert!((R.transpose() * R - Matrix3::identity()).amax() < 1e-15);
    }
}

#[test]
fn the_weight_pulls_down_and_turns_about_the_sensor_whatever_its_orientation() {
    let tool = Tool {
        mass: 2.0,
        cog: [0.1, 0.0, 0.0],
        ..Tool::default()
    };
    let level = tool.weight(&Matrix3::identity());
    assert_eq!(level.force, Vector3::new(0.0, 0.0, -19.62));
    assert!((level.torque - Vector3::new(0.0, 1.962, 0.0)).amax() < 1e-15);
    // Nose down, the sensor's x along gravity: no moment.
    let down = Mount {
        rpy: Vector3::new(0.0, FRAC_PI_2, 0.0),
    }
    .R();
    let weight = tool.weight(&down);
    assert!((weight.force - Vector3::new(19.62, 0.0, 0.0)).amax() < 1e-14); // rounding of π/2
    assert!(weight.torque.amax() < 1e-14);
}

#[test]
fn with_everything_off_a_force_passes_bit_for_bit() {
    let mut conditioner = Conditioner::new(Sensor::default(), 0.001).unwrap();
    let random = &mut Random(3);
    for k in 0..100 {
        let force = if k % 4 == 0 {
            Vector3::new(-0.0, 0.0, -0.0)
        } else {
            random.vector(1e3)
        };
        let sample = Sample {
            wrench: Wrench {
                force,
                torque: Vector3::zeros(),
            },
            R: random.orientation(),
            ..Sample::default()
        };
        let hand = conditioner.step(&sample).hand;
        assert_eq!(hand.force.map(f64::to_bits), force.map(f64::to_bits));
    }
}
