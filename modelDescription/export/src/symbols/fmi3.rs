//! The C names of the 75 functions of FMI 3.0.

/// The functions of FMI 3.0 of [`export!`](crate::export).
#[doc(hidden)]
#[macro_export]
macro_rules! export_fmi3 {
    ($model:ty) => {
        #[allow(
                clippy::missing_safety_doc,
                clippy::too_many_arguments,
                non_snake_case,
                reason = "names, signatures and contracts are those of the FMI 3.0 standard"
        )]
        const _: () = {
            // SAFETY (all functions): the importer keeps the contract of the standard, which is what the generic
            // functions ask for; each symbol is defined once, because this macro is expanded once per library.
            use $crate::ffi::fmi3::*;
            use $crate::functions::{self, fmi3::{self, Common, kind}};
            use $crate::legality::fmi3::Function;
            use ::core::ffi::c_void;
            type Model = $model;

            $crate::export_fmi3! { @ functions
                fn fmi3InstantiateModelExchange(name: FmiString, token: FmiString, resources: FmiString, _visible: Boolean, logging: Boolean, environment: *mut c_void, log_message: ::core::option::Option<LogMessage>) -> Component
                    { fmi3::instantiate_model_exchange::<Model>(Common { name, token, resources, logging, logger: Logger { log_message, environment } }) }
                fn fmi3InstantiateCoSimulation(name: FmiString, token: FmiString, resources: FmiString, _visible: Boolean, logging: Boolean, event_mode_used: Boolean, _early_return_allowed: Boolean, _intermediate_variables: *const ValueReference, n: usize, environment: *mut c_void, log_message: ::core::option::Option<LogMessage>, _intermediate_update: Uncalled) -> Component
                {
                    $crate::provenance::tell($crate::built_from!());
                    fmi3::instantiate_co_simulation::<Model>(Common { name, token, resources, logging, logger: Logger { log_message, environment } }, event_mode_used, n)
                }
                fn fmi3InstantiateScheduledExecution(name: FmiString, token: FmiString, resources: FmiString, _visible: Boolean, logging: Boolean, environment: *mut c_void, log_message: ::core::option::Option<LogMessage>, _clock_update: Uncalled, _lock_preemption: Uncalled, _unlock_preemption: Uncalled) -> Component
                {
                    $crate::provenance::tell($crate::built_from!());
                    fmi3::instantiate_scheduled_execution::<Model>(Common { name, token, resources, logging, logger: Logger { log_message, environment } })
                }
                fn fmi3FreeInstance(c: Component) -> () { functions::free_instance::<Model>(c) }
                fn fmi3SetDebugLogging(c: Component, on: Boolean, n: usize, categories: *const FmiString) -> Status
                    { functions::set_debug_logging::<Model>(c, Function::fmi3SetDebugLogging, on != 0, n, categories) }
                fn fmi3EnterInitializationMode(c: Component, tolerance_defined: Boolean, tolerance: Float64, start: Float64, stop_defined: Boolean, stop: Float64) -> Status
                    { fmi3::enter_initialization_mode::<Model>(c, tolerance_defined, tolerance, start, stop_defined, stop) }
                fn fmi3ExitInitializationMode(c: Component) -> Status { functions::exit_initialization_mode::<Model>(c, Function::fmi3ExitInitializationMode) }
                fn fmi3Terminate(c: Component) -> Status { functions::terminate::<Model>(c, Function::fmi3Terminate) }
                fn fmi3Reset(c: Component) -> Status { functions::reset::<Model>(c, Function::fmi3Reset) }
                fn fmi3GetFloat64(c: Component, vr: *const ValueReference, n: usize, values: *mut Float64, n_values: usize) -> Status
                    { fmi3::get::<Model, kind::Float64>(c, Function::fmi3GetFloat64, vr, n, values, n_values) }
                fn fmi3GetInt32(c: Component, vr: *const ValueReference, n: usize, values: *mut i32, n_values: usize) -> Status
                    { fmi3::get::<Model, kind::Int32>(c, Function::fmi3GetInt32, vr, n, values, n_values) }
                fn fmi3GetInt64(c: Component, vr: *const ValueReference, n: usize, values: *mut i64, n_values: usize) -> Status
                    { fmi3::get::<Model, kind::Int64>(c, Function::fmi3GetInt64, vr, n, values, n_values) }
                fn fmi3GetBoolean(c: Component, vr: *const ValueReference, n: usize, values: *mut Boolean, n_values: usize) -> Status
                    { fmi3::get_boolean::<Model>(c, vr, n, values, n_values) }
                fn fmi3GetString(c: Component, vr: *const ValueReference, n: usize, values: *mut FmiString, n_values: usize) -> Status
                    { fmi3::get_string::<Model>(c, vr, n, values, n_values) }
                fn fmi3GetFloat32(c: Component, vr: *const ValueReference, n: usize, values: *mut f32, n_values: usize) -> Status
                    { fmi3::get::<Model, kind::Float32>(c, Function::fmi3GetFloat32, vr, n, values, n_values) }
                fn fmi3GetInt8(c: Component, vr: *const ValueReference, n: usize, values: *mut i8, n_values: usize) -> Status
                    { fmi3::get::<Model, kind::Int8>(c, Function::fmi3GetInt8, vr, n, values, n_values) }
                fn fmi3GetUInt8(c: Component, vr: *const ValueReference, n: usize, values: *mut u8, n_values: usize) -> Status
                    { fmi3::get::<Model, kind::UInt8>(c, Function::fmi3GetUInt8, vr, n, values, n_values) }
                fn fmi3GetInt16(c: Component, vr: *const ValueReference, n: usize, values: *mut i16, n_values: usize) -> Status
                    { fmi3::get::<Model, kind::Int16>(c, Function::fmi3GetInt16, vr, n, values, n_values) }
                fn fmi3GetUInt16(c: Component, vr: *const ValueReference, n: usize, values: *mut u16, n_values: usize) -> Status
                    { fmi3::get::<Model, kind::UInt16>(c, Function::fmi3GetUInt16, vr, n, values, n_values) }
                fn fmi3GetUInt32(c: Component, vr: *const ValueReference, n: usize, values: *mut u32, n_values: usize) -> Status
                    { fmi3::get::<Model, kind::UInt32>(c, Function::fmi3GetUInt32, vr, n, values, n_values) }
                fn fmi3GetUInt64(c: Component, vr: *const ValueReference, n: usize, values: *mut u64, n_values: usize) -> Status
                    { fmi3::get::<Model, kind::UInt64>(c, Function::fmi3GetUInt64, vr, n, values, n_values) }
                fn fmi3GetBinary(c: Component, vr: *const ValueReference, n: usize, sizes: *mut usize, values: *mut Binary, n_values: usize) -> Status
                    { fmi3::get_binary::<Model>(c, vr, n, sizes, values, n_values) }
                fn fmi3SetFloat64(c: Component, vr: *const ValueReference, n: usize, values: *const Float64, n_values: usize) -> Status
                    { fmi3::set::<Model, kind::Float64>(c, Function::fmi3SetFloat64, vr, n, values, n_values) }
                fn fmi3SetInt32(c: Component, vr: *const ValueReference, n: usize, values: *const i32, n_values: usize) -> Status
                    { fmi3::set::<Model, kind::Int32>(c, Function::fmi3SetInt32, vr, n, values, n_values) }
                fn fmi3SetInt64(c: Component, vr: *const ValueReference, n: usize, values: *const i64, n_values: usize) -> Status
                    { fmi3::set::<Model, kind::Int64>(c, Function::fmi3SetInt64, vr, n, values, n_values) }
                fn fmi3SetBoolean(c: Component, vr: *const ValueReference, n: usize, values: *const Boolean, n_values: usize) -> Status
                    { fmi3::set_boolean::<Model>(c, vr, n, values, n_values) }
                fn fmi3SetString(c: Component, vr: *const ValueReference, n: usize, values: *const FmiString, n_values: usize) -> Status
                    { fmi3::set_string::<Model>(c, vr, n, values, n_values) }
                fn fmi3SetFloat32(c: Component, vr: *const ValueReference, n: usize, values: *const f32, n_values: usize) -> Status
                    { fmi3::set::<Model, kind::Float32>(c, Function::fmi3SetFloat32, vr, n, values, n_values) }
                fn fmi3SetInt8(c: Component, vr: *const ValueReference, n: usize, values: *const i8, n_values: usize) -> Status
                    { fmi3::set::<Model, kind::Int8>(c, Function::fmi3SetInt8, vr, n, values, n_values) }
                fn fmi3SetUInt8(c: Component, vr: *const ValueReference, n: usize, values: *const u8, n_values: usize) -> Status
                    { fmi3::set::<Model, kind::UInt8>(c, Function::fmi3SetUInt8, vr, n, values, n_values) }
                fn fmi3SetInt16(c: Component, vr: *const ValueReference, n: usize, values: *const i16, n_values: usize) -> Status
                    { fmi3::set::<Model, kind::Int16>(c, Function::fmi3SetInt16, vr, n, values, n_values) }
                fn fmi3SetUInt16(c: Component, vr: *const ValueReference, n: usize, values: *const u16, n_values: usize) -> Status
                    { fmi3::set::<Model, kind::UInt16>(c, Function::fmi3SetUInt16, vr, n, values, n_values) }
                fn fmi3SetUInt32(c: Component, vr: *const ValueReference, n: usize, values: *const u32, n_values: usize) -> Status
                    { fmi3::set::<Model, kind::UInt32>(c, Function::fmi3SetUInt32, vr, n, values, n_values) }
                fn fmi3SetUInt64(c: Component, vr: *const ValueReference, n: usize, values: *const u64, n_values: usize) -> Status
                    { fmi3::set::<Model, kind::UInt64>(c, Function::fmi3SetUInt64, vr, n, values, n_values) }
                fn fmi3SetBinary(c: Component, vr: *const ValueReference, n: usize, sizes: *const usize, values: *const Binary, n_values: usize) -> Status
                    { fmi3::set_binary::<Model>(c, vr, n, sizes, values, n_values) }
                fn fmi3GetFMUState(c: Component, state: *mut FmuState) -> Status
                    { functions::get_fmu_state::<Model, _>(c, Function::fmi3GetFMUState, state) }
                fn fmi3SetFMUState(c: Component, state: FmuState) -> Status
                    { functions::set_fmu_state::<Model, _>(c, Function::fmi3SetFMUState, state) }
                fn fmi3FreeFMUState(c: Component, state: *mut FmuState) -> Status
                    { functions::free_fmu_state::<Model, _>(c, Function::fmi3FreeFMUState, state) }
                fn fmi3SerializedFMUStateSize(c: Component, state: FmuState, size: *mut usize) -> Status
                    { functions::serialized_fmu_state_size::<Model, _>(c, Function::fmi3SerializedFMUStateSize, state, size) }
                fn fmi3SerializeFMUState(c: Component, state: FmuState, bytes: *mut Byte, size: usize) -> Status
                    { functions::serialize_fmu_state::<Model, _>(c, Function::fmi3SerializeFMUState, state, bytes, size) }
                fn fmi3DeserializeFMUState(c: Component, bytes: *const Byte, size: usize, state: *mut FmuState) -> Status
                    { functions::deserialize_fmu_state::<Model, _>(c, Function::fmi3DeserializeFMUState, bytes, size, state) }
                fn fmi3DoStep(c: Component, t: Float64, h: Float64, no_set_prior: Boolean, event_handling_needed: *mut Boolean, terminate_simulation: *mut Boolean, early_return: *mut Boolean, last_successful_time: *mut Float64) -> Status
                    { fmi3::do_step::<Model>(c, t, h, no_set_prior, event_handling_needed, terminate_simulation, early_return, last_successful_time) }
                fn fmi3ActivateModelPartition(c: Component, clock: ValueReference, t: Float64) -> Status
                    { fmi3::activate_model_partition::<Model>(c, clock, t) }
                fn fmi3GetIntervalDecimal(c: Component, vr: *const ValueReference, n: usize, intervals: *mut Float64, qualifiers: *mut IntervalQualifier) -> Status
                    { fmi3::get_interval::<Model>(c, vr, n, intervals, qualifiers) }
                fn fmi3GetShiftDecimal(c: Component, vr: *const ValueReference, n: usize, shifts: *mut Float64) -> Status
                    { fmi3::get_shift::<Model>(c, vr, n, shifts) }
                fn fmi3GetClock(c: Component, _vr: *const ValueReference, _n: usize, _values: *mut Boolean) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3GetClock, "no clock is an output or local") }
                fn fmi3SetClock(c: Component, _vr: *const ValueReference, _n: usize, _values: *const Boolean) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3SetClock, "hasEventMode is false") }
                fn fmi3GetIntervalFraction(c: Component, _vr: *const ValueReference, _n: usize, _counters: *mut u64, _resolutions: *mut u64, _qualifiers: *mut IntervalQualifier) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3GetIntervalFraction, "supportsFraction is false") }
                fn fmi3GetShiftFraction(c: Component, _vr: *const ValueReference, _n: usize, _counters: *mut u64, _resolutions: *mut u64) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3GetShiftFraction, "supportsFraction is false") }
                fn fmi3SetIntervalDecimal(c: Component, _vr: *const ValueReference, _n: usize, _intervals: *const Float64) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3SetIntervalDecimal, "intervalVariability is constant") }
                fn fmi3SetIntervalFraction(c: Component, _vr: *const ValueReference, _n: usize, _counters: *const u64, _resolutions: *const u64) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3SetIntervalFraction, "supportsFraction is false") }
                fn fmi3SetShiftDecimal(c: Component, _vr: *const ValueReference, _n: usize, _shifts: *const Float64) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3SetShiftDecimal, "intervalVariability is constant") }
                fn fmi3SetShiftFraction(c: Component, _vr: *const ValueReference, _n: usize, _counters: *const u64, _resolutions: *const u64) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3SetShiftFraction, "supportsFraction is false") }
                fn fmi3EnterEventMode(c: Component) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3EnterEventMode, "hasEventMode is false") }
                fn fmi3EnterStepMode(c: Component) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3EnterStepMode, "hasEventMode is false") }
                fn fmi3EvaluateDiscreteStates(c: Component) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3EvaluateDiscreteStates, "hasEventMode is false") }
                fn fmi3UpdateDiscreteStates(c: Component, _need_update: *mut Boolean, _terminate: *mut Boolean, _nominals_changed: *mut Boolean, _values_changed: *mut Boolean, _next_defined: *mut Boolean, _next: *mut Float64) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3UpdateDiscreteStates, "hasEventMode is false") }
                fn fmi3EnterConfigurationMode(c: Component) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3EnterConfigurationMode, "there is no structural parameter") }
                fn fmi3ExitConfigurationMode(c: Component) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3ExitConfigurationMode, "there is no structural parameter") }
                fn fmi3GetNumberOfVariableDependencies(c: Component, _vr: ValueReference, _n: *mut usize) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3GetNumberOfVariableDependencies, "providesPerElementDependencies is false") }
                fn fmi3GetVariableDependencies(c: Component, _dependent: ValueReference, _elements: *mut usize, _independents: *mut ValueReference, _of_independents: *mut usize, _kinds: *mut ::core::ffi::c_int, _n: usize) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3GetVariableDependencies, "providesPerElementDependencies is false") }
                fn fmi3GetDirectionalDerivative(c: Component, _unknowns: *const ValueReference, _nu: usize, _knowns: *const ValueReference, _nk: usize, _seed: *const Float64, _ns: usize, _sensitivity: *mut Float64, _nt: usize) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3GetDirectionalDerivative, "providesDirectionalDerivatives is false") }
                fn fmi3GetAdjointDerivative(c: Component, _unknowns: *const ValueReference, _nu: usize, _knowns: *const ValueReference, _nk: usize, _seed: *const Float64, _ns: usize, _sensitivity: *mut Float64, _nt: usize) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3GetAdjointDerivative, "providesAdjointDerivatives is false") }
                fn fmi3GetOutputDerivatives(c: Component, _vr: *const ValueReference, _n: usize, _orders: *const i32, _values: *mut Float64, _n_values: usize) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3GetOutputDerivatives, "maxOutputDerivativeOrder is 0") }
                fn fmi3EnterContinuousTimeMode(c: Component) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3EnterContinuousTimeMode, "there is no ModelExchange") }
                fn fmi3CompletedIntegratorStep(c: Component, _no_set_prior: Boolean, _enter_event_mode: *mut Boolean, _terminate: *mut Boolean) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3CompletedIntegratorStep, "there is no ModelExchange") }
                fn fmi3SetTime(c: Component, _time: Float64) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3SetTime, "there is no ModelExchange") }
                fn fmi3SetContinuousStates(c: Component, _states: *const Float64, _n: usize) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3SetContinuousStates, "there is no ModelExchange") }
                fn fmi3GetContinuousStateDerivatives(c: Component, _derivatives: *mut Float64, _n: usize) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3GetContinuousStateDerivatives, "there is no ModelExchange") }
                fn fmi3GetEventIndicators(c: Component, _indicators: *mut Float64, _n: usize) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3GetEventIndicators, "there is no ModelExchange") }
                fn fmi3GetContinuousStates(c: Component, _states: *mut Float64, _n: usize) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3GetContinuousStates, "there is no ModelExchange") }
                fn fmi3GetNominalsOfContinuousStates(c: Component, _nominals: *mut Float64, _n: usize) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3GetNominalsOfContinuousStates, "there is no ModelExchange") }
                fn fmi3GetNumberOfEventIndicators(c: Component, _n: *mut usize) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3GetNumberOfEventIndicators, "there is no ModelExchange") }
                fn fmi3GetNumberOfContinuousStates(c: Component, _n: *mut usize) -> Status
                    { functions::unsupported::<Model>(c, Function::fmi3GetNumberOfContinuousStates, "there is no ModelExchange") }
            }

            #[unsafe(no_mangle)]
            pub extern "C" fn fmi3GetVersion() -> FmiString {
                c"3.0".as_ptr()
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
