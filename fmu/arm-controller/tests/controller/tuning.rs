//! Gains changed during the run.

use crate::{ArmController, initialized, tick};
use export::{Log, Model};

/// Pushed down onto something that does not give way, until the spring is at its bound.
fn pushed() -> ArmController {
    let mut controller = initialized(|c| {
        (c.f_h, c.f_max, c.tuning_time) = ([0.0, 0.0, -10.0], [200.0; 3], 0.0);
    });
    (0..5000).for_each(|k| tick(&mut controller, k));
    controller
}

#[test]
fn a_lower_f_max_acts_at_the_next_tick() {
    let mut c = pushed();
    assert!((c.f_a[2] + 200.0).abs() < 1e-10 && c.saturated); // rounding of K y
    c.f_max = [50.0; 3];
    c.tune(&mut Log::silent()).expect("a valid limit");
    assert!((c.f_a[2] + 200.0).abs() < 1e-10);
    tick(&mut c, 5000);
    assert!((c.f_a[2] + 50.0).abs() < 1e-10);
    assert!((20_000.0 * c.e_nr[2]).abs() <= 50.0 * (1.0 + 1e-15)); // the product's rounding
}

/// K, K_P and Lambda_n raised while the spring is stretched: the stored energy must not rise with them.
#[test]
fn tuning_does_not_raise_the_stored_energy() {
    let mut c = pushed();
    let before = c.clone();
    (c.K, c.K_P, c.Lambda_n) = ([3000.0; 3], [100.0; 3], [50.0; 3]);
    c.tune(&mut Log::silent()).expect("valid gains");
    tick(&mut c, 5000);
    assert!(c.energy.G <= before.energy.G);
    assert!(c.e_nr[2].abs() < before.e_nr[2].abs() / 10.0);
}

#[test]
fn a_tuned_damping_lasts_through_a_slowed_stretch() {
    let settled = |D_n: f64| {
        let mut c = initialized(|c| (c.law, c.f_h) = (1, [0.0, 4.0, 0.0]));
        c.D_n = [D_n; 3];
        c.tune(&mut Log::silent()).expect("a valid damping");
        let ticks = |c: &mut ArmController, from: u32| (from..from + 4000).for_each(|k| tick(c, k));
        c.q = [0.0, -0.8, 0.2];
        ticks(&mut c, 0);
        assert!(c.slowed && c.dp_n[1] < 0.5 * 4.0 / D_n);
        c.q = [0.0, -0.8, 1.7];
        ticks(&mut c, 4000);
        assert!(!c.slowed);
        c.dp_n[1]
    };
    for D_n in [20.0, 40.0] {
        let v = settled(D_n);
        assert!((v * D_n / 4.0 - 1.0).abs() < 1e-6, "{v} m/s"); // 4 s are 16 time constants or more
    }
}

#[test]
fn a_refused_gain_leaves_the_law_as_it_was() {
    let start = || initialized(|c| c.f_h = [6.0, 0.0, -6.0]);
    let (mut tuned, mut untouched) = (start(), start());
    tuned.K[1] = -1.0;
    assert_eq!(
        tuned.tune(&mut Log::silent()).expect_err("negative").0,
        "K[2] = -1: expected a finite value greater than 0"
    );
    tuned.K = untouched.K; // as the C interface restores it
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
    assert_eq!(initialized(|c| c.K[1] = 3600.0).gain_warning, 1);
    assert_eq!(initialized(|c| c.Lambda_n[2] = 1.0).gain_warning, 2);
    let mut c = initialized(|c| (c.K[0], c.Lambda_n[2]) = (3600.0, 1.0));
    assert_eq!(c.gain_warning, 3);
    c.K = [1000.0; 3];
    c.tune(&mut Log::silent()).expect("valid gains");
    assert_eq!(c.gain_warning, 2);
}
