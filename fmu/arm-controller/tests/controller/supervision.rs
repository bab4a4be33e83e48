//! Supervision in the controller: what reaches the joints.

use crate::robot::{Robot, close_the_loop};
use crate::{controller, initialized, tick};
use arm_controller::ArmController;
use arm_law::kinematics::Kinematics;
use arm_law::supervision::{Diagnostic, State};
use export::{Log, Model};

/// Supervised, ready for an edge of engage after the ticks from 0 to 101.
fn ready(change: impl FnOnce(&mut ArmController)) -> (ArmController, u32) {
    let mut c = initialized(|c| {
        (c.supervision, c.enable, c.engage) = (true, true, false);
        c.heartbeat_timeout = 0.0;
        change(c);
    });
    (0..102).for_each(|k| tick(&mut c, k));
    assert_eq!(c.state, State::Ready.number());
    (c, 102)
}

/// Engaged with full authority, its handle pushed by `f_h` (N), on a robot that moves.
fn engaged(f_h: [f64; 3], change: impl FnOnce(&mut ArmController)) -> (ArmController, Robot, u32) {
    let (mut c, mut k) = ready(change);
    let mut robot = Robot::at_the_start();
    c.engage = true;
    for _ in 0..1500 {
        close_the_loop(&mut c, &mut robot, k, f_h);
        k += 1;
    }
    assert_eq!((c.state, c.authority), (State::Engaged.number(), 1.0));
    (c, robot, k)
}

#[test]
fn the_first_torque_is_zero_and_those_of_the_ramp_are_the_law_s_times_the_authority() {
    let (mut c, mut k) = ready(|c| c.f_h = [3.0, -20.0, 40.0]);
    c.engage = true;
    tick(&mut c, k);
    assert_eq!((c.tau_a, c.engaged, c.authority), ([0.0; 3], true, 0.0));
    let mut robot = Robot::at_the_start();
    for n in 1..=500 {
        k += 1;
        close_the_loop(&mut c, &mut robot, k, [3.0, -20.0, 40.0]);
        assert_eq!(c.authority, f64::from(n) / 500.0);
        for i in 0..3 {
            // Nothing saturates here. The rounding of three products and their sum.
            let expected = c.authority * c.tau_demand[i];
            assert!(
                (c.tau_a[i] - expected).abs() <= 1e-12,
                "{} {expected}",
                c.tau_a[i]
            );
        }
    }
    assert!(c.tau_a.iter().any(|tau| tau.abs() > 1.0), "{:?}", c.tau_a);
}

#[test]
fn engaging_anew_starts_from_where_the_arm_is() {
    let (mut c, mut robot, mut k) = engaged([0.0, 0.0, 8.0], |_| ());
    c.engage = false;
    for _ in 0..650 {
        close_the_loop(&mut c, &mut robot, k, [0.0, 0.0, 8.0]);
        k += 1;
    }
    assert_eq!((c.state, c.tau_a), (State::Ready.number(), [0.0; 3]));
    robot.q[1] += 0.1;
    c.engage = true;
    close_the_loop(&mut c, &mut robot, k, [0.0, 0.0, 8.0]);
    assert_eq!((c.tau_a, c.e_nr, c.dp_n), ([0.0; 3], [0.0; 3], [0.0; 3]));
}

#[test]
fn an_emergency_stop_takes_the_torque_of_its_tick() {
    let (mut c, mut robot, k) = engaged([0.0, 0.0, 8.0], |_| ());
    assert!(c.tau_a[1].abs() > 1.0);
    c.emergency_stop = true;
    close_the_loop(&mut c, &mut robot, k, [0.0, 0.0, 8.0]);
    assert_eq!((c.tau_a, c.state), ([0.0; 3], State::Fault.number()));
    assert_eq!(c.first_fault, Diagnostic::EmergencyStop.number());
}

#[test]
fn a_soft_stop_brakes_the_nominal_in_equal_steps_and_lets_the_torque_go_in_equal_ones() {
    let (mut c, mut robot, mut k) = engaged([0.0, 0.0, 8.0], |_| ());
    let speed = c.dp_n[2];
    assert!(speed > 0.1, "{speed}");
    let before = c.p_n[2];
    c.ft_valid = false;
    let mut last = before;
    for j in 0..=500 {
        close_the_loop(&mut c, &mut robot, k, [0.0, 0.0, 8.0]);
        k += 1;
        assert_eq!(c.state, State::SoftStop.number());
        assert_eq!(c.authority, 1.0 - f64::from(j) / 500.0);
        // p_n is shown as q + e_nr, before the motion of the sample: the mid-step speed shows one tick later. It is within
        // its limit but for the rounding of the difference; the spring does not slip here.
        let moved = (c.p_n[2] - last) / 0.001;
        last = c.p_n[2];
        let limit = match j {
            0 => continue,
            _ => speed * (1.0 - f64::from(j.min(50)) / 50.0),
        };
        assert!(
            moved.abs() <= limit + 1e-12,
            "{moved} at {j}, at most {limit}"
        );
    }
    assert_eq!(c.tau_a, [0.0; 3]);
    // Equal steps over 50 ticks: it goes on for half of what it would have gone.
    assert!(c.p_n[2] - before <= speed * 0.5 * 0.05 + speed * 0.001);
    close_the_loop(&mut c, &mut robot, k, [0.0, 0.0, 8.0]);
    assert_eq!(c.state, State::Fault.number());
    assert_eq!(c.first_fault, Diagnostic::FtInvalid.number());
}

#[test]
fn a_result_that_is_not_finite_is_a_fault_with_a_name_and_no_error() {
    // Under `standard` nothing slips: pushed like this the demand outgrows every number.
    let (mut c, robot, mut k) = engaged([0.0, 0.0, 8.0], |c| c.law = 1);
    (c.q, c.f_h) = (robot.q.into(), [0.0, 0.0, 1e308]);
    while c.state == State::Engaged.number() {
        assert!(
            c.tau_a.iter().all(|tau| tau.is_finite()) && k < 1800,
            "{c:?}"
        );
        tick(&mut c, k);
        k += 1;
    }
    let p = Kinematics::default().at(&robot.q).p;
    assert_eq!((c.tau_a, c.state), ([0.0; 3], State::Fault.number()));
    assert_eq!(c.diagnostic, Diagnostic::NotFinite.number());
    assert_eq!(c.first_fault, Diagnostic::NotFinite.number());
    assert_eq!((c.p, c.p_n), (p.into(), p.into())); // it rests where the arm is
    assert!(c.energy.G.is_finite());
    c.f_h = [0.0; 3];
    tick(&mut c, k);
    assert_eq!(c.diagnostic, Diagnostic::NotAcknowledged.number());
    c.acknowledge = true;
    tick(&mut c, k + 1);
    assert_eq!((c.state, c.first_fault), (State::Off.number(), 0));
}

#[test]
fn angles_and_forces_that_are_not_numbers_are_invalid_whatever_is_said_of_them() {
    let (mut c, _, k) = engaged([0.0, 0.0, 8.0], |_| ());
    let p = c.p;
    c.q[1] = f64::NAN;
    tick(&mut c, k);
    assert_eq!((c.tau_a, c.p), ([0.0; 3], p));
    assert_eq!(c.first_fault, Diagnostic::EncoderInvalid.number());

    let (mut c, _, k) = engaged([0.0, 0.0, 8.0], |_| ());
    c.f_h[0] = f64::NAN;
    tick(&mut c, k);
    assert_eq!(c.state, State::SoftStop.number());
    assert!(c.tau_a.iter().all(|tau| tau.is_finite()) && c.tau_a[1].abs() > 1.0);
    assert_eq!(c.first_fault, Diagnostic::FtInvalid.number());
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
                    (c.state, c.diagnostic, c.authority),
                    (State::Engaged.number(), 0, 1.0)
                );
                c.tau_a
            })
            .collect::<Vec<_>>()
    };
    let spoilt = run(|c| {
        (c.enable, c.acknowledge, c.emergency_stop) = (true, true, true);
        c.encoder_valid = false;
        (c.hold_enter, c.hold_leave) = (100.0, 100.0);
    });
    assert!(run(|_| ()) == spoilt);
}

#[test]
fn its_parameters_are_refused_by_name_value_and_range_when_it_is_on() {
    let refused = |change: fn(&mut ArmController)| {
        let mut c = controller(change);
        c.supervision = true;
        c.initialize(0.0, &mut Log::silent()).unwrap_err().0
    };
    assert_eq!(
        refused(|c| c.engage_time = -1.0),
        "engage_time = -1: expected a finite value not less than 0"
    );
    assert_eq!(
        refused(|c| c.hold_enter = 1.0),
        "hold_leave = 0: expected a value not less than hold_enter"
    );
}
