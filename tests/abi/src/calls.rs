//! Every function that is called on an instance, with arguments to which nothing can be objected.

use crate::types::*;
use crate::{Fmu, Instance, Kind, Status};
use std::ptr::null;

/// Calls a function of an instance with arguments to which nothing can be objected.
///
/// # Panics
/// When there is no function of this name that is called on an instance and returns a status.
pub fn call(function: &str, fmu: &Fmu, instance: &Instance) -> Status {
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
