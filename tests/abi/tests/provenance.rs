//! Version and git hash: every library says what it was built from, at any time and to no one's harm.

use abi::refusal::refused;
use abi::{Fmu, Kind, Phase, Status};

const VERSION: u32 = 16_776_960;
const GIT_HASH: u32 = 16_776_961;

fn is_hash(text: &str) -> bool {
    let hash = text.strip_suffix("-dirty").unwrap_or(text);
    hash == "unknown" || (hash.len() == 40 && hash.bytes().all(|byte| byte.is_ascii_hexdigit()))
}

fn status<T>(result: Result<T, Status>) -> Status {
    result.map_or_else(|status| status, |_| Status::OK)
}

#[test]
fn both_are_readable_before_during_and_after_the_run() {
    for fmu in Fmu::all() {
        for phase in [
            Phase::Instantiated,
            Phase::InitializationMode,
            Phase::StepComplete,
            Phase::Terminated,
        ] {
            let instance = phase.enter(&fmu);
            assert_eq!(instance.string(VERSION), env!("CARGO_PKG_VERSION"));
            let hash = instance.string(GIT_HASH);
            assert!(is_hash(&hash), "{}: {hash}", fmu.name);
        }
    }
}

#[test]
fn the_description_declares_them() {
    for fmu in Fmu::products() {
        assert_eq!(fmu.reference("version"), VERSION, "{}", fmu.name);
        assert_eq!(fmu.reference("git_hash"), GIT_HASH, "{}", fmu.name);
    }
}

#[test]
fn all_libraries_were_built_from_the_same_source() {
    let hashes: std::collections::BTreeSet<_> = Fmu::all()
        .iter()
        .map(|fmu| Phase::Instantiated.enter(fmu).string(GIT_HASH))
        .collect();
    assert_eq!(hashes.len(), 1, "{hashes:?}");
}

#[test]
fn setting_them_and_reading_them_as_numbers_is_refused_by_name() {
    for fmu in Fmu::all() {
        let instance = Phase::InitializationMode.enter(&fmu);
        // The first Get of a number in this mode computes the initial values; what follows must change nothing.
        let number = fmu.variables.iter().find(|v| v.kind == Kind::Real {});
        instance.real(number.expect("a Real").reference);
        for (reference, name) in [(VERSION, "version"), (GIT_HASH, "git_hash")] {
            refused(&instance, "fmi2SetString", &[name, "cannot be set"], |i| {
                i.set_string(reference, "mine")
            });
            refused(&instance, "fmi2SetReal", &[name, "cannot be set"], |i| {
                i.set_real(&[reference], &[1.0])
            });
            refused(&instance, "fmi2GetReal", &[name, "type Real"], |i| {
                status(i.get_real(&[reference]))
            });
        }
        refused(&instance, "fmi2GetReal", &["16776962"], |i| {
            status(i.get_real(&[GIT_HASH + 1]))
        });
        assert_ne!(instance.string(VERSION), "mine");
        assert_eq!(instance.exit_initialization_mode(), Status::OK);
    }
}
