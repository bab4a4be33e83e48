//! What is promised for the measured positions holds for the true ones but for the sensor's step.
//!
//! With δ = q − q̂, |δ| ≤ ½ of the step h, the true work of the held forces differs from the measured by, summed by parts,
//!
//! ```text
//! Σ f_k (δ_{k+1} − δ_k) = f_n δ_{n+1} − f_0 δ_0 − Σ (f_k − f_{k−1}) δ_k  ≤  ½ h (|f_0| + |f_n| + Σ |f_k − f_{k−1}|)
//! ```
#![allow(non_snake_case, reason = "the paper's symbols")]

use admittance::{Admittance, Gains, Law, Settings};
use nalgebra::Vector1;

const T: f64 = 0.002;
const STEP: f64 = 1e-4;

/// True less measured work of the controller, J, and the bound.
fn run(true_position: impl Fn(f64, f64) -> f64) -> (f64, f64) {
    let settings = Settings {
        law: Law::PassiveBounded,
        T,
        dq_cutoff: 30.0,
        ..Settings::default()
    };
    let gains = Gains {
        M_n: 5.0,
        D_n: 2.0,
        K: 300.0,
        K_P: 20.0,
        f_max: 200.0,
    };
    let mut law = Admittance::new(settings, [gains]).expect("valid parameters");
    let (mut difference, mut variation) = (0.0, 0.0);
    let mut before: Option<(f64, f64, f64)> = None; // measured, true position, force
    let mut f_first = None;
    for k in 0..10_000 {
        let t = T * f64::from(k);
        let measured = (0.1 * (2.0 * t).sin() / STEP).round() * STEP;
        let f = law
            .step(
                &Vector1::new(measured),
                &Vector1::new(10.0 * (3.0 * t).cos()),
            )
            .f
            .x;
        let change = before.map_or(0.0, |(_, _, last)| f - last);
        let q = true_position(measured, change);
        assert!((q - measured).abs() <= 0.5 * STEP * (1.0 + 1e-9));
        if let Some((measured_before, q_before, f)) = before {
            difference += f * ((q - q_before) - (measured - measured_before));
        }
        variation += change.abs();
        f_first.get_or_insert(f);
        before = Some((measured, q, f));
    }
    let ends = f_first.map_or(0.0, f64::abs) + before.map_or(0.0, |(_, _, f)| f.abs());
    (difference, 0.5 * STEP * (variation + ends))
}

#[test]
fn the_true_work_differs_by_no_more_than_half_a_step_times_the_variation_of_the_force() {
    let (difference, bound) = run(|measured, _| measured + 0.5 * STEP * (1e6 * measured).sin());
    assert!(difference.abs() <= bound);
    assert!(bound < 10.0, "{bound} J");
}

/// And a robot that hides within the sensor's step at the right moments comes near the bound: it is no smaller.
#[test]
fn a_robot_that_hides_within_the_step_reaches_that_bound() {
    let (difference, bound) = run(|measured, change| {
        let hidden = if change > 0.0 { -0.5 } else { 0.5 };
        measured + hidden * STEP
    });
    println!("{difference} J of at most {bound} J");
    assert!(
        difference <= bound && difference > 0.9 * bound,
        "{difference} of {bound} J"
    );
}
