//! Every function that is called on an instance, with arguments to which nothing can be objected.

use super::fmu::{Fmu, Type};
use super::instance::Instance;
use super::types::*;
use std::ptr::{null, null_mut};

/// Calls a function of an instance with arguments to which nothing can be objected. `clocks`: how many clocks it has.
///
/// # Panics
/// When there is no function of this name that is called on an instance and returns a status.
pub fn call(function: &str, fmu: &Fmu, instance: &Instance, clocks: usize) -> Status {
    let (l, c) = (instance.library(), instance.component());
    // Scalars: one value each. Set needs a variable that may be set in every state in which Set is legal; where an FMU has
    // none of the type, no variable at all is a valid list too.
    let first = |kind, settable: bool| {
        let found = fmu.rows.iter().find(|row| {
            let free = row.causality() == "input" || row.variability() == "tunable";
            row.kind == kind && row.len() == 1 && row.name != "panic" && (free || !settable)
        });
        found.map_or((0, 0), |row| (row.reference, 1_usize))
    };
    let (get, set) = (|kind| first(kind, false), |kind| first(kind, true));
    let (mut real, mut integer, mut item, mut truth) = ([1.0], [1], [1], [1]);
    let mut text = [c"label".as_ptr()];
    let (mut size, mut bytes) = (0_usize, vec![0_u8; 1 << 16]);
    let (mut period, mut counter, mut qualifier) = (0.0, 0, 0);
    let clock = CLOCK;
    let clock = &raw const clock;
    let mut state = instance.state();
    let serialized = instance.serialize(state);
    macro_rules! got {
        ($function:ident, $kind:expr, $C:ty) => {{
            let ((vr, n), mut values) = (get($kind), [<$C>::default()]);
            (l.$function)(c, &raw const vr, n, values.as_mut_ptr(), n)
        }};
    }
    macro_rules! given {
        ($function:ident, $kind:expr, $C:ty) => {{
            let ((vr, n), values) = (set($kind), [1 as $C]);
            (l.$function)(c, &raw const vr, n, values.as_ptr(), n)
        }};
    }
    // SAFETY: the instance is live; every pointer is to a local that outlives the call and has the length that is passed, or
    // is null for an array of length 0 and for what a refused function does not write.
    let status = unsafe {
        match function {
            "fmi3SetDebugLogging" => (l.fmi3SetDebugLogging)(c, 1, 0, null()),
            "fmi3EnterInitializationMode" => {
                (l.fmi3EnterInitializationMode)(c, 0, 0.0, 0.0, 0, 0.0)
            }
            "fmi3ExitInitializationMode" => (l.fmi3ExitInitializationMode)(c),
            "fmi3EnterEventMode" => (l.fmi3EnterEventMode)(c),
            "fmi3Terminate" => (l.fmi3Terminate)(c),
            "fmi3Reset" => (l.fmi3Reset)(c),
            "fmi3EnterConfigurationMode" => (l.fmi3EnterConfigurationMode)(c),
            "fmi3ExitConfigurationMode" => (l.fmi3ExitConfigurationMode)(c),
            "fmi3EvaluateDiscreteStates" => (l.fmi3EvaluateDiscreteStates)(c),
            "fmi3EnterContinuousTimeMode" => (l.fmi3EnterContinuousTimeMode)(c),
            "fmi3EnterStepMode" => (l.fmi3EnterStepMode)(c),
            "fmi3GetFloat64" => {
                let (vr, n) = get(Type::Float64);
                (l.fmi3GetFloat64)(c, &raw const vr, n, real.as_mut_ptr(), real.len() * n)
            }
            "fmi3SetFloat64" => {
                let (vr, n) = set(Type::Float64);
                (l.fmi3SetFloat64)(c, &raw const vr, n, real.as_ptr(), real.len() * n)
            }
            "fmi3GetInt32" => {
                let (vr, n) = get(Type::Int32);
                (l.fmi3GetInt32)(c, &raw const vr, n, integer.as_mut_ptr(), integer.len() * n)
            }
            "fmi3SetInt32" => {
                let (vr, n) = set(Type::Int32);
                (l.fmi3SetInt32)(c, &raw const vr, n, integer.as_ptr(), integer.len() * n)
            }
            "fmi3GetInt64" => {
                let (vr, n) = get(Type::Enumeration);
                (l.fmi3GetInt64)(c, &raw const vr, n, item.as_mut_ptr(), item.len() * n)
            }
            "fmi3SetInt64" => {
                let (vr, n) = set(Type::Enumeration);
                (l.fmi3SetInt64)(c, &raw const vr, n, item.as_ptr(), item.len() * n)
            }
            "fmi3GetBoolean" => {
                let (vr, n) = get(Type::Boolean);
                (l.fmi3GetBoolean)(c, &raw const vr, n, truth.as_mut_ptr(), truth.len() * n)
            }
            "fmi3SetBoolean" => {
                let (vr, n) = set(Type::Boolean);
                (l.fmi3SetBoolean)(c, &raw const vr, n, truth.as_ptr(), truth.len() * n)
            }
            "fmi3GetString" => {
                let (vr, n) = get(Type::Text);
                (l.fmi3GetString)(c, &raw const vr, n, text.as_mut_ptr(), text.len() * n)
            }
            "fmi3SetString" => {
                let (vr, n) = set(Type::Text);
                (l.fmi3SetString)(c, &raw const vr, n, text.as_ptr(), text.len() * n)
            }
            "fmi3GetFloat32" => got!(fmi3GetFloat32, Type::Float32, f32),
            "fmi3SetFloat32" => given!(fmi3SetFloat32, Type::Float32, f32),
            "fmi3GetInt8" => got!(fmi3GetInt8, Type::Int8, i8),
            "fmi3SetInt8" => given!(fmi3SetInt8, Type::Int8, i8),
            "fmi3GetUInt8" => got!(fmi3GetUInt8, Type::UInt8, u8),
            "fmi3SetUInt8" => given!(fmi3SetUInt8, Type::UInt8, u8),
            "fmi3GetInt16" => got!(fmi3GetInt16, Type::Int16, i16),
            "fmi3SetInt16" => given!(fmi3SetInt16, Type::Int16, i16),
            "fmi3GetUInt16" => got!(fmi3GetUInt16, Type::UInt16, u16),
            "fmi3SetUInt16" => given!(fmi3SetUInt16, Type::UInt16, u16),
            "fmi3GetUInt32" => got!(fmi3GetUInt32, Type::UInt32, u32),
            "fmi3SetUInt32" => given!(fmi3SetUInt32, Type::UInt32, u32),
            "fmi3GetUInt64" => got!(fmi3GetUInt64, Type::UInt64, u64),
            "fmi3SetUInt64" => given!(fmi3SetUInt64, Type::UInt64, u64),
            "fmi3GetBinary" => {
                let (vr, n) = get(Type::Binary);
                let (mut sizes, mut pointers) = ([0], [null()]);
                let (sizes, pointers) = (sizes.as_mut_ptr(), pointers.as_mut_ptr());
                (l.fmi3GetBinary)(c, &raw const vr, n, sizes, pointers, n)
            }
            "fmi3SetBinary" => {
                let (vr, n) = set(Type::Binary);
                let (sizes, pointers) = ([3], [b"bar".as_ptr()]);
                (l.fmi3SetBinary)(c, &raw const vr, n, sizes.as_ptr(), pointers.as_ptr(), n)
            }
            "fmi3GetClock" => (l.fmi3GetClock)(c, clock, 1, truth.as_mut_ptr()),
            "fmi3SetClock" => (l.fmi3SetClock)(c, clock, 1, truth.as_ptr()),
            "fmi3GetNumberOfVariableDependencies" => {
                (l.fmi3GetNumberOfVariableDependencies)(c, 0, &raw mut size)
            }
            "fmi3GetVariableDependencies" => (l.fmi3GetVariableDependencies)(
                c,
                0,
                null_mut(),
                null_mut(),
                null_mut(),
                null_mut(),
                0,
            ),
            "fmi3GetFMUState" => (l.fmi3GetFMUState)(c, &raw mut state),
            "fmi3SetFMUState" => (l.fmi3SetFMUState)(c, state),
            "fmi3FreeFMUState" => (l.fmi3FreeFMUState)(c, &raw mut state),
            "fmi3SerializedFMUStateSize" => (l.fmi3SerializedFMUStateSize)(c, state, &raw mut size),
            "fmi3SerializeFMUState" => {
                (l.fmi3SerializeFMUState)(c, state, bytes.as_mut_ptr(), bytes.len())
            }
            "fmi3DeserializeFMUState" => (l.fmi3DeserializeFMUState)(
                c,
                serialized.as_ptr(),
                serialized.len(),
                &raw mut state,
            ),
            "fmi3GetDirectionalDerivative" => {
                (l.fmi3GetDirectionalDerivative)(c, null(), 0, null(), 0, null(), 0, null_mut(), 0)
            }
            "fmi3GetAdjointDerivative" => {
                (l.fmi3GetAdjointDerivative)(c, null(), 0, null(), 0, null(), 0, null_mut(), 0)
            }
            "fmi3GetIntervalDecimal" => {
                (l.fmi3GetIntervalDecimal)(c, clock, clocks, &raw mut period, &raw mut qualifier)
            }
            "fmi3GetIntervalFraction" => (l.fmi3GetIntervalFraction)(
                c,
                clock,
                clocks,
                &raw mut counter,
                &raw mut counter,
                &raw mut qualifier,
            ),
            "fmi3GetShiftDecimal" => (l.fmi3GetShiftDecimal)(c, clock, clocks, &raw mut period),
            "fmi3GetShiftFraction" => {
                (l.fmi3GetShiftFraction)(c, clock, clocks, &raw mut counter, &raw mut counter)
            }
            "fmi3SetIntervalDecimal" => {
                (l.fmi3SetIntervalDecimal)(c, clock, clocks, &raw const period)
            }
            "fmi3SetIntervalFraction" => (l.fmi3SetIntervalFraction)(
                c,
                clock,
                clocks,
                &raw const counter,
                &raw const counter,
            ),
            "fmi3SetShiftDecimal" => (l.fmi3SetShiftDecimal)(c, clock, clocks, &raw const period),
            "fmi3SetShiftFraction" => {
                (l.fmi3SetShiftFraction)(c, clock, clocks, &raw const counter, &raw const counter)
            }
            "fmi3UpdateDiscreteStates" => (l.fmi3UpdateDiscreteStates)(
                c,
                null_mut(),
                null_mut(),
                null_mut(),
                null_mut(),
                null_mut(),
                null_mut(),
            ),
            "fmi3CompletedIntegratorStep" => {
                (l.fmi3CompletedIntegratorStep)(c, 1, null_mut(), null_mut())
            }
            "fmi3SetTime" => (l.fmi3SetTime)(c, 0.0),
            "fmi3SetContinuousStates" => (l.fmi3SetContinuousStates)(c, null(), 0),
            "fmi3GetContinuousStateDerivatives" => {
                (l.fmi3GetContinuousStateDerivatives)(c, null_mut(), 0)
            }
            "fmi3GetEventIndicators" => (l.fmi3GetEventIndicators)(c, null_mut(), 0),
            "fmi3GetContinuousStates" => (l.fmi3GetContinuousStates)(c, null_mut(), 0),
            "fmi3GetNominalsOfContinuousStates" => {
                (l.fmi3GetNominalsOfContinuousStates)(c, null_mut(), 0)
            }
            "fmi3GetNumberOfEventIndicators" => {
                (l.fmi3GetNumberOfEventIndicators)(c, &raw mut size)
            }
            "fmi3GetNumberOfContinuousStates" => {
                (l.fmi3GetNumberOfContinuousStates)(c, &raw mut size)
            }
            "fmi3GetOutputDerivatives" => {
                (l.fmi3GetOutputDerivatives)(c, null(), 0, null(), null_mut(), 0)
            }
            "fmi3DoStep" => instance.step(0.0, 0.01),
            "fmi3ActivateModelPartition" => (l.fmi3ActivateModelPartition)(c, CLOCK, 0.0),
            other => panic!("the table names {other}"),
        }
    };
    if !state.is_null() {
        assert_eq!(instance.free_state(&mut state), Status::OK);
    }
    status
}
