//! The low pass against its closed forms.

use arm_law::wrench::Wrench;
use arm_law::wrench::filter::LowPass;
use std::f64::consts::PI;

const T: f64 = 0.001;

/// What the filter makes of `u` on each component.
fn filtered(cutoff: f64, n: usize, u: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut filter = LowPass::new(cutoff, T);
    (0..n)
        .map(|k| {
            let components = filter.step(&[u(k as f64 * T); 6].into()).components();
            assert!(components.iter().all(|x| *x == components[0]));
            components[0]
        })
        .collect()
}

#[test]
fn a_step_is_answered_as_the_continuous_filter_answers_a_held_one() {
    let cutoff = 30.0;
    for (k, x) in filtered(cutoff, 200, |_| 1.0).into_iter().enumerate() {
        let exact = 1.0 - (-2.0 * PI * cutoff * (k + 1) as f64 * T).exp();
        assert!((x - exact).abs() < 1e-14); // rounding of 200 steps
    }
}

#[test]
fn a_ramp_is_late_by_what_the_documentation_says() {
    let cutoff = 30.0;
    let a = (-2.0 * PI * cutoff * T).exp();
    let delay = T * a / (1.0 - a);
    let last = *filtered(cutoff, 2000, |t| t).last().unwrap();
    assert!((1.999 - last - delay).abs() < 1e-12); // rounding of sums of up to 2
    assert!((delay - 4.8e-3).abs() < 5e-5); // "4.8 ms", rounded
    assert!((delay - (1.0 / (2.0 * PI * cutoff) - T / 2.0)).abs() < 2e-5); // "about half a sample"
}

#[test]
fn off_means_untouched_also_after_other_samples() {
    assert_eq!(filtered(0.0, 3, |t| 0.1 + t), [0.1, 0.1 + T, 0.1 + 2.0 * T]);
}

#[test]
fn after_a_reset_the_force_builds_up_from_zero() {
    let mut filter = LowPass::new(10.0, T);
    let one = Wrench::from([1.0; 6]);
    let first = filter.step(&one);
    filter.step(&one);
    filter.reset();
    assert_eq!(filter.step(&one), first);
}
