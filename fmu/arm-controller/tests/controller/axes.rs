//! The three axes of the base frame (eq:obs_dyn_cart) are three scalars, as long as no joint limits them.

use crate::{T, initialized, tick};
use admittance::{Admittance, Gains, Law, Settings};
use arm_law::kinematics::Kinematics;
use nalgebra::{Vector1, Vector3};

/// Joint angles (rad) and human force (N) at tick `k`: a slow motion about the start pose.
pub fn world(k: u32) -> ([f64; 3], [f64; 3]) {
    let t = T * f64::from(k);
    let wave = |f: f64| (f * t).sin();
    (
        [
            0.05 * wave(2.0),
            -1.48096 + 0.04 * wave(3.0),
            1.70138 + 0.03 * wave(1.0),
        ],
        [3.0 * wave(1.1), 2.0 * wave(0.7), 4.0 * wave(1.7)],
    )
}

#[test]
fn without_limits_the_arm_equals_three_scalar_axes() {
    for law in [1, 2, 3, 4] {
        let gains = |i: usize| Gains {
            M_n: [5.0, 2.0, 8.0][i],
            D_n: [20.0, 5.0, 30.0][i],
            K: [300.0, 200.0, 100.0][i],
            K_P: [20.0, 10.0, 15.0][i],
            f_max: if law == 4 { 400.0 } else { f64::INFINITY },
        };
        let mut arm = initialized(|c| {
            c.parameters.law = law;
            c.inputs.q = world(0).0;
            for i in 0..3 {
                let Gains {
                    M_n, D_n, K, K_P, ..
                } = gains(i);
                (
                    c.parameters.Lambda_n[i],
                    c.parameters.D_n[i],
                    c.parameters.K[i],
                    c.parameters.K_P[i],
                ) = (M_n, D_n, K, K_P);
            }
        });
        let settings = Settings {
            law: Law::try_from(law).expect("offered"),
            T,
            ..Settings::default()
        };
        let mut axes =
            [0, 1, 2].map(|i| Admittance::new(settings, [gains(i)]).expect("valid parameters"));
        for k in 0..1100 {
            let (q, f_h) = world(k);
            (arm.inputs.q, arm.inputs.f_h) = (q, f_h);
            tick(&mut arm, k);
            assert!(
                arm.outputs.saturated == 0 && arm.outputs.slowed == 0,
                "law {law}, tick {k}"
            );
            let p = Kinematics::default().at(&q.into()).p;
            for (i, axis) in axes.iter_mut().enumerate() {
                let alone = axis.step(&Vector1::new(p[i]), &Vector1::new(f_h[i]));
                assert_eq!(
                    (
                        arm.outputs.f_a[i],
                        arm.outputs.p_n[i],
                        arm.outputs.dp_n[i],
                        arm.outputs.e_nr[i],
                        arm.outputs.dp[i]
                    ),
                    (
                        alone.f.x,
                        alone.q_n.x,
                        alone.dq_n.x,
                        alone.e_nr.x,
                        alone.dq.x
                    ),
                    "law {law}, tick {k}, axis {i}"
                );
            }
        }
        assert!(
            arm.outputs.f_a.iter().all(|f_a| f_a.abs() > 1.0),
            "{:?}",
            arm.outputs.f_a
        );
    }
}

#[test]
fn tau_a_does_the_work_of_f_a() {
    let mut arm = initialized(|_| ());
    for k in 0..500 {
        (arm.inputs.q, arm.inputs.f_h) = world(k);
        tick(&mut arm, k);
    }
    // Virtual work by finite differences of the kinematics, not by its Jacobian.
    let p = |q: Vector3<f64>| Kinematics::default().at(&q).p;
    for i in 0..3 {
        let mut dq = Vector3::zeros();
        dq[i] = 1e-5;
        let dp = (p(Vector3::from(arm.inputs.q) + dq) - p(Vector3::from(arm.inputs.q) - dq)) / 2e-5;
        let work = Vector3::from(arm.outputs.f_a).dot(&dp);
        // Differences carry 4e-11 m/rad (tests/kinematics.rs); the forces are below 100 N.
        assert!(
            (arm.outputs.tau_a[i] - work).abs() < 1e-8,
            "joint {i}: {} {work}",
            arm.outputs.tau_a[i]
        );
        assert!(work.abs() > 0.01);
    }
}
