//! The steps in their order.

use arm_law::wrench::deadband::deadband;
use arm_law::wrench::filter::LowPass;
use arm_law::wrench::{Conditioned, Conditioner, Sample, Sensor, Tool, Wrench};
use nalgebra::Vector3;

const T: f64 = 0.001;

fn sensor() -> Sensor {
    Sensor {
        tool: Tool {
            mass: 1.0,
            cog: [0.0, 0.0, 0.1],
            ..Tool::default()
        },
        handle: [0.0, 0.1, 0.2],
        cutoff: 20.0,
        deadband: 1.0,
        ..Sensor::default()
    }
}

fn step(conditioner: &mut Conditioner, force: Vector3<f64>) -> Conditioned {
    conditioner.step(&Sample {
        wrench: Wrench {
            force,
            torque: Vector3::zeros(),
        },
        ..Sample::default()
    })
}

#[test]
fn the_weight_goes_first_then_the_lever_arm_the_filter_and_the_deadband() {
    let Sensor {
        tool,
        handle,
        cutoff,
        ..
    } = sensor();
    let mut conditioner = Conditioner::new(sensor(), T).unwrap();
    let mut filter = LowPass::new(cutoff, T);
    let R = nalgebra::Matrix3::identity();
    for k in 0..50 {
        let force = Vector3::new(3.0, -0.2 * f64::from(k), 4.0);
        let raw = Wrench {
            force,
            torque: Vector3::zeros(),
        };
        let expected = filter.step(&(raw - tool.weight(&R)).about(&handle.into()));
        let hand = step(&mut conditioner, force).hand;
        assert_eq!(hand.force, deadband(&expected.force, 1.0));
        assert_eq!(hand.torque, expected.torque);
    }
}

#[test]
fn after_a_fault_the_force_builds_up_from_zero() {
    let push = Vector3::new(30.0, 0.0, 0.0);
    let mut conditioner = Conditioner::new(sensor(), T).unwrap();
    let first = step(&mut conditioner, push).hand.force.norm();
    for _ in 0..100 {
        step(&mut conditioner, push);
    }
    step(&mut conditioner, Vector3::repeat(f64::NAN));
    let back = (0..200)
        .map(|_| step(&mut conditioner, push))
        .find(|tick| tick.fault.is_none());
    assert_eq!(back.unwrap().hand.force.norm(), first);
}

#[test]
fn a_force_that_is_no_number_once_the_tool_is_taken_off_is_a_fault_and_no_force() {
    for cutoff in [0.0, 20.0] {
        let tool = Tool {
            mass: 1e308,
            ..sensor().tool
        };
        let mut conditioner = Conditioner::new(
            Sensor {
                tool,
                cutoff,
                ..sensor()
            },
            T,
        )
        .unwrap();
        let seen = step(&mut conditioner, Vector3::new(3.0, 0.0, 0.0));
        assert_eq!(seen.hand, Wrench::ZERO);
        assert_eq!(seen.fault, Some(arm_law::wrench::Fault::NotFinite));
    }
}
