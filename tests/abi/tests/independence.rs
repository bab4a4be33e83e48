//! Reset, several instances, threads: each run equals a run alone, bit for bit.

use abi::{Fmu, Instance, Kind, Status};

const STEPS: u32 = 300;

/// Step `k` of run `run`: its own inputs, then the whole state as bytes.
fn step(fmu: &Fmu, instance: &Instance, run: u32, k: u32) -> Vec<u8> {
    let inputs: Vec<_> = fmu
        .variables
        .iter()
        .filter(|v| v.causality == "input" && v.kind == Kind::Real {})
        .map(|v| v.reference)
        .collect();
    let phase = f64::from(k) * 0.05 + f64::from(run);
    let values: Vec<_> = (0..inputs.len())
        .map(|i| (phase + i as f64).sin() * [0.1, 10.0, 6.0][i % 3])
        .collect();
    assert_eq!(instance.set_real(&inputs, &values), Status::OK);
    let status = instance.step(f64::from(k) * 0.002, 0.002);
    assert_eq!(status, Status::OK, "{:?}", instance.messages());
    instance.bytes()
}

/// The states of a run alone.
fn alone(fmu: &Fmu, run: u32) -> Vec<Vec<u8>> {
    let instance = fmu.instantiate();
    instance.initialize(0.0);
    (0..STEPS).map(|k| step(fmu, &instance, run, k)).collect()
}

#[test]
fn a_run_after_reset_equals_the_first() {
    for fmu in Fmu::all() {
        let expected = alone(&fmu, 0);
        assert_ne!(
            expected[10], expected[200],
            "nothing moves, nothing is tested"
        );
        let instance = fmu.instantiate();
        let new = instance.bytes();
        // Traces that a reset must wipe: another start time, another tunable parameter, another run.
        let tunable = fmu
            .variables
            .iter()
            .find(|v| v.variability == "tunable" && v.kind == Kind::Real {});
        if let Some(v) = tunable {
            let half = instance.real(v.reference) / 2.0;
            assert_eq!(instance.set_real(&[v.reference], &[half]), Status::OK);
        }
        instance.initialize(0.0);
        (0..50).for_each(|k| drop(step(&fmu, &instance, 9, k)));
        assert_eq!(instance.reset(), Status::OK);
        assert_eq!(
            instance.bytes(),
            new,
            "{}: as after fmi2Instantiate",
            fmu.name
        );
        instance.initialize(0.0);
        let again: Vec<_> = (0..STEPS).map(|k| step(&fmu, &instance, 0, k)).collect();
        assert!(again == expected, "{}", fmu.name);
    }
}

#[test]
fn two_interleaved_instances_equal_two_alone() {
    for fmu in Fmu::all() {
        let expected = [alone(&fmu, 1), alone(&fmu, 2)];
        assert!(expected[0] != expected[1], "the two runs differ");
        let instances = [fmu.instantiate(), fmu.instantiate()];
        instances
            .iter()
            .for_each(|instance| instance.initialize(0.0));
        for k in 0..STEPS {
            for (i, instance) in instances.iter().enumerate() {
                let bytes = step(&fmu, instance, i as u32 + 1, k);
                assert!(
                    bytes == expected[i][k as usize],
                    "{} instance {i} step {k}",
                    fmu.name
                );
            }
        }
    }
}

#[test]
fn instances_on_eight_threads_equal_one() {
    for fmu in Fmu::all() {
        let expected: Vec<_> = (0..8).map(|run| alone(&fmu, run)).collect();
        let got: Vec<_> = std::thread::scope(|scope| {
            let threads: Vec<_> = (0..8)
                .map(|run| {
                    // Made here, run there: an importer may hand instances over.
                    let instance = fmu.instantiate();
                    let fmu = &fmu;
                    scope.spawn(move || {
                        instance.initialize(0.0);
                        (0..STEPS)
                            .map(|k| step(fmu, &instance, run, k))
                            .collect::<Vec<_>>()
                    })
                })
                .collect();
            threads
                .into_iter()
                .map(|t| t.join().expect("no panic"))
                .collect()
        });
        assert!(got == expected, "{}", fmu.name);
    }
}

#[test]
fn reading_changes_nothing() {
    for fmu in Fmu::all() {
        let expected = alone(&fmu, 3);
        let instance = fmu.instantiate();
        instance.initialize(0.0);
        for k in 0..STEPS {
            for v in &fmu.variables {
                match v.kind {
                    Kind::Real {} => drop(instance.real(v.reference)),
                    Kind::Integer {} | Kind::Enumeration {} => drop(instance.integer(v.reference)),
                    Kind::Boolean {} => drop(instance.boolean(v.reference)),
                    Kind::String {} => drop(instance.string(v.reference)),
                }
            }
            assert!(
                step(&fmu, &instance, 3, k) == expected[k as usize],
                "{} step {k}",
                fmu.name
            );
        }
    }
}
