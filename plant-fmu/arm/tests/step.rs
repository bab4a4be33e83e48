//! Communication steps: any length, exact ends, inputs held, state saved and restored; the energy balance.

mod arm;

use arm::{bytes, run, started, step};
use exoskeleton_arm::ExoskeletonArm;
use exoskeleton_arm::force_sensor::SENSOR;
use fmu_export::{Log, Model, Step};

/// Falls on the table within 20 ms and slides on it toward the wall, with noise.
fn busy(substep: f64) -> ExoskeletonArm {
    let mut arm = started(|arm| {
        arm.parameters.table.z = -0.36;
        arm.parameters.wall.x = 0.50;
        arm.parameters.payload_m = 5.0;
        arm.start.attached = true;
        arm.start.dq = [0.3, 0.1, -0.6];
        arm.ft.noise = 0.5;
        arm.ft.frame = SENSOR;
        arm.substep = substep;
    });
    arm.inputs.vacuum = true;
    arm.inputs.tau_a = [20.0, 15.0, 10.0];
    arm.inputs.f_h = [120.0, 10.0, -30.0];
    arm.inputs.f_d = [0.0, 3.0, 0.0];
    arm
}

#[test]
fn one_step_of_10_ms_equals_ten_of_1_ms_bit_for_bit() {
    let (mut one, mut ten) = (busy(1e-4), busy(1e-4));
    for k in 0..20 {
        step(&mut one, f64::from(k) * 0.01, 0.01);
        let mut mean = [0.0; 3];
        for k in 10 * k..10 * k + 10 {
            run(&mut ten, k, k + 1);
            mean = [0, 1, 2].map(|i| mean[i] + 0.1 * ten.outputs.tau_drive[i]);
        }
        // The one output that is about the step as a whole; 100 roundings of 20 N·m.
        for (tau, mean) in one.outputs.tau_drive.into_iter().zip(mean) {
            assert!((tau - mean).abs() < 1e-12, "{k}: {tau} {mean}");
        }
        ten.outputs.tau_drive = one.outputs.tau_drive;
        assert_eq!(bytes(&one), bytes(&ten), "{k}");
    }
    assert!(one.outputs.energy.loss_surface > 0.0 && one.outputs.energy.loss_rub > 0.0);
}

#[test]
fn a_step_ends_exactly_at_its_end_whatever_its_length() {
    // Yaw without friction, gravity or inertia coupling: q₁ = dq₁ h, so a missing or extra substep would show.
    for h in [1e-9, 0.99e-4, 1.01e-4, 1e-3, 0.001_500_000_000_1, 0.123_456] {
        let mut arm = started(|arm| {
            for joint in &mut arm.parameters.friction {
                (joint.F_c, joint.F_s, joint.b) = (0.0, 0.0, 0.0);
            }
            arm.parameters.masses.gravity = [0.0; 3];
            arm.parameters.masses.gear = [1e4; 3]; // rotors of 2 000 kg·m² keep the speed
            arm.start.dq = [0.25, 0.0, 0.0];
        });
        step(&mut arm, 0.0, h);
        // Centrifugal torque 0.25² · 1 kg·m² on 2 000 kg·m² for 0.12 s.
        assert!(
            (arm.outputs.q_joint[0] / (0.25 * h) - 1.0).abs() < 1e-6,
            "{h}"
        );
    }
}

#[test]
fn inputs_set_after_a_step_change_no_output_before_the_next() {
    let mut arm = busy(1e-4);
    run(&mut arm, 0, 10);
    let shown = |arm: &ExoskeletonArm| {
        (
            arm.outputs.q,
            arm.outputs.dp,
            arm.outputs.f_h_measured,
            arm.outputs.tau_applied,
            arm.outputs.f_e,
        )
    };
    let before = shown(&arm);
    (
        arm.inputs.tau_a,
        arm.inputs.f_h,
        arm.inputs.f_d,
        arm.inputs.vacuum,
    ) = ([50.0; 3], [9.0; 3], [9.0; 3], false);
    assert_eq!(shown(&arm), before);
    run(&mut arm, 10, 11);
    assert_ne!(shown(&arm), before);
}

#[test]
fn each_input_books_its_own_work() {
    let push = |tau_a: f64, f_h: f64, f_d: f64| {
        let mut arm = started(|_| ());
        (arm.inputs.tau_a[0], arm.inputs.f_h[1], arm.inputs.f_d[1]) = (tau_a, f_h, f_d);
        run(&mut arm, 0, 200);
        assert!(arm.outputs.dq[0] > 0.0 && arm.outputs.p[1] > 0.0);
        [
            arm.outputs.energy.work_tau,
            arm.outputs.energy.work_f_h,
            arm.outputs.energy.work_f_d,
        ]
        .map(|work| work > 0.0)
    };
    assert_eq!(push(60.0, 0.0, 0.0), [true, false, false]);
    assert_eq!(push(0.0, 120.0, 0.0), [false, true, false]);
    assert_eq!(push(0.0, 0.0, 120.0), [false, false, true]);
}

#[test]
fn the_torque_lags_by_its_corner_frequency() {
    let mut arm = started(|arm| arm.parameters.drive_cutoff = 100.0);
    let mut direct = started(|arm| arm.parameters.drive_cutoff = 0.0);
    (arm.inputs.tau_a, direct.inputs.tau_a) = ([8.0, -4.0, 2.0], [8.0, -4.0, 2.0]);
    for k in 1..=10 {
        run(&mut arm, k - 1, k);
        run(&mut direct, k - 1, k);
        let share = 1.0 - (-2.0 * core::f64::consts::PI * 100.0 * f64::from(k) * 1e-3).exp();
        for (tau, asked) in arm.outputs.tau_applied.into_iter().zip(arm.inputs.tau_a) {
            // Rounding of at most 100 substeps.
            assert!((tau - asked * share).abs() < 1e-13 * 100.0, "{tau} {k}");
        }
        assert_eq!(direct.outputs.tau_applied, direct.inputs.tau_a);
    }
}

#[test]
fn the_energy_residual_halves_with_the_substep_and_stays_below_a_percent() {
    let residual = |substep| {
        let mut arm = busy(substep);
        let mut worst: f64 = 0.0;
        for k in 0..600 {
            step(&mut arm, f64::from(k) * 1e-3, 1e-3);
            worst = worst.max(arm.outputs.energy.residual.abs());
        }
        let e = arm.outputs.energy;
        let throughput = e.work_tau.abs() + e.work_f_h.abs() + e.work_f_d.abs();
        assert!(
            throughput > 1.0 && worst < 0.01 * throughput,
            "{worst} of {throughput}"
        );
        worst
    };
    let ratio = residual(1e-4) / residual(5e-5);
    assert!((ratio - 2.0).abs() < 0.25, "{ratio}");
}

#[test]
fn a_saved_state_continues_bit_for_bit() {
    let mut arm = busy(1e-4);
    run(&mut arm, 0, 40);
    assert!(arm.outputs.contact);
    let mut restored: ExoskeletonArm = postcard::from_bytes(&bytes(&arm)).unwrap();
    run(&mut arm, 40, 400);
    run(&mut restored, 40, 400);
    assert_eq!(bytes(&arm), bytes(&restored));
}

fn refused(arm: &mut ExoskeletonArm, h: f64) -> String {
    let step = Step::at(0.0, h);
    arm.step(step, &mut Log::silent()).unwrap_err().0
}

#[test]
fn a_force_that_leaves_the_range_of_numbers_fails_the_step_and_is_named() {
    let mut arm = started(|_| ());
    arm.inputs.f_h[0] = 1e308;
    let text = refused(&mut arm, 1.0);
    assert!(
        text.starts_with("motion left the range of numbers: q_joint = "),
        "{text}"
    );
    assert!(text.contains("f_h = [1e308, 0.0, 0.0] N"), "{text}");
}

#[test]
fn a_step_that_would_seem_to_hang_is_not_accepted() {
    let arm = started(|_| ());
    let step = |h| Step::at(0.0, h);
    assert_eq!(arm.accepts(&step(1e4)), Ok(()));
    assert_eq!(
        arm.accepts(&step(1e9)).unwrap_err().0,
        "communicationStepSize = 1000000000.0 s, expected at most 10000.0 s (1e8 times substep)"
    );
}
