//! FMU states that no run leads to: refused by name, or, with a right checksum, a step answers, soon and without a panic.
//! By FMI 2.0 and by FMI 3.0, whose instances of scheduled execution too.

use abi::both::Hosted;
use abi::fmi3::{self, Interface};
use abi::refusal::refused;
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

/// The same instance by FMI 3.0: a state goes from one version to the other.
fn moved3(fmu: &fmi3::Fmu, interface: Interface) -> fmi3::Instance {
    let instance = fmu.instantiate_as(interface);
    let status = instance.restore(&moved(&fmu.fmi2).bytes());
    assert_eq!(status, Status::OK, "{:?}", instance.messages());
    instance.messages();
    instance
}

/// All FMUs, by FMI 3.0.
fn all3() -> Vec<fmi3::Fmu> {
    Fmu::all().into_iter().map(fmi3::Fmu::new).collect()
}

/// Asserts that bytes are refused with these words, and that nothing comes into the slot.
#[track_caller]
fn not_read<I: Hosted>(instance: &I, bytes: &[u8], words: &[&str]) {
    refused(instance, I::DESERIALIZE, words, |i| {
        let mut slot = null_mut();
        let status = i.deserialize_into(bytes, &mut slot);
        assert!(slot.is_null(), "{words:?}");
        status
    });
}

/// Times that no steps lead to, on an instance that made some.
fn times_are_refused<I: Hosted>(instance: &I) {
    let bytes = instance.bytes();
    for (at, name) in [
        (START_TIME, "start_time = "),
        (TIME, "time = "),
        (ELAPSED, "elapsed = "),
    ] {
        for (number, text) in [(f64::NAN, "NaN s"), (f64::INFINITY, "inf s")] {
            let words = ["serialized state: ", &format!("{name}{text}"), "expected"];
            not_read(instance, &with_number(&bytes, at, number), &words);
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
        not_read(instance, &with_number(&bytes, at, number), &[text]);
    }
}

#[test]
fn a_state_with_times_that_no_steps_lead_to_is_refused_by_name() {
    for fmu in Fmu::all() {
        times_are_refused(&moved(&fmu));
        // Before the first step there are none.
        let new = Phase::InitializationMode.enter(&fmu);
        let bytes = with_number(&new.bytes(), ELAPSED, 0.5);
        not_read(&new, &bytes, &["before the first step"]);
    }
    for fmu in all3() {
        times_are_refused(&moved3(&fmu, Interface::CoSimulation));
    }
    for fmu in fmi3::Fmu::sampled() {
        times_are_refused(&moved3(&fmu, Interface::ScheduledExecution));
    }
}

/// A state of an earlier build.
fn an_earlier_version_is_refused<I: Hosted>(instance: &I) {
    let mut bytes = instance.bytes();
    bytes[VERSION].copy_from_slice(&1_u32.to_le_bytes());
    let words = ["serialized state: expected format version 2, got 1"];
    not_read(instance, &bytes, &words);
}

#[test]
fn a_state_of_an_earlier_build_is_refused_by_its_version() {
    for fmu in Fmu::all() {
        an_earlier_version_is_refused(&moved(&fmu));
    }
    for fmu in all3() {
        an_earlier_version_is_refused(&moved3(&fmu, Interface::CoSimulation));
    }
}

/// Every byte of the header, and of the payload as in [`places`], with some of its bits turned: always refused, whichever
/// it was.
fn every_damaged_byte_is_refused<I: Hosted>(instance: &I) {
    let mut bytes = instance.bytes();
    let before = bytes.clone();
    let payload = places(bytes.len() - HEADER).map(|at| at + HEADER);
    for at in (0..HEADER).chain(payload.collect::<Vec<_>>()) {
        for turned in [0x01, 0x80, 0xff] {
            bytes[at] ^= turned;
            let mut slot = null_mut();
            let status = instance.deserialize_into(&bytes, &mut slot);
            bytes[at] ^= turned;
            assert_eq!(status, Status::ERROR, "byte {at} by {turned:#x}");
            assert!(slot.is_null(), "byte {at} by {turned:#x}");
            let log = instance.messages();
            let [message] = &log[..] else {
                panic!("byte {at} by {turned:#x}: {log:?}")
            };
            let begin = format!("{}: serialized state: ", I::DESERIALIZE);
            assert!(message.text.starts_with(&begin), "byte {at}: {message:?}");
        }
    }
    for length in [0, 1, HEADER - 1, HEADER, bytes.len() / 2, bytes.len() - 1] {
        let words = ["serialized state: expected ", "bytes"];
        not_read(instance, &bytes[..length], &words);
    }
    assert_eq!(instance.bytes(), before);
}

#[test]
fn a_state_with_one_damaged_byte_anywhere_or_cut_off_is_refused() {
    for fmu in all3() {
        every_damaged_byte_is_refused(&moved(&fmu.fmi2));
        every_damaged_byte_is_refused(&moved3(&fmu, Interface::CoSimulation));
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
        let bytes = with_number(&one, at, number);
        let words = ["serialized state: ", text];
        not_read(&instance, &bytes, &words);
        let three = fmi3::Fmu::new(Fmu::open(name)).instantiate();
        not_read(&three, &bytes, &words);
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

/// Every place of a payload; of a long one (what the hand felt) those at its two ends and every 501st.
fn places(length: usize) -> impl Iterator<Item = usize> {
    const END: usize = 4_000;
    (0..length).filter(move |at| *at < END || length - at < END || at % 501 == 0)
}

/// Every number and count at every place of the payload.
fn forgeries(bytes: &[u8]) -> impl Iterator<Item = (usize, Vec<u8>)> {
    places(bytes.len() - HEADER).flat_map(move |at| {
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

/// Tries all forgeries on an instance after 30 steps of `h` (s); `tell` hears of each before it is tried.
fn try_all<I: Hosted>(
    name: &str,
    instance: &I,
    h: f64,
    step: impl Fn(&I, f64, f64) -> Status,
    tell: impl Fn(usize),
) -> Seen {
    let bytes = instance.bytes();
    let end = 30.0 * h;
    let mut seen = Seen::default();
    let mut state = instance.state();
    for (at, forgery) in forgeries(&bytes) {
        tell(at);
        let answer = instance.deserialize_into(&forgery, &mut state);
        if answer == Status::OK && instance.set_state(state) != Status::OK {
            // A scheduled instance has the period of its clock.
            let log = instance.messages();
            let of_clock = |m: &abi::Message| m.text.contains("the clock's interval is constant");
            assert!(
                log.iter().all(of_clock) && log.len() == 1,
                "{name}: {log:?}"
            );
            seen.refused += 1;
        } else if answer == Status::OK {
            let steps = [(end, h), (end + h, h), (end + 2.0 * h, 10.0 * h)];
            let status = steps.map(|(t, h)| step(instance, t, h));
            seen.stepped += u32::from(status[0] == Status::OK);
        } else {
            seen.refused += 1;
        }
        for message in instance.messages() {
            let text = &message.text;
            assert!(!text.contains("panic"), "{name}, byte {at}: {text}");
            let begin = format!("{}: serialized state: ", I::DESERIALIZE);
            assert!(
                answer == Status::OK || text.starts_with(&begin),
                "{name}, byte {at}: {text}"
            );
        }
    }
    assert_eq!(instance.free_state(&mut state), Status::OK);
    seen
}

/// Tries all forgeries on the instance that `make` gives, in a thread whose answers are waited for.
fn watched<I: Hosted>(
    name: &str,
    make: impl FnOnce() -> (I, f64) + Send + 'static,
    step: impl Fn(&I, f64, f64) -> Status + Send + 'static,
) {
    let (told, hear) = channel();
    let thread = std::thread::spawn({
        let name = name.to_owned();
        move || {
            let (instance, h) = make();
            try_all(&name, &instance, h, step, |at| {
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

#[test]
fn no_forged_number_makes_a_step_hang_or_panic() {
    for fmu in Fmu::all() {
        let (name, h) = (fmu.name.clone(), fmu.step_size);
        watched(&name, move || (moved(&fmu), h), Instance::step);
    }
}

#[test]
fn no_forged_number_makes_a_step_or_an_activation_of_fmi_3_hang_or_panic() {
    for fmu in all3() {
        let (name, h) = (fmu.name().to_owned(), fmu.fmi2.step_size);
        let make = move || (moved3(&fmu, Interface::CoSimulation), h);
        watched(&name, make, fmi3::Instance::step);
    }
    for fmu in fmi3::Fmu::sampled() {
        let (name, h) = (fmu.name().to_owned(), fmu.fmi2.step_size);
        let make = move || (moved3(&fmu, Interface::ScheduledExecution), h);
        watched(&name, make, |instance, t, _| instance.activate(t));
    }
}
