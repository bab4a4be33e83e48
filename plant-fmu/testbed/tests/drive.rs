//! The actuator: a force, or a drive with a position loop.

#![allow(non_snake_case, reason = "the paper's symbols")]

use fmu_export::{Log, Model, Step};
use mechanics::drive::Command;
use mechanics::friction::Friction;
use mechanics::testbed::Forces;
use mechanics::wall::Wall;
use testbed::Testbed;

/// Without friction and wall, the position drive on.
fn driven(change: impl FnOnce(&mut Testbed)) -> Testbed {
    let mut plant = Testbed {
        mode: 2,
        ..Testbed::default()
    };
    plant.parameters.friction = Friction { F_c: 0.0, b: 0.0 };
    plant.parameters.wall.q = Wall::NONE;
    change(&mut plant);
    plant.initialize(0.0, &mut Log::silent()).unwrap();
    plant
}

fn run(plant: &mut Testbed, h: f64, steps: u32) {
    for k in 0..steps {
        let step = Step::at(f64::from(k) * h, h);
        plant.step(step, &mut Log::silent()).unwrap();
    }
}

#[test]
fn the_drive_follows_the_second_order_response_of_its_loop() {
    // M ddq + K dq + K K_P q = K K_P q_d: ω_n = √(K K_P/M), ζ = K/(2 M ω_n).
    let (M, K, K_P, q_d) = (6.0_f64, 30.0, 10.0, 0.01);
    let (omega, zeta) = ((K * K_P / M).sqrt(), K / (2.0 * (M * K * K_P).sqrt()));
    let damped = omega * (1.0 - zeta * zeta).sqrt();
    let mut plant = driven(|p| (p.command.q_d, p.substep) = (q_d, 1e-6));
    for k in 1..=20 {
        run(&mut plant, 0.05, 1);
        let t = 0.05 * f64::from(k);
        let swing = (damped * t).cos() + zeta * omega / damped * (damped * t).sin();
        let exact = q_d * (1.0 - (-zeta * omega * t).exp() * swing);
        // Sampled force and backward Euler, both first order: ω_n dt = 7e-6 of the step of 0.01 m, some t/ω long.
        assert!(
            (plant.outputs.q - exact).abs() < 5e-5 * q_d,
            "{t}: {}",
            plant.outputs.q - exact
        );
    }
}

#[test]
fn a_velocity_drive_takes_one_velocity_for_the_step_from_the_position_at_its_begin() {
    // M ddq = K (w − dq), w = dq_d + K_P (q_d − q(t_k)) for one step of h: dq⁺ = w + (dq − w) x, x = exp(−K h/M), and
    // q⁺ = q + w h + (dq − w)(1 − x) M/K.
    let (M, K, K_P, q_d, h) = (6.0, 30.0, 10.0, 0.01, 0.05);
    let mut plant = driven(|p| (p.mode, p.command.q_d, p.substep) = (3, q_d, 1e-6));
    let x = f64::exp(-K * h / M);
    let (mut q, mut dq) = (0.0, 0.0);
    for k in 0..40 {
        run(&mut plant, h, 1);
        let w = K_P * (q_d - q);
        q += w * h + (dq - w) * (1.0 - x) * M / K;
        dq = w + (dq - w) * x;
        // Sampled force and backward Euler, both first order: K dt/M = 5e-6, over a loop that forgets within a second.
        let off = plant.outputs.q - q;
        assert!(off.abs() < 5e-5 * q_d, "{k}: {off}");
    }
    assert!((plant.outputs.q / q_d - 1.0).abs() < 0.05); // it got there
}

#[test]
fn tau_drive_is_the_mean_force_of_the_step_and_its_momentum_is_the_masss() {
    let mut plant = driven(|p| (p.command.q_d, p.command.dq_d) = (0.02, 0.3));
    for _ in 0..50 {
        let before = plant.outputs.dq;
        run(&mut plant, 0.002, 1);
        let momentum = plant.parameters.M * (plant.outputs.dq - before);
        assert!((plant.outputs.tau_drive * 0.002 - momentum).abs() < 1e-14); // 25 roundings of some 1e-2 N·s
    }
    assert!(plant.outputs.tau_drive.abs() > 0.1);
}

#[test]
fn the_drive_stays_within_its_limit_and_does_not_use_tau_a() {
    let mut plant =
        driven(|p| (p.command.q_d, p.drive.tau_max, p.forces.tau_a) = (100.0, 2.0, 9.0));
    run(&mut plant, 0.002, 10);
    assert!((plant.outputs.tau_drive - 2.0).abs() < 1e-14); // mean of 25 equal numbers
    assert!(plant.outputs.energy.work_tau_a > 0.0 && plant.outputs.energy.residual.abs() < 1e-15);
    // Backward Euler: half a substep of 8e-5 s at dq beyond ½ a t².
    let (a, t) = (2.0 / 6.0, 0.02);
    assert!((plant.outputs.q - 0.5 * a * t * (t + 8e-5)).abs() < 1e-15);
}

#[test]
fn in_torque_mode_the_command_changes_nothing_and_tau_drive_is_tau_a() {
    let run_with = |q_d, dq_d| {
        let mut plant = Testbed {
            forces: Forces {
                tau_a: 3.0,
                ..Forces::default()
            },
            command: Command { q_d, dq_d },
            ..Testbed::default()
        };
        plant.initialize(0.0, &mut Log::silent()).unwrap();
        run(&mut plant, 0.002, 700);
        plant
    };
    let (plain, told) = (run_with(0.0, 0.0), run_with(7.0, -3.0));
    assert_eq!(
        (plain.outputs.q, plain.outputs.dq),
        (told.outputs.q, told.outputs.dq)
    );
    assert_eq!(plain.outputs.energy, told.outputs.energy);
    assert_eq!(
        (plain.outputs.tau_drive, told.outputs.tau_drive),
        (3.0, 3.0)
    );
}
