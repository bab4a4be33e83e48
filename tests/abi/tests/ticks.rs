//! Ticks and substeps do not depend on how an importer cuts time into steps.

use abi::{Fmu, Instance, Status};

const T: f64 = 0.002;

/// An initialized controller under a constant push, and the references of what it shows.
fn controller(fmu: &Fmu) -> Instance {
    let instance = fmu.instantiate();
    instance.initialize(0.0);
    let inputs = fmu.references(["q", "tau_h"]);
    assert_eq!(instance.set_real(&inputs, &[0.05, 3.0]), Status::OK);
    instance
}

/// What a controller shows: the tick and all Real outputs, bit for bit.
fn outputs(fmu: &Fmu, instance: &Instance) -> (i32, Vec<u64>) {
    let reals: Vec<_> = fmu
        .variables
        .iter()
        .filter(|v| v.causality == "output" && v.kind == abi::Kind::Real {})
        .map(|v| v.reference)
        .collect();
    let values = instance.get_real(&reals).expect("outputs can be read");
    let bits = values.into_iter().map(f64::to_bits).collect();
    (instance.integer(fmu.reference("tick")), bits)
}

/// The outputs after each of the first `n` ticks, by steps of exactly one period.
fn by_the_period(fmu: &Fmu, n: u32) -> Vec<(i32, Vec<u64>)> {
    let instance = controller(fmu);
    (0..n)
        .map(|k| {
            assert_eq!(instance.step(f64::from(k) * T, T), Status::OK);
            outputs(fmu, &instance)
        })
        .collect()
}

#[test]
fn one_step_of_the_period_runs_one_tick_and_the_first_runs_tick_zero() {
    let fmu = Fmu::open("TestbedController");
    let all = by_the_period(&fmu, 200);
    for (k, (tick, _)) in all.iter().enumerate() {
        assert_eq!(*tick, k as i32);
    }
    assert!(
        all.windows(2).all(|pair| pair[0].1 != pair[1].1),
        "the outputs move at every tick"
    );
}

#[test]
fn any_step_size_runs_the_ticks_that_lie_in_it() {
    let fmu = Fmu::open("TestbedController");
    let reference = by_the_period(&fmu, 720);
    for h in [T / 10.0, T / 3.0, T, 1.5 * T, 7.0 * T] {
        let instance = controller(&fmu);
        for i in 0..(1.4 / h) as u32 {
            let t = f64::from(i) * h;
            assert_eq!(instance.step(t, h), Status::OK, "{:?}", instance.messages());
            // Ticks in [0, t + h): the last is the greatest k with k·T < t + h, seen with an importer's rounding.
            let last = ((f64::from(i + 1) * h / T - 1e-6).ceil() - 1.0) as usize;
            assert_eq!(
                outputs(&fmu, &instance),
                reference[last],
                "h = {h}, t = {t}"
            );
        }
    }
}

#[test]
fn random_step_sizes_run_the_ticks_that_lie_in_them() {
    let fmu = Fmu::open("TestbedController");
    let reference = by_the_period(&fmu, 1100);
    let instance = controller(&fmu);
    let (mut t, mut seed) = (0.0, 7_u64);
    while t < 2.0 {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let h = ((seed >> 40) as f64 + 1.0) / (1_u64 << 24) as f64 * 5.0 * T;
        let end = (t + h) / T;
        // A point within the exporter's tolerance (1e-3 of a period) of a tick could be either side of it.
        if (end - end.round()).abs() < 1e-2 {
            continue;
        }
        assert_eq!(instance.step(t, h), Status::OK);
        t += h;
        assert_eq!(
            outputs(&fmu, &instance),
            reference[end.ceil() as usize - 1],
            "t = {t}"
        );
    }
}

#[test]
fn two_hundred_thousand_steps_run_one_tick_each_whether_times_are_summed_or_multiplied() {
    let fmu = Fmu::open("TestbedController");
    let n = 200_000;
    let [summed, multiplied] = [controller(&fmu), controller(&fmu)];
    let tick = fmu.reference("tick");
    let mut t = 0.0;
    for k in 0..n {
        assert_eq!(summed.step(t, T), Status::OK);
        assert_eq!(multiplied.step(f64::from(k) * T, T), Status::OK);
        t += T;
        assert_eq!((summed.integer(tick), multiplied.integer(tick)), (k, k));
    }
    assert_eq!(outputs(&fmu, &summed), outputs(&fmu, &multiplied));
    assert!(
        t != f64::from(n) * T,
        "the sum has rounded, or nothing was tested"
    );
}

#[test]
fn ticks_count_from_the_start_time() {
    let fmu = Fmu::open("TestbedController");
    let reference = by_the_period(&fmu, 50);
    for start in [-1.0, 0.0013, 1e4] {
        let instance = fmu.instantiate();
        instance.initialize(start);
        assert_eq!(
            instance.set_real(&fmu.references(["q", "tau_h"]), &[0.05, 3.0]),
            Status::OK
        );
        for (k, expected) in (0..).zip(&reference) {
            assert_eq!(instance.step(start + f64::from(k) * T, T), Status::OK);
            assert_eq!(
                &outputs(&fmu, &instance),
                expected,
                "start {start}, tick {k}"
            );
        }
    }
}

#[test]
fn the_testbed_ends_where_one_large_step_ends_when_the_substeps_are_the_same() {
    let fmu = Fmu::open("Testbed");
    // Powers of two: the lengths of substeps and all times are exact, so that equal means equal.
    let (substep, small, n) = (2.0_f64.powi(-14), 2.0_f64.powi(-9), 512);
    let run = |h: f64, steps: u32| {
        let instance = fmu.instantiate();
        assert_eq!(
            instance.set_real(&[fmu.reference("substep")], &[substep]),
            Status::OK
        );
        instance.initialize(0.0);
        // Fast enough for 0.3 m in 1 s: friction, flight and the wall are all in it.
        assert_eq!(
            instance.set_real(&[fmu.reference("tau_h")], &[8.0]),
            Status::OK
        );
        for k in 0..steps {
            assert_eq!(instance.step(f64::from(k) * h, h), Status::OK);
        }
        let outputs = fmu.references(["q", "dq", "tau_f", "energy.residual", "energy.loss_wall"]);
        instance.get_real(&outputs).expect("outputs")
    };
    let reference = run(small, n);
    assert!(reference[4] > 0.0, "the wall is hit: {reference:?}");
    for parts in [1, 2, 4, 64] {
        assert_eq!(
            run(f64::from(n) * small / f64::from(parts), parts),
            reference,
            "{parts} steps"
        );
    }
}
