//! Times: experiments, communication points and step sizes that are accepted or refused.

use abi::refusal::refused;
use abi::{Fmu, Instance, Phase, Status};

#[test]
fn step_sizes_that_are_no_step_are_refused_at_once() {
    for fmu in Fmu::all() {
        let instance = Phase::StepComplete.enter(&fmu);
        for (h, text) in [
            (0.0, "= 0.0 s"),
            (-0.0, "= -0.0 s"),
            (-1.0, "= -1.0 s"),
            (f64::NAN, "NaN"),
            (f64::INFINITY, "= inf"),
            (-f64::INFINITY, "= -inf"),
        ] {
            let parts = [
                "communicationStepSize",
                text,
                "finite normal number above 0",
            ];
            refused(&instance, "fmi2DoStep", &parts, |i| i.step(0.0, h));
        }
        assert_eq!(instance.step(0.0, 0.002), Status::OK);
        // Below the resolution of the time: no progress.
        refused(
            &instance,
            "fmi2DoStep",
            &["does not advance the time 0.002 s"],
            |i| i.step(0.002, 1e-20),
        );
        assert_eq!(instance.step(0.002, 0.002), Status::OK);
    }
}

#[test]
fn the_smallest_steps_are_steps() {
    for fmu in Fmu::all() {
        let instance = Phase::StepComplete.enter(&fmu);
        let mut t = 0.0;
        // Below the smallest normal number 1/h is infinite.
        refused(&instance, "fmi2DoStep", &["5e-324", "normal"], |i| {
            i.step(0.0, f64::from_bits(1))
        });
        for h in [f64::MIN_POSITIVE, 1e-300, 1e-12] {
            assert_eq!(instance.step(t, h), Status::OK, "{:?}", instance.messages());
            t += h;
        }
    }
}

#[test]
fn a_step_of_too_many_periods_is_refused_before_anything_moves() {
    for (name, period) in [
        ("TestbedController", "T"),
        ("Testbed", "substep"),
        ("ArmController", "T"),
        ("ExoskeletonArm", "substep"),
        ("ExoskeletonArms", "substep"),
    ] {
        let instance = Phase::StepComplete.enter(&Fmu::open(name));
        refused(&instance, "fmi2DoStep", &["at most", period], |i| {
            i.step(0.0, 1e300)
        });
        assert_eq!(instance.step(0.0, 0.01), Status::OK);
    }
}

#[test]
fn time_never_becomes_infinite() {
    // The test model, because a sampled model would run 1e311 ticks.
    let fmu = Fmu::lag();
    let instance = Phase::StepComplete.enter(&fmu);
    assert_eq!(instance.step(0.0, f64::MAX), Status::OK);
    refused(&instance, "fmi2DoStep", &["communicationStepSize"], |i| {
        i.step(f64::MAX, f64::MAX)
    });
}

#[test]
fn a_wrong_communication_point_is_refused_with_both_times() {
    for fmu in Fmu::all() {
        let instance = Phase::StepComplete.enter(&fmu);
        assert_eq!(instance.step(0.0, 0.01), Status::OK);
        for (t, text) in [
            (0.0, "got 0 s"),
            (0.02, "got 0.02 s"),
            (-0.01, "got -0.01 s"),
            (0.0101, "got 0.0101 s"),
            (f64::NAN, "got NaN s"),
            (f64::INFINITY, "got inf s"),
            (-1e300, "got -1e300 s"),
            (2.5e-300, "got 2.5e-300 s"),
        ] {
            let parts = ["expected currentCommunicationPoint 0.01 s", text];
            refused(&instance, "fmi2DoStep", &parts, |i| i.step(t, 0.01));
        }
        // What importers really pass: a rounding error beside it.
        assert_eq!(instance.step(0.010_000_000_000_000_009, 0.01), Status::OK);
    }
}

/// Initializes for an experiment that ends.
fn until(instance: &Instance, start: f64, stop: f64) {
    assert_eq!(instance.setup_experiment(start, Some(stop)), Status::OK);
    assert_eq!(instance.enter_initialization_mode(), Status::OK);
    assert_eq!(instance.exit_initialization_mode(), Status::OK);
}

#[test]
fn a_step_past_the_stop_time_is_refused_with_time_step_and_stop_time_and_a_rounding_is_not() {
    for fmu in Fmu::all() {
        let instance = Phase::Instantiated.enter(&fmu);
        until(&instance, 0.0, 0.3);
        for k in 0..2 {
            let status = instance.step(f64::from(k) * 0.1, 0.1);
            assert_eq!(status, Status::OK, "{:?}", instance.messages());
        }
        // It begins before the stop time and ends a thousandth of a step behind it.
        for (h, text) in [(0.1001, "0.1001 s"), (0.2, "0.2 s"), (1e6, "1000000.0 s")] {
            let parts = [
                "currentCommunicationPoint = 0.2 s",
                &format!("communicationStepSize = {text}"),
                "stopTime = 0.3 s",
            ];
            refused(&instance, "fmi2DoStep", &parts, |i| i.step(0.2, h));
        }
        // 3 * 0.1 s is a rounding past it.
        assert!(f64::from(3) * 0.1 > 0.3);
        assert_eq!(instance.step(0.2, 0.1), Status::OK);
        refused(&instance, "fmi2DoStep", &["stopTime = 0.3 s"], |i| {
            i.step(0.3, 0.1)
        });
        // A reset forgets it, and another experiment has another one.
        assert_eq!(instance.reset(), Status::OK);
        instance.initialize(0.0);
        for k in 0..5 {
            let status = instance.step(f64::from(k) * 0.1, 0.1);
            assert_eq!(status, Status::OK, "{:?}", instance.messages());
        }
        assert_eq!(instance.reset(), Status::OK);
        until(&instance, -1.0, -0.9);
        assert_eq!(instance.step(-1.0, 0.1), Status::OK);
        refused(&instance, "fmi2DoStep", &["stopTime = -0.9 s"], |i| {
            i.step(-0.9, 0.1)
        });
    }
}

#[test]
fn a_state_brings_no_stop_time_and_takes_none_away() {
    for fmu in Fmu::all() {
        let short = fmu.instantiate();
        until(&short, 0.0, 0.1);
        assert_eq!(short.step(0.0, 0.1), Status::OK);
        let mut end = short.state();
        let long = fmu.instantiate();
        until(&long, 0.0, 0.2);
        assert_eq!(long.set_state(end), Status::OK);
        assert_eq!(long.step(0.1, 0.1), Status::OK, "{:?}", long.messages());
        refused(&long, "fmi2DoStep", &["stopTime = 0.2 s"], |i| {
            i.step(0.2, 0.1)
        });
        assert_eq!(short.set_state(end), Status::OK);
        refused(&short, "fmi2DoStep", &["stopTime = 0.1 s"], |i| {
            i.step(0.1, 0.1)
        });
        assert_eq!(short.free_state(&mut end), Status::OK);
    }
}

#[test]
fn an_experiment_that_cannot_be_is_refused() {
    for fmu in Fmu::all() {
        let instance = Phase::Instantiated.enter(&fmu);
        let (nan, inf) = (f64::NAN, f64::INFINITY);
        for (tolerance, start, stop, part) in [
            (None, nan, None, "startTime = NaN"),
            (None, inf, None, "startTime = inf"),
            (None, 1.0, Some(0.5), "stopTime = 0.5"),
            (None, 0.0, Some(nan), "stopTime = NaN"),
            (
                None,
                1e300,
                Some(-1e300),
                "stopTime = -1e300 s, expected at least startTime = 1e300 s",
            ),
            (Some(-1e300), 0.0, None, "tolerance = -1e300,"),
            (Some(nan), 0.0, None, "tolerance = NaN"),
            (Some(-1e-6), 0.0, None, "tolerance = -0.000001"),
        ] {
            refused(&instance, "fmi2SetupExperiment", &[part], |i| {
                let (t, s) = (tolerance.unwrap_or_default(), stop.unwrap_or_default());
                let (td, sd) = (tolerance.is_some().into(), stop.is_some().into());
                // SAFETY: numbers only.
                unsafe { (i.library().fmi2SetupExperiment)(i.component(), td, t, start, sd, s) }
            });
        }
        assert_eq!(instance.setup_experiment(-3.0, Some(-3.0)), Status::OK);
        assert_eq!(instance.enter_initialization_mode(), Status::OK);
        assert_eq!(instance.exit_initialization_mode(), Status::OK);
        refused(&instance, "fmi2DoStep", &["stopTime = -3.0 s"], |i| {
            i.step(-3.0, 0.01)
        });
    }
}
