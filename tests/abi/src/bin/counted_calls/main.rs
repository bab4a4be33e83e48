//! The same calls on one FMU again and again, for callgrind to count (`cargo xtask bench`).
//!
//! ```text
//! counted_calls --fmu-dir DIR --fmu NAME --calls N [--moving TABLE]
//! ```
//!
//! The FMU runs at its start values with the step of its default experiment. After some calls that nobody counts, it makes N
//! steps, then gets all outputs N times, then sets all inputs N times, as an importer does: one call for each type that
//! occurs. `counted_part` ends each of the three. It prints the number of outputs and of inputs.
//!
//! With the C host's table of the FMU it moves: parameters are set, each step has other inputs, and N steps are all that is
//! counted.

mod moving;

use abi::{Fmu, Instance, Kind, Status};
use moving::{Moving, Watched};
use std::path::Path;
use std::process::ExitCode;

/// Steps before the first that counts: buffers are filled, the dynamic linker has bound what is called.
const WARM_UP: u32 = 100;

/// Value references by type, with room for the values.
struct Block {
    reals: (Vec<u32>, Vec<f64>),
    integers: (Vec<u32>, Vec<i32>),
    booleans: (Vec<u32>, Vec<i32>),
}

impl Block {
    /// All variables of a causality but Strings.
    fn of(fmu: &Fmu, causality: &str) -> Self {
        let references = |kinds: &[Kind]| -> Vec<u32> {
            let wanted = fmu
                .variables
                .iter()
                .filter(|one| one.causality == causality && kinds.contains(&one.kind));
            wanted.map(|one| one.reference).collect()
        };
        let reals = references(&[Kind::Real {}]);
        let integers = references(&[Kind::Integer {}, Kind::Enumeration {}]);
        let booleans = references(&[Kind::Boolean {}]);
        Self {
            reals: (reals.clone(), vec![0.0; reals.len()]),
            integers: (integers.clone(), vec![0; integers.len()]),
            booleans: (booleans.clone(), vec![0; booleans.len()]),
        }
    }

    fn len(&self) -> usize {
        self.reals.0.len() + self.integers.0.len() + self.booleans.0.len()
    }

    fn get(&mut self, instance: &Instance) {
        let (library, component) = (instance.library(), instance.component());
        macro_rules! get {
            ($function:ident, $block:expr) => {
                let (references, values) = &mut $block;
                if !references.is_empty() {
                    let (n, values) = (references.len(), values.as_mut_ptr());
                    let (call, names) = (library.$function, references.as_ptr());
                    // SAFETY: arrays of the length that is passed; the component is live.
                    let status = unsafe { call(component, names, n, values) };
                    assert_eq!(status, Status::OK, "{:?}", instance.messages());
                }
            };
        }
        get!(fmi2GetReal, self.reals);
        get!(fmi2GetInteger, self.integers);
        get!(fmi2GetBoolean, self.booleans);
    }

    fn set(&self, instance: &Instance) {
        let (library, component) = (instance.library(), instance.component());
        macro_rules! set {
            ($function:ident, $block:expr) => {
                let (references, values) = &$block;
                if !references.is_empty() {
                    let (n, values) = (references.len(), values.as_ptr());
                    let (call, names) = (library.$function, references.as_ptr());
                    // SAFETY: arrays of the length that is passed; the component is live.
                    let status = unsafe { call(component, names, n, values) };
                    assert_eq!(status, Status::OK, "{:?}", instance.messages());
                }
            };
        }
        set!(fmi2SetReal, self.reals);
        set!(fmi2SetInteger, self.integers);
        set!(fmi2SetBoolean, self.booleans);
    }
}

/// Where callgrind writes down what it has counted so far, and begins anew.
#[unsafe(no_mangle)]
#[inline(never)]
extern "C" fn counted_part() {
    // A function that does nothing at all would not be called.
    std::hint::black_box(());
}

fn step(fmu: &Fmu, instance: &Instance, k: u32) {
    let status = instance.step(f64::from(k) * fmu.step_size, fmu.step_size);
    assert_eq!(status, Status::OK, "{:?}", instance.messages());
}

fn play_moving(fmu: &Fmu, calls: u32, moving: &Moving) {
    let instance = fmu.instantiate_as(&fmu.setup().silent());
    moving.prepare(fmu, &instance);
    instance.initialize(0.0);
    let mut watched = Watched::new(fmu, &instance);
    for k in 0..WARM_UP + calls {
        if k == WARM_UP {
            counted_part();
        }
        moving.set(k, &instance);
        step(fmu, &instance, k);
        if k >= WARM_UP {
            watched.moved();
        }
    }
    counted_part();
}

fn play(fmu: &Fmu, calls: u32) {
    let instance = fmu.instantiate_as(&fmu.setup().silent());
    instance.initialize(0.0);
    let (mut outputs, mut inputs) = (Block::of(fmu, "output"), Block::of(fmu, "input"));
    let step = |k| step(fmu, &instance, k);
    inputs.get(&instance);
    outputs.get(&instance);
    inputs.set(&instance);
    (0..WARM_UP).for_each(step);
    counted_part();
    (WARM_UP..WARM_UP + calls).for_each(step);
    counted_part();
    (0..calls).for_each(|_| outputs.get(&instance));
    counted_part();
    (0..calls).for_each(|_| inputs.set(&instance));
    counted_part();
    println!("{} {}", outputs.len(), inputs.len());
}

fn main() -> ExitCode {
    let words: Vec<_> = std::env::args().skip(1).collect();
    let words: Vec<_> = words.iter().map(String::as_str).collect();
    let calls = |text: &str| text.parse().ok().filter(|calls| *calls > 0);
    if let [
        "--fmu-dir",
        folder,
        "--fmu",
        name,
        "--calls",
        text,
        ref more @ ..,
    ] = *words
        && let Some(calls) = calls(text)
    {
        let fmu = Fmu::open_in(Path::new(folder), name);
        match more {
            [] => play(&fmu, calls),
            ["--moving", table] => play_moving(&fmu, calls, &Moving::read(Path::new(table))),
            _ => return usage(),
        }
        return ExitCode::SUCCESS;
    }
    usage()
}

fn usage() -> ExitCode {
    eprintln!("usage: counted_calls --fmu-dir DIR --fmu NAME --calls N [--moving TABLE]");
    ExitCode::FAILURE
}
