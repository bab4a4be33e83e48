//! Arrays of any length as a part of a state: serde's own end at 32 elements. As bytes they are the same.
//!
//! [`interface`](macro@crate::interface) and [`group`](macro@crate::group) write `#[serde(with = "fmu_export::arrays")]` at fields that are
//! longer arrays. The elements are of any type that serde knows.

use serde::de::{Error, SeqAccess, Visitor};
use serde::ser::SerializeTuple;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::marker::PhantomData;

/// Writes the elements, one after the other.
///
/// # Errors
/// Those of the serializer.
pub fn serialize<T: Serialize, S: Serializer, const LEN: usize>(
    array: &[T; LEN],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let mut tuple = serializer.serialize_tuple(LEN)?;
    for element in array {
        tuple.serialize_element(element)?;
    }
    tuple.end()
}

/// Reads them.
///
/// # Errors
/// Those of the deserializer, and where there are fewer than `LEN` elements.
pub fn deserialize<'de, T: Deserialize<'de>, D: Deserializer<'de>, const LEN: usize>(
    deserializer: D,
) -> Result<[T; LEN], D::Error> {
    deserializer.deserialize_tuple(LEN, Elements(PhantomData))
}

struct Elements<T, const LEN: usize>(PhantomData<T>);

impl<'de, T: Deserialize<'de>, const LEN: usize> Visitor<'de> for Elements<T, LEN> {
    type Value = [T; LEN];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{LEN} elements")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<[T; LEN], A::Error> {
        // Not LEN: bytes that are cut off soon end.
        let mut elements = Vec::new();
        while elements.len() < LEN {
            match sequence.next_element()? {
                Some(element) => elements.push(element),
                None => return Err(A::Error::invalid_length(elements.len(), &self)),
            }
        }
        let found = elements.len();
        elements
            .try_into()
            .map_err(|_| A::Error::custom(format_args!("{found} elements, expected {LEN}")))
    }
}
