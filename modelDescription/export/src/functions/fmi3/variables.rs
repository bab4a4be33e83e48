//! Variables by value reference: section 2.2.6. A value reference stands for all elements of its row.

use crate::failure::Failure;
use crate::ffi::fmi3::*;
use crate::ffi::{array, array_mut, string};
use crate::functions::known;
use crate::guard::guard;
use crate::instance::{Instance, refused};
use crate::kind::{Kind, Number, fmi3 as kind};
use crate::legality::fmi3::Function as F;
use crate::model::Model;
use crate::value::{NoBytes, NoText, boolean};
use std::convert::Infallible;
use std::ffi::CString;

/// The references, once it is sure that the importer's array of values is as long as their variables' sizes add up to.
///
/// # Safety
/// As for [`array`].
unsafe fn references<'a, M: Model, K: Kind>(
    instance: &Instance<M>,
    references: *const ValueReference,
    n: usize,
    n_values: usize,
) -> Result<&'a [ValueReference], Failure> {
    // SAFETY: this function's contract.
    let references = known(unsafe { array(references, n) }, "valueReferences")?;
    if instance.is_known::<K>(references, n_values) {
        return Ok(references);
    }
    let count = instance.count::<K>(references)?;
    if n_values != count {
        return refused(format!(
            "nValues = {n_values}, expected {count}, the sum of the variables' sizes"
        ));
    }
    Ok(references)
}

/// fmi3GetFloat32 to fmi3GetUInt64: numbers of kind `K`.
pub unsafe fn get<M: Model, K: Number>(
    c: Component,
    function: F,
    vr: *const ValueReference,
    n: usize,
    values: *mut K::C,
    n_values: usize,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M, _>(c, function, |instance| {
            let vr = references::<M, K>(instance, vr, n, n_values)?;
            let values = known(array_mut(values, n_values), "values")?;
            instance.get_all::<K, _>(vr, values, K::give)
        })
    }
}

/// fmi3SetFloat32 to fmi3SetUInt64: numbers of kind `K`.
pub unsafe fn set<M: Model, K: Number>(
    c: Component,
    function: F,
    vr: *const ValueReference,
    n: usize,
    values: *const K::C,
    n_values: usize,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M, _>(c, function, |instance| {
            let vr = references::<M, K>(instance, vr, n, n_values)?;
            let values = known(array(values, n_values), "values")?;
            instance.set_all::<K, _, Infallible>(vr, values, |value| Ok(K::take(value)))
        })
    }
}

/// fmi3GetBoolean: bytes 0 and 1.
pub unsafe fn get_boolean<M: Model>(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *mut Boolean,
    n_values: usize,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M, _>(c, F::fmi3GetBoolean, |instance| {
            let vr = references::<M, kind::Boolean>(instance, vr, n, n_values)?;
            let values = known(array_mut(values, n_values), "values")?;
            instance.get_all::<kind::Boolean, _>(vr, values, Boolean::from)
        })
    }
}

/// fmi3SetBoolean: bytes 0 and 1; any other is refused.
pub unsafe fn set_boolean<M: Model>(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *const Boolean,
    n_values: usize,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M, _>(c, F::fmi3SetBoolean, |instance| {
            let vr = references::<M, kind::Boolean>(instance, vr, n, n_values)?;
            let values = known(array(values, n_values), "values")?;
            instance.set_all::<kind::Boolean, _, _>(vr, values, |value| boolean(value.into()))
        })
    }
}

/// fmi3GetString: the strings live until the next call of this function.
pub unsafe fn get_string<M: Model>(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *mut FmiString,
    n_values: usize,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M, _>(c, F::fmi3GetString, |instance| {
            let vr = references::<M, kind::Text>(instance, vr, n, n_values)?;
            let values = known(array_mut(values, n_values), "values")?;
            let mut strings = Vec::with_capacity(n_values);
            instance.get::<kind::Text>(vr, |_, text| {
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

/// fmi3SetString
pub unsafe fn set_string<M: Model>(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *const FmiString,
    n_values: usize,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M, _>(c, F::fmi3SetString, |instance| {
            let vr = references::<M, kind::Text>(instance, vr, n, n_values)?;
            let values = known(array(values, n_values), "values")?;
            instance
                .set::<kind::Text, _>(vr, |i| string(values[i]).map(str::to_owned).ok_or(NoText))
        })
    }
}

/// fmi3GetBinary: the bytes live until the next call of this function.
pub unsafe fn get_binary<M: Model>(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    sizes: *mut usize,
    values: *mut Binary,
    n_values: usize,
) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M, _>(c, F::fmi3GetBinary, |instance| {
            let vr = references::<M, kind::Binary>(instance, vr, n, n_values)?;
            let sizes = known(array_mut(sizes, n_values), "valueSizes")?;
            let values = known(array_mut(values, n_values), "values")?;
            let mut binaries = Vec::with_capacity(n_values);
            instance.get::<kind::Binary>(vr, |_, bytes| binaries.push(bytes))?;
            instance.binaries = binaries;
            for ((size, value), bytes) in sizes.iter_mut().zip(values).zip(&instance.binaries) {
                *size = bytes.len();
                // No bytes have an address, too, so that importers may copy from it.
                *value = if bytes.is_empty() {
                    NO_BYTES.as_ptr()
                } else {
                    bytes.as_ptr()
                };
            }
            Ok(())
        })
    }
}

/// Where a Binary without bytes lies.
static NO_BYTES: [Byte; 1] = [0];

/// fmi3SetBinary: the bytes are copied; the address of none may be null.
pub unsafe fn set_binary<M: Model>(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    sizes: *const usize,
    values: *const Binary,
    n_values: usize,
) -> Status {
    // SAFETY: the importer's contract, also for each of its binaries.
    unsafe {
        guard::<M, _>(c, F::fmi3SetBinary, |instance| {
            let vr = references::<M, kind::Binary>(instance, vr, n, n_values)?;
            let sizes = known(array(sizes, n_values), "valueSizes")?;
            let values = known(array(values, n_values), "values")?;
            instance.set::<kind::Binary, _>(vr, |i| {
                let bytes = array(values[i], sizes[i]).map(<[Byte]>::to_vec);
                bytes.ok_or(NoBytes(sizes[i]))
            })
        })
    }
}
