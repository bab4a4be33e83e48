//! What the drives take: torques, or commands of positions or velocities around which each closes a loop of its own.

#![allow(non_snake_case, reason = "the paper's symbols")]

mod arm;

use arm::{bytes, run, started, started_at, step};
use exoskeleton_arm::ExoskeletonArm;
use mechanics::drive::{POSITION_SERVO, VELOCITY_SERVO};

const K: f64 = 1e4;
const K_P: f64 = 10.0;

/// Nothing but inertia, next to all of it the rotors', and a drive without a lag: three axes that do not know of each other.
fn inert(mode: i32, change: impl FnOnce(&mut ExoskeletonArm)) -> ExoskeletonArm {
    started(|arm| {
        let parameters = &mut arm.parameters;
        for joint in &mut parameters.friction {
            (joint.F_c, joint.F_s, joint.b) = (0.0, 0.0, 0.0);
        }
        parameters.masses.gravity = [0.0; 3];
        parameters.masses.gear = [1e4; 3]; // rotors of 2 000 kg·m²
        (parameters.drive_cutoff, parameters.drive_mode) = (0.0, mode);
        for joint in &mut parameters.servo {
            (joint.K, joint.K_P, joint.tau_max) = (K, K_P, 1e6);
        }
        (arm.command.q_d, arm.substep) = (arm.start.q, 1e-5);
        change(arm);
    })
}

#[test]
fn a_position_drive_follows_the_second_order_response_of_its_loop() {
    // M ddq + K dq + K K_P q = K K_P q_d: ω_n = √(K K_P/M), ζ = K/(2 √(M K K_P)).
    let q_d = 1e-3;
    let mut arm = inert(POSITION_SERVO, |arm| arm.command.q_d[0] = q_d);
    let M = arm.outputs.rigid_body.M[0];
    let (omega, zeta) = ((K * K_P / M).sqrt(), K / (2.0 * (M * K * K_P).sqrt()));
    let damped = omega * (1.0 - zeta * zeta).sqrt();
    for k in 1..=20 {
        let t = 0.05 * f64::from(k);
        step(&mut arm, t - 0.05, 0.05);
        let swing = (damped * t).cos() + zeta * omega / damped * (damped * t).sin();
        let exact = q_d * (1.0 - (-zeta * omega * t).exp() * swing);
        // Sampled torque and backward Euler, both first order: ω_n dt = 7e-5 of the step of 1e-3 rad, some t/ω long.
        let off = arm.outputs.q_joint[0] - exact;
        assert!(off.abs() < 5e-4 * q_d, "{t}: {off}");
    }
    assert!((arm.outputs.q_joint[0] / q_d - 1.0).abs() < 0.2); // it got there
}

#[test]
fn a_velocity_drive_takes_one_velocity_for_the_step_from_the_position_at_its_begin() {
    // M ddq = K (w − dq), w = dq_d + K_P (q_d − q(t_k)) for one step of h: dq⁺ = w + (dq − w) x, x = exp(−K h/M), and
    // q⁺ = q + w h + (dq − w)(1 − x) M/K.
    let (q_d, dq_d, h) = (1e-3, 2e-3, 0.05);
    let mut arm = inert(VELOCITY_SERVO, |arm| {
        (arm.command.q_d[0], arm.command.dq_d[0]) = (q_d, dq_d);
    });
    let M = arm.outputs.rigid_body.M[0];
    let x = (-K * h / M).exp();
    let (mut q, mut dq) = (0.0, 0.0);
    for k in 0..80 {
        step(&mut arm, f64::from(k) * h, h);
        let w = dq_d + K_P * (q_d - q);
        q += w * h + (dq - w) * (1.0 - x) * M / K;
        dq = w + (dq - w) * x;
        // First order in K dt/M = 5e-5, over a loop that forgets within a second.
        let off = arm.outputs.q_joint[0] - q;
        assert!(off.abs() < 5e-4 * q_d, "{k}: {off}");
    }
    // q_d stands still while dq_d is 2e-3: it ends dq_d/K_P beyond q_d.
    assert!((arm.outputs.q_joint[0] - (q_d + dq_d / K_P)).abs() < 1e-2 * q_d);
}

#[test]
fn tau_drive_is_the_mean_torque_of_the_step_and_its_momentum_is_the_joints() {
    for mode in [1, POSITION_SERVO, VELOCITY_SERVO] {
        let mut arm = inert(mode, |arm| {
            (arm.parameters.drive_cutoff, arm.ft.T) = (30.0, 4e-4); // the force is sampled within steps
            (arm.command.q_d[0], arm.command.dq_d[0]) = (0.02, 0.3);
            arm.inputs.tau_a = [800.0, 0.0, 0.0];
        });
        for k in 0..50 {
            let before = arm.outputs.dq[0];
            step(&mut arm, f64::from(k) * 1e-3, 1e-3);
            let momentum = arm.outputs.rigid_body.M[0] * (arm.outputs.dq[0] - before);
            let given = arm.outputs.tau_drive[0] * 1e-3;
            // M of the links' 1 kg·m² in 2 000 as the pitch joints move, and the Coriolis torque of that.
            assert!(
                (given - momentum).abs() < 1e-6 * given.abs(),
                "{mode} {given} {momentum}"
            );
        }
        assert!(arm.outputs.tau_drive[0] > 700.0, "{mode}");
    }
}

#[test]
fn a_drive_asks_for_no_more_than_its_limit_and_does_not_use_tau_a() {
    for mode in [POSITION_SERVO, VELOCITY_SERVO] {
        let mut arm = inert(mode, |arm| {
            arm.command.q_d = [100.0, -100.0, 100.0];
            arm.inputs.tau_a = [9.0; 3];
            for (joint, tau_max) in arm.parameters.servo.iter_mut().zip([2.0, 3.0, 4.0]) {
                joint.tau_max = tau_max;
            }
        });
        run(&mut arm, 0, 20);
        assert_eq!(arm.outputs.tau_applied, [2.0, -3.0, 4.0]);
        let energy = arm.outputs.energy;
        assert!(energy.work_tau > 0.0 && energy.residual.abs() < 1e-6 * energy.work_tau);
    }
}

#[test]
fn the_loop_is_closed_behind_the_drives_lag() {
    let mut arm = inert(POSITION_SERVO, |arm| {
        arm.parameters.drive_cutoff = 30.0;
        arm.command.q_d[0] = 1.0;
        arm.parameters.servo[0].tau_max = 50.0;
    });
    step(&mut arm, 0.0, 1e-3);
    let share = 1.0 - (-2.0 * core::f64::consts::PI * 30.0 * 1e-3_f64).exp();
    assert!((arm.outputs.tau_applied[0] - 50.0 * share).abs() < 1e-12); // 100 roundings of 50 N·m
}

#[test]
fn under_torque_commands_gains_and_limits_change_nothing() {
    let run_with = |q_d: [f64; 3], gain: f64| {
        let mut arm = started(|arm| {
            (arm.command.q_d, arm.command.dq_d) = (q_d, q_d);
            arm.inputs.tau_a = [10.0, 60.0, 20.0];
            for joint in &mut arm.parameters.servo {
                (joint.K, joint.K_P, joint.tau_max) = (gain, gain, gain);
            }
        });
        run(&mut arm, 0, 200);
        arm.outputs
    };
    let plain = run_with([0.0; 3], 1.0);
    assert!(plain.dp[2] > 0.0);
    assert_eq!(plain, run_with([1.0, -2.0, 3.0], 77.0));
}

/// Pressed on its table by its drives, with everything on.
fn pressed(mode: i32) -> ExoskeletonArm {
    started(|arm| {
        (arm.parameters.table.z, arm.parameters.drive_mode) = (-0.4171, mode);
        let q = arm.start.q;
        arm.command.q_d = [q[0] + 0.05, q[1] - 0.1, q[2] - 0.1];
    })
}

#[test]
fn a_saved_state_continues_bit_for_bit_and_ten_steps_of_a_position_drive_are_one() {
    for mode in [POSITION_SERVO, VELOCITY_SERVO] {
        let mut arm = pressed(mode);
        run(&mut arm, 0, 100);
        let mut restored: ExoskeletonArm = postcard::from_bytes(&bytes(&arm)).unwrap();
        run(&mut arm, 100, 300);
        run(&mut restored, 100, 300);
        assert_eq!(bytes(&arm), bytes(&restored));
        assert!(arm.outputs.contact && arm.outputs.f_e[2] > 10.0);
    }
    let (mut one, mut ten) = (pressed(POSITION_SERVO), pressed(POSITION_SERVO));
    for k in 0..20 {
        step(&mut one, f64::from(k) * 0.01, 0.01);
        run(&mut ten, 10 * k, 10 * k + 10);
        assert_eq!(one.plant, ten.plant, "{k}");
    }
}

#[test]
fn a_mode_that_there_is_not_is_refused_by_name() {
    assert_eq!(
        started_at(0.0, |arm| arm.parameters.drive_mode = 4).unwrap_err(),
        "drive.mode = 4, expected an item of Drive: 1 torque, 2 position_servo, 3 velocity_servo"
    );
}
