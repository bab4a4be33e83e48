//! The ledger at the joints, and what `passive_bounded` promises.

use crate::axes::world;
use crate::robot::{Robot, close_the_loop};
use crate::{ArmController, T, initialized, tick};
use nalgebra::Vector3;

/// The human at tick `k`: sines on all axes, a hard push into the floor, a lift, sideways.
fn human(k: u32) -> [f64; 3] {
    let t = T * f64::from(k);
    let wave = |f: f64| (std::f64::consts::TAU * f * t).sin();
    match t {
        t if t < 2.0 => [7.0 * wave(0.8), 5.0 * wave(0.6), 4.0 * wave(0.7)],
        t if t < 5.0 => [0.0, 0.0, -20.0],
        t if t < 6.5 => [4.0, 0.0, 10.0],
        t if t < 8.0 => [0.0, 9.0, -25.0],
        _ => [-6.0 * wave(0.5), 4.0 * wave(0.9), 3.0],
    }
}

#[test]
fn passive_bounded_keeps_the_spring_within_f_max_and_creates_no_energy() {
    // f_max that the joints can deliver in this region, so that only f_max limits.
    for f_max in [120.0, 60.0] {
        let mut c = initialized(|c| c.parameters.f_max = [f_max; 3]);
        let mut robot = Robot::at_the_start();
        let (mut bound, mut contact) = (0, 0);
        for k in 0..10_000 {
            close_the_loop(&mut c, &mut robot, k, human(k));
            for i in 0..3 {
                let spring = (c.parameters.K[i] * c.parameters.K_P[i] * c.outputs.e_nr[i]).abs();
                assert!(spring <= f_max * (1.0 + 1e-15), "tick {k}: {spring} N"); // the product's rounding
                bound += u32::from(spring >= f_max * (1.0 - 1e-9));
                assert!(
                    c.outputs.f_a[i].abs() <= f_max * (1.0 + 1e-15),
                    "tick {k}: {} N",
                    c.outputs.f_a[i]
                ); // as above
            }
            contact += u32::from(c.outputs.p[2] < -0.30);
            assert!(c.outputs.G <= 1e-12, "tick {k}: {} J", c.outputs.G); // rounding of H, some 10 J
            assert!(c.outputs.tank > 9.9, "tick {k}: {} J", c.outputs.tank); // K T Δv²/4 a touch-down
        }
        assert!(bound > 100 && contact > 1000, "{bound} {contact}");
        assert!(c.outputs.G < -10.0, "{} J", c.outputs.G);
    }
}

#[test]
fn with_joints_that_cannot_deliver_f_max_it_still_creates_none_here() {
    let mut c = initialized(|c| c.parameters.tau_max = [60.0, 80.0, 50.0]);
    let mut robot = Robot::at_the_start();
    let mut scaled = 0;
    for k in 0..10_000 {
        close_the_loop(&mut c, &mut robot, k, human(k));
        let delivered: f64 = Vector3::from(c.outputs.f_a).amax();
        scaled += u32::from(c.outputs.saturated != 0 && delivered < 399.0);
        assert!((0..3).all(
            |i| (c.parameters.K[i] * c.parameters.K_P[i] * c.outputs.e_nr[i]).abs()
                <= 400.0 * (1.0 + 1e-15)
        )); // rounding
        assert!(c.outputs.G <= 1e-12, "tick {k}: {} J", c.outputs.G); // as above
        assert!(c.outputs.tank > 9.0, "tick {k}: {} J", c.outputs.tank);
    }
    assert!(scaled > 500, "{scaled}");
}

/// The negative control: for 5 s the robot is moved against a human who keeps the yaw joint saturated. The nominal of the
/// paper's law feels the full y all the while, so that K f_h·Δp is
/// accounted for where the robot gives f_a·Δp, less the nominal's own damping K D_n v_n².
#[test]
fn the_paper_s_law_creates_energy_once_saturated_and_the_ledger_sees_it() {
    let created = |law| {
        let mut c = initialized(|c| (c.parameters.law, c.inputs.f_h) = (law, [0.0, -10.0, 0.0]));
        let (mut settled, mut way) = (0.0, 0.0);
        for k in 0..10_000 {
            if k == 5000 {
                (settled, way) = (c.outputs.G, 0.2 * 0.44 * 5.0);
            }
            if k > 5000 {
                c.inputs.q[0] += 0.2 * T;
            }
            c.inputs.f_h = [10.0 * c.inputs.q[0].sin(), -10.0 * c.inputs.q[0].cos(), 0.0]; // along the handle's path
            tick(&mut c, k);
        }
        (c.outputs.G - settled, way)
    };
    let (paper, way) = created(2);
    let expected = (10_000.0 - 153.0 / 0.44) * way - 1000.0 * 20.0 * 0.088 * way;
    assert!(
        (paper / expected - 1.0).abs() < 0.02,
        "{paper} J, {expected} J"
    ); // settling to the new speed takes 0.7 of 5 s
    let (bounded, _) = created(4);
    assert!(bounded <= 0.0, "{bounded} J");
}

/// G again, from the interface alone: ΔG = ΔH + tau·Δq − (K/alpha) f_h·v_m T, v_m by the law's own q_n⁺ = q_n + T v_m.
fn recounted(change: fn(&mut ArmController), delay: usize) {
    let mut c = initialized(|c| {
        c.parameters.delay = delay as i32;
        change(c);
    });
    let mut taus = vec![Vector3::zeros(); delay];
    let (mut G, mut last) = (0.0, None::<ArmController>);
    for k in 0..3000 {
        let (q, f_h) = world(k);
        (c.inputs.q, c.inputs.f_h) = (q, f_h.map(|f| 10.0 * f));
        tick(&mut c, k);
        taus.push(Vector3::from(c.outputs.tau_a));
        if let Some(last) = &last {
            let tau = taus[k as usize - 1];
            // No spring slips here, so the nominal's way is T v_m.
            let supplied: f64 = (0..3)
                .map(|i| {
                    c.parameters.K[i]
                        * last.inputs.f_h[i]
                        * (c.outputs.p_n[i] - last.outputs.p_n[i])
                })
                .sum();
            let way = Vector3::from(c.inputs.q) - Vector3::from(last.inputs.q);
            G += c.outputs.H - last.outputs.H + tau.dot(&way) - supplied;
        }
        last = Some(c.clone());
        let scale = 1.0 + G.abs() + c.outputs.H;
        assert!(
            (c.outputs.G - G).abs() < 1e-9 * scale,
            "tick {k}: {} {G}",
            c.outputs.G
        ); // p_n's 1e-16 m times K f_h, 3000 times
    }
    assert!(G.abs() > 1.0, "{G}");
}

#[test]
fn G_is_the_energy_balance_at_the_joints() {
    recounted(|c| c.parameters.law = 2, 0);
    recounted(
        |c| {
            (
                c.parameters.law,
                c.parameters.torque_limiting,
                c.parameters.tau_max,
            ) = (2, 2, [3.0; 3])
        },
        0,
    );
    recounted(
        |c| (c.parameters.law, c.parameters.tau_max) = (1, [3.0; 3]),
        0,
    );
}

#[test]
fn a_delayed_torque_works_one_sample_later() {
    recounted(|c| c.parameters.law = 2, 1);
    recounted(
        |c| (c.parameters.law, c.parameters.tau_max) = (3, [3.0; 3]),
        1,
    );
}

#[test]
fn with_alpha_zero_the_energy_is_not_defined_and_shown_as_zero() {
    let mut c = initialized(|c| (c.parameters.alpha, c.inputs.f_h) = (0.0, [6.0; 3]));
    assert_eq!(c.outputs.tank, 0.0);
    (0..100).for_each(|k| tick(&mut c, k));
    assert_eq!((c.outputs.H, c.outputs.G, c.outputs.tank), (0.0, 0.0, 0.0));
    assert!(c.outputs.f_a[0] > 0.0);
}
