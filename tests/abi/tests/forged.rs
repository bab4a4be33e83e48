//! FMU states that no run leads to, with a right checksum: refused by name, or a step answers, soon and without a panic.

use abi::refusal::refused;
use abi::types::FmuState;
use abi::{Fmu, Instance, Kind, Phase, Status};
use std::ops::Range;
use std::ptr::null_mut;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// Where the header says the version of the format, how long the payload is, and its checksum (modelDescription/export/src/snapshot.rs).
const VERSION: Range<usize> = 8..12;
const LENGTH: Range<usize> = 54..62;
const CHECKSUM: Range<usize> = 62..66;
const HEADER: usize = 66;

/// Where the payload has the times of the clock, after one byte for the phase.
const START_TIME: usize = 1;
const TIME: usize = 9;
const ELAPSED: usize = 17;
const ELAPSED_LOW: usize = 25;

/// Longer than any step here takes: ten periods of a model that takes 0.1 ms for one.
const PATIENCE: Duration = Duration::from_secs(20);

/// A state's bytes with another payload.
fn forged(bytes: &[u8], payload: &[u8]) -> Vec<u8> {
    let mut forged = bytes[..HEADER].to_vec();
    forged[LENGTH].copy_from_slice(&(payload.len() as u64).to_le_bytes());
    forged[CHECKSUM].copy_from_slice(&crc32fast::hash(payload).to_le_bytes());
    forged.extend_from_slice(payload);
    forged
}

/// A state's bytes with these in the place of the payload's from `at` on, `replaced` of them.
fn with(bytes: &[u8], at: usize, replaced: usize, new: &[u8]) -> Vec<u8> {
    let mut payload = bytes[HEADER..].to_vec();
    payload.splice(
        at..(at + replaced).min(bytes.len() - HEADER),
        new.iter().copied(),
    );
    forged(bytes, &payload)
}

/// A state's bytes with another number in the payload.
fn with_number(bytes: &[u8], at: usize, number: f64) -> Vec<u8> {
    with(bytes, at, 8, &number.to_le_bytes())
}

/// An instance after 30 steps in which everything moves, the human's hand with a reflex.
fn moved(fmu: &Fmu) -> Instance {
    let instance = fmu.instantiate();
    for (name, value) in [("k_h", 100.0), ("delay", 0.01), ("ft.noise", 0.1)] {
        let named = |v: &&abi::Variable| v.name == name && v.kind == (Kind::Real {});
        if let Some(v) = fmu.variables.iter().find(named) {
            assert_eq!(instance.set_real(&[v.reference], &[value]), Status::OK);
        }
    }
    instance.initialize(0.0);
    let inputs = fmu.variables.iter().filter(|v| v.causality == "input");
    for (i, v) in inputs.enumerate() {
        if v.kind == (Kind::Real {}) {
            let value = 0.1 * (1.0 + i as f64).sin();
            assert_eq!(instance.set_real(&[v.reference], &[value]), Status::OK);
        } else if v.kind == (Kind::Boolean {}) && v.name != "panic" {
            assert_eq!(instance.set_boolean(&[v.reference], &[1]), Status::OK);
        }
    }
    for k in 0..30 {
        let status = instance.step(f64::from(k) * fmu.step_size, fmu.step_size);
        assert_eq!(status, Status::OK, "{:?}", instance.messages());
    }
    instance.messages();
    instance
}

/// fmi2DeSerializeFMUstate into a slot that keeps its state.
fn deserialize(instance: &Instance, bytes: &[u8], state: &mut FmuState) -> Status {
    // SAFETY: the bytes and the slot are locals of the caller.
    unsafe {
        (instance.library().fmi2DeSerializeFMUstate)(
            instance.component(),
            bytes.as_ptr().cast(),
            bytes.len(),
            &raw mut *state,
        )
    }
}

#[test]
fn a_state_with_times_that_no_steps_lead_to_is_refused_by_name() {
    for fmu in Fmu::all() {
        let instance = moved(&fmu);
        let bytes = instance.bytes();
        for (at, name) in [
            (START_TIME, "start_time = "),
            (TIME, "time = "),
            (ELAPSED, "elapsed = "),
        ] {
            for (number, text) in [(f64::NAN, "NaN s"), (f64::INFINITY, "inf s")] {
                let parts = ["serialized state: ", &format!("{name}{text}"), "expected"];
                refused(&instance, "fmi2DeSerializeFMUstate", &parts, |i| {
                    deserialize(i, &with_number(&bytes, at, number), &mut null_mut())
                });
            }
        }
        for (at, number, text) in [
            (START_TIME, -1e6, "start_time = -1000000.0 s and time = "),
            (START_TIME, 1e6, "start_time = 1000000.0 s and time = "),
            (TIME, 1e6, "and time = 1000000.0 s"),
            (TIME, -1e6, "and time = -1000000.0 s"),
            (ELAPSED, -1e6, "elapsed = -1000000.0 s"),
            (ELAPSED, 0.0, " 0.0 s"),
            (ELAPSED_LOW, 1e6, "and 1000000.0 s"),
        ] {
            refused(&instance, "fmi2DeSerializeFMUstate", &[text], |i| {
                deserialize(i, &with_number(&bytes, at, number), &mut null_mut())
            });
        }
        // Before the first step there are none.
        let new = Phase::InitializationMode.enter(&fmu);
        refused(
            &new,
            "fmi2DeSerializeFMUstate",
            &["before the first step"],
            |i| deserialize(i, &with_number(&i.bytes(), ELAPSED, 0.5), &mut null_mut()),
        );
    }
}

#[test]
fn a_state_of_an_earlier_build_is_refused_by_its_version() {
    for fmu in Fmu::all() {
        let instance = moved(&fmu);
        let mut bytes = instance.bytes();
        bytes[VERSION].copy_from_slice(&1_u32.to_le_bytes());
        let parts = ["serialized state: expected format version 2, got 1"];
        refused(&instance, "fmi2DeSerializeFMUstate", &parts, |i| {
            deserialize(i, &bytes, &mut null_mut())
        });
    }
}

#[test]
fn a_state_with_a_value_that_set_refuses_is_refused_in_the_same_words() {
    for (name, variable, number, text) in [
        (
            "Testbed",
            "tau_h",
            f64::NAN,
            "tau_h = NaN N, expected a finite value",
        ),
        (
            "ArmController",
            "q[2]",
            f64::INFINITY,
            "q[2] = inf rad, expected a finite value",
        ),
        (
            "ExoskeletonArms",
            "substep",
            1e6,
            "substep = 1000000 s, expected a value from",
        ),
        (
            "HumanOperator",
            "k_h",
            -1e6,
            "k_h = -1000000 N/m, expected a value from 0 to",
        ),
    ] {
        let fmu = Fmu::open(name);
        let instance = fmu.instantiate();
        let reference = fmu.reference(variable);
        // The value is found where the bytes differ that it changes.
        let found = |value: f64| {
            assert_eq!(instance.set_real(&[reference], &[value]), Status::OK);
            instance.bytes()
        };
        let (one, other) = (found(1.0 / 256.0), found(1.0 / 512.0));
        let place = one[HEADER..].windows(8).zip(other[HEADER..].windows(8));
        let at = place
            .into_iter()
            .position(|(a, b)| {
                a == (1.0_f64 / 256.0).to_le_bytes() && b == (1.0_f64 / 512.0).to_le_bytes()
            })
            .expect("the value is in the state");
        instance.messages();
        refused(
            &instance,
            "fmi2DeSerializeFMUstate",
            &["serialized state: ", text],
            |i| deserialize(i, &with_number(&one, at, number), &mut null_mut()),
        );
    }
}

/// Numbers that are tried wherever one may stand.
const NUMBERS: [f64; 6] = [1e6, -1e6, 1e300, f64::NAN, f64::INFINITY, 0.0];

/// Counts that are tried in place of one byte, as the format writes them: 1e6, 2³² − 1, 2⁶⁴ − 1.
const COUNTS: [&[u8]; 3] = [
    &[0xc0, 0x84, 0x3d],
    &[0xff, 0xff, 0xff, 0xff, 0x0f],
    &[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x01],
];

/// Every number and count at every place of the payload; of a long one (what the hand felt) at its two ends and at every
/// 501st byte.
fn forgeries(bytes: &[u8]) -> impl Iterator<Item = (usize, Vec<u8>)> {
    const END: usize = 4_000;
    let length = bytes.len() - HEADER;
    (0..length)
        .filter(move |at| *at < END || length - at < END || at % 501 == 0)
        .flat_map(move |at| {
            let numbers = NUMBERS
                .into_iter()
                .map(move |number| with_number(bytes, at, number));
            let counts = COUNTS
                .into_iter()
                .map(move |count| with(bytes, at, 1, count));
            numbers.chain(counts).map(move |forged| (at, forged))
        })
}

/// How many of a library's forged states were refused and how many made steps.
#[derive(Debug, Default)]
struct Seen {
    refused: u32,
    stepped: u32,
}

/// Tries all forgeries on an FMU; `tell` hears of each before it is tried.
fn try_all(name: &str, tell: impl Fn(usize)) -> Seen {
    let fmu = Fmu::named(name);
    let instance = moved(&fmu);
    let bytes = instance.bytes();
    let (end, h) = (30.0 * fmu.step_size, fmu.step_size);
    let mut seen = Seen::default();
    let mut state = instance.state();
    for (at, forgery) in forgeries(&bytes) {
        tell(at);
        let answer = deserialize(&instance, &forgery, &mut state);
        if answer == Status::OK {
            assert_eq!(instance.set_state(state), Status::OK);
            let steps = [(end, h), (end + h, h), (end + 2.0 * h, 10.0 * h)];
            let status = steps.map(|(t, h)| instance.step(t, h));
            seen.stepped += u32::from(status[0] == Status::OK);
        } else {
            seen.refused += 1;
        }
        for message in instance.messages() {
            let text = &message.text;
            assert!(!text.contains("panic"), "{name}, byte {at}: {text}");
            assert!(
                answer == Status::OK
                    || text.starts_with("fmi2DeSerializeFMUstate: serialized state: "),
                "{name}, byte {at}: {text}"
            );
        }
    }
    assert_eq!(instance.free_state(&mut state), Status::OK);
    seen
}

#[test]
fn no_forged_number_makes_a_step_hang_or_panic() {
    for name in Fmu::all().into_iter().map(|fmu| fmu.name) {
        let (told, hear) = channel();
        let thread = std::thread::spawn({
            let name = name.clone();
            move || {
                try_all(&name, |at| {
                    let _ = told.send(at);
                })
            }
        });
        let mut last = 0;
        loop {
            match hear.recv_timeout(PATIENCE) {
                Ok(at) => last = at,
                Err(RecvTimeoutError::Disconnected) => break,
                Err(RecvTimeoutError::Timeout) => {
                    panic!("{name}: no answer in {PATIENCE:?} after byte {last} was forged")
                }
            }
        }
        let seen = thread
            .join()
            .unwrap_or_else(|e| std::panic::resume_unwind(e));
        assert!(seen.refused > 50 && seen.stepped > 50, "{name}: {seen:?}");
    }
}
