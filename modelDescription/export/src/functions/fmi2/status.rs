//! Status inquiry: section 4.2.3.

use crate::ffi::fmi2::*;
use crate::functions::known;
use crate::guard::guard;
use crate::instance::refused;
use crate::legality::fmi2::Function as F;
use crate::model::Model;

/// fmi2GetRealStatus
pub unsafe fn get_real_status<M: Model>(
    c: Component,
    kind: StatusKind,
    value: *mut Real,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M, _>(c, F::fmi2GetRealStatus, |instance| {
            let value = known(value.as_mut(), "value")?;
            if kind != LAST_SUCCESSFUL_TIME {
                return refused(format!(
                    "status kind {kind} is not supported, expected fmi2LastSuccessfulTime (2)"
                ));
            }
            *value = instance.now.clock.time();
            Ok(())
        })
    }
}

/// fmi2GetBooleanStatus
pub unsafe fn get_boolean_status<M: Model>(
    c: Component,
    kind: StatusKind,
    value: *mut Boolean,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M, _>(c, F::fmi2GetBooleanStatus, |_| {
            let value = known(value.as_mut(), "value")?;
            if kind != TERMINATED {
                return refused(format!(
                    "status kind {kind} is not supported, expected fmi2Terminated (3)"
                ));
            }
            *value = 0; // no model ends the run by itself
            Ok(())
        })
    }
}
