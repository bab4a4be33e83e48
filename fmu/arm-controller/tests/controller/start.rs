//! Initialization and engaging.

use crate::{ArmController, initialized, tick};
use fmu_export::{Log, Model};

const ZERO: [f64; 3] = [0.0; 3];

fn is_at_start(c: &ArmController, p: [f64; 3]) {
    assert_eq!(
        (c.outputs.tau_a, c.outputs.tau_demand, c.outputs.f_a),
        (ZERO, ZERO, ZERO)
    );
    assert_eq!((c.outputs.p, c.outputs.p_n), (p, p));
    assert_eq!(
        (c.outputs.e_nr, c.outputs.dp_n, c.outputs.dp),
        (ZERO, ZERO, ZERO)
    );
    assert_eq!(
        (
            c.outputs.saturated != 0,
            c.outputs.engaged != 0,
            c.outputs.outside_bounds != 0,
            c.outputs.slowed != 0,
            c.tick
        ),
        (false, false, false, false, -1)
    );
    assert_eq!((c.outputs.H, c.outputs.G, c.outputs.tank), (0.0, 0.0, 10.0));
}

#[test]
fn after_initialization_there_is_no_torque_and_the_nominal_stands_at_the_handle() {
    let mut controller = initialized(|c| c.inputs.f_h = [9.0, -4.0, 30.0]);
    let at = |q: [f64; 3]| -> [f64; 3] { controller_kinematics(q) };
    is_at_start(&controller, at([0.0, -1.48096, 1.70138]));
    assert!(controller.outputs.sigma_min > 0.18);
    // Again, after a run and with another pose.
    tick(&mut controller, 0);
    controller.inputs.q = [0.4, -1.0, 1.2];
    controller
        .initialize(0.0, &mut Log::silent())
        .expect("valid parameters");
    is_at_start(&controller, at([0.4, -1.0, 1.2]));
    tick(&mut controller, 0); // tick 0 again
    assert_eq!(
        (controller.outputs.e_nr, controller.outputs.engaged != 0),
        (ZERO, true)
    );
}

fn controller_kinematics(q: [f64; 3]) -> [f64; 3] {
    arm_law::kinematics::Kinematics::default()
        .at(&q.into())
        .p
        .into()
}

#[test]
fn the_first_tick_engages_where_the_handle_is_whatever_q_was_when_initialized() {
    let mut controller = initialized(|c| c.inputs.q = ZERO);
    controller.inputs.q = [0.2, -1.2, 1.6]; // an importer that wires late
    tick(&mut controller, 0);
    assert_eq!(
        controller.outputs.p,
        controller_kinematics(controller.inputs.q)
    );
    assert_eq!(
        (controller.outputs.p_n, controller.outputs.e_nr),
        (controller.outputs.p, ZERO)
    );
    assert_eq!(
        (controller.outputs.dp, controller.outputs.tau_a),
        (ZERO, ZERO)
    );
    assert!(controller.outputs.engaged != 0 && controller.outputs.outside_bounds == 0);
}

#[test]
fn until_engage_is_true_there_is_no_torque_and_then_it_starts_at_the_handle() {
    let mut controller = initialized(|c| (c.inputs.engage, c.inputs.f_h) = (0, [0.0, 0.0, 8.0]));
    for k in 0..5 {
        controller.inputs.q[1] += 1e-4;
        tick(&mut controller, k);
        assert_eq!(
            (controller.outputs.tau_a, controller.outputs.e_nr),
            (ZERO, ZERO)
        );
        assert_eq!(
            (controller.outputs.p_n, controller.outputs.engaged != 0),
            (controller.outputs.p, false)
        );
    }
    controller.inputs.engage = 1;
    tick(&mut controller, 5);
    assert_eq!(
        (controller.outputs.p_n, controller.outputs.dp),
        (controller.outputs.p, ZERO)
    );
    assert!(controller.outputs.engaged != 0 && controller.outputs.f_a[2] > 0.0);
    // And out again: the stored energy is given up, none is created.
    tick(&mut controller, 6);
    assert!(controller.outputs.H > 0.0);
    let G = controller.outputs.G;
    controller.inputs.engage = 0;
    tick(&mut controller, 7);
    assert_eq!(
        (controller.outputs.tau_a, controller.outputs.e_nr),
        (ZERO, ZERO)
    );
    assert_eq!(controller.outputs.H, 0.0);
    assert!(controller.outputs.G < G);
}
