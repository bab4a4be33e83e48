//! Which call is legal in which phase: FMI 2.0.5, section 4.2.4, written down a second time and tried cell by cell.

use abi::types::*;
use abi::{Fmu, Instance, Kind, Phase, Status};
use std::ptr::{null, null_mut};

/// Columns: instantiated, Initialization Mode, step complete, terminated, error.
///
/// | mark | standard | here |
/// |---|---|---|
/// | `x` | legal | fmi2OK |
/// | `u` | legal, for a capability that the XML does not claim | refused: `not supported` |
/// | `d` | not legal | fmi2OK, a documented deviation (`fmu/export/src/legality.rs`) |
/// | `.` | not legal | refused |
const TABLE: &str = "
    fmi2SetDebugLogging          x x x x x
    fmi2SetupExperiment          x . . . .
    fmi2EnterInitializationMode  x . . . .
    fmi2ExitInitializationMode   . x . . .
    fmi2Terminate                . . x . .
    fmi2Reset                    x x x x x
    fmi2GetReal                  d x x x x
    fmi2GetInteger               d x x x x
    fmi2GetBoolean               d x x x x
    fmi2GetString                d x x x x
    fmi2SetReal                  d x x . .
    fmi2SetInteger               d x x . .
    fmi2SetBoolean               d x x . .
    fmi2SetString                d x x . .
    fmi2GetFMUstate              x x x x x
    fmi2SetFMUstate              x x x x x
    fmi2FreeFMUstate             x x x x x
    fmi2SerializedFMUstateSize   x x x x x
    fmi2SerializeFMUstate        x x x x x
    fmi2DeSerializeFMUstate      x x x x x
    fmi2GetDirectionalDerivative . u u u u
    fmi2SetRealInputDerivatives  u u u . .
    fmi2GetRealOutputDerivatives . . u u u
    fmi2DoStep                   . . x . .
    fmi2CancelStep               . . . . .
    fmi2GetStatus                . . u u .
    fmi2GetRealStatus            . . x x d
    fmi2GetIntegerStatus         . . u u .
    fmi2GetBooleanStatus         . . x x d
    fmi2GetStringStatus          . . u u .
";

/// The functions of the table with their marks by phase.
fn table() -> Vec<(&'static str, Vec<&'static str>)> {
    let rows = TABLE.lines().filter(|line| !line.trim().is_empty());
    rows.map(|line| {
        let mut words = line.split_whitespace();
        (words.next().expect("a name"), words.collect())
    })
    .collect()
}

/// Calls a function with arguments to which nothing can be objected.
fn call(function: &str, fmu: &Fmu, instance: &Instance) -> Status {
    let (l, c) = (instance.library(), instance.component());
    // Set needs a variable that may be set in every phase in which Set is legal; where an FMU has none of the type, no
    // variable at all is a valid list too.
    let settable = |kind| {
        fmu.variables.iter().find(|v| {
            v.kind == kind
                && v.name != "panic"
                && (v.causality == "input" || v.variability == "tunable")
        })
    };
    let (mut real, mut integer, mut string) = (0.0, 0, null());
    let (mut size, mut bytes) = (0_usize, vec![0_u8; 1 << 16]);
    let (dx, order) = (1.0, 1);
    let mut state = instance.state();
    let serialized = instance.serialize(state);
    let get = |kind| {
        let first = fmu.variables.iter().find(|v| v.kind == kind);
        (
            first.map_or(0, |v| v.reference),
            usize::from(first.is_some()),
        )
    };
    let set = |kind| settable(kind).map_or((0, 0), |v| (v.reference, 1_usize));
    let label = c"label";
    let label = label.as_ptr();
    // SAFETY: the instance is live; every pointer is to a local that outlives the call and has the length that is passed.
    let status = unsafe {
        match function {
            "fmi2SetDebugLogging" => (l.fmi2SetDebugLogging)(c, 1, 0, null()),
            "fmi2SetupExperiment" => (l.fmi2SetupExperiment)(c, 0, 0.0, 0.0, 0, 0.0),
            "fmi2EnterInitializationMode" => (l.fmi2EnterInitializationMode)(c),
            "fmi2ExitInitializationMode" => (l.fmi2ExitInitializationMode)(c),
            "fmi2Terminate" => (l.fmi2Terminate)(c),
            "fmi2Reset" => (l.fmi2Reset)(c),
            "fmi2GetReal" => {
                let (vr, n) = get(Kind::Real {});
                (l.fmi2GetReal)(c, &raw const vr, n, &raw mut real)
            }
            "fmi2GetInteger" => {
                let (vr, n) = get(Kind::Integer {});
                (l.fmi2GetInteger)(c, &raw const vr, n, &raw mut integer)
            }
            "fmi2GetBoolean" => {
                let (vr, n) = get(Kind::Boolean {});
                (l.fmi2GetBoolean)(c, &raw const vr, n, &raw mut integer)
            }
            "fmi2GetString" => {
                let (vr, n) = get(Kind::String {});
                (l.fmi2GetString)(c, &raw const vr, n, &raw mut string)
            }
            "fmi2SetReal" => {
                let (vr, n) = set(Kind::Real {});
                (l.fmi2SetReal)(c, &raw const vr, n, &raw const dx)
            }
            "fmi2SetInteger" => {
                let (vr, n) = set(Kind::Integer {});
                (l.fmi2SetInteger)(c, &raw const vr, n, &raw const order)
            }
            "fmi2SetBoolean" => {
                let (vr, n) = set(Kind::Boolean {});
                (l.fmi2SetBoolean)(c, &raw const vr, n, &raw const order)
            }
            "fmi2SetString" => {
                let (vr, n) = set(Kind::String {});
                (l.fmi2SetString)(c, &raw const vr, n, &raw const label)
            }
            "fmi2GetFMUstate" => (l.fmi2GetFMUstate)(c, &raw mut state),
            "fmi2SetFMUstate" => (l.fmi2SetFMUstate)(c, state),
            "fmi2FreeFMUstate" => (l.fmi2FreeFMUstate)(c, &raw mut state),
            "fmi2SerializedFMUstateSize" => (l.fmi2SerializedFMUstateSize)(c, state, &raw mut size),
            "fmi2SerializeFMUstate" => {
                (l.fmi2SerializeFMUstate)(c, state, bytes.as_mut_ptr().cast(), bytes.len())
            }
            "fmi2DeSerializeFMUstate" => (l.fmi2DeSerializeFMUstate)(
                c,
                serialized.as_ptr().cast(),
                serialized.len(),
                &raw mut state,
            ),
            "fmi2GetDirectionalDerivative" => {
                let (vr, n) = get(Kind::Real {});
                let (vr, dv) = (&raw const vr, &raw const dx);
                (l.fmi2GetDirectionalDerivative)(c, vr, n, vr, n, dv, &raw mut real)
            }
            "fmi2SetRealInputDerivatives" => {
                let (vr, n) = set(Kind::Real {});
                (l.fmi2SetRealInputDerivatives)(
                    c,
                    &raw const vr,
                    n,
                    &raw const order,
                    &raw const dx,
                )
            }
            "fmi2GetRealOutputDerivatives" => {
                let (vr, n) = get(Kind::Real {});
                (l.fmi2GetRealOutputDerivatives)(
                    c,
                    &raw const vr,
                    n,
                    &raw const order,
                    &raw mut real,
                )
            }
            "fmi2DoStep" => (l.fmi2DoStep)(c, 0.0, 0.01, 1),
            "fmi2CancelStep" => (l.fmi2CancelStep)(c),
            "fmi2GetStatus" => (l.fmi2GetStatus)(c, DO_STEP_STATUS, &raw mut integer),
            "fmi2GetRealStatus" => (l.fmi2GetRealStatus)(c, LAST_SUCCESSFUL_TIME, &raw mut real),
            "fmi2GetIntegerStatus" => (l.fmi2GetIntegerStatus)(c, DO_STEP_STATUS, &raw mut integer),
            "fmi2GetBooleanStatus" => (l.fmi2GetBooleanStatus)(c, TERMINATED, &raw mut integer),
            "fmi2GetStringStatus" => (l.fmi2GetStringStatus)(c, PENDING_STATUS, &raw mut string),
            other => panic!("the table names {other}"),
        }
    };
    if !state.is_null() {
        assert_eq!(instance.free_state(&mut state), Status::OK);
    }
    status
}

#[test]
fn the_table_has_every_function_that_is_called_on_an_instance() {
    // All but FreeInstance (in every phase, below) and the three without an instance.
    let mut names: Vec<_> = table().into_iter().map(|(name, _)| name).collect();
    names.extend([
        "fmi2FreeInstance",
        "fmi2Instantiate",
        "fmi2GetTypesPlatform",
        "fmi2GetVersion",
    ]);
    names.sort_unstable();
    let mut expected = abi::Library::FUNCTIONS;
    expected.sort_unstable();
    assert_eq!(names, expected);
}

#[test]
fn every_function_in_every_phase_does_what_the_standard_s_table_says() {
    for fmu in Fmu::all() {
        for (function, marks) in table() {
            for (phase, mark) in Phase::ALL.into_iter().zip(marks) {
                if !Phase::reachable(&fmu).contains(&phase) {
                    continue;
                }
                let instance = phase.enter(&fmu);
                let cell = format!("{} {function} in {phase:?}", fmu.name);
                let before = instance.bytes();
                let status = call(function, &fmu, &instance);
                let log = instance.messages();
                if matches!(mark, "x" | "d") {
                    assert_eq!(status, Status::OK, "{cell}: {log:?}");
                    assert!(
                        log.iter().all(|m| m.category == "logEvents"),
                        "{cell}: {log:?}"
                    );
                    continue;
                }
                assert_eq!(status, Status::ERROR, "{cell}");
                let [message] = &log[..] else {
                    panic!("{cell}: expected one message, got {log:?}")
                };
                assert_eq!(message.category, "logStatusError", "{cell}");
                assert_eq!(message.status, Status::ERROR, "{cell}");
                assert!(
                    message.text.starts_with(&format!("{function}: ")),
                    "{cell}: {message:?}"
                );
                let reason = if mark == "u" { "not supported" } else { "" };
                assert!(message.text.contains(reason), "{cell}: {message:?}");
                assert_eq!(
                    instance.bytes(),
                    before,
                    "{cell}: a refused call changed something"
                );
            }
        }
    }
}

#[test]
fn an_instance_is_freed_in_every_phase() {
    for fmu in Fmu::all() {
        for phase in Phase::reachable(&fmu) {
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
