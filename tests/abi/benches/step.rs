//! Nanoseconds for one set + step + get through dlopen: what a coupling loop pays for each FMU and tick.
//!
//! The test model, whose step is a handful of operations, shows what the C interface itself costs.

use abi::{Fmu, Instance, Status};
use divan::Bencher;

/// Sets the inputs, steps by 2 ms, gets the outputs.
fn set_step_get(bencher: Bencher<'_, '_>, fmu: &Fmu, inputs: &[&str], outputs: &[&str]) {
    let instance: Instance = fmu.instantiate_as(&fmu.setup().silent());
    instance.initialize(0.0);
    let inputs: Vec<_> = inputs.iter().map(|name| fmu.reference(name)).collect();
    let outputs: Vec<_> = outputs.iter().map(|name| fmu.reference(name)).collect();
    let (library, component) = (instance.library(), instance.component());
    let mut values = vec![0.0; inputs.len()];
    let mut got = vec![0.0; outputs.len()];
    let mut k = 0_u32;
    bencher.bench_local(|| {
        let t = f64::from(k) * 0.002;
        // Slow triangle: moving, never in saturation, no function of the C library to be timed.
        values.fill(1e-3 * f64::from((k % 2000).abs_diff(1000)));
        k += 1;
        // SAFETY: arrays of the lengths that are passed; the component is live.
        let status = unsafe {
            let set =
                (library.fmi2SetReal)(component, inputs.as_ptr(), inputs.len(), values.as_ptr());
            let step = (library.fmi2DoStep)(component, t, 0.002, 1);
            let get =
                (library.fmi2GetReal)(component, outputs.as_ptr(), outputs.len(), got.as_mut_ptr());
            [set, step, get]
        };
        assert_eq!(status, [Status::OK; 3]);
        got[0]
    });
}

#[divan::bench(sample_count = 200, sample_size = 1000)]
fn lag(bencher: Bencher<'_, '_>) {
    set_step_get(bencher, &Fmu::lag(), &["u"], &["u", "y"]);
}

#[divan::bench(sample_count = 200, sample_size = 1000)]
fn testbed_controller(bencher: Bencher<'_, '_>) {
    let fmu = Fmu::open("TestbedController");
    set_step_get(bencher, &fmu, &["q", "tau_h"], &["tau_a", "e_nr"]);
}

#[divan::bench(sample_count = 200, sample_size = 1000)]
fn testbed(bencher: Bencher<'_, '_>) {
    let fmu = Fmu::open("Testbed");
    set_step_get(bencher, &fmu, &["tau_a", "tau_h"], &["q", "dq"]);
}

fn main() {
    divan::main();
}
