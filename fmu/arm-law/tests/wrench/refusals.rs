//! A sensor that cannot be is refused, with the name, the value and the range.

use arm_law::wrench::tare::TareSettings;
use arm_law::wrench::validity::Checks;
use arm_law::wrench::{Conditioner, Mount, Sensor, Tool};
use nalgebra::Vector3;

fn refusal(sensor: Sensor) -> String {
    Conditioner::new(sensor, 0.001).unwrap_err().to_string()
}

#[test]
fn every_parameter_out_of_its_range_is_named() {
    let sensor = Sensor::default();
    let message = refusal(Sensor {
        tool: Tool {
            mass: -0.4,
            ..Tool::default()
        },
        ..sensor
    });
    assert_eq!(
        message,
        "ft.mass = -0.4: expected a finite value not less than 0"
    );
    let message = refusal(Sensor {
        handle: [0.0, f64::NAN, 0.0],
        ..sensor
    });
    assert_eq!(message, "ft.handle[2] = NaN: expected a finite value");
    let nan = [0.0, 0.0, f64::NAN];
    let tool = |cog, gravity| Sensor {
        tool: Tool {
            mass: 1.0,
            cog,
            gravity,
        },
        ..sensor
    };
    let checks = |change: fn(&mut Checks)| {
        let mut sensor = sensor;
        change(&mut sensor.checks);
        sensor
    };
    let tare = |change: fn(&mut TareSettings)| {
        let mut sensor = sensor;
        change(&mut sensor.tare);
        sensor
    };
    for (name, sensor) in [
        ("ft.cog[3]", tool(nan, [0.0; 3])),
        ("ft.gravity[3]", tool([0.0; 3], nan)),
        ("ft.range_force", checks(|checks| checks.range_force = -1.0)),
        (
            "ft.range_torque",
            checks(|checks| checks.range_torque = f64::NAN),
        ),
        ("ft.rate_force", checks(|checks| checks.rate_force = -1.0)),
        ("ft.rate_torque", checks(|checks| checks.rate_torque = -1.0)),
        (
            "ft.recovery_time",
            checks(|checks| checks.recovery_time = f64::INFINITY),
        ),
        ("ft.tare_time", tare(|tare| tare.time = 0.0)),
        ("ft.tare_motion", tare(|tare| tare.motion = -1.0)),
        (
            "ft.tare_spread_force",
            tare(|tare| tare.spread_force = -1.0),
        ),
        (
            "ft.tare_spread_torque",
            tare(|tare| tare.spread_torque = -1.0),
        ),
        ("ft.tare_max_force", tare(|tare| tare.max_force = -1.0)),
        ("ft.tare_max_torque", tare(|tare| tare.max_torque = -1.0)),
        (
            "ft.cutoff",
            Sensor {
                cutoff: -1.0,
                ..sensor
            },
        ),
        (
            "ft.deadband",
            Sensor {
                deadband: f64::NAN,
                ..sensor
            },
        ),
    ] {
        let message = refusal(sensor);
        assert!(message.starts_with(&format!("{name} = ")), "{message}");
    }
    let rpy = Vector3::new(f64::INFINITY, 0.0, 0.0);
    let message = Mount { rpy }.check().unwrap_err().to_string();
    assert_eq!(message, "ft.mount[1] = inf: expected a finite value");
}
