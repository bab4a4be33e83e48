//! The arm's law takes a short way where next to nothing is made of a reading; the conditioning by itself knows the long one
//! only.

use arm_law::wrench::{Conditioner, Fault, Sample, Sensor, Wrench};
use arm_law::{ArmInputs, ArmLaw, ArmOutputs, ArmParameters};
use nalgebra::Vector3;
use proptest::prelude::*;

/// A sound reading most of the time, a sensor that fails now and then.
fn readings() -> impl Strategy<Value = Vec<([f64; 3], bool, bool)>> {
    let component = prop_oneof![
        40 => -20.0..20.0,
        1 => Just(f64::NAN),
        1 => Just(f64::INFINITY),
        1 => Just(-0.0),
        1 => Just(1.7e308),
    ];
    let force = [component.clone(), component.clone(), component];
    prop::collection::vec(
        (force, prop::bool::weighted(0.97), prop::bool::weighted(0.1)),
        1..80,
    )
}

/// A sensor on which the short way is open, and some on which it is not.
fn sensors() -> impl Strategy<Value = Sensor> {
    let handle = [-0.5..0.5, -0.5..0.5, -0.5..0.5];
    let off = |on: f64| prop_oneof![3 => Just(0.0), 1 => Just(on)];
    (handle, off(1.0), off(20.0), off(0.3), off(15.0)).prop_map(
        |(handle, deadband, cutoff, mass, range_force)| {
            let mut sensor = Sensor {
                handle,
                deadband,
                cutoff,
                ..Sensor::default()
            };
            sensor.tool.mass = mass;
            sensor.checks.range_force = range_force;
            // A tare that ends within the run, whatever is pushed meanwhile.
            sensor.checks.recovery_time = 0.003;
            sensor.tare.time = 0.005;
            sensor.tare.spread_force = 0.0;
            sensor.tare.max_force = 0.0;
            sensor.tare.max_torque = 0.0;
            sensor.tare.spread_torque = 0.0;
            sensor
        },
    )
}

proptest! {
    #[test]
    fn both_ways_lead_to_the_same_bits(sensor in sensors(), readings in readings()) {
        let parameters = ArmParameters { ft: sensor, ..ArmParameters::default() };
        let mut law = ArmLaw::new(&parameters).unwrap();
        let mut conditioner = Conditioner::new(sensor, parameters.T).unwrap();
        let mut outputs = ArmOutputs::default();
        let q = ArmInputs::default().q;
        for (force, valid, tare) in readings {
            let inputs = ArmInputs {
                engage: 0,
                f_h: force,
                ft_valid: valid.into(),
                ft_tare: tare.into(),
                ..ArmInputs::default()
            };
            law.tick(&inputs, &mut outputs).unwrap();
            let expected = conditioner.step(&Sample {
                wrench: Wrench { force: force.into(), torque: Vector3::zeros() },
                q: q.into(),
                valid,
                tare,
                ..Sample::default()
            });
            let bits = |values: [f64; 3]| values.map(f64::to_bits);
            prop_assert_eq!(bits(outputs.ft_f_h), bits(expected.hand.force.into()));
            prop_assert_eq!(bits(outputs.ft_moment), bits(expected.hand.torque.into()));
            prop_assert_eq!(outputs.ft_fault, expected.fault.map_or(0, Fault::number));
            prop_assert_eq!(outputs.ft_tare_state, expected.tare.number());
            prop_assert_eq!(bits(outputs.ft_bias_force), bits(conditioner.bias().force.into()));
        }
    }
}
