//! Declarations that were written as bytes, read back. What a declaration refers to lives as long as the program, as its
//! constants do; so does what is read: a program reads a few declarations, once.

use crate::{Enumeration, Item};
use serde::{Deserialize, Deserializer};

/// The items of an enumeration.
///
/// # Errors
/// When the bytes are none.
pub(crate) fn items<'de: 'static, D: Deserializer<'de>>(
    from: D,
) -> Result<&'static [Item], D::Error> {
    Ok(Vec::<Item>::deserialize(from)?.leak())
}

/// An enumeration, for `#[serde(deserialize_with = "…")]`.
///
/// # Errors
/// When the bytes are none.
pub fn enumeration<'de: 'static, D: Deserializer<'de>>(
    from: D,
) -> Result<&'static Enumeration, D::Error> {
    Ok(Box::leak(Box::new(Enumeration::deserialize(from)?)))
}
