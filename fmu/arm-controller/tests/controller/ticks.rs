//! Ticks and step sizes.

use crate::{initialized, step};
use export::{Clock, Model, Step};

#[test]
fn odd_step_sizes_run_the_same_ticks_as_one_step_a_tick() {
    let run = |h: f64, steps: u32| {
        let mut controller = initialized(|c| c.inputs.f_h = [3.0, -2.0, 5.0]);
        (0..steps).for_each(|k| step(&mut controller, k, h));
        controller
    };
    let reference = run(0.001, 30);
    assert_eq!(reference.tick, 29);
    for (h, steps) in [(0.0001, 300), (0.0015, 20), (0.03, 1), (0.0005, 60)] {
        let mut other = run(h, steps);
        assert!(
            (&other.outputs, other.tick) == (&reference.outputs, reference.tick),
            "h = {h} s"
        );
        // The state is the same, too: it goes on alike.
        let mut goes_on = reference.clone();
        for k in 30..60 {
            for controller in [&mut other, &mut goes_on] {
                step(controller, k, 0.001);
            }
            assert!(other.outputs == goes_on.outputs, "h = {h} s, tick {k}");
        }
    }
    // Between two ticks outputs hold: 0.02975 s to 0.03 s contains none.
    let mut between = run(0.00025, 119);
    assert_eq!(between.tick, 29);
    between.inputs.f_h = [-100.0; 3];
    between.inputs.q = [0.0; 3];
    step(&mut between, 119, 0.00025);
    assert_eq!(
        (between.outputs.tau_a, between.outputs.p),
        (reference.outputs.tau_a, reference.outputs.p)
    );
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
    let named = "number of ticks = 20, expected 0 periods of 0.001 s";
    assert!(refusal.0.starts_with(named), "{refusal}");
}
