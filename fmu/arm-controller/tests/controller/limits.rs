//! Force and torque limits.

use crate::{ArmController, initialized, tick};
use nalgebra::Vector3;

/// The most that each joint delivers, N·m.
const TAU_MAX: [f64; 3] = [153.0, 259.0, 153.0];

/// Pushed hard for `ticks` against something that does not give way: asks for more than the joints deliver.
fn pushed(ticks: u32, change: impl FnOnce(&mut ArmController)) -> ArmController {
    let mut controller = initialized(|c| {
        c.inputs.f_h = [30.0, -45.0, 60.0];
        change(c);
    });
    (0..ticks).for_each(|k| tick(&mut controller, k));
    controller
}

fn within_tau_max(controller: &ArmController) -> bool {
    (0..3).all(|i| controller.outputs.tau_a[i].abs() <= TAU_MAX[i])
}

#[test]
fn one_common_factor_keeps_the_direction_of_the_force() {
    for law in [1, 2, 3, 4] {
        let c = pushed(4000, |c| c.parameters.law = law);
        assert!(
            c.outputs.saturated != 0 && within_tau_max(&c),
            "law {law}: {:?}",
            c.outputs.tau_a
        );
        let (tau, demand) = (
            Vector3::from(c.outputs.tau_a),
            Vector3::from(c.outputs.tau_demand),
        );
        let nearest = (0..3).map(|i| TAU_MAX[i] - c.outputs.tau_a[i].abs());
        assert!(
            nearest.fold(f64::MAX, f64::min) < 1e-12,
            "law {law}: one joint lives on its limit"
        ); // rounding
        if law != 4 {
            // Under passive_bounded f_max has turned the demand already.
            let s = tau.norm() / demand.norm();
            assert!(
                s < 0.9 && (tau - demand * s).amax() < 1e-12,
                "law {law}, s = {s}"
            ); // rounding of 259 N·m
        }
        let pose = c.parameters.kinematics.at(&c.inputs.q.into());
        assert!((pose.J.tr_mul(&Vector3::from(c.outputs.f_a)) - tau).amax() < 1e-12); // as above
    }
}

#[test]
fn clipping_cuts_each_joint_by_itself_and_shows_the_force_that_is_left() {
    for law in [1, 2] {
        let c = pushed(4000, |c| {
            (c.parameters.law, c.parameters.torque_limiting) = (law, 2)
        });
        for (i, tau_max) in TAU_MAX.into_iter().enumerate() {
            let expected = c.outputs.tau_demand[i].clamp(-tau_max, tau_max);
            assert_eq!(c.outputs.tau_a[i], expected, "law {law}, joint {i}");
        }
        assert!(c.outputs.saturated != 0);
        let pose = c.parameters.kinematics.at(&c.inputs.q.into());
        let residual =
            pose.J.tr_mul(&Vector3::from(c.outputs.f_a)) - Vector3::from(c.outputs.tau_a);
        assert!(residual.amax() < 1e-11, "{residual}"); // an inverse of condition 3 on 1e3 N
        let scaled = pushed(4000, |c| c.parameters.law = law);
        assert!(
            c.outputs.tau_a != scaled.outputs.tau_a
                && c.outputs.tau_demand == scaled.outputs.tau_demand
        );
    }
}

#[test]
fn below_the_limits_clipping_and_scaling_are_the_same() {
    let gentle = |limiting| {
        pushed(500, |c| {
            (c.parameters.law, c.parameters.torque_limiting, c.inputs.f_h) =
                (2, limiting, [0.05, 0.1, -0.15]);
        })
    };
    let (scaled, clipped) = (gentle(1), gentle(2));
    assert!(scaled.outputs.saturated == 0 && clipped.outputs.saturated == 0);
    assert_eq!(
        (scaled.outputs.tau_a, scaled.outputs.f_a),
        (clipped.outputs.tau_a, clipped.outputs.f_a)
    );
    let energy = |c: &ArmController| {
        let shown = &c.outputs;
        (shown.H, shown.G, shown.tank, shown.share, shown.debt)
    };
    assert_eq!(energy(&scaled), energy(&clipped));
}

/// 4 N in y alone, K = 1000: the paper's law settles at K f_h = 4 kN, of which f_max would leave 400 N. Its factor comes
/// from the yaw joint, 153 N·m at 0.44 m.
#[test]
fn f_max_limits_passive_bounded_only() {
    let push = |law| {
        let c = pushed(6000, |c| {
            (c.parameters.law, c.inputs.f_h, c.parameters.f_max) =
                (law, [0.0, 4.0, 0.0], [200.0; 3])
        });
        (
            c.outputs.f_a[1],
            c.outputs.tau_demand[0] / c.outputs.p[0],
            c.outputs.saturated != 0,
        )
    };
    let (f_a, demand, saturated) = push(4);
    assert!((f_a - 200.0).abs() < 1e-10 && demand > 200.0 && saturated);
    for law in [1, 2, 3] {
        let (f_a, demand, saturated) = push(law);
        let yaw = 153.0 / 0.44;
        assert!((f_a / yaw - 1.0).abs() < 2e-5, "law {law}: {f_a} N"); // p is 0.44 m to 5e-6 m
        assert!(demand > yaw && saturated, "law {law}");
    }
    let (_, demand, _) = push(2);
    assert!((demand / 4000.0 - 1.0).abs() < 1e-3, "{demand} N"); // settles with 1/(K_P (1 + 1/D_n)), 6 s of it
}

/// Pushed for 12 s against something rigid: e⁺ = e + T v_n, and M_n dv_n/dt = f_h − D_n v_n − alpha·(y as it is felt).
#[test]
fn under_the_factor_the_nominal_of_laws_3_and_4_feels_less() {
    let delivered = 153.0 / 0.44; // N in y, by the yaw joint
    let pushed = |law| {
        let c = pushed(12_000, |c| {
            (c.parameters.law, c.inputs.f_h, c.parameters.f_max) = (law, [0.0, 4.0, 0.0], [1e6; 3])
        });
        assert!(c.outputs.saturated != 0 && (c.outputs.f_a[1] / delivered - 1.0).abs() < 2e-5); // p is 0.44 m to 5e-6 m
        (
            c.outputs.dp_n[1],
            c.parameters.K[1] * c.parameters.K_P[1] * c.outputs.e_nr[1],
        )
    };
    // passive feels all of y and comes to rest at K f_h/alpha, far beyond what is delivered.
    let (v_n, spring) = pushed(2);
    assert!(
        v_n.abs() < 1e-6 && (spring / 4000.0 - 1.0).abs() < 1e-6,
        "{v_n} m/s, {spring} N"
    ); // e^(−1.46·12)
    // passive_applied runs away at (f_h − alpha s y)/D_n, s y = delivered/K: the spring winds up.
    let (v_n, spring) = pushed(3);
    let expected = (4.0 - delivered / 1000.0) / 20.0;
    assert!(
        (v_n / expected - 1.0).abs() < 1e-5 && spring > 10_000.0,
        "{v_n} m/s, {spring} N"
    ); // p, as above
    // passive_bounded feels the same, but its reset leaves the nominal where the spring asks for what is delivered.
    let (v_n, spring) = pushed(4);
    assert!(
        v_n.abs() < 0.01 * expected && (spring / delivered - 1.0).abs() < 0.02,
        "{v_n} m/s, {spring} N"
    );
}
