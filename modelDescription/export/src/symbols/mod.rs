//! The macro that gives the generic functions their C names.

mod fmi2;
mod fmi3;

/// Exports a [`Model`](crate::Model) as the 34 functions of FMI 2.0 co-simulation and the 75 functions of FMI 3.0, co-simulation
/// and scheduled execution: `fmu_export::export!(Lag);`, once in a `cdylib`.
///
/// Two crates that expand it are never linked into one binary: the symbols would clash. That is why every FMU is a
/// library crate with the expansion in a `cdylib` target of its own.
#[macro_export]
macro_rules! export {
    ($model:ty) => {
        // Said out here: where the functions are, a model of a name such as Status would be the SDK's.
        #[doc(hidden)]
        type __ExportedModel = $model;
        $crate::export_fmi2! { __ExportedModel }
        $crate::export_fmi3! { __ExportedModel }
        $crate::hand_over! { $model }
    };
}
