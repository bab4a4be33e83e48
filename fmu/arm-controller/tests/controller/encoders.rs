//! Joint angles that cannot be: what reaches the joints.

use crate::robot::{Robot, close_the_loop};
use crate::{ArmController, initialized, step, tick};
use admittance::encoder::Fault;
use arm_law::choices::DEBT;
use arm_law::kinematics::Kinematics;
use arm_law::supervision::{Diagnostic, State};
use fmu_export::Model;

/// A push that moves the arm up.
const PUSH: [f64; 3] = [2.0, 3.0, 8.0];

/// A controller in the loop whose handle has been pushed for a second and a half, and its robot.
fn running(change: impl FnOnce(&mut ArmController)) -> (ArmController, Robot, u32) {
    let mut c = initialized(|c| {
        c.parameters.supervisor.heartbeat_timeout = 0.0;
        change(c);
    });
    let mut robot = Robot::at_the_start();
    let mut k = 0;
    if c.parameters.supervision != 0 {
        (c.inputs.enable, c.inputs.engage) = (1, 0);
        (0..102).for_each(|_| {
            tick(&mut c, k);
            k += 1;
        });
        c.inputs.engage = 1;
    }
    for _ in 0..1500 {
        close_the_loop(&mut c, &mut robot, k, PUSH);
        k += 1;
    }
    assert_eq!(c.outputs.state, State::Engaged.number());
    (c, robot, k)
}

/// One tick at which the angle of joint `joint` reads `error` (rad) too much.
fn misread(c: &mut ArmController, robot: &mut Robot, k: u32, joint: usize, error: f64) {
    let mut q = robot.q;
    q[joint] += error;
    (c.inputs.q, c.inputs.f_h) = (q.into(), PUSH);
    tick(c, k);
    robot.advance(&c.outputs.tau_a.into(), &PUSH.into());
}

fn farthest(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    (0..3).fold(0.0, |most: f64, i| most.max((a[i] - b[i]).abs()))
}

#[test]
fn one_wrong_angle_changes_no_torque_by_more_than_its_motion_would() {
    for law in 1..=4 {
        for space in [1, 2] {
            for supervision in [0, 1] {
                for (joint, error) in [(2, 0.5), (0, -0.5), (1, 1e3), (2, 0.02)] {
                    let (mut c, mut robot, k) = running(|c| {
                        (c.parameters.law, c.parameters.space) = (law, space);
                        c.parameters.supervision = supervision;
                    });
                    let (mut twin, mut true_robot) = (c.clone(), Robot { ..robot });
                    misread(&mut c, &mut robot, k, joint, error);
                    assert!(c.outputs.encoder_fault != 0 && c.outputs.outside_bounds != 0);
                    assert_eq!(c.outputs.state, State::Engaged.number());
                    if supervision != 0 {
                        assert_eq!(c.outputs.diagnostic, Diagnostic::OutsideBounds.number());
                    }
                    close_the_loop(&mut twin, &mut true_robot, k, PUSH);
                    // It goes on at its last velocity: the acceleration of one sample is what it does not know.
                    let mut most = farthest(&c.outputs.tau_a, &twin.outputs.tau_a);
                    for k in k + 1..k + 20 {
                        close_the_loop(&mut c, &mut robot, k, PUSH);
                        close_the_loop(&mut twin, &mut true_robot, k, PUSH);
                        most = most.max(farthest(&c.outputs.tau_a, &twin.outputs.tau_a));
                        assert_eq!(c.outputs.encoder_fault, 0);
                    }
                    assert!(
                        most < 1.0,
                        "law {law}, space {space}, {error} rad: {most} N·m"
                    );
                    assert_eq!(c.outputs.debt, 0);
                }
            }
        }
    }
}

#[test]
fn the_same_angle_without_the_check_asks_for_all_that_the_joints_can_give() {
    let (mut c, mut robot, k) = running(|c| {
        (c.parameters.law, c.parameters.encoder.samples) = (2, 0);
    });
    misread(&mut c, &mut robot, k, 2, 0.5);
    assert!(farthest(&c.outputs.tau_a, &[0.0; 3]) > 100.0);
}

#[test]
fn an_angle_that_stays_wrong_takes_the_torque_at_the_fifth_reading_and_engages_anew_after_five() {
    let (mut c, robot, k) = running(|_| ());
    let mut q = robot.q;
    q[2] += 0.5;
    c.inputs.q = q.into();
    let mut story = Vec::new();
    for k in k..k + 10 {
        tick(&mut c, k);
        story.push((c.outputs.encoder_fault, c.outputs.engaged));
    }
    let (doubted, lost, anew) = ((Fault::Jump.number(), 1), (Fault::Jump.number(), 0), (0, 1));
    assert_eq!(
        story,
        [
            [doubted; 4].as_slice(),
            [lost; 5].as_slice(),
            [anew; 1].as_slice()
        ]
        .concat()
    );
    let p: [f64; 3] = Kinematics::default().at(&q).p.into();
    assert_eq!((c.outputs.p, c.outputs.p_n), (p, p));
    assert!(farthest(&c.outputs.tau_a, &[0.0; 3]) < 1.0); // nothing but the hand's push
    assert!(c.outputs.tank >= 0.0, "{} J", c.outputs.tank);
}

#[test]
fn under_supervision_an_angle_that_stays_wrong_is_a_fault_with_a_name() {
    let (mut c, robot, k) = running(|c| c.parameters.supervision = 1);
    let mut q = robot.q;
    q[1] -= 0.5;
    c.inputs.q = q.into();
    for k in k..k + 4 {
        tick(&mut c, k);
        assert_eq!(c.outputs.state, State::Engaged.number());
    }
    for k in k + 4..k + 20 {
        tick(&mut c, k);
        assert_eq!(c.outputs.tau_a, [0.0; 3]);
        assert_eq!(c.outputs.state, State::Fault.number());
        assert_eq!(c.outputs.first_fault, Diagnostic::EncoderInvalid.number());
    }
    assert_eq!(c.outputs.encoder_fault, 0); // the angles are sound again, the fault waits to be acknowledged
    assert_eq!(c.outputs.diagnostic, Diagnostic::NotAcknowledged.number());
}

#[test]
fn an_angle_beyond_every_joint_is_named_and_gives_no_torque() {
    for q in [1e300, -7.0] {
        let (mut c, _, k) = running(|_| ());
        c.inputs.q[0] = q;
        for k in k..k + 30 {
            tick(&mut c, k);
            assert_eq!(c.outputs.encoder_fault, Fault::OverRange.number());
        }
        assert_eq!((c.outputs.tau_a, c.outputs.engaged), ([0.0; 3], 0));
    }
}

#[test]
fn angles_marked_invalid_give_no_torque_in_that_tick_and_the_law_engages_anew_after() {
    for law in 1..=4 {
        let (mut c, mut robot, k) = running(|c| c.parameters.law = law);
        assert!(c.outputs.tau_a[1].abs() > 1.0);
        c.inputs.encoder_valid = 0;
        close_the_loop(&mut c, &mut robot, k, PUSH);
        assert_eq!((c.outputs.tau_a, c.outputs.engaged), ([0.0; 3], 0));
        assert_eq!(c.outputs.encoder_fault, Fault::Invalid.number());
        assert_eq!(c.outputs.state, State::Off.number());
        c.inputs.encoder_valid = 1;
        close_the_loop(&mut c, &mut robot, k + 1, PUSH);
        assert_eq!((c.outputs.engaged, c.outputs.e_nr), (1, [0.0; 3]));
        assert_eq!(c.outputs.encoder_fault, 0);
    }
}

#[test]
fn an_angle_that_stands_still_under_a_rising_torque_is_stuck() {
    let (mut c, mut robot, k) = running(|c| c.parameters.encoder.stuck_torque = [0.0, 20.0, 0.0]);
    let stuck = robot.q[1];
    let mut named = None;
    for k in k..k + 2000 {
        let mut q = robot.q;
        q[1] = stuck;
        (c.inputs.q, c.inputs.f_h) = (q.into(), PUSH);
        tick(&mut c, k);
        robot.advance(&c.outputs.tau_a.into(), &PUSH.into());
        if c.outputs.encoder_fault != 0 {
            named = Some(c.outputs.encoder_fault);
            break;
        }
    }
    assert_eq!(named, Some(Fault::Stuck.number()));
    assert_eq!(c.outputs.tau_a, [0.0; 3]);
}

#[test]
fn a_communication_step_of_several_ticks_is_no_jump() {
    // 5 rad/s, within dq_max: 5 mrad a tick, 50 mrad a step of ten.
    for ticks in [1_u32, 2, 3, 10] {
        let mut c = initialized(|_| ());
        let start = c.inputs.q[0];
        for k in 0..40 {
            c.inputs.q[0] = start + 0.005 * f64::from(k * ticks);
            step(&mut c, k, 0.001 * f64::from(ticks));
            assert_eq!(c.outputs.encoder_fault, 0, "{ticks} ticks, step {k}");
        }
        c.inputs.q[0] += 0.017 * f64::from(ticks); // beyond dq_max, and 12 rad/s more than before
        step(&mut c, 40, 0.001 * f64::from(ticks));
        assert_eq!(c.outputs.encoder_fault, Fault::Jump.number());
    }
}

#[test]
fn no_torque_for_want_of_energy_is_a_state_of_its_own() {
    let (mut c, mut robot, k) = running(|c| {
        (c.parameters.encoder.samples, c.parameters.E_0) = (0, 0.1);
    });
    let along = 3.0 * c.outputs.tau_a[1].signum(); // what the torque seems to have done, nobody has brought
    misread(&mut c, &mut robot, k, 1, along);
    close_the_loop(&mut c, &mut robot, k + 1, PUSH);
    assert_eq!((c.outputs.debt, c.outputs.state), (1, DEBT));
    assert_eq!(c.outputs.tau_a, [0.0; 3]);
}

#[test]
fn the_start_shows_angles_over_range_by_name() {
    let mut c = crate::controller(|c| c.inputs.q[1] = 8.0);
    c.initialize(0.0, &mut fmu_export::Log::silent())
        .expect("they may be wired later");
    assert_eq!(c.outputs.encoder_fault, Fault::OverRange.number());
}
