//! Random calls in random order on two instances, about 200 000 of them: never a crash, only fmi2OK and fmi2Error, and
//! always the one that a model of the standard's state machine predicts, with the values it predicts.
//!
//! Here every number of the test model is known in closed form. `tests/random.rs` does without that, on any FMU.

use abi::types::{FmuState, LAST_SUCCESSFUL_TIME, TERMINATED};
use abi::{Fmu, Instance, Phase, Status};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed, TestRunner};
use std::ptr::null_mut;

#[derive(Clone, Copy, Debug)]
enum Call {
    Setup { start: f64 },
    Enter,
    Exit,
    Terminate,
    Reset,
    SetU(f64),
    SetTau(f64),
    SetGain(f64),
    SetPanic(bool),
    SetOutput,
    GetUnknown,
    Step { off: f64, h: f64 },
    Save(usize),
    Restore(usize),
    Free(usize),
    ThroughBytes(usize),
    Unsupported,
    Logging(bool),
}

/// What the test model should be, after its source's three lines and the standard's life cycle.
#[derive(Clone, Copy, Debug)]
struct Expected {
    phase: Phase,
    start: f64,
    time: f64,
    u: f64,
    y: f64,
    tau: f64,
    gain: f64,
    steps: i32,
    panic: bool,
}

impl Expected {
    const NEW: Self = Self {
        phase: Phase::Instantiated,
        start: 0.0,
        time: 0.0,
        u: 0.0,
        y: 0.0,
        tau: 0.5,
        gain: 1.0,
        steps: 0,
        panic: false,
    };

    fn before_run(&self) -> bool {
        matches!(self.phase, Phase::Instantiated | Phase::InitializationMode)
    }

    fn settable(&self) -> bool {
        self.before_run() || self.phase == Phase::StepComplete
    }

    /// Initialization, which any Get in Initialization Mode shows.
    fn initialize(&mut self) {
        self.y = self.gain * self.u;
        self.steps = 0;
    }

    /// Whether the call is accepted, with its effect.
    fn accept(&mut self, call: Call, saved: &mut [Option<Self>; 3]) -> bool {
        match call {
            Call::Setup { start } => {
                let legal = self.phase == Phase::Instantiated && start.is_finite();
                if legal {
                    (self.start, self.time) = (start, start);
                }
                legal
            }
            Call::Enter => self.change(Phase::Instantiated, Phase::InitializationMode),
            Call::Exit => {
                let legal = self.change(Phase::InitializationMode, Phase::StepComplete);
                if legal {
                    self.initialize();
                }
                legal
            }
            Call::Terminate => self.change(Phase::StepComplete, Phase::Terminated),
            Call::Reset => {
                *self = Self::NEW;
                true
            }
            Call::SetU(u) => {
                let legal = self.settable() && u.is_finite();
                if legal {
                    self.u = u;
                }
                legal
            }
            Call::SetTau(tau) => {
                let legal = self.before_run() && (1e-6..=1e6).contains(&tau);
                if legal {
                    self.tau = tau;
                }
                legal
            }
            Call::SetGain(gain) => {
                let refused_in_run = self.phase == Phase::StepComplete && gain == 13.0;
                let legal = self.settable() && (-1e3..=1e3).contains(&gain) && !refused_in_run;
                if legal {
                    self.gain = gain;
                }
                legal
            }
            Call::SetPanic(panic) => {
                let legal = self.settable();
                if legal {
                    self.panic = panic;
                }
                legal
            }
            Call::SetOutput | Call::GetUnknown | Call::Unsupported => false,
            Call::Step { off, h } => {
                let legal =
                    self.phase == Phase::StepComplete && h.is_finite() && h > 0.0 && off == 0.0;
                if !legal {
                    return false;
                }
                if self.panic {
                    self.phase = Phase::Error;
                    return false;
                }
                self.y += -(-h / self.tau).exp_m1() * (self.gain * self.u - self.y);
                self.steps += 1;
                self.time += h;
                true
            }
            Call::Save(slot) => {
                saved[slot] = Some(*self);
                true
            }
            Call::Restore(slot) => saved[slot].map(|state| *self = state).is_some(),
            Call::Free(slot) => {
                saved[slot] = None;
                true
            }
            Call::ThroughBytes(slot) => saved[slot].is_some(),
            Call::Logging(_) => true,
        }
    }

    fn change(&mut self, from: Phase, to: Phase) -> bool {
        let legal = self.phase == from;
        if legal {
            self.phase = to;
        }
        legal
    }
}

/// The call on the library.
fn perform(
    fmu: &Fmu,
    instance: &Instance,
    call: Call,
    time: f64,
    states: &mut [FmuState; 3],
) -> Status {
    let (l, c) = (&fmu.library, instance.component());
    match call {
        Call::Setup { start } => instance.setup_experiment(start, None),
        Call::Enter => instance.enter_initialization_mode(),
        Call::Exit => instance.exit_initialization_mode(),
        Call::Terminate => instance.terminate(),
        Call::Reset => instance.reset(),
        Call::SetU(u) => instance.set_real(&[fmu.reference("u")], &[u]),
        Call::SetTau(tau) => instance.set_real(&[fmu.reference("tau")], &[tau]),
        Call::SetGain(gain) => instance.set_real(&[fmu.reference("gain")], &[gain]),
        Call::SetPanic(on) => instance.set_boolean(&[fmu.reference("panic")], &[on.into()]),
        Call::SetOutput => instance.set_real(&fmu.references(["u", "y"]), &[1.0, 1.0]),
        Call::GetUnknown => instance
            .get_real(&[fmu.reference("u"), 77_777])
            .map_or_else(|s| s, |_| Status::OK),
        Call::Step { off, h } => instance.step(time + off, h),
        // SAFETY: the slot holds null or a live state of this library.
        Call::Save(slot) => unsafe { (l.fmi2GetFMUstate)(c, &raw mut states[slot]) },
        Call::Restore(slot) => instance.set_state(states[slot]),
        Call::Free(slot) => instance.free_state(&mut states[slot]),
        Call::ThroughBytes(slot) => {
            let mut size = 0;
            // SAFETY: null or a live state; the size is a local.
            let status = unsafe { (l.fmi2SerializedFMUstateSize)(c, states[slot], &raw mut size) };
            if status != Status::OK {
                return status;
            }
            let bytes = instance.serialize(states[slot]);
            // SAFETY: the bytes are those; the slot holds a live state, which is replaced by its own copy.
            unsafe {
                (l.fmi2DeSerializeFMUstate)(
                    c,
                    bytes.as_ptr().cast(),
                    bytes.len(),
                    &raw mut states[slot],
                )
            }
        }
        // SAFETY: no arguments.
        Call::Unsupported => unsafe { (l.fmi2CancelStep)(c) },
        Call::Logging(on) => instance.set_debug_logging(on, &[]),
    }
}

/// Compares everything that can be read with what is expected.
fn compare(fmu: &Fmu, instance: &Instance, expected: &mut Expected) -> Result<(), TestCaseError> {
    if expected.phase == Phase::InitializationMode {
        expected.initialize();
    }
    let references = fmu.references(["u", "y", "tau", "gain"]);
    let got = instance
        .get_real(&references)
        .expect("Get is accepted in every phase");
    let e = *expected;
    // exp_m1 of two C libraries may differ in the last bit, which up to 400 steps carry on.
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-12 * a.abs().max(b.abs());
    prop_assert!(close(got[1], e.y), "y = {}, {e:?}", got[1]);
    prop_assert_eq!((got[0], got[2], got[3]), (e.u, e.tau, e.gain));
    prop_assert_eq!(instance.integer(fmu.reference("steps")), e.steps);
    prop_assert_eq!(instance.boolean(fmu.reference("panic")), i32::from(e.panic));
    let (mut time, mut ended) = (f64::NAN, 7);
    // SAFETY: the values are locals.
    let statuses = unsafe {
        [
            (fmu.library.fmi2GetRealStatus)(
                instance.component(),
                LAST_SUCCESSFUL_TIME,
                &raw mut time,
            ),
            (fmu.library.fmi2GetBooleanStatus)(instance.component(), TERMINATED, &raw mut ended),
        ]
    };
    if e.before_run() {
        prop_assert_eq!(statuses, [Status::ERROR; 2]);
    } else {
        prop_assert_eq!((statuses, time, ended), ([Status::OK; 2], e.time, 0));
    }
    Ok(())
}

/// The instance and the call that a random number stands for. (A number each: quick to draw, and what proptest shrinks
/// is still the list.)
fn decode(number: u16) -> (usize, Call) {
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    let (instance, kind, pick) = (number % 2, number / 2 % 48, usize::from(number / 96));
    let slot = pick % 3;
    let of = |values: &[f64]| values[pick % values.len()];
    let call = match kind {
        0 => Call::Setup {
            start: of(&[0.0, 1.5, -2.0, nan, inf]),
        },
        1..=4 => Call::Enter,
        5..=8 => Call::Exit,
        9 => Call::Terminate,
        10..=11 => Call::Reset,
        12..=15 => Call::SetU(of(&[-4.7, -1.0, 0.0, 0.3, 2.0, 5.1, nan, inf, -inf])),
        16..=17 => Call::SetTau(of(&[1e-6, 0.1, 2.0, 0.0, -1.0, 1e7, nan])),
        18..=20 => Call::SetGain(of(&[0.0, 2.0, -3.0, 13.0, 2e3, nan])),
        21 => Call::SetPanic(pick % 2 == 0),
        22 => Call::SetOutput,
        23 => Call::GetUnknown,
        24..=36 => Call::Step {
            off: 0.0,
            h: of(&[1e-3, 0.01, 0.5, 3.0]),
        },
        37..=38 => Call::Step {
            off: 0.0,
            h: of(&[0.0, -1.0, nan, inf]),
        },
        39 => Call::Step {
            off: of(&[0.3, -0.3, nan, inf]),
            h: 0.01,
        },
        40..=41 => Call::Save(slot),
        42..=43 => Call::Restore(slot),
        44 => Call::Free(slot),
        45 => Call::ThroughBytes(slot),
        46 => Call::Unsupported,
        _ => Call::Logging(pick % 2 == 0),
    };
    (usize::from(instance), call)
}

#[test]
fn random_calls_on_two_instances_do_what_the_state_machine_predicts() {
    let fmu = Fmu::lag();
    let config = Config {
        cases: 500,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(20_051),
        ..Config::default()
    };
    let sequences = prop::collection::vec(any::<u16>(), 400);
    let mut visited = [0_u32; 5];
    let visits = std::cell::RefCell::new(&mut visited);
    let result = TestRunner::new(config).run(&sequences, |sequence| {
        let instances = [fmu.instantiate(), fmu.instantiate()];
        let mut expected = [Expected::NEW; 2];
        // Shared by both instances: a state of one may be set on the other.
        let (mut states, mut saved) = ([null_mut(); 3], [None; 3]);
        for (k, (i, call)) in sequence.into_iter().map(decode).enumerate() {
            let time = expected[i].time;
            let status = perform(&fmu, &instances[i], call, time, &mut states);
            let accepted = expected[i].accept(call, &mut saved);
            let predicted = if accepted { Status::OK } else { Status::ERROR };
            prop_assert_eq!(status, predicted, "{:?} {:?}", call, expected[i]);
            // Both, seldom enough to be quick: the other one must not have noticed.
            compare(&fmu, &instances[i], &mut expected[i])?;
            if k % 16 == 0 {
                compare(&fmu, &instances[1 - i], &mut expected[1 - i])?;
            }
            visits.borrow_mut()[expected[i].phase as usize] += 1;
        }
        for state in &mut states {
            prop_assert_eq!(instances[0].free_state(state), Status::OK);
        }
        Ok(())
    });
    if let Err(error) = result {
        panic!("{error}");
    }
    assert!(
        visited.iter().all(|&n| n > 2000),
        "each phase is visited: {visited:?}"
    );
}
