//! FMI 3.0: where an experiment ends, and the period of the clock.

use abi::Status;
use abi::fmi3::{Fmu, Instance, Interface, Value};
use abi::refusal::refused;

/// Initializes for an experiment that ends.
fn until(instance: &Instance, start: f64, stop: f64) {
    let entered = instance.enter_initialization_mode(start, Some(stop));
    assert_eq!(entered, Status::OK, "{:?}", instance.messages());
    assert_eq!(instance.exit_initialization_mode(), Status::OK);
    instance.messages();
}

#[test]
fn a_step_past_the_stop_time_is_refused_with_time_step_and_stop_time_and_a_rounding_is_not() {
    for fmu in Fmu::all() {
        let instance = fmu.instantiate();
        until(&instance, 0.0, 0.3);
        for k in 0..2 {
            assert_eq!(instance.step(f64::from(k) * 0.1, 0.1), Status::OK);
        }
        refused(
            &instance,
            "fmi3DoStep",
            &[
                "currentCommunicationPoint = 0.2 s",
                "communicationStepSize = 0.1001 s",
                "stopTime = 0.3 s",
            ],
            |i| i.step(0.2, 0.1001),
        );
        assert_eq!(instance.step(0.2, 0.1), Status::OK);
        refused(&instance, "fmi3DoStep", &["stopTime = 0.3 s"], |i| {
            i.step(0.3, 0.1)
        });
        assert_eq!(instance.reset(), Status::OK);
        instance.initialize(0.0);
        for k in 0..5 {
            let status = instance.step(f64::from(k) * 0.1, 0.1);
            assert_eq!(status, Status::OK, "{:?}", instance.messages());
        }
    }
}

#[test]
fn an_activation_past_the_stop_time_is_refused_and_one_at_it_is_not() {
    for fmu in Fmu::sampled() {
        let period = fmu.fmi2.step_size;
        let instance = fmu.instantiate_as(Interface::ScheduledExecution);
        until(&instance, 0.0, 3.0 * period);
        for k in 0..=3 {
            let status = instance.activate(f64::from(k) * period);
            assert_eq!(status, Status::OK, "{k}: {:?}", instance.messages());
        }
        instance.messages();
        let stop = format!("not past stopTime = {:?} s", 3.0 * period);
        refused(
            &instance,
            "fmi3ActivateModelPartition",
            &["activationTime = ", &stop],
            |i| i.activate(4.0 * period),
        );
    }
}

#[test]
fn another_sample_period_than_the_clock_s_is_refused_by_name_in_scheduled_execution_alone() {
    for fmu in Fmu::sampled() {
        let period = fmu.fmi2.step_size;
        let row = fmu.row("T");
        let other = [Value::Number(2.0 * period)];
        let instance = fmu.instantiate_as(Interface::ScheduledExecution);
        assert_eq!(instance.write(row, &other), Status::OK);
        assert_eq!(instance.enter_initialization_mode(0.0, None), Status::OK);
        let words = [
            &format!("T = {:?} s", 2.0 * period) as &str,
            &format!("expected {period:?} s"),
            "the clock's interval is constant",
        ];
        refused(&instance, "fmi3ExitInitializationMode", &words, |i| {
            i.exit_initialization_mode()
        });
        // The start value, set by the importer, is the clock's.
        assert_eq!(instance.write(row, &[Value::Number(period)]), Status::OK);
        assert_eq!(instance.exit_initialization_mode(), Status::OK);
        assert_eq!(instance.activate(0.0), Status::OK);

        // In co-simulation it is the sample period, and such a state is none of a scheduled instance.
        let steps = fmu.instantiate();
        assert_eq!(steps.write(row, &other), Status::OK);
        steps.initialize(0.0);
        assert_eq!(steps.step(0.0, 2.0 * period), Status::OK);
        let bytes = steps.bytes();
        refused(&instance, "fmi3SetFMUState", &words, |i| i.restore(&bytes));
        assert_eq!(instance.activate(period), Status::OK);
    }
}
