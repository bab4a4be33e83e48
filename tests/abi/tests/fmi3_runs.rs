//! FMI 3.0: runs equal those of FMI 2.0 bit for bit, states go from one version to the other, and scheduled execution is
//! co-simulation with a step of one period.

use abi::Status;
use abi::fmi3::{Fmu, Instance, Interface, Type, Value, mirror};
use std::sync::Barrier;

/// Sets the k-th inputs: each Float64 moves on a course of its own, what is true or false is true, and what counts is 1.
fn load(fmu: &Fmu, k: u32, instance: &Instance, also: Option<&abi::Instance>) {
    let inputs = fmu.rows.iter().filter(|row| row.causality() == "input");
    for (i, row) in inputs.filter(|row| row.name != "panic").enumerate() {
        let values: Vec<_> = (0..row.len())
            .map(|element| match row.kind {
                Type::Float64 => {
                    let phase = f64::from(k) * (0.02 + 0.003 * i as f64) + element as f64;
                    Value::Number(0.2 * phase.sin())
                }
                Type::Boolean => Value::Truth(1),
                _ => Value::Integer(1),
            })
            .collect();
        let status = instance.write(row, &values);
        assert_eq!(
            status,
            Status::OK,
            "{}: {:?}",
            row.name,
            instance.messages()
        );
        let Some(also) = also else { continue };
        for (value, element) in values.iter().zip(&row.elements) {
            let status = match value {
                Value::Number(value) => also.set_real(&[element.reference], &[*value]),
                Value::Truth(_) => also.set_boolean(&[element.reference], &[1]),
                _ => also.set_integer(&[element.reference], &[1]),
            };
            assert_eq!(status, Status::OK, "{}", element.name);
        }
    }
}

/// All values of all rows.
fn seen(fmu: &Fmu, instance: &Instance) -> Vec<String> {
    let show = |row| format!("{:?}", instance.read(row));
    fmu.rows.iter().map(show).collect()
}

const STEPS: u32 = 300;

#[test]
fn a_run_by_fmi_3_equals_the_run_by_fmi_2_bit_for_bit() {
    for fmu in Fmu::all() {
        let (three, two) = (fmu.instantiate(), fmu.fmi2.instantiate());
        three.initialize(0.0);
        two.initialize(0.0);
        let h = fmu.fmi2.step_size;
        let mut changed = false;
        for k in 0..STEPS {
            load(&fmu, k, &three, Some(&two));
            let before = three.bytes();
            let t = f64::from(k) * h;
            assert_eq!(three.step(t, h), Status::OK, "{:?}", three.messages());
            assert_eq!(two.step(t, h), Status::OK);
            assert_eq!(three.bytes(), two.bytes(), "{} at {t} s", fmu.name());
            changed |= three.bytes() != before;
            for row in fmu.rows.iter().filter(|row| row.kind == Type::Float64) {
                let scalars: Vec<_> = row.elements.iter().map(|one| one.reference).collect();
                let expected = two.get_real(&scalars).expect("readable");
                let bits = |value: f64| value.to_bits();
                let expected: Vec<_> = expected.into_iter().map(bits).collect();
                let got = three.read(row).expect("readable");
                let got: Vec<_> = got
                    .into_iter()
                    .map(|value| match value {
                        Value::Number(value) => value.to_bits(),
                        other => panic!("{other:?}"),
                    })
                    .collect();
                assert_eq!(got, expected, "{} {} at {t} s", fmu.name(), row.name);
            }
        }
        assert!(changed, "{} moves", fmu.name());
    }
}

#[test]
fn an_activation_equals_a_step_of_one_period_bit_for_bit() {
    for fmu in Fmu::sampled() {
        let steps = fmu.instantiate();
        let scheduled = fmu.instantiate_as(Interface::ScheduledExecution);
        steps.initialize(5.0);
        scheduled.initialize(5.0);
        let period = fmu.fmi2.step_size;
        let mut changed = 0;
        for k in 0..STEPS {
            load(&fmu, k, &steps, None);
            load(&fmu, k, &scheduled, None);
            let before = seen(&fmu, &scheduled);
            let t = 5.0 + f64::from(k) * period;
            assert_eq!(steps.step(t, period), Status::OK);
            assert_eq!(
                scheduled.activate(t),
                Status::OK,
                "{:?}",
                scheduled.messages()
            );
            assert_eq!(
                seen(&fmu, &scheduled),
                seen(&fmu, &steps),
                "{} at {t} s",
                fmu.name()
            );
            assert_eq!(scheduled.bytes(), steps.bytes(), "{} at {t} s", fmu.name());
            assert!(
                (scheduled.time() - t).abs() <= 1e-15 * t,
                "the time is that of the activation"
            );
            changed += u32::from(before != seen(&fmu, &scheduled));
        }
        assert!(changed > STEPS / 2, "{}: {changed}", fmu.name());
    }
}

#[test]
fn an_activation_at_another_time_or_of_another_clock_is_refused_and_the_next_is_as_it_was() {
    for fmu in Fmu::sampled() {
        let scheduled = fmu.instantiate_as(Interface::ScheduledExecution);
        scheduled.initialize(0.0);
        assert_eq!(scheduled.activate(0.0), Status::OK);
        let before = scheduled.bytes();
        let period = fmu.fmi2.step_size;
        for t in [0.0, 0.5 * period, 2.0 * period, f64::NAN, f64::INFINITY] {
            scheduled.messages();
            assert_eq!(scheduled.activate(t), Status::ERROR, "{t}");
            let text = scheduled.message();
            let expected = format!("activationTime = {t:?} s, expected {period:?} s");
            assert!(
                text.starts_with("fmi3ActivateModelPartition: ") && text.contains(&expected),
                "{text}"
            );
        }
        for clock in [0, 0xFFFF_FFFF] {
            // SAFETY: the component is live.
            let status = unsafe {
                (scheduled.library().fmi3ActivateModelPartition)(
                    scheduled.component(),
                    clock,
                    period,
                )
            };
            assert_eq!(status, Status::ERROR);
            assert!(
                scheduled
                    .message()
                    .contains(&format!("clockReference = {clock}, expected 4294967294"))
            );
        }
        assert_eq!(scheduled.bytes(), before);
        assert_eq!(scheduled.activate(period), Status::OK);
    }
}

#[test]
fn a_state_goes_on_by_another_version_and_another_interface_bit_for_bit() {
    for fmu in Fmu::all() {
        let two = fmu.fmi2.instantiate();
        two.initialize(0.0);
        let h = fmu.fmi2.step_size;
        let step = |k: u32| f64::from(k) * h;
        for k in 0..5 {
            assert_eq!(two.step(step(k), h), Status::OK);
        }
        let three = fmu.instantiate();
        assert_eq!(
            three.restore(&two.bytes()),
            Status::OK,
            "{:?}",
            three.messages()
        );
        assert_eq!(three.bytes(), two.bytes(), "{}", fmu.name());
        assert_eq!(three.step(step(5), h), Status::OK, "{:?}", three.messages());
        assert_eq!(two.step(step(5), h), Status::OK);
        assert_eq!(three.bytes(), two.bytes(), "{}", fmu.name());
        let back = fmu.fmi2.instantiate();
        let mut state = back
            .deserialize(&three.bytes())
            .expect("a state of FMI 3.0");
        assert_eq!(back.set_state(state), Status::OK);
        assert_eq!(back.free_state(&mut state), Status::OK);
        assert_eq!(back.step(step(6), h), Status::OK);
        assert_eq!(two.step(step(6), h), Status::OK);
        assert_eq!(back.bytes(), two.bytes(), "{}", fmu.name());
    }
    for fmu in Fmu::sampled() {
        let steps = fmu.instantiate();
        steps.initialize(0.0);
        let h = fmu.fmi2.step_size;
        assert_eq!(steps.step(0.0, h), Status::OK);
        let scheduled = fmu.instantiate_as(Interface::ScheduledExecution);
        assert_eq!(scheduled.restore(&steps.bytes()), Status::OK);
        assert_eq!(
            scheduled.activate(h),
            Status::OK,
            "{:?}",
            scheduled.messages()
        );
        assert_eq!(steps.step(h, h), Status::OK);
        assert_eq!(scheduled.bytes(), steps.bytes());
    }
}

#[test]
fn a_restored_state_runs_on_as_the_first_time_and_a_reset_as_a_new_instance() {
    for fmu in Fmu::all() {
        let instance = fmu.instantiate();
        let h = fmu.fmi2.step_size;
        let run = |from: u32| {
            for k in from..from + 20 {
                load(&fmu, k, &instance, None);
                assert_eq!(instance.step(f64::from(k) * h, h), Status::OK);
            }
            instance.bytes()
        };
        instance.initialize(0.0);
        let first = run(0);
        let mut state = instance.state();
        let second = run(20);
        assert_eq!(instance.set_state(state), Status::OK);
        assert_eq!(instance.bytes(), first);
        assert_eq!(run(20), second, "{}", fmu.name());
        assert_eq!(instance.free_state(&mut state), Status::OK);
        assert!(state.is_null());
        assert_eq!(instance.reset(), Status::OK);
        instance.initialize(0.0);
        assert_eq!(run(0), first, "{}", fmu.name());
    }
}

/// Initializes and runs with the inputs of run `run`; the state after each step or activation.
fn course(fmu: &Fmu, instance: &Instance, interface: Interface, run: u32) -> Vec<Vec<u8>> {
    let h = fmu.fmi2.step_size;
    instance.initialize(0.0);
    (0..STEPS)
        .map(|k| {
            load(fmu, k + 1000 * run, instance, None);
            let t = f64::from(k) * h;
            let status = match interface {
                Interface::ScheduledExecution => instance.activate(t),
                _ => instance.step(t, h),
            };
            assert_eq!(status, Status::OK, "{:?}", instance.messages());
            instance.bytes()
        })
        .collect()
}

#[test]
fn two_instances_in_two_threads_at_once_equal_each_alone_bit_for_bit() {
    let co_simulation = Fmu::all()
        .into_iter()
        .map(|fmu| (fmu, Interface::CoSimulation));
    let scheduled = Fmu::sampled()
        .into_iter()
        .map(|fmu| (fmu, Interface::ScheduledExecution));
    for (fmu, interface) in co_simulation.chain(scheduled) {
        let alone = [0, 1].map(|run| course(&fmu, &fmu.instantiate_as(interface), interface, run));
        assert!(alone[0] != alone[1], "{}: the two runs differ", fmu.name());
        let begin = Barrier::new(2);
        let together = std::thread::scope(|scope| {
            let threads = [0, 1].map(|run| {
                // Made here, run there: an importer may hand instances over.
                let instance = fmu.instantiate_as(interface);
                let (fmu, begin) = (&fmu, &begin);
                scope.spawn(move || {
                    begin.wait();
                    course(fmu, &instance, interface, run)
                })
            });
            threads.map(|thread| thread.join().expect("no panic"))
        });
        assert!(together == alone, "{} {interface:?}", fmu.name());
    }
}

#[test]
fn a_panic_is_an_error_that_leaves_other_instances_alone_and_a_reset_recovers() {
    let fmu = Fmu::new(abi::Fmu::lag());
    let (instance, other) = (fmu.instantiate(), fmu.instantiate());
    instance.initialize(0.0);
    other.initialize(0.0);
    assert_eq!(
        instance.write(fmu.row("panic"), &[Value::Truth(1)]),
        Status::OK
    );
    instance.messages();
    assert_eq!(instance.step(0.0, 0.01), Status::ERROR);
    let text = instance.message();
    assert!(
        text.starts_with("fmi3DoStep: panic in the model: provoked with 100 percent"),
        "{text}"
    );
    assert!(
        text.ends_with("the instance needs fmi3Reset, fmi3SetFMUState or fmi3FreeInstance"),
        "{text}"
    );
    assert_eq!(instance.step(0.0, 0.01), Status::ERROR);
    assert!(
        instance
            .message()
            .contains("not legal in the phase 'Terminated', expected 'Step Mode'")
    );
    assert!(
        instance.read(fmu.row("y")).is_ok(),
        "values are readable after an error"
    );
    assert_eq!(other.step(0.0, 0.01), Status::OK);
    assert_eq!(instance.reset(), Status::OK);
    instance.initialize(0.0);
    assert_eq!(instance.step(0.0, 0.01), Status::OK);
}

#[test]
fn random_calls_on_two_instances_of_every_fmu_do_what_fmi_2_does() {
    for fmu in Fmu::all().into_iter().chain([Fmu::narrow()]) {
        let calls = if fmu.name() == "Lag" { 40_000 } else { 3_000 };
        let played = mirror::play(&fmu, calls, 1).unwrap_or_else(|report| panic!("{report}"));
        assert_eq!(played.calls, calls);
        let share = played.accepted as f64 / played.calls as f64;
        assert!((0.2..0.95).contains(&share), "{}: {played:?}", fmu.name());
        assert!(fmu.name() != "Lag" || played.broken > 10, "{played:?}");
    }
}
