//! Which communication steps become ticks. Part of the tests of both controllers, which say what a `Controller` is, its period
//! `T` (s), how to push it, and what else it could be told between two ticks.

use crate::{Controller, T, initialized, pushed, step, told_otherwise};
use admittance::timing::IN_TIME;
use fmu_export::{Clock, Model, Step};

/// `steps` steps of `h` (s) with the sample `period` (s) asked for.
fn run(period: f64, h: f64, steps: u32) -> Controller {
    let mut controller = initialized(|c| {
        c.parameters.T = period;
        pushed(c);
    });
    (0..steps).for_each(|k| step(&mut controller, k, h));
    controller
}

#[test]
fn steps_that_divide_the_period_run_the_same_ticks_as_one_step_a_tick() {
    let reference = run(T, T, 30);
    assert_eq!((reference.tick, reference.sample_period), (29, T));
    for parts in [2_u32, 3, 4, 10, 40] {
        let mut other = run(T, T / f64::from(parts), 30 * parts);
        assert!(
            (&other.outputs, other.tick) == (&reference.outputs, reference.tick),
            "T/{parts}"
        );
        // The state is the same, too: it goes on alike.
        let mut goes_on = reference.clone();
        for k in 30..60 {
            for controller in [&mut other, &mut goes_on] {
                step(controller, k, T);
            }
            assert!(other.outputs == goes_on.outputs, "T/{parts}, tick {k}");
        }
    }
    // Between two ticks outputs hold.
    let mut between = run(T, T / 4.0, 119);
    assert_eq!(between.tick, 29);
    told_otherwise(&mut between);
    step(&mut between, 119, T / 4.0);
    assert!(between.outputs == reference.outputs);
}

#[test]
fn steps_that_do_not_divide_the_period_are_sampled_with_the_nearest_number_of_steps() {
    // The step in T, and how many make up a sample.
    for (part, steps) in [(1.5, 1), (0.7, 1), (0.3, 3), (30.0, 1), (2.0, 1)] {
        let h = part * T;
        let period = h * f64::from(steps);
        let other = run(T, h, 30 * steps);
        let reference = run(period, period, 30);
        assert!(
            (&other.outputs, other.tick) == (&reference.outputs, reference.tick),
            "h = {h} s"
        );
        assert_eq!((other.sample_period, other.tick), (period, 29));
        assert_eq!(other.outputs.timing, IN_TIME);
    }
}

#[test]
fn a_number_of_ticks_that_is_not_that_of_the_time_is_refused_by_name() {
    let mut controller = initialized(|_| ());
    let mut clock = Clock::at_start(0.0);
    for k in 0..20 {
        step(&mut controller, k, T);
        clock.advance(&Step::at(0.0, T));
    }
    assert_eq!(controller.fits(&clock), Ok(()));
    let refusal = controller.fits(&Clock::at_start(0.0)).unwrap_err();
    let named = format!(
        "beginning of the last sample = {:?} s, expected a time in the 0.0 s",
        19.0 * T
    );
    assert!(refusal.0.starts_with(&named), "{refusal}");
}
