//! Supervision in the controller: what reaches the joints.

use crate::robot::{Robot, close_the_loop};
use crate::{controller, initialized, tick};
use arm_controller::ArmController;
use arm_law::kinematics::Kinematics;
use arm_law::supervision::{Diagnostic, State};
use fmu_export::{Log, Model};

/// Supervised, ready for an edge of engage after the ticks from 0 to 101.
fn ready(change: impl FnOnce(&mut ArmController)) -> (ArmController, u32) {
    let mut c = initialized(|c| {
        (c.parameters.supervision, c.inputs.enable, c.inputs.engage) = (1, 1, 0);
        c.parameters.supervisor.heartbeat_timeout = 0.0;
        change(c);
    });
    (0..102).for_each(|k| tick(&mut c, k));
    assert_eq!(c.outputs.state, State::Ready.number());
    (c, 102)
}

/// Engaged with full authority, its handle pushed by `f_h` (N), on a robot that moves.
fn engaged(f_h: [f64; 3], change: impl FnOnce(&mut ArmController)) -> (ArmController, Robot, u32) {
    let (mut c, mut k) = ready(change);
    let mut robot = Robot::at_the_start();
    c.inputs.engage = 1;
    for _ in 0..1500 {
        close_the_loop(&mut c, &mut robot, k, f_h);
        k += 1;
    }
    assert_eq!(
        (c.outputs.state, c.outputs.authority),
        (State::Engaged.number(), 1.0)
    );
    (c, robot, k)
}

#[test]
fn the_first_torque_is_zero_and_those_of_the_ramp_are_the_law_s_times_the_authority() {
    let (mut c, mut k) = ready(|c| c.inputs.f_h = [3.0, -20.0, 40.0]);
    c.inputs.engage = 1;
    tick(&mut c, k);
    assert_eq!(
        (c.outputs.tau_a, c.outputs.engaged != 0, c.outputs.authority),
        ([0.0; 3], true, 0.0)
    );
    let mut robot = Robot::at_the_start();
    for n in 1..=500 {
        k += 1;
        close_the_loop(&mut c, &mut robot, k, [3.0, -20.0, 40.0]);
        assert_eq!(c.outputs.authority, f64::from(n) / 500.0);
        for i in 0..3 {
            // Nothing saturates here. The rounding of three products and their sum.
            let expected = c.outputs.authority * c.outputs.tau_demand[i];
            assert!(
                (c.outputs.tau_a[i] - expected).abs() <= 1e-12,
                "{} {expected}",
                c.outputs.tau_a[i]
            );
        }
    }
    assert!(
        c.outputs.tau_a.iter().any(|tau| tau.abs() > 1.0),
        "{:?}",
        c.outputs.tau_a
    );
}

#[test]
fn engaging_anew_starts_from_where_the_arm_is() {
    let (mut c, mut robot, mut k) = engaged([0.0, 0.0, 8.0], |_| ());
    c.inputs.engage = 0;
    for _ in 0..650 {
        close_the_loop(&mut c, &mut robot, k, [0.0, 0.0, 8.0]);
        k += 1;
    }
    assert_eq!(
        (c.outputs.state, c.outputs.tau_a),
        (State::Ready.number(), [0.0; 3])
    );
    robot.q[1] += 0.1;
    c.inputs.engage = 1;
    close_the_loop(&mut c, &mut robot, k, [0.0, 0.0, 8.0]);
    assert_eq!(
        (c.outputs.tau_a, c.outputs.e_nr, c.outputs.dp_n),
        ([0.0; 3], [0.0; 3], [0.0; 3])
    );
}

#[test]
fn an_emergency_stop_takes_the_torque_of_its_tick() {
    let (mut c, mut robot, k) = engaged([0.0, 0.0, 8.0], |_| ());
    assert!(c.outputs.tau_a[1].abs() > 1.0);
    c.inputs.emergency_stop = 1;
    close_the_loop(&mut c, &mut robot, k, [0.0, 0.0, 8.0]);
    assert_eq!(
        (c.outputs.tau_a, c.outputs.state),
        ([0.0; 3], State::Fault.number())
    );
    assert_eq!(c.outputs.first_fault, Diagnostic::EmergencyStop.number());
}

#[test]
fn a_soft_stop_brakes_the_nominal_in_equal_steps_and_lets_the_torque_go_in_equal_ones() {
    let (mut c, mut robot, mut k) = engaged([0.0, 0.0, 8.0], |_| ());
    let speed = c.outputs.dp_n[2];
    assert!(speed > 0.1, "{speed}");
    let before = c.outputs.p_n[2];
    c.inputs.ft_valid = 0;
    let mut last = before;
    for j in 0..=500 {
        close_the_loop(&mut c, &mut robot, k, [0.0, 0.0, 8.0]);
        k += 1;
        assert_eq!(c.outputs.state, State::SoftStop.number());
        assert_eq!(c.outputs.authority, 1.0 - f64::from(j) / 500.0);
        // p_n is shown as q + e_nr, before the motion of the sample: the mid-step speed shows one tick later. It is within
        // its limit but for the rounding of the difference; the spring does not slip here.
        let moved = (c.outputs.p_n[2] - last) / 0.001;
        last = c.outputs.p_n[2];
        let limit = match j {
            0 => continue,
            _ => speed * (1.0 - f64::from(j.min(50)) / 50.0),
        };
        assert!(
            moved.abs() <= limit + 1e-12,
            "{moved} at {j}, at most {limit}"
        );
    }
    assert_eq!(c.outputs.tau_a, [0.0; 3]);
    // Equal steps over 50 ticks: it goes on for half of what it would have gone.
    assert!(c.outputs.p_n[2] - before <= speed * 0.5 * 0.05 + speed * 0.001);
    close_the_loop(&mut c, &mut robot, k, [0.0, 0.0, 8.0]);
    assert_eq!(c.outputs.state, State::Fault.number());
    assert_eq!(c.outputs.first_fault, Diagnostic::FtInvalid.number());
}

#[test]
fn a_result_that_is_not_finite_is_a_fault_with_a_name_and_no_error() {
    // Under `standard` nothing slips: pushed like this the demand outgrows every number.
    let (mut c, robot, mut k) = engaged([0.0, 0.0, 8.0], |c| c.parameters.law = 1);
    (c.inputs.q, c.inputs.f_h) = (robot.q.into(), [0.0, 0.0, 1e308]);
    while c.outputs.state == State::Engaged.number() {
        assert!(
            c.outputs.tau_a.iter().all(|tau| tau.is_finite()) && k < 1800,
            "{c:?}"
        );
        tick(&mut c, k);
        k += 1;
    }
    let p = Kinematics::default().at(&robot.q).p;
    assert_eq!(
        (c.outputs.tau_a, c.outputs.state),
        ([0.0; 3], State::Fault.number())
    );
    assert_eq!(c.outputs.diagnostic, Diagnostic::NotFinite.number());
    assert_eq!(c.outputs.first_fault, Diagnostic::NotFinite.number());
    assert_eq!((c.outputs.p, c.outputs.p_n), (p.into(), p.into())); // it rests where the arm is
    assert!(c.outputs.G.is_finite());
    c.inputs.f_h = [0.0; 3];
    tick(&mut c, k);
    assert_eq!(c.outputs.diagnostic, Diagnostic::NotAcknowledged.number());
    c.inputs.acknowledge = 1;
    tick(&mut c, k + 1);
    assert_eq!(
        (c.outputs.state, c.outputs.first_fault),
        (State::Off.number(), 0)
    );
}

#[test]
fn angles_and_forces_that_are_not_numbers_are_invalid_whatever_is_said_of_them() {
    let (mut c, _, k) = engaged([0.0, 0.0, 8.0], |_| ());
    let p = c.outputs.p;
    c.inputs.q[1] = f64::NAN;
    tick(&mut c, k);
    assert_eq!((c.outputs.tau_a, c.outputs.p), ([0.0; 3], p));
    assert_eq!(c.outputs.first_fault, Diagnostic::EncoderInvalid.number());

    let (mut c, _, k) = engaged([0.0, 0.0, 8.0], |_| ());
    c.inputs.f_h[0] = f64::NAN;
    tick(&mut c, k);
    assert_eq!(c.outputs.state, State::SoftStop.number());
    assert!(c.outputs.tau_a.iter().all(|tau| tau.is_finite()) && c.outputs.tau_a[1].abs() > 1.0);
    assert_eq!(c.outputs.first_fault, Diagnostic::FtInvalid.number());
}

#[test]
fn without_supervision_its_inputs_do_nothing() {
    let run = |spoil: fn(&mut ArmController)| {
        let mut c = initialized(spoil);
        let mut robot = Robot::at_the_start();
        (0..500)
            .map(|k| {
                close_the_loop(&mut c, &mut robot, k, [1.0, 2.0, 8.0]);
                assert_eq!(
                    (c.outputs.state, c.outputs.diagnostic, c.outputs.authority),
                    (State::Engaged.number(), 0, 1.0)
                );
                c.outputs.tau_a
            })
            .collect::<Vec<_>>()
    };
    let spoilt = run(|c| {
        (
            c.inputs.enable,
            c.inputs.acknowledge,
            c.inputs.emergency_stop,
        ) = (1, 1, 1);
        (
            c.parameters.supervisor.hold_enter,
            c.parameters.supervisor.hold_leave,
        ) = (100.0, 100.0);
    });
    assert!(run(|_| ()) == spoilt);
}

#[test]
fn its_parameters_are_refused_by_name_value_and_range_when_it_is_on() {
    let refused = |change: fn(&mut ArmController)| {
        let mut c = controller(change);
        c.parameters.supervision = 1;
        c.initialize(0.0, &mut Log::silent()).unwrap_err().0
    };
    assert_eq!(
        refused(|c| c.parameters.supervisor.engage_time = -1.0),
        "engage_time = -1: expected a finite value not less than 0"
    );
    assert_eq!(
        refused(|c| c.parameters.supervisor.hold_enter = 1.0),
        "hold_leave = 0: expected a value not less than hold_enter"
    );
}
