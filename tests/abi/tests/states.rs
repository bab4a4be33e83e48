//! FMU state: get, set, free, and as bytes.

use abi::types::FmuState;
use abi::{Fmu, Instance, Kind, Phase, Status};
use std::process::Command;
use std::ptr::null_mut;

/// A changing load on all Real inputs, and a step.
fn step(fmu: &Fmu, instance: &Instance, k: u32) {
    let inputs: Vec<_> = fmu
        .variables
        .iter()
        .filter(|v| v.causality == "input" && v.kind == Kind::Real {})
        .map(|v| v.reference)
        .collect();
    let values: Vec<_> = (0..inputs.len())
        .map(|i| (f64::from(k) * 0.1 + i as f64).sin() * [0.1, 8.0, 5.0][i % 3])
        .collect();
    assert_eq!(instance.set_real(&inputs, &values), Status::OK);
    let status = instance.step(f64::from(k) * 0.002, 0.002);
    assert_eq!(status, Status::OK, "{:?}", instance.messages());
}

/// Steps `from..to`; the state after each, as bytes.
fn run(fmu: &Fmu, instance: &Instance, from: u32, to: u32) -> Vec<Vec<u8>> {
    (from..to)
        .map(|k| {
            step(fmu, instance, k);
            instance.bytes()
        })
        .collect()
}

#[test]
fn a_restored_state_runs_on_bit_for_bit_as_the_first_time() {
    for fmu in Fmu::all() {
        let instance = Phase::StepComplete.enter(&fmu);
        run(&fmu, &instance, 0, 40);
        let mut saved = instance.state();
        let first = run(&fmu, &instance, 40, 90);
        assert_ne!(
            first[0], first[49],
            "{}: nothing moves, nothing is tested",
            fmu.name
        );
        for _ in 0..2 {
            assert_eq!(instance.set_state(saved), Status::OK);
            assert_eq!(run(&fmu, &instance, 40, 90), first, "{}", fmu.name);
        }
        // Through bytes, into another instance.
        let other = fmu.instantiate();
        let mut copy = other
            .deserialize(&instance.serialize(saved))
            .expect("our own bytes");
        assert_eq!(other.set_state(copy), Status::OK);
        assert_eq!(run(&fmu, &other, 40, 90), first, "{}", fmu.name);
        assert_eq!(other.free_state(&mut copy), Status::OK);
        assert_eq!(instance.free_state(&mut saved), Status::OK);
        assert!(saved.is_null(), "a freed state is null");
    }
}

#[test]
fn a_state_keeps_the_phase_in_which_it_was_taken() {
    for fmu in Fmu::all() {
        for phase in Phase::ALL {
            let source = phase.enter(&fmu);
            let mut state = source.state();
            let target = Phase::StepComplete.enter(&fmu);
            assert_eq!(target.set_state(state), Status::OK);
            let probes = [
                target.enter_initialization_mode() == Status::OK,
                phase == Phase::InitializationMode
                    && target.exit_initialization_mode() == Status::OK,
                phase == Phase::StepComplete && target.terminate() == Status::OK,
            ];
            let expected = [
                phase == Phase::Instantiated,
                phase == Phase::InitializationMode,
                phase == Phase::StepComplete,
            ];
            assert_eq!(probes, expected, "{} {phase:?}", fmu.name);
            assert_eq!(source.free_state(&mut state), Status::OK);
        }
    }
}

#[test]
fn a_state_pointer_is_reused_and_a_state_stays_as_it_was() {
    for fmu in Fmu::all() {
        let instance = Phase::StepComplete.enter(&fmu);
        step(&fmu, &instance, 0);
        let mut state = instance.state();
        let (address, early) = (state, instance.serialize(state));
        run(&fmu, &instance, 1, 30);
        assert_eq!(
            instance.serialize(state),
            early,
            "the instance ran on, the state did not"
        );
        // SAFETY: the slot is a local that holds a live state.
        let status = unsafe { (fmu.library.fmi2GetFMUstate)(instance.component(), &raw mut state) };
        assert_eq!((status, state), (Status::OK, address));
        assert_ne!(instance.serialize(state), early);
        // A state outlives its instance.
        let other = fmu.instantiate();
        drop(instance);
        assert_eq!(other.set_state(state), Status::OK);
        step(&fmu, &other, 30);
        assert_eq!(other.free_state(&mut state), Status::OK);
    }
}

/// Asserts that all functions that take a state refuse this pointer and that the instance is as before.
fn not_a_state(instance: &Instance, pointer: FmuState) {
    let before = instance.bytes();
    let (l, c) = (instance.library(), instance.component());
    let (mut slot, mut size, mut bytes) = (pointer, 0_usize, [0; 16]);
    // SAFETY: the library promises to compare the pointer with those it handed out, and not to follow it.
    let statuses = unsafe {
        [
            (l.fmi2SetFMUstate)(c, pointer),
            (l.fmi2SerializedFMUstateSize)(c, pointer, &raw mut size),
            (l.fmi2SerializeFMUstate)(c, pointer, bytes.as_mut_ptr(), bytes.len()),
            (l.fmi2FreeFMUstate)(c, &raw mut slot),
        ]
    };
    assert_eq!(statuses, [Status::ERROR; 4]);
    assert_eq!(slot, pointer, "a refused Free leaves the pointer");
    assert_eq!(instance.messages().len(), 4);
    assert_eq!(instance.bytes(), before);
}

#[test]
fn freed_foreign_and_invented_pointers_are_refused_and_never_followed() {
    for fmu in Fmu::all() {
        let instance = Phase::StepComplete.enter(&fmu);
        let mut state = instance.state();
        let stale = state;
        assert_eq!(instance.free_state(&mut state), Status::OK);
        not_a_state(&instance, stale);
        not_a_state(&instance, instance.component());
        not_a_state(&instance, std::ptr::without_provenance_mut(0x10));
        not_a_state(&instance, std::ptr::without_provenance_mut(usize::MAX));
        let local = Fmu::lag();
        let foreign = local.instantiate();
        if fmu.name != "Lag" {
            let mut lag = foreign.state();
            not_a_state(&instance, lag);
            assert_eq!(foreign.free_state(&mut lag), Status::OK);
        }
        step(&fmu, &instance, 0);
    }
}

#[test]
fn a_buffer_that_is_too_small_is_refused_with_the_size_it_needs() {
    for fmu in Fmu::all() {
        let instance = Phase::StepComplete.enter(&fmu);
        let mut state = instance.state();
        let size = instance.serialize(state).len();
        instance.messages();
        let mut bytes = vec![0x5a_u8; size + 8];
        for (given, expected) in [
            (0, Status::ERROR),
            (size - 1, Status::ERROR),
            (size, Status::OK),
            (size + 8, Status::OK),
        ] {
            // SAFETY: the buffer has at least `given` bytes.
            let status = unsafe {
                (fmu.library.fmi2SerializeFMUstate)(
                    instance.component(),
                    state,
                    bytes.as_mut_ptr().cast(),
                    given,
                )
            };
            assert_eq!(status, expected, "{given}");
            if expected == Status::ERROR {
                assert!(
                    instance
                        .message()
                        .contains(&format!("at least {size} bytes"))
                );
                assert!(bytes.iter().all(|&byte| byte == 0x5a), "nothing is written");
            }
        }
        assert_eq!(
            bytes[size..],
            [0x5a; 8],
            "nothing is written beyond the state"
        );
        assert_eq!(instance.free_state(&mut state), Status::OK);
    }
}

/// Asserts that bytes are refused with one message, and that nothing came of it.
fn not_bytes_of_a_state(instance: &Instance, bytes: &[u8], what: &str) {
    instance.messages();
    assert_eq!(instance.deserialize(bytes), Err(Status::ERROR), "{what}");
    let text = instance.message();
    assert!(
        text.starts_with("fmi2DeSerializeFMUstate: serialized state: "),
        "{what}: {text}"
    );
}

#[test]
fn truncated_bytes_are_refused_at_every_length() {
    for fmu in Fmu::all() {
        let instance = Phase::StepComplete.enter(&fmu);
        step(&fmu, &instance, 0);
        let bytes = instance.bytes();
        for length in 0..bytes.len() {
            not_bytes_of_a_state(&instance, &bytes[..length], &format!("{length} bytes"));
        }
        assert_eq!(instance.bytes(), bytes);
        step(&fmu, &instance, 1);
    }
}

#[test]
fn every_flipped_bit_is_noticed() {
    for fmu in Fmu::all() {
        let instance = Phase::StepComplete.enter(&fmu);
        step(&fmu, &instance, 0);
        let bytes = instance.bytes();
        for bit in 0..bytes.len() * 8 {
            let mut damaged = bytes.clone();
            damaged[bit / 8] ^= 1 << (bit % 8);
            not_bytes_of_a_state(&instance, &damaged, &format!("{}: bit {bit}", fmu.name));
        }
        assert_eq!(instance.bytes(), bytes);
        step(&fmu, &instance, 1);
    }
}

#[test]
fn other_fmus_bytes_and_any_bytes_are_refused() {
    let fmus = Fmu::all();
    for (own, fmu) in fmus.iter().enumerate() {
        let instance = Phase::StepComplete.enter(fmu);
        for (other, foreign) in fmus.iter().enumerate() {
            if own != other {
                let bytes = Phase::StepComplete.enter(foreign).bytes();
                not_bytes_of_a_state(&instance, &bytes, &foreign.name);
            }
        }
        let mut any = 1_u32;
        let noise: Vec<u8> = std::iter::repeat_with(|| {
            any = any.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (any >> 24) as u8
        })
        .take(4096)
        .collect();
        not_bytes_of_a_state(&instance, &noise, "noise");
        not_bytes_of_a_state(&instance, &[0; 4096], "zeros");
        step(fmu, &instance, 0);
    }
}

#[test]
fn a_refused_deserialization_leaves_the_state_it_would_have_replaced() {
    let fmu = Fmu::lag();
    let instance = Phase::StepComplete.enter(&fmu);
    let mut state = instance.state();
    let (address, bytes) = (state, instance.serialize(state));
    // SAFETY: three bytes; the slot holds a live state.
    let status = unsafe {
        (fmu.library.fmi2DeSerializeFMUstate)(
            instance.component(),
            b"bad".as_ptr().cast(),
            3,
            &raw mut state,
        )
    };
    assert_eq!((status, state), (Status::ERROR, address));
    assert_eq!(instance.serialize(state), bytes);
    assert_eq!(instance.free_state(&mut state), Status::OK);
    let mut none = null_mut();
    assert_eq!(instance.free_state(&mut none), Status::OK);
}

/// Where the test below leaves its bytes for the other process.
const FOLDER: &str = "ABI_STATES_FOLDER";

#[test]
fn a_state_read_in_another_process_runs_on_bit_for_bit() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for fmu in Fmu::all() {
        let instance = Phase::StepComplete.enter(&fmu);
        run(&fmu, &instance, 0, 20);
        let before = folder.path().join(format!("{}.before", fmu.name));
        std::fs::write(before, instance.bytes()).expect("written");
        run(&fmu, &instance, 20, 60);
        let after = folder.path().join(format!("{}.expected", fmu.name));
        std::fs::write(after, instance.bytes()).expect("written");
    }
    let output = Command::new(std::env::current_exe().expect("a path"))
        .args(["--ignored", "--exact", "the_other_process"])
        .env(FOLDER, folder.path())
        .output()
        .expect("this test can be started");
    let stdout = String::from_utf8_lossy(&output.stdout);
    assert!(
        output.status.success() && stdout.contains("1 passed"),
        "{stdout}"
    );
    for fmu in Fmu::all() {
        let read = |suffix| std::fs::read(folder.path().join(format!("{}.{suffix}", fmu.name)));
        let (expected, got) = (
            read("expected").expect("read"),
            read("after").expect("read"),
        );
        assert_eq!(got, expected, "{}", fmu.name);
    }
}

#[test]
#[ignore = "the second half of a_state_read_in_another_process_runs_on_bit_for_bit"]
fn the_other_process() {
    let folder = std::path::PathBuf::from(std::env::var_os(FOLDER).expect("set by the first half"));
    for fmu in Fmu::all() {
        let instance = fmu.instantiate();
        let bytes = std::fs::read(folder.join(format!("{}.before", fmu.name))).expect("read");
        let mut state = instance
            .deserialize(&bytes)
            .expect("bytes of the first half");
        assert_eq!(instance.set_state(state), Status::OK);
        assert_eq!(instance.free_state(&mut state), Status::OK);
        run(&fmu, &instance, 20, 60);
        std::fs::write(folder.join(format!("{}.after", fmu.name)), instance.bytes())
            .expect("written");
    }
}
