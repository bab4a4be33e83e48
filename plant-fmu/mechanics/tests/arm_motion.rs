//! Free motion and friction of the arm against closed forms and against a fourth-order integrator.

#![allow(
    non_snake_case,
    reason = "the symbols of mechanics with their capitals: M, F_s"
)]

use mechanics::arm::{Arm, Inputs, Parameters, Start};
use nalgebra::Vector3;

/// Without dry friction, stops out of reach, torques at once.
fn loose(b: f64) -> Parameters {
    let mut parameters = Parameters {
        drive_cutoff: 0.0,
        ..Parameters::default()
    };
    for i in 0..3 {
        let friction = &mut parameters.friction[i];
        (friction.F_c, friction.F_s, friction.b) = (0.0, 0.0, b);
        (parameters.stops[i].min, parameters.stops[i].max) = (-10.0, 10.0);
    }
    parameters
}

const MOVING: Start = Start {
    q: [0.3, -0.8, 1.2],
    dq: [1.0, -0.7, 1.4],
    attached: true,
};

fn after(parameters: &Parameters, start: &Start, inputs: &Inputs, t: f64, n: u32) -> Arm {
    let mut arm = Arm::new(*parameters, start).unwrap();
    arm.advance(inputs, n, t / f64::from(n));
    arm
}

/// M dv/dt + C v + g + b v = τ + J_hᵀ f_h + J_pᵀ f_d by the classical Runge–Kutta method: error 1e-9 with 500 steps.
fn runge_kutta(parameters: &Parameters, start: &Start, inputs: &Inputs, t: f64) -> Vector3<f64> {
    let rate = |q: &Vector3<f64>, v: &Vector3<f64>| {
        let still = Start {
            q: (*q).into(),
            ..*start
        };
        let place = *Arm::new(*parameters, &still).unwrap().place();
        let body = mechanics::arm::rigid_body::RigidBody::at(
            &place.pose,
            &parameters.lengths,
            &parameters.masses,
            parameters.payload_m,
        );
        let torque = Vector3::from(inputs.tau_a)
            + place.handle.J.transpose() * Vector3::from(inputs.f_h)
            + place.pad.J.transpose() * Vector3::from(inputs.f_d)
            - body.C(v) * v
            - body.g
            - v * parameters.friction[0].b;
        body.M.lu().solve(&torque).unwrap()
    };
    let (mut q, mut v) = (Vector3::from(start.q), Vector3::from(start.dq));
    let n = 500;
    let h = t / f64::from(n);
    for _ in 0..n {
        let (k_1, l_1) = (v, rate(&q, &v));
        let (k_2, l_2) = (
            v + l_1 * (h / 2.0),
            rate(&(q + k_1 * (h / 2.0)), &(v + l_1 * (h / 2.0))),
        );
        let (k_3, l_3) = (
            v + l_2 * (h / 2.0),
            rate(&(q + k_2 * (h / 2.0)), &(v + l_2 * (h / 2.0))),
        );
        let (k_4, l_4) = (v + l_3 * h, rate(&(q + k_3 * h), &(v + l_3 * h)));
        q += (k_1 + k_2 * 2.0 + k_3 * 2.0 + k_4) * (h / 6.0);
        v += (l_1 + l_2 * 2.0 + l_3 * 2.0 + l_4) * (h / 6.0);
    }
    q
}

#[test]
fn motion_under_every_force_tends_to_the_exact_one_with_the_substep() {
    let parameters = Parameters {
        payload_m: 3.0,
        ..loose(4.0)
    };
    let inputs = Inputs {
        tau_a: [9.0, 25.0, -6.0],
        f_h: [12.0, -20.0, 15.0],
        f_d: [-8.0, 11.0, -5.0],
        vacuum: true,
    };
    let exact = runge_kutta(&parameters, &MOVING, &inputs, 0.5);
    let error = |n| (after(&parameters, &MOVING, &inputs, 0.5, n).q() - exact).amax();
    let (coarse, fine) = (error(1_000), error(4_000));
    assert!(fine < 2.5e-4, "{fine:e}");
    // First order: four times the substeps, a quarter of the error; the second order adds some 1 %.
    assert!((coarse / fine - 4.0).abs() < 0.05, "{}", coarse / fine);
}

#[test]
fn a_free_swing_keeps_its_energy_but_for_the_substep() {
    let parameters = Parameters {
        payload_m: 3.0,
        ..loose(0.0)
    };
    let inputs = Inputs {
        vacuum: true,
        ..Inputs::default()
    };
    let lost = |n| {
        let energy = after(&parameters, &MOVING, &inputs, 0.5, n).energy();
        let start = Arm::new(parameters, &MOVING).unwrap().energy();
        assert_eq!(energy.work() + energy.loss() - energy.loss_step, 0.0);
        (energy.kinetic + energy.potential - start.kinetic - start.potential).abs() / start.kinetic
    };
    let (coarse, fine) = (lost(1_000), lost(4_000));
    assert!(fine < 2.5e-3, "{fine:e}");
    assert!((coarse / fine - 4.0).abs() < 0.1, "{}", coarse / fine); // first order
}

#[test]
fn yaw_runs_up_by_the_closed_form() {
    // The pitch joints stick: the centrifugal torque of 0.5 rad/s stays below their stiction. F_s = F_c makes
    //   (M₁₁ + dt b) v⁺ = M₁₁ v + dt (τ − F_c)    ⇒    v_n = v_∞ (1 − (1 + dt b/M₁₁)⁻ⁿ),  v_∞ = (τ − F_c)/b.
    let mut parameters = Parameters {
        drive_cutoff: 0.0,
        ..Parameters::default()
    };
    parameters.friction[0].F_s = 12.0;
    let mut arm = Arm::new(parameters, &Start::default()).unwrap();
    let inputs = Inputs {
        tau_a: [30.0, 0.0, 0.0],
        ..Inputs::default()
    };
    let (n, dt) = (2_000, 1e-4);
    let place = arm.place();
    let M = mechanics::arm::rigid_body::RigidBody::at(
        &place.pose,
        &parameters.lengths,
        &parameters.masses,
        0.0,
    )
    .M;
    arm.advance(&inputs, n, dt);
    let v = (30.0 - 12.0) / 8.0 * (1.0 - (1.0 + dt * 8.0 / M[(0, 0)]).powi(-(n as i32)));
    assert!((arm.dq()[0] - v).abs() < 1e-12, "{} {v}", arm.dq()[0]); // 2000 roundings of 1 rad/s
    assert_eq!((arm.dq()[1], arm.dq()[2], arm.q()[1]), (0.0, 0.0, -1.48096));
    assert_eq!(arm.shown().tau_f[0], -12.0 - 8.0 * arm.dq()[0]);
}

#[test]
fn stiction_holds_for_20_s_at_nine_tenths_and_lets_go_beyond() {
    let parameters = Parameters::default();
    let start = Start::default();
    let place = *Arm::default().place();
    let g = mechanics::arm::rigid_body::RigidBody::at(
        &place.pose,
        &parameters.lengths,
        &parameters.masses,
        0.0,
    )
    .g;
    let load = |part: f64| Inputs {
        tau_a: [0, 1, 2].map(|i| g[i] + part * parameters.friction[i].F_s),
        ..Inputs::default()
    };
    let mut arm = Arm::new(parameters, &start).unwrap();
    arm.advance(&load(0.9), 20_000, 1e-3);
    assert_eq!(
        (arm.q(), arm.dq()),
        (Vector3::from(start.q), Vector3::zeros())
    );
    let held = Vector3::from_fn(|i, _| -0.9 * parameters.friction[i].F_s);
    assert!(
        (arm.shown().tau_f - held).amax() < 1e-11,
        "{}",
        arm.shown().tau_f
    ); // the lag has died out; dt · N·m / dt

    arm.advance(&load(1.01), 1_000, 1e-4);
    assert!(arm.dq().iter().all(|v| *v > 0.0), "{}", arm.dq());
}

#[test]
fn gravity_may_point_anywhere() {
    // Turned on its side the arm falls to the side: the yaw axis feels what the pitch axes felt.
    let mut parameters = loose(0.0);
    parameters.masses.gravity = [0.0, -9.81, 0.0];
    let arm = after(
        &parameters,
        &Start::default(),
        &Inputs::default(),
        0.1,
        1_000,
    );
    assert!(arm.dq()[0] < -0.1, "{}", arm.dq());
    let energy = arm.energy();
    let start = Arm::new(parameters, &Start::default()).unwrap().energy();
    assert!(((energy.kinetic + energy.potential - start.potential) / energy.kinetic).abs() < 0.02); // dt/t per step
}
