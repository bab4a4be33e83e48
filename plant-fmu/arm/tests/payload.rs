//! The payload through the input `vacuum`: gripped, held, released, lost.
#![allow(
    non_snake_case,
    reason = "the interface's symbols with its capitals: F_max"
)]

mod arm;

use arm::{run, started, step};
use exoskeleton_arm::ExoskeletonArm;

/// The arm 20 mm above a table on which 10 kg lie; the human presses the pad on it.
fn pressing(F_max: f64) -> ExoskeletonArm {
    let mut arm = started(|arm| {
        arm.parameters.table.z = -0.37710;
        arm.parameters.payload_m = 10.0;
        arm.parameters.vacuum.F_max = F_max;
    });
    arm.f_h = [0.0, 0.0, -120.0];
    run(&mut arm, 0, 1000);
    assert!(arm.contact && arm.f_e[2] > 5.0 && !arm.attached);
    arm
}

#[test]
fn vacuum_grips_what_the_pad_presses_on_and_lifts_it() {
    let mut arm = pressing(450.0);
    let light = arm.rigid_body.clone();
    arm.vacuum = true;
    run(&mut arm, 1000, 1010);
    assert!(arm.attached);
    // The payload hangs at the pad: 10 kg · 9.81 m/s² at the pad's distance from the shoulder's axis.
    let expected = 10.0 * 9.81 * (arm.p_pad[0] - 0.06);
    assert!((arm.rigid_body.g[1] - light.g[1] - expected).abs() < 0.2);
    assert!(arm.rigid_body.M[0] > light.M[0] + 10.0 * 0.4 * 0.4);
    assert!(arm.energy.loss_grip >= 0.0);

    arm.f_h = [0.0, 0.0, 220.0];
    run(&mut arm, 1010, 1400);
    assert!(
        arm.attached && !arm.contact && arm.p_pad[2] > -0.37,
        "{:?}",
        arm.p_pad
    );
    assert!(arm.tension > 50.0, "{}", arm.tension);
}

#[test]
fn without_vacuum_nothing_is_gripped_and_without_a_payload_neither() {
    let mut arm = pressing(450.0);
    run(&mut arm, 1000, 1100);
    assert!(!arm.attached);
    let mut none = started(|empty| empty.parameters.table.z = -0.37710);
    none.f_h = [0.0, 0.0, -120.0];
    none.vacuum = true;
    run(&mut none, 0, 1100);
    assert!(none.contact && !none.attached);
}

#[test]
fn release_leaves_the_payload_behind() {
    let mut arm = started(|arm| {
        arm.parameters.payload_m = 10.0;
        arm.parameters.payload_attached = true;
        arm.vacuum = true;
    });
    assert!(arm.attached);
    arm.f_h = [0.0, 0.0, 100.0];
    run(&mut arm, 0, 500);
    let before = arm.energy;
    assert!(
        arm.attached && (arm.tension - 98.1).abs() < 20.0,
        "{}",
        arm.tension
    );
    arm.vacuum = false;
    run(&mut arm, 500, 501);
    assert!(!arm.attached && arm.tension == 0.0);
    // It takes along its potential energy m g z; by then it moved with less than 10 mm/s (0.5 mJ).
    let taken = arm.energy.payload - before.payload;
    assert!(
        (taken + 10.0 * 9.81 * arm.p_pad[2]).abs() < 2e-3,
        "{taken} {:?}",
        arm.p_pad
    );
    run(&mut arm, 501, 1000);
    assert!(!arm.attached);
}

#[test]
fn a_payload_that_hangs_from_the_start_falls_without_vacuum() {
    let mut arm = started(|arm| {
        arm.parameters.payload_m = 10.0;
        arm.parameters.payload_attached = true;
    });
    assert!(arm.attached);
    step(&mut arm, 0.0, 1e-3);
    assert!(!arm.attached);
}

#[test]
fn the_bond_breaks_above_its_strength() {
    for (F_max, holds) in [(90.0, false), (450.0, true)] {
        let mut arm = started(|arm| {
            arm.parameters.payload_m = 10.0;
            arm.parameters.payload_attached = true;
            arm.parameters.vacuum.F_max = F_max;
            arm.vacuum = true;
        });
        arm.f_h = [0.0, 0.0, 98.1]; // at rest the bond bears 98 N
        run(&mut arm, 0, 100);
        assert_eq!(arm.attached, holds, "{F_max}");
    }
}
