//! The C names of the 34 functions of FMI 2.0.

/// The functions of FMI 2.0 of [`export!`](crate::export).
#[doc(hidden)]
#[macro_export]
macro_rules! export_fmi2 {
    ($model:ty) => {
        #[allow(
                clippy::missing_safety_doc,
                clippy::too_many_arguments,
                non_snake_case,
                reason = "names, signatures and contracts are those of the FMI 2.0 standard"
        )]
        const _: () = {
            // SAFETY (all functions): the importer keeps the contract of the standard, which is what the generic
            // functions ask for; each symbol is defined once, because this macro is expanded once per library.
            use $crate::ffi::fmi2::*;
            use $crate::functions::{self, fmi2::{self, kind}};
            use $crate::legality::fmi2::Function;
            type Model = $model;

            $crate::export_fmi2! { @ functions
                fn fmi2Instantiate(name: FmiString, kind: Type, guid: FmiString, location: FmiString, callbacks: *const Callbacks, visible: Boolean, logging: Boolean) -> Component
                    { fmi2::instantiate::<Model>(name, kind, guid, location, callbacks, visible, logging) }
                fn fmi2FreeInstance(c: Component) -> () { functions::free_instance::<Model>(c) }
                fn fmi2SetDebugLogging(c: Component, on: Boolean, n: usize, categories: *const FmiString) -> Status
                    { functions::set_debug_logging::<Model>(c, Function::fmi2SetDebugLogging, on != 0, n, categories) }
                fn fmi2SetupExperiment(c: Component, tolerance_defined: Boolean, tolerance: Real, start: Real, stop_defined: Boolean, stop: Real) -> Status
                    { fmi2::setup_experiment::<Model>(c, tolerance_defined, tolerance, start, stop_defined, stop) }
                fn fmi2EnterInitializationMode(c: Component) -> Status { functions::enter_initialization_mode::<Model>(c, Function::fmi2EnterInitializationMode) }
                fn fmi2ExitInitializationMode(c: Component) -> Status { functions::exit_initialization_mode::<Model>(c, Function::fmi2ExitInitializationMode) }
                fn fmi2Terminate(c: Component) -> Status { functions::terminate::<Model>(c, Function::fmi2Terminate) }
                fn fmi2Reset(c: Component) -> Status { functions::reset::<Model>(c, Function::fmi2Reset) }
                fn fmi2GetReal(c: Component, vr: *const ValueReference, n: usize, value: *mut Real) -> Status
                    { fmi2::get::<Model, kind::Real>(c, Function::fmi2GetReal, vr, n, value) }
                fn fmi2GetInteger(c: Component, vr: *const ValueReference, n: usize, value: *mut Integer) -> Status
                    { fmi2::get::<Model, kind::Integer>(c, Function::fmi2GetInteger, vr, n, value) }
                fn fmi2GetBoolean(c: Component, vr: *const ValueReference, n: usize, value: *mut Boolean) -> Status
                    { fmi2::get_boolean::<Model>(c, vr, n, value) }
                fn fmi2GetString(c: Component, vr: *const ValueReference, n: usize, value: *mut FmiString) -> Status
                    { fmi2::get_string::<Model>(c, vr, n, value) }
                fn fmi2SetReal(c: Component, vr: *const ValueReference, n: usize, value: *const Real) -> Status
                    { fmi2::set::<Model, kind::Real>(c, Function::fmi2SetReal, vr, n, value) }
                fn fmi2SetInteger(c: Component, vr: *const ValueReference, n: usize, value: *const Integer) -> Status
                    { fmi2::set::<Model, kind::Integer>(c, Function::fmi2SetInteger, vr, n, value) }
                fn fmi2SetBoolean(c: Component, vr: *const ValueReference, n: usize, value: *const Boolean) -> Status
                    { fmi2::set_boolean::<Model>(c, vr, n, value) }
                fn fmi2SetString(c: Component, vr: *const ValueReference, n: usize, value: *const FmiString) -> Status
                    { fmi2::set_string::<Model>(c, vr, n, value) }
                fn fmi2GetFMUstate(c: Component, state: *mut FmuState) -> Status { functions::get_fmu_state::<Model, _>(c, Function::fmi2GetFMUstate, state) }
                fn fmi2SetFMUstate(c: Component, state: FmuState) -> Status { functions::set_fmu_state::<Model, _>(c, Function::fmi2SetFMUstate, state) }
                fn fmi2FreeFMUstate(c: Component, state: *mut FmuState) -> Status { functions::free_fmu_state::<Model, _>(c, Function::fmi2FreeFMUstate, state) }
                fn fmi2SerializedFMUstateSize(c: Component, state: FmuState, size: *mut usize) -> Status
                    { functions::serialized_fmu_state_size::<Model, _>(c, Function::fmi2SerializedFMUstateSize, state, size) }
                fn fmi2SerializeFMUstate(c: Component, state: FmuState, bytes: *mut Byte, size: usize) -> Status
                    { functions::serialize_fmu_state::<Model, _>(c, Function::fmi2SerializeFMUstate, state, bytes.cast(), size) }
                fn fmi2DeSerializeFMUstate(c: Component, bytes: *const Byte, size: usize, state: *mut FmuState) -> Status
                    { functions::deserialize_fmu_state::<Model, _>(c, Function::fmi2DeSerializeFMUstate, bytes.cast(), size, state) }
                fn fmi2GetDirectionalDerivative(c: Component, _unknown: *const ValueReference, _nu: usize, _known: *const ValueReference, _nk: usize, _dv_known: *const Real, _dv_unknown: *mut Real) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi2GetDirectionalDerivative, "providesDirectionalDerivative is false") }
                fn fmi2SetRealInputDerivatives(c: Component, _vr: *const ValueReference, _n: usize, _order: *const Integer, _value: *const Real) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi2SetRealInputDerivatives, "canInterpolateInputs is false") }
                fn fmi2GetRealOutputDerivatives(c: Component, _vr: *const ValueReference, _n: usize, _order: *const Integer, _value: *mut Real) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi2GetRealOutputDerivatives, "maxOutputDerivativeOrder is 0") }
                fn fmi2DoStep(c: Component, t: Real, h: Real, _no_set_prior: Boolean) -> Status
                    { functions::step::<Model>(c, t, h) }
                fn fmi2CancelStep(c: Component) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi2CancelStep, "canRunAsynchronuously is false") }
                fn fmi2GetStatus(c: Component, _kind: StatusKind, _value: *mut Integer) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi2GetStatus, "canRunAsynchronuously is false") }
                fn fmi2GetRealStatus(c: Component, kind: StatusKind, value: *mut Real) -> Status
                    { fmi2::get_real_status::<Model>(c, kind, value) }
                fn fmi2GetIntegerStatus(c: Component, _kind: StatusKind, _value: *mut Integer) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi2GetIntegerStatus, "no integer status is defined") }
                fn fmi2GetBooleanStatus(c: Component, kind: StatusKind, value: *mut Boolean) -> Status
                    { fmi2::get_boolean_status::<Model>(c, kind, value) }
                fn fmi2GetStringStatus(c: Component, _kind: StatusKind, _value: *mut FmiString) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi2GetStringStatus, "canRunAsynchronuously is false") }
            }

            #[unsafe(no_mangle)]
            pub extern "C" fn fmi2GetTypesPlatform() -> FmiString {
                c"default".as_ptr()
            }

            #[unsafe(no_mangle)]
            pub extern "C" fn fmi2GetVersion() -> FmiString {
                c"2.0".as_ptr()
            }
        };
    };
    (@ functions $(fn $name:ident($($argument:ident: $type:ty),*) -> $result:ty $body:block)*) => {$(
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name($($argument: $type),*) -> $result {
            // SAFETY: see the head of this block.
            unsafe { $body }
        }
    )*};
}
