//! The payload: gripped with its momentum, borne, lost.

#![allow(
    non_snake_case,
    reason = "the symbols of mechanics with their capitals: F_max"
)]

use mechanics::arm::rigid_body::RigidBody;
use mechanics::arm::{Arm, Inputs, Parameters, Start};
use nalgebra::Vector3;

fn body(arm: &Arm, payload: f64) -> RigidBody {
    let Parameters {
        lengths, masses, ..
    } = arm.parameters();
    RigidBody::at(&arm.place().pose, lengths, masses, payload)
}

/// A table 1 mm under the pad, torques at once.
fn above_the_table(payload_m: f64) -> Parameters {
    let mut parameters = Parameters {
        drive_cutoff: 0.0,
        payload_m,
        ..Parameters::default()
    };
    parameters.table.z = Arm::default().place().pad.p.z - 1e-3;
    parameters
}

#[test]
fn gripping_keeps_the_momentum() {
    let press = Inputs {
        tau_a: [40.0, 0.0, 0.0],
        f_h: [0.0, 0.0, -250.0],
        f_d: [0.0; 3],
        vacuum: true,
    };
    let mut arm = Arm::new(above_the_table(5.0), &Start::default()).unwrap();
    let mut empty = Arm::new(above_the_table(0.0), &Start::default()).unwrap(); // the same without anything to grip
    while !arm.attached() {
        assert_eq!(arm.dq(), empty.dq());
        arm.advance(&press, 1, 1e-4);
        empty.advance(&press, 1, 1e-4);
    }
    assert!(arm.f_e().z > 5.0 && empty.dq().amax() > 0.1);
    let (before, after) = (
        body(&empty, 0.0).M * empty.dq(),
        body(&arm, 5.0).M * arm.dq(),
    );
    assert!(
        (before - after).amax() < 1e-14 * before.amax(),
        "{before}{after}"
    ); // an inverse of condition 30
    // What the impact took is what kinetic energy lost; what came in is the potential energy of the payload.
    let (with, without) = (arm.energy(), empty.energy());
    assert!((without.kinetic - with.kinetic - with.loss_grip).abs() < 1e-13);
    assert!(with.loss_grip > 0.0);
    assert!((with.potential - without.potential - with.payload).abs() < 1e-12);
    assert!((with.payload - 5.0 * 9.81 * arm.place().pad.p.z).abs() < 1e-12);
}

#[test]
fn it_takes_vacuum_and_5_N_to_grip() {
    // Weightless and without dry friction the arm passes on what pushes the pad; 10 kN·s/m let it settle from below.
    let mut parameters = above_the_table(5.0);
    parameters.table.z += 1e-3; // touching
    parameters.table.c = 1e4;
    parameters.masses.gravity = [0.0; 3];
    for friction in &mut parameters.friction {
        (friction.F_c, friction.F_s) = (0.0, 0.0);
    }
    for (force, vacuum, grips) in [(4.9, true, false), (5.1, false, false), (5.1, true, true)] {
        let mut arm = Arm::new(parameters, &Start::default()).unwrap();
        let press = Inputs {
            f_d: [0.0, 0.0, -force],
            vacuum,
            ..Inputs::default()
        };
        arm.advance(&press, 20_000, 1e-4);
        assert!((arm.f_e().z - force).abs() < 0.05, "{}", arm.f_e());
        assert_eq!(arm.attached(), grips, "{force} {vacuum}");
    }
}

#[test]
fn the_bond_breaks_when_the_payload_outweighs_it() {
    for (F_max, holds) in [(98.11, true), (98.09, false)] {
        let mut parameters = Parameters {
            drive_cutoff: 0.0,
            payload_m: 10.0,
            ..Parameters::default()
        }; // 98.1 N
        parameters.vacuum.F_max = F_max;
        let mut arm = Arm::new(
            parameters,
            &Start {
                attached: true,
                ..Start::default()
            },
        )
        .unwrap();
        let hold = Inputs {
            tau_a: body(&arm, 10.0).g.into(),
            vacuum: true,
            ..Inputs::default()
        };
        arm.advance(&hold, 1, 1e-4);
        assert!((arm.tension() - 98.1).abs() < 1e-12, "{}", arm.tension());
        assert_eq!(arm.attached(), holds);
        arm.advance(&hold, 1_000, 1e-4);
        assert_eq!(arm.attached(), holds, "what is lost stays lost");
        assert_eq!(arm.tension() > 0.0, holds);
    }
}

#[test]
fn tension_is_weight_and_inertia_less_what_the_table_bears() {
    let (m, dt) = (10.0, 1e-4);
    let mut arm = Arm::new(
        above_the_table(m),
        &Start {
            attached: true,
            ..Start::default()
        },
    )
    .unwrap();
    let hold = body(&arm, m).g;
    for force in [-200.0, 300.0] {
        let inputs = Inputs {
            tau_a: hold.into(),
            f_h: [0.0, 0.0, force],
            vacuum: true,
            ..Inputs::default()
        };
        for _ in 0..1_000 {
            let before = arm.place().pad.J * arm.dq();
            arm.advance(&inputs, 1, dt);
            let a = (arm.place().pad.J * arm.dq() - before) / dt;
            let expected = m * (a.z + 9.81) - arm.f_e().z;
            assert!((arm.tension() - expected).abs() < 1e-9, "{expected}"); // 1e-16 m/s over dt
        }
        assert_eq!(arm.contact(), force < 0.0);
    }
}

#[test]
fn what_is_released_takes_its_energy_along() {
    let parameters = Parameters {
        drive_cutoff: 0.0,
        payload_m: 10.0,
        ..Parameters::default()
    };
    let mut arm = Arm::new(
        parameters,
        &Start {
            attached: true,
            ..Start::default()
        },
    )
    .unwrap();
    let lift = Inputs {
        tau_a: (body(&arm, 10.0).g * 1.5).into(),
        f_h: [0.0, 5.0, 60.0],
        vacuum: true,
        ..Inputs::default()
    };
    arm.advance(&lift, 3_000, 1e-4);
    arm.advance(
        &Inputs {
            vacuum: false,
            ..lift
        },
        1,
        1e-4,
    ); // it is there through this substep
    let w = arm.place().pad.J * arm.dq();
    let taken = 0.5 * 10.0 * w.norm_squared() + 10.0 * 9.81 * arm.place().pad.p.z;
    assert!(!arm.attached() && w.norm() > 0.1);
    assert!((arm.energy().payload + taken).abs() < 1e-12);
    assert!(arm.energy().residual.abs() < 1e-3 * arm.energy().work());
    arm.advance(
        &Inputs {
            vacuum: true,
            ..lift
        },
        1_000,
        1e-4,
    );
    assert!(!arm.attached(), "there is nothing to grip in the air");
}

#[test]
fn a_start_payload_hangs_at_the_pad_unless_it_has_no_mass() {
    for (payload_m, attached) in [(10.0, true), (0.0, false)] {
        let parameters = Parameters {
            payload_m,
            ..Parameters::default()
        };
        let arm = Arm::new(
            parameters,
            &Start {
                attached: true,
                dq: [0.1, 0.0, 0.0],
                ..Start::default()
            },
        )
        .unwrap();
        assert_eq!(arm.attached(), attached);
        assert!(
            (arm.energy().kinetic - body(&arm, payload_m).kinetic(&Vector3::new(0.1, 0.0, 0.0)))
                .abs()
                < 1e-15
        );
    }
}
