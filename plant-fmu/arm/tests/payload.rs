//! The payload through the input `vacuum`: gripped, held, released, lost.
#![allow(
    non_snake_case,
    reason = "the interface's symbols with its capitals: F_max, F_shear"
)]

mod arm;

use arm::{bytes, run, started};
use exoskeleton_arm::ExoskeletonArm;

/// The arm 20 mm above a table on which 10 kg lie; the human presses the pad on it.
fn pressing(F_max: f64) -> ExoskeletonArm {
    let mut arm = started(|arm| {
        arm.parameters.table.z = -0.37710;
        arm.parameters.payload_m = 10.0;
        arm.parameters.vacuum.F_max = F_max;
    });
    arm.inputs.f_h = [0.0, 0.0, -120.0];
    run(&mut arm, 0, 1000);
    assert!(arm.outputs.contact && arm.outputs.f_e[2] > 5.0 && !arm.outputs.attached);
    arm
}

#[test]
fn vacuum_grips_what_the_pad_presses_on_and_lifts_it() {
    let mut arm = pressing(450.0);
    let light = arm.outputs.rigid_body;
    arm.inputs.vacuum = true;
    run(&mut arm, 1000, 1010);
    assert!(arm.outputs.attached);
    // The payload hangs at the pad: 10 kg · 9.81 m/s² at the pad's distance from the shoulder's axis.
    let expected = 10.0 * 9.81 * (arm.outputs.p_pad[0] - 0.06);
    assert!((arm.outputs.rigid_body.g[1] - light.g[1] - expected).abs() < 0.2);
    assert!(arm.outputs.rigid_body.M[0] > light.M[0] + 10.0 * 0.4 * 0.4);
    assert!(arm.outputs.energy.loss_grip >= 0.0);

    arm.inputs.f_h = [0.0, 0.0, 220.0];
    run(&mut arm, 1010, 1400);
    assert!(
        arm.outputs.attached && !arm.outputs.contact && arm.outputs.p_pad[2] > -0.37,
        "{:?}",
        arm.outputs.p_pad
    );
    assert!(arm.outputs.tension > 50.0, "{}", arm.outputs.tension);
}

#[test]
fn without_vacuum_nothing_is_gripped_and_without_a_payload_neither() {
    let mut arm = pressing(450.0);
    run(&mut arm, 1000, 1100);
    assert!(!arm.outputs.attached);
    let mut none = started(|empty| empty.parameters.table.z = -0.37710);
    none.inputs.f_h = [0.0, 0.0, -120.0];
    none.inputs.vacuum = true;
    run(&mut none, 0, 1100);
    assert!(none.outputs.contact && !none.outputs.attached);
}

#[test]
fn release_leaves_the_payload_behind() {
    let mut arm = started(|arm| {
        arm.parameters.payload_m = 10.0;
        arm.start.attached = true;
        arm.inputs.vacuum = true;
    });
    assert!(arm.outputs.attached);
    arm.inputs.f_h = [0.0, 0.0, 100.0];
    run(&mut arm, 0, 500);
    let before = arm.outputs.energy;
    assert!(
        arm.outputs.attached && (arm.outputs.tension - 98.1).abs() < 20.0,
        "{}",
        arm.outputs.tension
    );
    arm.inputs.vacuum = false;
    run(&mut arm, 500, 501);
    assert!(!arm.outputs.attached && arm.outputs.tension == 0.0);
    // It takes along its potential energy m g z; by then it moved with less than 10 mm/s (0.5 mJ).
    let taken = arm.outputs.energy.payload - before.payload;
    assert!(
        (taken + 10.0 * 9.81 * arm.outputs.p_pad[2]).abs() < 2e-3,
        "{taken} {:?}",
        arm.outputs.p_pad
    );
    run(&mut arm, 501, 1000);
    assert!(!arm.outputs.attached);
}

#[test]
fn a_payload_that_hangs_from_the_start_stays_until_the_vacuum_has_been_on() {
    let mut arm = started(|arm| {
        arm.parameters.payload_m = 10.0;
        arm.start.attached = true;
    });
    run(&mut arm, 0, 500); // nobody wired vacuum
    assert!(arm.outputs.attached);
    let saved = bytes(&arm);
    arm.inputs.vacuum = true;
    run(&mut arm, 500, 501);
    assert!(arm.outputs.attached);
    arm.inputs.vacuum = false;
    run(&mut arm, 501, 502);
    assert!(!arm.outputs.attached);
    // What it waits for is part of the state.
    let mut restored: ExoskeletonArm = postcard::from_bytes(&saved).unwrap();
    run(&mut restored, 500, 600);
    assert!(restored.outputs.attached);
}

#[test]
fn a_payload_lost_without_vacuum_is_not_gripped_again() {
    let mut arm = started(|arm| {
        arm.parameters.table.z = -0.37710;
        arm.parameters.payload_m = 10.0;
        arm.start.attached = true;
        arm.parameters.vacuum.F_max = 90.0;
    });
    arm.inputs.f_h = [0.0, 0.0, 98.1];
    run(&mut arm, 0, 100);
    assert!(!arm.outputs.attached);
    arm.inputs.f_h = [0.0, 0.0, -150.0];
    run(&mut arm, 100, 1500);
    assert!(arm.outputs.contact && !arm.outputs.attached);
}

/// A payload of 10 kg that hangs, with gravity forward besides: at rest the bond bears 98.1 N up and the `sideways` force (N).
fn sheared(F_shear: f64, sideways: [f64; 2]) -> ExoskeletonArm {
    let mut arm = started(|arm| {
        arm.parameters.payload_m = 10.0;
        arm.start.attached = true;
        arm.parameters.vacuum.F_shear = F_shear;
        arm.parameters.masses.gravity = [-sideways[0] / 10.0, -sideways[1] / 10.0, -9.81];
        for friction in &mut arm.parameters.friction {
            (friction.F_c, friction.F_s) = (1e4, 1e4); // nothing moves
        }
    });
    run(&mut arm, 0, 20);
    arm
}

#[test]
fn shear_breaks_the_bond_beyond_its_strength_in_any_direction_and_at_the_start_none_does() {
    for [x, y] in [[60.0, 0.0], [0.0, -60.0], [36.0, 48.0]] {
        for (F_shear, holds) in [(0.0, true), (60.0 + 1e-9, true), (60.0 - 1e-9, false)] {
            let arm = sheared(F_shear, [x, y]);
            assert_eq!(arm.outputs.attached, holds, "{x} {y} {F_shear}");
            if holds {
                // At rest it is the payload's own force: |m g| across.
                assert!(
                    (arm.outputs.shear - 60.0).abs() < 1e-12,
                    "{}",
                    arm.outputs.shear
                );
                assert!((arm.outputs.tension - 98.1).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn the_bond_breaks_above_its_strength() {
    for (F_max, holds) in [(90.0, false), (450.0, true)] {
        let mut arm = started(|arm| {
            arm.parameters.payload_m = 10.0;
            arm.start.attached = true;
            arm.parameters.vacuum.F_max = F_max;
            arm.inputs.vacuum = true;
        });
        arm.inputs.f_h = [0.0, 0.0, 98.1]; // at rest the bond bears 98 N
        run(&mut arm, 0, 100);
        assert_eq!(arm.outputs.attached, holds, "{F_max}");
    }
}
