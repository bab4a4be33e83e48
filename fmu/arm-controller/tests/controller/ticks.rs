//! Ticks and step sizes.

use crate::{ArmController, initialized, step};
use admittance::timing::{EARLY, IN_TIME, LATE};
use fmu_export::{Clock, Model, Step};

/// `steps` steps of `h` (s) with the sample period `T` (s) asked for.
#[allow(non_snake_case, reason = "the paper's symbol")]
fn run(T: f64, h: f64, steps: u32) -> ArmController {
    let mut controller = initialized(|c| {
        c.parameters.T = T;
        c.inputs.f_h = [3.0, -2.0, 5.0];
    });
    (0..steps).for_each(|k| step(&mut controller, k, h));
    controller
}

#[test]
fn steps_that_divide_the_period_run_the_same_ticks_as_one_step_a_tick() {
    let reference = run(0.001, 0.001, 30);
    assert_eq!((reference.tick, reference.sample_period), (29, 0.001));
    for parts in [2_u32, 3, 4, 10, 40] {
        let mut other = run(0.001, 0.001 / f64::from(parts), 30 * parts);
        assert!(
            (&other.outputs, other.tick) == (&reference.outputs, reference.tick),
            "T/{parts}"
        );
        // The state is the same, too: it goes on alike.
        let mut goes_on = reference.clone();
        for k in 30..60 {
            for controller in [&mut other, &mut goes_on] {
                step(controller, k, 0.001);
            }
            assert!(other.outputs == goes_on.outputs, "T/{parts}, tick {k}");
        }
    }
    // Between two ticks outputs hold.
    let mut between = run(0.001, 0.001 / 4.0, 119);
    assert_eq!(between.tick, 29);
    between.inputs.f_h = [-100.0; 3];
    between.inputs.q = [0.0; 3];
    step(&mut between, 119, 0.001 / 4.0);
    assert_eq!(
        (between.outputs.tau_a, between.outputs.p),
        (reference.outputs.tau_a, reference.outputs.p)
    );
}

#[test]
fn steps_that_do_not_divide_the_period_are_sampled_with_the_nearest_number_of_steps() {
    // The step, how many make up a sample, and that sample's period.
    for (h, steps) in [(0.0015, 1), (0.0007, 1), (0.0003, 3), (0.03, 1), (0.002, 1)] {
        let period = h * f64::from(steps);
        let other = run(0.001, h, 30 * steps);
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
        step(&mut controller, k, 0.001);
        clock.advance(&Step::at(0.0, 0.001));
    }
    assert_eq!(controller.fits(&clock), Ok(()));
    let refusal = controller.fits(&Clock::at_start(0.0)).unwrap_err();
    let named = "beginning of the last sample = 0.019 s, expected a time in the 0.0 s";
    assert!(refusal.0.starts_with(named), "{refusal}");
}

#[test]
fn a_step_that_is_longer_than_those_before_is_a_late_tick_with_the_right_velocity() {
    let mut c = initialized(|_| ());
    let start = c.inputs.q;
    let mut t = 0.0;
    let mut go = |c: &mut ArmController, h: f64| {
        let by = [0.5, -0.3, 0.2].map(|dq| dq * t); // rad
        c.inputs.q = core::array::from_fn(|i| start[i] + by[i]);
        let step = Step::at(t, h);
        c.step(step, &mut fmu_export::Log::silent())
            .expect("a step");
        t += h;
    };
    for _ in 0..20 {
        go(&mut c, 0.001);
    }
    let dp = c.outputs.dp;
    let near = |c: &ArmController| (0..3).all(|i| (c.outputs.dp[i] - dp[i]).abs() < 0.01);
    // 6.1 ms, and then two that are there at once.
    for (h, tick, timing) in [
        (0.0061, 20, IN_TIME), // this step's own beginning was in time
        (0.0009, 26, LATE),
        (0.0001, 27, IN_TIME),
        (0.001, 28, EARLY),
        (0.001, 29, IN_TIME),
    ] {
        go(&mut c, h);
        assert!(near(&c), "{:?} and {dp:?}", c.outputs.dp);
        assert_eq!((c.tick, c.outputs.timing), (tick, timing), "h = {h}");
        assert_eq!(c.outputs.encoder_fault, 0);
    }
}
