//! Steps: the physics arrives at the right ports, the state is whole, and events are said.

mod arms;

use arms::{run, started};
use exoskeleton_arm::ExoskeletonArm;
use exoskeleton_arms::ExoskeletonArms;
use fmu_export::{Log, Model, Step};
use mechanics::drive::{POSITION_SERVO, VELOCITY_SERVO};

/// 20 kg on both pads, the left arm lifting more than the right one.
fn lifting() -> ExoskeletonArms {
    let mut arms = started(|arms| {
        arms.parameters.arm.payload_m = 20.0;
        arms.start.attached = true;
    });
    arms.inputs.left.tau_a = [20.0, 160.0, 100.0];
    arms.inputs.right.tau_a = [0.0, 120.0, 80.0];
    (arms.inputs.left.vacuum, arms.inputs.right.vacuum) = (true, true);
    arms
}

#[test]
fn each_port_drives_its_own_arm() {
    let mut arms = started(|_| ());
    arms.inputs.right.tau_a = [0.0, 60.0, 20.0];
    arms.inputs.left.f_h = [0.0, 80.0, 0.0];
    run(&mut arms, 0, 300);
    for (side, f_h, tau_a) in [
        (&arms.outputs.left, [0.0, 80.0, 0.0], [0.0; 3]),
        (&arms.outputs.right, [0.0; 3], [0.0, 60.0, 20.0]),
    ] {
        let mut single = ExoskeletonArm::default();
        (single.inputs.f_h, single.inputs.tau_a) = (f_h, tau_a);
        single.initialize(0.0, &mut Log::silent()).unwrap();
        for k in 0..300 {
            let step = Step::at(f64::from(k) * 1e-3, 1e-3);
            single.step(step, &mut Log::silent()).unwrap();
        }
        assert_ne!(single.outputs.dq, [0.0; 3]);
        assert_eq!(
            (side.q, side.dq, side.dp),
            (single.outputs.q, single.outputs.dq, single.outputs.dp)
        );
        assert_eq!(
            (side.tau_applied, side.tau_f),
            (single.outputs.tau_applied, single.outputs.tau_f)
        );
    }
}

#[test]
fn the_wrists_bear_the_moment_of_the_pads_forces_about_the_payloads_middle() {
    // At rest nothing but the cups holds the payload up: T_L and T_R, 0.2 m to the left and to the right of its middle. They
    // turn it about x with 0.2 (T_L − T_R), and the wrists turn it back.
    let mut arms = started(|arms| {
        arms.parameters.arm.payload_m = 20.0;
        arms.start.attached = true;
    });
    (arms.inputs.left.vacuum, arms.inputs.right.vacuum) = (true, true);
    arms.inputs.left.tau_a = [0.0, 100.0, 60.0];
    arms.inputs.right.tau_a = [0.0, 60.0, 36.0];
    run(&mut arms, 0, 3000);
    let shown = &arms.outputs;
    assert!(shown.attached && shown.left.dq == [0.0; 3] && shown.right.dq == [0.0; 3]);
    let apart = shown.left.tension - shown.right.tension;
    assert!(apart.abs() > 1.0, "{apart}");
    assert!(
        (shown.wrist[0] + 0.2 * apart).abs() < 1e-9,
        "{:?}",
        shown.wrist
    );
    // Level forces: equal and opposite at rest, as the payload pulls at neither pad: they turn it about z.
    let shears = [shown.left.shear, shown.right.shear];
    assert!((shears[0] - shears[1]).abs() < 1e-9, "{shears:?}");
    // No moment about the line between the pads.
    let r: Vec<_> = (0..3)
        .map(|i| shown.left.p_pad[i] - shown.right.p_pad[i])
        .collect();
    assert!((0..3).map(|i| r[i] * shown.wrist[i]).sum::<f64>().abs() < 1e-12);
}

#[test]
fn the_payload_ties_the_arms_and_lambda_says_how_hard() {
    let mut arms = lifting();
    run(&mut arms, 0, 500);
    assert!(arms.outputs.attached && arms.outputs.left.p_pad[2] > -0.35);
    let apart: Vec<_> = (0..3)
        .map(|i| arms.outputs.left.p_pad[i] - arms.outputs.right.p_pad[i] - [0.0, 0.4, 0.0][i])
        .collect();
    let gap = apart.iter().map(|x| x * x).sum::<f64>().sqrt();
    assert!(gap > 0.0 && gap < 1e-5, "{gap:e}");
    assert!(
        (arms.outputs.gap - gap).abs() < 1e-15,
        "{:e} {gap:e}",
        arms.outputs.gap
    ); // roundings of 0.4 m
    // The left half hangs on the right one: down on it, and less tension here than there would be without.
    assert!(arms.outputs.lambda[2] < -5.0, "{:?}", arms.outputs.lambda);
    assert!(arms.outputs.left.tension > arms.outputs.right.tension);
    assert!(arms.outputs.energy.bond > 0.0 && arms.outputs.energy.loss_bond > 0.0);
}

#[test]
fn a_state_that_is_restored_continues_to_the_last_bit() {
    let mut arms = lifting();
    run(&mut arms, 0, 100);
    let saved = postcard::to_allocvec(&arms).unwrap();
    run(&mut arms, 100, 300);
    let mut restored: ExoskeletonArms = postcard::from_bytes(&saved).unwrap();
    run(&mut restored, 100, 300);
    assert_eq!(
        postcard::to_allocvec(&restored).unwrap(),
        postcard::to_allocvec(&arms).unwrap()
    );
}

#[test]
fn one_long_step_is_many_short_ones() {
    let (mut short, mut long) = (lifting(), lifting());
    run(&mut short, 0, 100);
    let step = Step::at(0.0, 0.1);
    long.step(step, &mut Log::silent()).unwrap();
    // The substeps differ by roundings of 0.1/1000; after 1000 of them some 1e-13 is left.
    for i in 0..3 {
        assert!((short.outputs.left.q[i] - long.outputs.left.q[i]).abs() < 1e-11);
        assert!((short.outputs.right.q[i] - long.outputs.right.q[i]).abs() < 1e-11);
    }
}

#[test]
fn a_step_of_too_many_substeps_is_refused_before_anything_moves() {
    let arms = started(|arms| arms.substep = 1e-7);
    assert_eq!(arms.accepts(&Step::at(0.0, 10.0)), Ok(()));
    for h in [10.1, 429.5, 1e9] {
        let refusal = arms.accepts(&Step::at(0.0, h)).unwrap_err();
        assert_eq!(
            refusal.0,
            format!("communicationStepSize = {h:?} s, expected at most 10.0 s (1e8 times substep)")
        );
    }
}

#[test]
fn numbers_out_of_range_are_refused() {
    let mut arms = lifting();
    arms.inputs.right.f_h = [f64::MAX; 3];
    let step = Step::at(0.0, 1.0);
    let refusal = arms.step(step, &mut Log::silent()).unwrap_err();
    assert!(
        refusal.0.starts_with("motion left the range of numbers"),
        "{}",
        refusal.0
    );
}

#[test]
fn each_command_reaches_the_drives_of_its_own_arm() {
    for mode in [POSITION_SERVO, VELOCITY_SERVO] {
        let q = ExoskeletonArms::default().start.q;
        let told = |by: f64| [q[0] + by, q[1] + by, q[2] - by];
        let mut arms = started(|arms| arms.parameters.arm.drive_mode = mode);
        arms.left_command.q_d = told(0.1);
        (arms.right_command.q_d, arms.right_command.dq_d) = (told(-0.2), [0.1; 3]);
        run(&mut arms, 0, 300);
        for (side, command) in [
            (&arms.outputs.left, arms.left_command),
            (&arms.outputs.right, arms.right_command),
        ] {
            let mut single = ExoskeletonArm::default();
            (single.parameters.drive_mode, single.command) = (mode, command);
            single.initialize(0.0, &mut Log::silent()).unwrap();
            for k in 0..300 {
                let step = Step::at(f64::from(k) * 1e-3, 1e-3);
                single.step(step, &mut Log::silent()).unwrap();
            }
            assert_ne!(single.outputs.dq, [0.0; 3]);
            assert_eq!(
                (side.q, side.dq, side.tau_drive),
                (
                    single.outputs.q,
                    single.outputs.dq,
                    single.outputs.tau_drive
                )
            );
        }
    }
}
