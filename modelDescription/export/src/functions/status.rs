//! Status inquiry (section 4.2.3) and the functions of capabilities that no model here has.

use super::known;
use crate::ffi::*;
use crate::guard::guard;
use crate::instance::refused;
use crate::legality::Function as F;
use crate::model::Model;

/// A function of an optional capability that the XML does not claim: always refused.
pub unsafe fn unsupported<M: Model>(c: Component, function: F, capability: &str) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M>(c, function, |_| {
            refused(format!(
                "not supported ({capability} in modelDescription.xml)"
            ))
        })
    }
}

/// fmi2GetRealStatus
pub unsafe fn get_real_status<M: Model>(
    c: Component,
    kind: StatusKind,
    value: *mut Real,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M>(c, F::fmi2GetRealStatus, |instance| {
            *known(value.as_mut(), "value")? = instance.real_status(kind)?;
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
        guard::<M>(c, F::fmi2GetBooleanStatus, |instance| {
            *known(value.as_mut(), "value")? = instance.boolean_status(kind)?.into();
            Ok(())
        })
    }
}
