//! Life cycle, as far as both versions have the same arguments.

use super::known;
use crate::ffi::{Component, FmiString, Status, array, string};
use crate::guard::guard;
use crate::instance::Instance;
use crate::legality::Call;
use crate::model::Model;
use std::panic::catch_unwind;

/// fmi2FreeInstance, fmi3FreeInstance: null is allowed.
pub unsafe fn free_instance<M: Model>(component: Component) {
    if !component.is_null() {
        // SAFETY: the component came from `Box::into_raw` when `M` was instantiated and is freed once, by contract. Dropping a
        // model runs no code of its own that could panic; should it, the panic ends here.
        let _ = catch_unwind(|| drop(unsafe { Box::from_raw(component.cast::<Instance<M>>()) }));
    }
}

/// fmi2SetDebugLogging, fmi3SetDebugLogging
pub unsafe fn set_debug_logging<M: Model>(
    c: Component,
    function: impl Call,
    on: bool,
    n: usize,
    names: *const FmiString,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M, _>(c, function, |instance| {
            let names = known(array(names, n), "categories")?;
            instance.set_debug_logging(on, names.iter().map(|&name| string(name)))
        })
    }
}

macro_rules! plain {
    ($($(#[$doc:meta])* $name:ident;)*) => {$(
        $(#[$doc])*
        pub unsafe fn $name<M: Model>(c: Component, function: impl Call) -> Status {
            // SAFETY: the importer's contract.
            unsafe { guard::<M, _>(c, function, Instance::$name) }
        }
    )*};
}

plain! {
    /// fmi2EnterInitializationMode
    enter_initialization_mode;
    /// fmi2ExitInitializationMode, fmi3ExitInitializationMode
    exit_initialization_mode;
    /// fmi2Terminate, fmi3Terminate
    terminate;
    /// fmi2Reset, fmi3Reset
    reset;
}
