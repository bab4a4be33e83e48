//! The 34 functions of FMI 2.0 co-simulation in a shared library.

use crate::types::*;
use std::ffi::c_int;
use std::path::Path;

macro_rules! functions {
    ($Library:ident, $count:literal: $($(#[$doc:meta])* fn $name:ident($($type:ty),*) $(-> $result:ty)?;)*) => {
        /// A loaded shared library with its functions under their C names. Dropping it closes the library.
        #[allow(non_snake_case, reason = "the C names of the standard")]
        pub struct $Library {
            $(
                #[doc = concat!("`", stringify!($name), "`")]
                pub $name: unsafe extern "C" fn($($type),*) $(-> $result)?,
            )*
            _library: libloading::Library,
        }

        impl $Library {
            /// The names of all functions, those that are not called on an instance last.
            pub const FUNCTIONS: [&'static str; $count] = [$(stringify!($name)),*];

            /// Loads a library and looks up every function.
            ///
            /// # Panics
            /// When the library cannot be loaded or lacks a function; the message names both.
            #[allow(non_snake_case, reason = "the C names of the standard")]
            pub fn load(path: &Path) -> Self {
                // SAFETY: an FMU of this project; its initializers are those of the Rust standard library.
                let library = unsafe { libloading::Library::new(path) }
                    .unwrap_or_else(|e| panic!("{} cannot be loaded: {e}", path.display()));
                $(
                    // SAFETY: the type is the one that the standard gives to this name; the library is kept
                    // as long as the pointer.
                    let $name = *unsafe { library.get(concat!(stringify!($name), "\0").as_bytes()) }
                        .unwrap_or_else(|e| panic!("{} lacks {}: {e}", path.display(), stringify!($name)));
                )*
                Self { $($name,)* _library: library }
            }
        }
    };
}
pub(crate) use functions;

functions! {
    Library, 34:

    fn fmi2SetDebugLogging(Component, Boolean, usize, *const FmiString) -> Status;
    fn fmi2FreeInstance(Component);
    fn fmi2SetupExperiment(Component, Boolean, Real, Real, Boolean, Real) -> Status;
    fn fmi2EnterInitializationMode(Component) -> Status;
    fn fmi2ExitInitializationMode(Component) -> Status;
    fn fmi2Terminate(Component) -> Status;
    fn fmi2Reset(Component) -> Status;
    fn fmi2GetReal(Component, *const Reference, usize, *mut Real) -> Status;
    fn fmi2GetInteger(Component, *const Reference, usize, *mut Integer) -> Status;
    fn fmi2GetBoolean(Component, *const Reference, usize, *mut Boolean) -> Status;
    fn fmi2GetString(Component, *const Reference, usize, *mut FmiString) -> Status;
    fn fmi2SetReal(Component, *const Reference, usize, *const Real) -> Status;
    fn fmi2SetInteger(Component, *const Reference, usize, *const Integer) -> Status;
    fn fmi2SetBoolean(Component, *const Reference, usize, *const Boolean) -> Status;
    fn fmi2SetString(Component, *const Reference, usize, *const FmiString) -> Status;
    fn fmi2GetFMUstate(Component, *mut FmuState) -> Status;
    fn fmi2SetFMUstate(Component, FmuState) -> Status;
    fn fmi2FreeFMUstate(Component, *mut FmuState) -> Status;
    fn fmi2SerializedFMUstateSize(Component, FmuState, *mut usize) -> Status;
    fn fmi2SerializeFMUstate(Component, FmuState, *mut Byte, usize) -> Status;
    fn fmi2DeSerializeFMUstate(Component, *const Byte, usize, *mut FmuState) -> Status;
    fn fmi2GetDirectionalDerivative(Component, *const Reference, usize, *const Reference, usize, *const Real, *mut Real) -> Status;
    fn fmi2SetRealInputDerivatives(Component, *const Reference, usize, *const Integer, *const Real) -> Status;
    fn fmi2GetRealOutputDerivatives(Component, *const Reference, usize, *const Integer, *mut Real) -> Status;
    fn fmi2DoStep(Component, Real, Real, Boolean) -> Status;
    fn fmi2CancelStep(Component) -> Status;
    fn fmi2GetStatus(Component, c_int, *mut c_int) -> Status;
    fn fmi2GetRealStatus(Component, c_int, *mut Real) -> Status;
    fn fmi2GetIntegerStatus(Component, c_int, *mut Integer) -> Status;
    fn fmi2GetBooleanStatus(Component, c_int, *mut Boolean) -> Status;
    fn fmi2GetStringStatus(Component, c_int, *mut FmiString) -> Status;
    fn fmi2Instantiate(FmiString, c_int, FmiString, FmiString, *const Callbacks, Boolean, Boolean) -> Component;
    fn fmi2GetTypesPlatform() -> FmiString;
    fn fmi2GetVersion() -> FmiString;
}
