//! Joint limits inside the law: where the nominal stops, how it comes there, and how it comes back.

use crate::robot::{Robot, close_the_loop};
use crate::{ArmController, initialized, tick};
use arm_law::kinematics::Kinematics;
use arm_law::workspace::Workspace;
use nalgebra::Vector3;

/// Joint angles at which the handle is at `p`, by the law of cosines; the elbow bends upwards.
fn angles(p: &[f64; 3]) -> [f64; 3] {
    let Kinematics {
        A1, L1, handle_x, ..
    } = Kinematics::default();
    let (x, z) = (p[0].hypot(p[1]) - A1, p[2]);
    let square = x * x + z * z;
    let elbow = ((square - L1 * L1 - handle_x * handle_x) / (2.0 * L1 * handle_x)).clamp(-1.0, 1.0);
    let q_3 = elbow.acos();
    let q_2 = z.atan2(x) - (handle_x * q_3.sin()).atan2(L1 + handle_x * q_3.cos());
    [p[1].atan2(p[0]), q_2, q_3]
}

/// Pushed by `f_h` (N) for 6 s: the least and the largest angles of the nominal, and whether it was held.
fn pushed(c: &mut ArmController, robot: &mut Robot, from: u32, f_h: [f64; 3]) -> [[f64; 3]; 2] {
    let (mut least, mut most) = ([f64::MAX; 3], [f64::MIN; 3]);
    for k in from..from + 6000 {
        close_the_loop(c, robot, k, f_h);
        let q_n = angles(&c.outputs.p_n);
        for i in 0..3 {
            least[i] = least[i].min(q_n[i]);
            most[i] = most[i].max(q_n[i]);
        }
    }
    [least, most]
}

const WAYS: [[f64; 3]; 6] = [
    [10.0, 0.0, 0.0],
    [-10.0, 0.0, 0.0],
    [0.0, 10.0, 0.0],
    [0.0, -10.0, 0.0],
    [0.0, 0.0, 10.0],
    [7.0, 7.0, 7.0],
];

/// In task space the limits are known to first order at the robot, which the nominal is a few millimetres ahead of: by the
/// elbow's 12 rad/m that is a few hundredths of a radian.
#[test]
fn pushed_to_any_end_the_nominal_stops_at_a_limit_and_the_same_force_brings_the_robot_back() {
    let Workspace { q_min, q_max, .. } = Workspace::default();
    for f_h in WAYS {
        for space in [1, 2] {
            let mut c = initialized(|c| c.parameters.space = space);
            let mut robot = Robot::at_the_start();
            let start = Vector3::from(c.outputs.p);
            let [least, most] = pushed(&mut c, &mut robot, 0, f_h);
            let room = if space == 1 { 0.06 } else { 1e-12 };
            for i in 0..3 {
                let within = least[i] >= q_min[i] - room && most[i] <= q_max[i] + room;
                assert!(within, "{f_h:?} in space {space}: {least:?} {most:?}");
            }
            assert!(c.outputs.held != 0, "{f_h:?} in space {space}");
            let way = (Vector3::from(c.outputs.p) - start).dot(&Vector3::from(f_h));
            pushed(&mut c, &mut robot, 6000, f_h.map(|f| -f));
            let back = (Vector3::from(c.outputs.p) - start).dot(&Vector3::from(f_h));
            assert!(way > 0.5 && back < 0.0, "{f_h:?}: {way} {back}");
            assert!(c.outputs.tank >= 10.0 - 1e-9 && c.outputs.share == 1.0);
        }
    }
}

/// What the limits cost where they do not act: nothing, to the bit.
#[test]
fn before_a_limit_acts_every_output_is_what_it_is_without_limits() {
    let mut with = initialized(|_| ());
    let mut without = initialized(|c| c.parameters.workspace.limited = 0);
    let (mut a, mut b) = (Robot::at_the_start(), Robot::at_the_start());
    let mut compared = 0;
    for k in 0..3000 {
        close_the_loop(&mut with, &mut a, k, [10.0, 0.0, 0.0]);
        close_the_loop(&mut without, &mut b, k, [10.0, 0.0, 0.0]);
        if with.outputs.held != 0 {
            break;
        }
        assert_eq!(with.outputs, without.outputs);
        compared += 1;
    }
    assert!((200..3000).contains(&compared), "{compared} ticks");
}

/// In joint space the way to a limit is a closed form: dq_n = (q_max − q_n)/t_s, so that a tenth is left after ln 10 t_s.
#[test]
fn a_joint_comes_to_its_limit_exponentially() {
    let mut c = initialized(|c| {
        (c.parameters.space, c.parameters.law) = (2, 1); // no reaction: the nominal alone
        c.inputs.f_h = [0.0, 60.0, 0.0];
    });
    let (mut first, mut k) = (None, 0);
    let q_max = c.parameters.workspace.q_max[0];
    while c.outputs.q_n[0] < q_max - 1e-6 && k < 10_000 {
        tick(&mut c, k);
        if c.outputs.held != 0 && first.is_none() {
            first = Some((k, q_max - c.outputs.q_n[0]));
        }
        if let Some((begun, left)) = first {
            let ticks = i32::try_from(k - begun).expect("few ticks");
            let expected = left * (1.0 - 0.001_f64 / 0.2).powi(ticks);
            let error = (q_max - c.outputs.q_n[0] - expected).abs();
            assert!(error < 1e-12, "tick {k}: {error}"); // a rounding of q_n a tick
        }
        k += 1;
    }
    assert!(
        first.is_some() && k < 10_000,
        "{first:?} {}",
        c.outputs.q_n[0]
    );
}

#[test]
fn an_arm_that_engages_beyond_a_limit_may_only_come_back() {
    let engaged = |f_h: [f64; 3]| {
        let mut c = initialized(|c| {
            c.inputs.q = [0.0, -0.5, 0.3]; // straighter than workspace.q_min[3] = 0.5
            (c.inputs.f_h, c.parameters.law) = (f_h, 1);
        });
        (0..2000).for_each(|k| tick(&mut c, k));
        (angles(&c.outputs.p_n)[2], c.outputs.held != 0)
    };
    let (out, held) = engaged([10.0, 0.0, -3.0]);
    assert!(held && (out - 0.3).abs() < 1e-3, "{out}"); // curvature of a step along the sphere
    let (back, held) = engaged([-10.0, 0.0, 3.0]);
    assert!(!held && back > 0.32, "{back}");
}

#[test]
fn a_hold_beside_a_limit_is_still_a_hold() {
    let mut c = initialized(|c| {
        c.inputs.q = [0.0, -0.5, 0.45];
        (c.inputs.f_h, c.inputs.hold) = ([10.0, 5.0, 5.0], 1);
    });
    tick(&mut c, 0);
    let p_n = c.outputs.p_n;
    (1..1000).for_each(|k| tick(&mut c, k));
    assert_eq!(c.outputs.p_n, p_n);
}
