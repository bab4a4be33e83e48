//! Initialization and engaging.

use crate::{ArmController, initialized, tick};
use export::{Log, Model};

const ZERO: [f64; 3] = [0.0; 3];

fn is_at_start(c: &ArmController, p: [f64; 3]) {
    assert_eq!((c.tau_a, c.tau_demand, c.f_a), (ZERO, ZERO, ZERO));
    assert_eq!((c.p, c.p_n), (p, p));
    assert_eq!((c.e_nr, c.dp_n, c.dp), (ZERO, ZERO, ZERO));
    assert_eq!(
        (c.saturated, c.engaged, c.outside_bounds, c.slowed, c.tick),
        (false, false, false, false, -1)
    );
    assert_eq!((c.energy.H, c.energy.G, c.energy.tank), (0.0, 0.0, 10.0));
}

#[test]
fn after_initialization_there_is_no_torque_and_the_nominal_stands_at_the_handle() {
    let mut controller = initialized(|c| c.f_h = [9.0, -4.0, 30.0]);
    let at = |q: [f64; 3]| -> [f64; 3] { controller_kinematics(q) };
    is_at_start(&controller, at([0.0, -1.48096, 1.70138]));
    assert!(controller.sigma_min > 0.18);
    // Again, after a run and with another pose.
    tick(&mut controller, 0);
    controller.q = [0.4, -1.0, 1.2];
    controller
        .initialize(0.0, &mut Log::silent())
        .expect("valid parameters");
    is_at_start(&controller, at([0.4, -1.0, 1.2]));
    tick(&mut controller, 0); // tick 0 again
    assert_eq!((controller.e_nr, controller.engaged), (ZERO, true));
}

fn controller_kinematics(q: [f64; 3]) -> [f64; 3] {
    arm_law::kinematics::Kinematics::default()
        .at(&q.into())
        .p
        .into()
}

#[test]
fn the_first_tick_engages_where_the_handle_is_whatever_q_was_when_initialized() {
    let mut controller = initialized(|c| c.q = ZERO);
    controller.q = [0.2, -1.2, 1.6]; // an importer that wires late
    tick(&mut controller, 0);
    assert_eq!(controller.p, controller_kinematics(controller.q));
    assert_eq!((controller.p_n, controller.e_nr), (controller.p, ZERO));
    assert_eq!((controller.dp, controller.tau_a), (ZERO, ZERO));
    assert!(controller.engaged && !controller.outside_bounds);
}

#[test]
fn until_engage_is_true_there_is_no_torque_and_then_it_starts_at_the_handle() {
    let mut controller = initialized(|c| (c.engage, c.f_h) = (false, [0.0, 0.0, 8.0]));
    for k in 0..5 {
        controller.q[1] += 1e-4;
        tick(&mut controller, k);
        assert_eq!((controller.tau_a, controller.e_nr), (ZERO, ZERO));
        assert_eq!((controller.p_n, controller.engaged), (controller.p, false));
    }
    controller.engage = true;
    tick(&mut controller, 5);
    assert_eq!((controller.p_n, controller.dp), (controller.p, ZERO));
    assert!(controller.engaged && controller.f_a[2] > 0.0);
    // And out again: the stored energy is given up, none is created.
    tick(&mut controller, 6);
    assert!(controller.energy.H > 0.0);
    let G = controller.energy.G;
    controller.engage = false;
    tick(&mut controller, 7);
    assert_eq!((controller.tau_a, controller.e_nr), (ZERO, ZERO));
    assert_eq!(controller.energy.H, 0.0);
    assert!(controller.energy.G < G);
}
