//! Hosts differ in their floating-point environment: some trap invalid operations, some flush denormal numbers to zero, some
//! round otherwise. None of it may stop a model or change what it does by more than rounding.
#![cfg(all(target_os = "linux", target_env = "gnu"))]

use abi::{Fmu, Instance, Kind, Status, Variable};
use std::ffi::c_int;

#[link(name = "m")]
unsafe extern "C" {
    safe fn feclearexcept(exceptions: c_int) -> c_int;
    safe fn fetestexcept(exceptions: c_int) -> c_int;
    safe fn fesetround(mode: c_int) -> c_int;
}

/// FE_INVALID, FE_DIVBYZERO, FE_OVERFLOW: what a host may trap.
#[cfg(target_arch = "x86_64")]
const TRAPPED: [(c_int, &str); 3] = [(1, "invalid"), (4, "division by zero"), (8, "overflow")];
#[cfg(target_arch = "aarch64")]
const TRAPPED: [(c_int, &str); 3] = [(1, "invalid"), (2, "division by zero"), (4, "overflow")];

/// FE_TONEAREST and the other three.
#[cfg(target_arch = "x86_64")]
const ROUNDING: [c_int; 4] = [0, 0x400, 0x800, 0xc00];
#[cfg(target_arch = "aarch64")]
const ROUNDING: [c_int; 4] = [0, 0x80_0000, 0x40_0000, 0xc0_0000];

/// What a call raises, by name.
fn raised(call: impl FnOnce()) -> Vec<&'static str> {
    let all = TRAPPED.iter().fold(0, |all, (bit, _)| all | bit);
    feclearexcept(all);
    call();
    let seen = fetestexcept(all);
    let names = TRAPPED.iter().filter(|(bit, _)| seen & bit != 0);
    names.map(|(_, name)| *name).collect()
}

/// A value for a variable that is not a Real, or is one.
#[derive(Clone, Debug)]
struct Setting {
    name: String,
    reference: u32,
    kind: Kind,
    value: f64,
}

impl Setting {
    fn new(variable: &Variable, value: f64) -> Self {
        Self {
            name: variable.name.clone(),
            reference: variable.reference,
            kind: variable.kind,
            value,
        }
    }

    fn set(&self, instance: &Instance) -> Status {
        let references = [self.reference];
        match self.kind {
            Kind::Real {} => instance.set_real(&references, &[self.value]),
            Kind::Boolean {} => instance.set_boolean(&references, &[self.value as c_int]),
            Kind::Integer {} | Kind::Enumeration {} => {
                instance.set_integer(&references, &[self.value as c_int])
            }
            Kind::String {} => Status::OK,
        }
    }
}

/// Settings of one parameter each: every choice, both truths, and each end of its range that is not far.
fn alternatives(fmu: &Fmu) -> Vec<Setting> {
    let parameters = fmu.variables.iter().filter(|v| v.causality == "parameter");
    parameters
        .flat_map(|v| {
            let (low, high) = v.bounds.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
            let values: Vec<f64> = match v.kind {
                Kind::Boolean {} => vec![0.0, 1.0],
                Kind::Integer {} if high <= 10.0 => {
                    (low as i32..=high as i32).map(f64::from).collect()
                }
                Kind::Integer {} => vec![low],
                Kind::Real {} if low == 0.0 => vec![0.0, 1.0],
                Kind::Real {} => vec![low, 1.0, high],
                Kind::Enumeration {} | Kind::String {} => vec![],
            };
            values
                .into_iter()
                .filter(move |value| (low..=high).contains(value))
                .map(|value| Setting::new(v, value))
        })
        .collect()
}

/// Under which law, in which space or form each alternative is tried.
fn grounds(fmu: &Fmu) -> Vec<Vec<Setting>> {
    let mut grounds = vec![vec![]];
    for name in ["law", "space", "form"] {
        let Some(variable) = fmu.variables.iter().find(|v| v.name == name) else {
            continue;
        };
        let (low, high) = variable.bounds.expect("a choice has bounds");
        grounds = (low as i32..=high as i32)
            .flat_map(|value| {
                let setting = Setting::new(variable, f64::from(value));
                grounds
                    .iter()
                    .map(move |ground| [ground.as_slice(), std::slice::from_ref(&setting)].concat())
                    .collect::<Vec<_>>()
            })
            .collect();
    }
    grounds
}

/// Real inputs with their start values, and whether they are forces.
fn inputs(fmu: &Fmu) -> Vec<(u32, f64, bool)> {
    let inputs = fmu.variables.iter().filter(|v| v.causality == "input");
    inputs
        .filter(|v| matches!(v.kind, Kind::Real {}))
        .map(|v| {
            let start = v.start.as_ref().and_then(|start| start.parse().ok());
            let name = v.name.rsplit('.').next().expect("a name");
            let force = ["tau", "f_", "force"]
                .iter()
                .any(|start| name.starts_with(start));
            (
                v.reference,
                start.expect("an input has a start value"),
                force,
            )
        })
        .collect()
}

/// Steps at rest, steps with pushes and small motions, and more at rest; `each` sees every status.
fn run(
    fmu: &Fmu,
    instance: &Instance,
    steps: u32,
    mut each: impl FnMut(&mut dyn FnMut() -> Status),
) {
    let inputs = inputs(fmu);
    let references: Vec<u32> = inputs.iter().map(|(reference, ..)| *reference).collect();
    for k in 0..steps {
        let pushed = (steps / 4..3 * steps / 4).contains(&k);
        let values: Vec<f64> = (0..)
            .zip(&inputs)
            .map(|(i, (_, start, force))| match (pushed, force) {
                (false, _) => *start,
                // Along the third component alone, too: the others then stay exactly 0.
                (true, true) if k % 2 == 0 => start - 400.0 * f64::from(u8::from(i % 3 == 2)),
                (true, true) => start + 20.0 * f64::from(k % 7) - 15.0 * f64::from(i % 3),
                (true, false) => start + 1e-4 * f64::from((k % 5) * (1 + i % 2)),
            })
            .collect();
        assert_eq!(instance.set_real(&references, &values), Status::OK);
        each(&mut || instance.step(f64::from(k) * fmu.step_size, fmu.step_size));
    }
}

/// An initialized instance with these settings, unless they are refused.
fn begun(fmu: &Fmu, settings: &[Setting], found: &mut Vec<&'static str>) -> Option<Instance> {
    let instance = fmu.instantiate_as(&fmu.setup().silent());
    let mut status = Status::OK;
    let seen = raised(|| {
        for setting in settings {
            if status == Status::OK {
                status = setting.set(&instance);
            }
        }
        if status == Status::OK {
            assert_eq!(instance.setup_experiment(0.0, None), Status::OK);
            status = instance.enter_initialization_mode();
        }
        if status == Status::OK {
            status = instance.exit_initialization_mode();
        }
    });
    if status != Status::OK {
        return None;
    }
    found.extend(seen);
    Some(instance)
}

/// What each accepted setting raises.
fn offenders(fmu: &Fmu) -> (usize, Vec<String>) {
    let (mut accepted, mut offenders) = (0, Vec::new());
    for ground in grounds(fmu) {
        let mut trials = vec![ground.clone()];
        for alternative in alternatives(fmu) {
            trials.push([ground.as_slice(), &[alternative]].concat());
        }
        for settings in trials {
            let mut found = Vec::new();
            let Some(instance) = begun(fmu, &settings, &mut found) else {
                continue;
            };
            let mut refused = false;
            run(fmu, &instance, 48, |step| {
                let mut status = Status::OK;
                let seen = raised(|| status = step());
                refused |= status != Status::OK;
                if !refused {
                    found.extend(seen);
                }
            });
            accepted += 1;
            if !found.is_empty() {
                found.sort_unstable();
                found.dedup();
                let settings: Vec<_> = settings
                    .iter()
                    .map(|s| format!("{} = {}", s.name, s.value))
                    .collect();
                offenders.push(format!("{}: {}: {found:?}", fmu.name, settings.join(", ")));
            }
        }
    }
    (accepted, offenders)
}

#[test]
fn nothing_that_is_accepted_raises_what_a_host_may_trap() {
    let mut all = Vec::new();
    for fmu in Fmu::products() {
        let (accepted, offenders) = offenders(&fmu);
        println!("{}: {accepted} settings", fmu.name);
        assert!(accepted > 15, "{}: {accepted}", fmu.name);
        all.extend(offenders);
    }
    assert!(all.is_empty(), "{} of them:\n{}", all.len(), all.join("\n"));
}

/// All finite Real outputs after a run.
fn outcome(fmu: &Fmu) -> Vec<f64> {
    let instance = begun(fmu, &[], &mut Vec::new()).expect("start values");
    let outputs: Vec<u32> = fmu
        .variables
        .iter()
        .filter(|v| v.causality == "output" && matches!(v.kind, Kind::Real {}))
        .map(|v| v.reference)
        .collect();
    run(fmu, &instance, 400, |step| assert_eq!(step(), Status::OK));
    instance.get_real(&outputs).expect("outputs")
}

fn assert_alike(name: &str, what: &str, one: &[f64], other: &[f64]) {
    for (i, (a, b)) in one.iter().zip(other).enumerate() {
        // A friction that sticks or slips a substep later: 1e-6 of what moves. Rounding alone is 1e-12.
        assert!(
            (a - b).abs() <= 1e-6 * (1.0 + a.abs()),
            "{name}, {what}: output {i}: {a} and {b}"
        );
    }
}

#[test]
fn every_rounding_mode_gives_the_same_but_for_rounding() {
    for fmu in Fmu::products() {
        let nearest = outcome(&fmu);
        for mode in ROUNDING {
            fesetround(mode);
            let other = outcome(&fmu);
            fesetround(ROUNDING[0]);
            assert_alike(&fmu.name, &format!("rounding {mode:#x}"), &nearest, &other);
        }
    }
}

/// Flush to zero and denormals are zero.
#[cfg(target_arch = "x86_64")]
#[test]
fn denormal_numbers_may_be_flushed_to_zero() {
    fn control(change: impl FnOnce(u32) -> u32) -> u32 {
        let mut before = 0_u32;
        // SAFETY: reads and writes the control register of this thread's SSE unit; the bits set are defined.
        unsafe {
            std::arch::asm!("stmxcsr [{}]", in(reg) &raw mut before);
            let after = change(before);
            std::arch::asm!("ldmxcsr [{}]", in(reg) &raw const after);
        }
        before
    }
    for fmu in Fmu::products() {
        let whole = outcome(&fmu);
        let before = control(|bits| bits | 0x8040);
        let flushed = outcome(&fmu);
        control(|_| before);
        assert_alike(&fmu.name, "flushed", &whole, &flushed);
    }
}
