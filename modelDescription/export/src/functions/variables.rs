//! Variables by value reference: section 2.1.7.

use super::known;
use crate::access::{NoValue, Value, boolean};
use crate::ffi::*;
use crate::guard::guard;
use crate::legality::Function as F;
use crate::model::Model;
use std::ffi::CString;

/// fmi2GetReal, fmi2GetInteger: values of type `V` as they are.
pub unsafe fn get<M: Model, V: Value + Copy>(
    c: Component,
    function: F,
    references: *const ValueReference,
    n: usize,
    values: *mut V,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M>(c, function, |instance| {
            let references = known(array(references, n), "vr")?;
            let values = known(array_mut(values, n), "value")?;
            instance.get::<V>(references, |i, value| values[i] = value)
        })
    }
}

/// fmi2SetReal, fmi2SetInteger: values of type `V` as they are.
pub unsafe fn set<M: Model, V: Value + Copy>(
    c: Component,
    function: F,
    references: *const ValueReference,
    n: usize,
    values: *const V,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M>(c, function, |instance| {
            let references = known(array(references, n), "vr")?;
            let values = known(array(values, n), "value")?;
            instance.set::<V>(references, |i| Ok(values[i]))
        })
    }
}

/// fmi2GetBoolean
pub unsafe fn get_boolean<M: Model>(
    c: Component,
    references: *const ValueReference,
    n: usize,
    values: *mut Boolean,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M>(c, F::fmi2GetBoolean, |instance| {
            let references = known(array(references, n), "vr")?;
            let values = known(array_mut(values, n), "value")?;
            instance.get::<bool>(references, |i, value| values[i] = value.into())
        })
    }
}

/// fmi2SetBoolean
pub unsafe fn set_boolean<M: Model>(
    c: Component,
    references: *const ValueReference,
    n: usize,
    values: *const Boolean,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M>(c, F::fmi2SetBoolean, |instance| {
            let references = known(array(references, n), "vr")?;
            let values = known(array(values, n), "value")?;
            instance.set::<bool>(references, |i| boolean(values[i]))
        })
    }
}

/// fmi2GetString: the strings live until the next call of this function.
pub unsafe fn get_string<M: Model>(
    c: Component,
    references: *const ValueReference,
    n: usize,
    values: *mut FmiString,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M>(c, F::fmi2GetString, |instance| {
            let references = known(array(references, n), "vr")?;
            let values = known(array_mut(values, n), "value")?;
            let mut strings = Vec::new(); // not n: the references are checked one by one
            instance.get::<String>(references, |_, text| {
                strings.push(CString::new(text.replace('\0', "")).unwrap_or_default());
            })?;
            instance.strings = strings;
            values
                .iter_mut()
                .zip(&instance.strings)
                .for_each(|(value, text)| *value = text.as_ptr());
            Ok(())
        })
    }
}

/// fmi2SetString
pub unsafe fn set_string<M: Model>(
    c: Component,
    references: *const ValueReference,
    n: usize,
    values: *const FmiString,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M>(c, F::fmi2SetString, |instance| {
            let references = known(array(references, n), "vr")?;
            let values = known(array(values, n), "value")?;
            instance.set::<String>(references, |i| {
                string(values[i]).map(str::to_owned).ok_or(NoValue::Text)
            })
        })
    }
}
