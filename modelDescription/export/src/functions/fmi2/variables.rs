//! Variables by value reference: section 2.1.7.

use crate::ffi::fmi2::*;
use crate::ffi::{array, array_mut, string};
use crate::functions::known;
use crate::guard::guard;
use crate::kind::{Number, fmi2 as kind};
use crate::legality::fmi2::Function as F;
use crate::model::Model;
use crate::value::{NoText, boolean};
use std::convert::Infallible;
use std::ffi::CString;

/// fmi2GetReal, fmi2GetInteger: values of kind `K` as they are.
pub unsafe fn get<M: Model, K: Number>(
    c: Component,
    function: F,
    references: *const ValueReference,
    n: usize,
    values: *mut K::C,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M, _>(c, function, |instance| {
            let references = known(array(references, n), "vr")?;
            let values = known(array_mut(values, n), "value")?;
            instance.get_all::<K, _>(references, values, K::give)
        })
    }
}

/// fmi2SetReal, fmi2SetInteger: values of kind `K` as they are.
pub unsafe fn set<M: Model, K: Number>(
    c: Component,
    function: F,
    references: *const ValueReference,
    n: usize,
    values: *const K::C,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M, _>(c, function, |instance| {
            let references = known(array(references, n), "vr")?;
            let values = known(array(values, n), "value")?;
            instance.set_all::<K, _, Infallible>(references, values, |value| Ok(K::take(value)))
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
        guard::<M, _>(c, F::fmi2GetBoolean, |instance| {
            let references = known(array(references, n), "vr")?;
            let values = known(array_mut(values, n), "value")?;
            instance.get_all::<kind::Boolean, _>(references, values, Boolean::from)
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
        guard::<M, _>(c, F::fmi2SetBoolean, |instance| {
            let references = known(array(references, n), "vr")?;
            let values = known(array(values, n), "value")?;
            instance.set_all::<kind::Boolean, _, _>(references, values, boolean)
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
        guard::<M, _>(c, F::fmi2GetString, |instance| {
            let references = known(array(references, n), "vr")?;
            let values = known(array_mut(values, n), "value")?;
            let mut strings = Vec::new(); // not n: the references are checked one by one
            instance.get::<kind::Text>(references, |_, text| {
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
        guard::<M, _>(c, F::fmi2SetString, |instance| {
            let references = known(array(references, n), "vr")?;
            let values = known(array(values, n), "value")?;
            instance.set::<kind::Text, _>(references, |i| {
                string(values[i]).map(str::to_owned).ok_or(NoText)
            })
        })
    }
}
