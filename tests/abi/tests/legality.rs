//! Which call is legal in which phase: the standard's table with the deviations from it ([`abi::standard`]), tried cell by
//! cell on every FMU: status, log, survival.

use abi::calls::call;
use abi::standard::{DEVIATIONS, Verdict, rows, verdict};
use abi::types::*;
use abi::{Fmu, Instance, Kind, Phase, Status};
use std::ptr::{null, null_mut};

/// The functions that are called on an instance and return a status.
fn functions() -> Vec<&'static str> {
    let without = [
        "fmi2Instantiate",
        "fmi2FreeInstance",
        "fmi2GetTypesPlatform",
        "fmi2GetVersion",
    ];
    let names = rows().iter().map(|(name, _)| *name);
    names.filter(|name| !without.contains(name)).collect()
}

/// What an accepted call of these leaves is not what was before.
const CHANGE: [&str; 9] = [
    "fmi2EnterInitializationMode",
    "fmi2ExitInitializationMode",
    "fmi2Terminate",
    "fmi2Reset",
    "fmi2SetReal",
    "fmi2SetInteger",
    "fmi2SetBoolean",
    "fmi2SetString",
    "fmi2DoStep",
];

/// Goes on from a phase, or from a reset, for three steps with a load on all Real inputs; the state then.
fn going_on(fmu: &Fmu, instance: &Instance, from: Phase) -> Vec<u8> {
    match from {
        Phase::Instantiated => instance.initialize(0.0),
        Phase::InitializationMode => assert_eq!(instance.exit_initialization_mode(), Status::OK),
        Phase::StepComplete => {}
        Phase::Terminated | Phase::Error => {
            assert_eq!(instance.reset(), Status::OK);
            instance.initialize(0.0);
        }
    }
    for k in 0..3_u32 {
        for input in &fmu.variables {
            if input.causality == "input" && input.kind == (Kind::Real {}) {
                let value = 0.1 * f64::from(k + 1);
                assert_eq!(instance.set_real(&[input.reference], &[value]), Status::OK);
            }
        }
        let status = instance.step(f64::from(k) * 0.002, 0.002);
        assert_eq!(status, Status::OK, "{:?}", instance.messages());
    }
    instance.bytes()
}

/// One cell: the call with and without logging, and what becomes of the instance.
fn try_cell(fmu: &Fmu, function: &str, phase: Phase, untouched: &[u8], reset: &[u8]) {
    for logging in [true, false] {
        let cell = format!("{} {function} in {phase:?}, logging {logging}", fmu.name);
        let instance = phase.enter(fmu);
        assert_eq!(instance.set_debug_logging(logging, &[]), Status::OK);
        let before = instance.bytes();
        let status = call(function, fmu, &instance);
        let log = instance.messages();
        let accepted = verdict(function, phase) == Verdict::Accepted;
        if let Verdict::Refused(reason) = verdict(function, phase) {
            assert_eq!(status, Status::ERROR, "{cell}");
            assert_eq!(
                instance.bytes(),
                before,
                "{cell}: a refused call changed something"
            );
            let expected = if logging { 1 } else { 0 };
            assert_eq!(log.len(), expected, "{cell}: {log:?}");
            let state = format!("not legal in the phase '{}'", phase.name());
            let part = if reason.is_some() {
                "not supported"
            } else {
                &state
            };
            for message in log {
                assert_eq!(message.category, "logStatusError", "{cell}");
                assert_eq!(message.status, Status::ERROR, "{cell}");
                let named = message.text.starts_with(&format!("{function}: "));
                assert!(named && message.text.contains(part), "{cell}: {message:?}");
            }
        } else {
            assert_eq!(status, Status::OK, "{cell}: {log:?}");
            // Logging is on again after fmi2SetDebugLogging.
            let silent = !logging && function != "fmi2SetDebugLogging";
            // A step that is no sample period is warned of.
            let told = |category: &str| {
                category == "logEvents"
                    || (function == "fmi2DoStep" && category == "logStatusWarning")
            };
            let events = log.iter().all(|m| told(&m.category) && !silent);
            assert!(events, "{cell}: {log:?}");
        }
        if accepted && CHANGE.contains(&function) {
            assert_eq!(instance.reset(), Status::OK);
            assert!(
                going_on(fmu, &instance, Phase::Instantiated) == reset,
                "{cell}: other numbers"
            );
        } else {
            assert!(
                going_on(fmu, &instance, phase) == untouched,
                "{cell}: other numbers"
            );
        }
    }
}

#[test]
fn every_function_in_every_phase_does_what_the_standard_s_table_says_and_the_instance_goes_on() {
    for fmu in Fmu::all() {
        let reset = going_on(&fmu, &fmu.instantiate(), Phase::Instantiated);
        for phase in Phase::ALL {
            let untouched = going_on(&fmu, &phase.enter(&fmu), phase);
            for function in functions() {
                try_cell(&fmu, function, phase, &untouched, &reset);
            }
        }
    }
}

#[test]
fn deviations_from_the_table_are_gets_before_and_status_after_what_they_show_is_final() {
    // Tried above like all cells; here that the list grows no longer unnoticed.
    for (functions, phase, _) in DEVIATIONS {
        let expected = match phase {
            Phase::Instantiated => "fmi2Get",
            Phase::Error => "Status",
            _ => panic!("no deviation in {phase:?} was meant"),
        };
        assert!(
            functions.iter().all(|f| f.contains(expected)),
            "{functions:?}"
        );
    }
    assert_eq!(DEVIATIONS.map(|(functions, ..)| functions.len()), [4, 5]);
}

#[test]
fn an_instance_is_freed_in_every_phase() {
    for fmu in Fmu::all() {
        for phase in Phase::ALL {
            drop(phase.enter(&fmu));
        }
    }
}

#[test]
fn without_an_instance_every_function_is_an_error_and_free_does_nothing() {
    for fmu in Fmu::all() {
        let l = &fmu.library;
        let c = null_mut();
        let (mut real, mut integer, mut string) = (0.0, 0, null());
        let (mut state, mut size, mut byte) = (null_mut(), 0_usize, 0);
        let vr = fmu.variables[0].reference;
        let vr = &raw const vr;
        // SAFETY: a null component is what is tested; every other pointer is to a local.
        let statuses = unsafe {
            (l.fmi2FreeInstance)(c);
            [
                (l.fmi2SetDebugLogging)(c, 1, 0, null()),
                (l.fmi2SetupExperiment)(c, 0, 0.0, 0.0, 0, 0.0),
                (l.fmi2EnterInitializationMode)(c),
                (l.fmi2ExitInitializationMode)(c),
                (l.fmi2Terminate)(c),
                (l.fmi2Reset)(c),
                (l.fmi2GetReal)(c, vr, 1, &raw mut real),
                (l.fmi2GetInteger)(c, vr, 1, &raw mut integer),
                (l.fmi2GetBoolean)(c, vr, 1, &raw mut integer),
                (l.fmi2GetString)(c, vr, 1, &raw mut string),
                (l.fmi2SetReal)(c, vr, 1, &raw const real),
                (l.fmi2SetInteger)(c, vr, 1, &raw const integer),
                (l.fmi2SetBoolean)(c, vr, 1, &raw const integer),
                (l.fmi2SetString)(c, vr, 1, &raw const string),
                (l.fmi2GetFMUstate)(c, &raw mut state),
                (l.fmi2SetFMUstate)(c, state),
                (l.fmi2FreeFMUstate)(c, &raw mut state),
                (l.fmi2SerializedFMUstateSize)(c, state, &raw mut size),
                (l.fmi2SerializeFMUstate)(c, state, &raw mut byte, 1),
                (l.fmi2DeSerializeFMUstate)(c, &raw const byte, 1, &raw mut state),
                (l.fmi2GetDirectionalDerivative)(c, vr, 1, vr, 1, &raw const real, &raw mut real),
                (l.fmi2SetRealInputDerivatives)(c, vr, 1, &raw const integer, &raw const real),
                (l.fmi2GetRealOutputDerivatives)(c, vr, 1, &raw const integer, &raw mut real),
                (l.fmi2DoStep)(c, 0.0, 0.01, 1),
                (l.fmi2CancelStep)(c),
                (l.fmi2GetStatus)(c, DO_STEP_STATUS, &raw mut integer),
                (l.fmi2GetRealStatus)(c, LAST_SUCCESSFUL_TIME, &raw mut real),
                (l.fmi2GetIntegerStatus)(c, DO_STEP_STATUS, &raw mut integer),
                (l.fmi2GetBooleanStatus)(c, TERMINATED, &raw mut integer),
                (l.fmi2GetStringStatus)(c, PENDING_STATUS, &raw mut string),
            ]
        };
        assert_eq!(statuses, [Status::ERROR; 30], "{}", fmu.name);
        assert!(state.is_null());
    }
}

#[test]
fn types_platform_and_version_are_the_standard_s() {
    for fmu in Fmu::all() {
        // SAFETY: both return a static string and take nothing.
        let (platform, version) = unsafe {
            (
                (fmu.library.fmi2GetTypesPlatform)(),
                (fmu.library.fmi2GetVersion)(),
            )
        };
        assert_eq!(abi::messages::owned(platform), "default");
        assert_eq!(abi::messages::owned(version), "2.0");
    }
}
