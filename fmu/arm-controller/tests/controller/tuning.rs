//! Gains changed during the run.

use crate::{ArmController, initialized, tick};
use fmu_export::{Log, Model};

/// Pushed down onto something that does not give way, until the spring is at its bound.
fn pushed() -> ArmController {
    let mut controller = initialized(|c| {
        (c.inputs.f_h, c.parameters.f_max, c.parameters.tuning_time) =
            ([0.0, 0.0, -10.0], [200.0; 3], 0.0);
    });
    (0..5000).for_each(|k| tick(&mut controller, k));
    controller
}

#[test]
fn a_lower_f_max_acts_at_the_next_tick() {
    let mut c = pushed();
    assert!((c.outputs.f_a[2] + 200.0).abs() < 1e-10 && c.outputs.saturated != 0); // rounding of K y
    c.parameters.f_max = [50.0; 3];
    c.tune(&mut Log::silent()).expect("a valid limit");
    assert!((c.outputs.f_a[2] + 200.0).abs() < 1e-10);
    tick(&mut c, 5000);
    assert!((c.outputs.f_a[2] + 50.0).abs() < 1e-10);
    assert!((20_000.0 * c.outputs.e_nr[2]).abs() <= 50.0 * (1.0 + 1e-15)); // the product's rounding
}

/// K, K_P and Lambda_n raised while the spring is stretched: the stored energy must not rise with them.
#[test]
fn tuning_does_not_raise_the_stored_energy() {
    let mut c = pushed();
    let before = c.clone();
    (c.parameters.K, c.parameters.K_P, c.parameters.Lambda_n) =
        ([3000.0; 3], [100.0; 3], [50.0; 3]);
    c.tune(&mut Log::silent()).expect("valid gains");
    tick(&mut c, 5000);
    assert!(c.outputs.G <= before.outputs.G);
    assert!(c.outputs.e_nr[2].abs() < before.outputs.e_nr[2].abs() / 10.0);
}

#[test]
fn a_tuned_damping_lasts_through_a_slowed_stretch() {
    let settled = |D_n: f64| {
        let mut c = initialized(|c| (c.parameters.law, c.inputs.f_h) = (1, [0.0, 4.0, 0.0]));
        c.parameters.D_n = [D_n; 3];
        c.tune(&mut Log::silent()).expect("a valid damping");
        let ticks = |c: &mut ArmController, from: u32| (from..from + 4000).for_each(|k| tick(c, k));
        c.inputs.q = [0.0, -0.8, 0.2];
        ticks(&mut c, 0);
        assert!(c.outputs.slowed != 0 && c.outputs.dp_n[1] < 0.5 * 4.0 / D_n);
        c.inputs.q = [0.0, -0.8, 1.7];
        ticks(&mut c, 4000);
        assert!(c.outputs.slowed == 0);
        c.outputs.dp_n[1]
    };
    for D_n in [20.0, 40.0] {
        let v = settled(D_n);
        assert!((v * D_n / 4.0 - 1.0).abs() < 1e-6, "{v} m/s"); // 4 s are 16 time constants or more
    }
}

#[test]
fn a_refused_gain_leaves_the_law_as_it_was() {
    let start = || initialized(|c| c.inputs.f_h = [6.0, 0.0, -6.0]);
    let (mut tuned, mut untouched) = (start(), start());
    tuned.parameters.K[1] = -1.0;
    assert_eq!(
        tuned.tune(&mut Log::silent()).expect_err("negative").0,
        "K[2] = -1: expected a finite value, at least 1e-6"
    );
    tuned.parameters.K = untouched.parameters.K; // as the C interface restores it
    for k in 0..10 {
        tick(&mut tuned, k);
        tick(&mut untouched, k);
    }
    assert_eq!(tuned, untouched);
}

#[test]
fn gain_warning_is_that_of_the_axis_that_needs_it() {
    assert_eq!(initialized(|_| ()).gain_warning, 0);
    // K T/M_min = 0.25 at K = 3500 N·s/m, M_min/10 = 1.4 kg.
    assert_eq!(initialized(|c| c.parameters.K[1] = 3600.0).gain_warning, 1);
    assert_eq!(
        initialized(|c| c.parameters.Lambda_n[2] = 1.0).gain_warning,
        2
    );
    let mut c = initialized(|c| (c.parameters.K[0], c.parameters.Lambda_n[2]) = (3600.0, 1.0));
    assert_eq!(c.gain_warning, 3);
    c.parameters.K = [1000.0; 3];
    c.tune(&mut Log::silent()).expect("valid gains");
    assert_eq!(c.gain_warning, 2);
}
