//! Null pointers and unknown kinds where the standard wants something else.

use abi::refusal::refused;
use abi::types::*;
use abi::{Fmu, Phase, Status};
use std::ptr::{null, null_mut};

#[test]
fn null_pointers_are_refused_where_something_must_stand() {
    let fmu = Fmu::lag();
    let instance = Phase::StepComplete.enter(&fmu);
    let [u, steps, panic, label] = fmu.references(["u", "steps", "panic", "label"]);
    let (mut real, mut integer, mut string) = (0.0, 0, null());
    let mut state = instance.state();
    let (l, c) = (&fmu.library, instance.component());
    // SAFETY: null pointers are what is tested; all others are to locals of one element.
    unsafe {
        let mut expected = Vec::new();
        for (function, calls) in [
            (
                "fmi2GetReal",
                [
                    (l.fmi2GetReal)(c, null(), 1, &raw mut real),
                    (l.fmi2GetReal)(c, &raw const u, 1, null_mut()),
                ],
            ),
            (
                "fmi2GetInteger",
                [
                    (l.fmi2GetInteger)(c, null(), 1, &raw mut integer),
                    (l.fmi2GetInteger)(c, &raw const steps, 1, null_mut()),
                ],
            ),
            (
                "fmi2GetBoolean",
                [
                    (l.fmi2GetBoolean)(c, null(), 1, &raw mut integer),
                    (l.fmi2GetBoolean)(c, &raw const panic, 1, null_mut()),
                ],
            ),
            (
                "fmi2GetString",
                [
                    (l.fmi2GetString)(c, null(), 1, &raw mut string),
                    (l.fmi2GetString)(c, &raw const label, 1, null_mut()),
                ],
            ),
            (
                "fmi2SetReal",
                [
                    (l.fmi2SetReal)(c, null(), 1, &raw const real),
                    (l.fmi2SetReal)(c, &raw const u, 1, null()),
                ],
            ),
            (
                "fmi2SetInteger",
                [
                    (l.fmi2SetInteger)(c, null(), 1, &raw const integer),
                    (l.fmi2SetInteger)(c, &raw const steps, 1, null()),
                ],
            ),
            (
                "fmi2SetBoolean",
                [
                    (l.fmi2SetBoolean)(c, null(), 1, &raw const integer),
                    (l.fmi2SetBoolean)(c, &raw const panic, 1, null()),
                ],
            ),
            (
                "fmi2SetString",
                [
                    (l.fmi2SetString)(c, null(), 1, &raw const string),
                    (l.fmi2SetString)(c, &raw const label, 1, null()),
                ],
            ),
            (
                "fmi2GetFMUstate",
                [
                    (l.fmi2GetFMUstate)(c, null_mut()),
                    (l.fmi2GetFMUstate)(c, null_mut()),
                ],
            ),
            (
                "fmi2SetFMUstate",
                [
                    (l.fmi2SetFMUstate)(c, null_mut()),
                    (l.fmi2SetFMUstate)(c, null_mut()),
                ],
            ),
            (
                "fmi2SerializedFMUstateSize",
                [
                    (l.fmi2SerializedFMUstateSize)(c, state, null_mut()),
                    (l.fmi2SerializedFMUstateSize)(c, null_mut(), &raw mut *Box::new(0)),
                ],
            ),
            (
                "fmi2SerializeFMUstate",
                [
                    (l.fmi2SerializeFMUstate)(c, state, null_mut(), 1000),
                    (l.fmi2SerializeFMUstate)(c, null_mut(), null_mut(), 0),
                ],
            ),
            (
                "fmi2DeSerializeFMUstate",
                [
                    (l.fmi2DeSerializeFMUstate)(c, null(), 100, &raw mut state),
                    (l.fmi2DeSerializeFMUstate)(c, [0].as_ptr(), 1, null_mut()),
                ],
            ),
            (
                "fmi2GetRealStatus",
                [
                    (l.fmi2GetRealStatus)(c, LAST_SUCCESSFUL_TIME, null_mut()),
                    (l.fmi2GetRealStatus)(c, LAST_SUCCESSFUL_TIME, null_mut()),
                ],
            ),
            (
                "fmi2GetBooleanStatus",
                [
                    (l.fmi2GetBooleanStatus)(c, TERMINATED, null_mut()),
                    (l.fmi2GetBooleanStatus)(c, TERMINATED, null_mut()),
                ],
            ),
            (
                "fmi2SetDebugLogging",
                [
                    (l.fmi2SetDebugLogging)(c, 1, 1, null()),
                    (l.fmi2SetDebugLogging)(c, 1, 1, &raw const string),
                ],
            ),
        ] {
            assert_eq!(calls, [Status::ERROR; 2], "{function}");
            expected.extend([function; 2]);
        }
        // Each refusal is one message under its function's name.
        let log = instance.messages();
        assert_eq!(log.len(), expected.len(), "{log:?}");
        for (message, function) in log.iter().zip(expected) {
            assert!(
                message.text.starts_with(&format!("{function}: ")),
                "{function}: {message:?}"
            );
        }
        // No elements, no pointers needed.
        assert_eq!((l.fmi2GetReal)(c, null(), 0, null_mut()), Status::OK);
        assert_eq!((l.fmi2SetReal)(c, null(), 0, null()), Status::OK);
        // Freeing nothing is no mistake.
        assert_eq!((l.fmi2FreeFMUstate)(c, null_mut()), Status::OK);
        assert_eq!(
            (l.fmi2FreeFMUstate)(c, &raw mut *Box::new(null_mut())),
            Status::OK
        );
    }
    assert_eq!(instance.free_state(&mut state), Status::OK);
    assert_eq!(instance.step(0.0, 0.01), Status::OK);
}

#[test]
fn unknown_status_kinds_are_refused() {
    let fmu = Fmu::lag();
    let instance = Phase::StepComplete.enter(&fmu);
    let (mut real, mut boolean) = (0.0, 0);
    for kind in [-1, DO_STEP_STATUS, PENDING_STATUS, TERMINATED, 4, i32::MAX] {
        refused(&instance, "fmi2GetRealStatus", &[&kind.to_string()], |i| {
            // SAFETY: the value is a local.
            unsafe { (i.library().fmi2GetRealStatus)(i.component(), kind, &raw mut real) }
        });
    }
    for kind in [-1, DO_STEP_STATUS, PENDING_STATUS, LAST_SUCCESSFUL_TIME, 4] {
        refused(
            &instance,
            "fmi2GetBooleanStatus",
            &[&kind.to_string()],
            |i| {
                // SAFETY: the value is a local.
                unsafe { (i.library().fmi2GetBooleanStatus)(i.component(), kind, &raw mut boolean) }
            },
        );
    }
}
