//! Slowing down before a singularity.

use crate::robot::{Robot, close_the_loop};
use crate::{T, initialized, tick};
use arm_law::kinematics::Kinematics;
use arm_law::singularity::Singularity;
use nalgebra::Vector3;

const FREE: Singularity = Singularity {
    sigma_slow: 0.0,
    D: 20.0,
};

#[test]
fn from_sigma_slow_on_nothing_is_added_and_below_it_grows_with_the_inverse_square() {
    let slow = Singularity {
        sigma_slow: 0.1,
        D: 20.0,
    };
    assert_eq!((slow.damping(0.1), slow.damping(0.3)), (0.0, 0.0));
    assert!(!slow.slows(0.1) && slow.slows(0.099));
    assert!((slow.damping(0.05) - 60.0).abs() < 1e-12); // rounding
    assert!(slow.damping(0.1 - 1e-12) < 1e-8, "it begins without a jump");
    assert!((slow.damping(0.0) - 300.0).abs() < 1e-12, "it ends finite");
    assert_eq!(FREE.damping(0.0), 0.0);
}

/// The paper's experiments come down to 0.18 m/rad, the force sensor's bias runs to 0.16.
#[test]
fn the_start_value_lies_below_what_the_scenarios_meet_and_above_a_nearly_straight_arm() {
    let sigma_slow = Singularity::default().sigma_slow;
    assert!(sigma_slow < 0.16);
    let straight = Kinematics::default().at(&Vector3::new(0.0, -0.5, 0.10)); // elbow at its stop
    assert!(
        straight.sigma_min < 0.5 * sigma_slow,
        "{}",
        straight.sigma_min
    );
}

/// A steady push on a robot that follows: the nominal's speed settles at f_h/(D_n + damping).
#[test]
fn the_nominal_s_speed_falls_as_said() {
    let settled = |q_3: f64| {
        let mut c = initialized(|c| {
            c.inputs.q = [0.0, -0.8, q_3];
            (c.inputs.f_h, c.parameters.law) = ([0.0, 5.0, 0.0], 1); // no reaction: the nominal alone
        });
        (0..4000).for_each(|k| tick(&mut c, k));
        (
            c.outputs.dp_n[1],
            c.outputs.sigma_min,
            c.outputs.slowed != 0,
        )
    };
    let (v, _, slowed) = settled(1.7);
    assert!((v - 0.25).abs() < 1e-6 && !slowed, "{v}"); // 5/20 m/s; 4 s are 16 time constants
    let (v, sigma_min, slowed) = settled(0.4);
    let expected = 5.0 / (20.0 + 200.0 * ((0.12 / sigma_min).powi(2) - 1.0));
    assert!(slowed && sigma_min < 0.12);
    assert!((v / expected - 1.0).abs() < 1e-9, "{v} {expected}"); // settled to rounding
}

/// Pulled straight for 4 s, forward and up, then back for 8 s: the least sigma_min, the last one, the most energy created.
fn pulled_straight(singularity: Singularity) -> (f64, f64, f64) {
    let mut c = initialized(|c| {
        c.parameters.singularity = singularity;
        c.parameters.workspace.limited = 0;
    });
    let mut robot = Robot::at_the_start();
    let (mut least, mut most) = (f64::MAX, f64::MIN);
    for k in 0..12_000 {
        let f_h = if k < 4000 {
            [6.0, 0.0, 4.0]
        } else {
            [-6.0, 0.0, 0.0]
        };
        close_the_loop(&mut c, &mut robot, k, f_h);
        assert_eq!(
            c.outputs.slowed != 0,
            c.outputs.sigma_min < singularity.sigma_slow
        );
        least = least.min(c.outputs.sigma_min);
        most = most.max(c.outputs.G);
    }
    (least, c.outputs.sigma_min, most)
}

/// Without it the arm is pulled straight and stays so: what f_max leaves of a pull along the arm is less than the elbow's
/// friction.
#[test]
fn it_slows_before_the_arm_is_straight_and_lets_it_out_again_and_only_dissipates() {
    let (least, last, most) = pulled_straight(Singularity::default());
    assert!(least > 0.045 && last > 0.12, "{least} m/rad, {last} m/rad");
    assert!(most <= 1e-12, "{most} J"); // rounding of H, some 10 J
    let (least, last, _) = pulled_straight(FREE);
    assert!(
        least < 0.001 && last < 0.05,
        "{least} m/rad, {last} m/rad without"
    );
}

/// The arm straight with the handle on the yaw axis and a force that no joint can give: finite all the way.
#[test]
fn at_the_singularity_itself_everything_stays_finite() {
    let mut c = initialized(|c| {
        c.inputs.q = [0.3, -0.7, 0.0];
        c.inputs.f_h = [20.0, -20.0, 20.0];
    });
    assert_eq!(c.outputs.sigma_min, 0.0);
    (0..(1.0 / T) as u32).for_each(|k| tick(&mut c, k));
    assert!(c.outputs.slowed != 0 && c.outputs.f_a.iter().all(|f_a| f_a.is_finite()));
}

/// Clipped joints and no inverse of J: f_a is then what was asked for.
#[test]
fn clipping_at_the_singularity_itself_is_finite_too() {
    let mut c = initialized(|c| {
        (c.parameters.law, c.parameters.torque_limiting) = (2, 2);
        c.parameters.singularity = FREE;
        c.inputs.q = [0.0, 0.0, 0.0];
        c.inputs.f_h = [0.0, 0.0, 20.0];
    });
    (0..4000).for_each(|k| tick(&mut c, k));
    assert!(c.outputs.saturated != 0 && c.outputs.tau_a[1] == 259.0);
    assert!(c.outputs.f_a.iter().all(|f_a| f_a.is_finite()) && c.outputs.f_a[2] > 259.0 / 0.68);
}
