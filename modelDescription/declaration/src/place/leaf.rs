//! Which fields a row can show.

use super::value::{Stored, Value};
use crate::integer::IntegerType;

/// The type of a field that a row can show: a value, or an array of values.
#[diagnostic::on_unimplemented(
    message = "a row cannot show a field of type `{Self}`",
    label = "expected f64, f32, an integer of 8 to 64 bits, bool, String, Vec<u8> or an array of one of them",
    note = "a field without `#[input]`, `#[output]`, `#[parameter]`, `#[calculated]` or `#[local]` is a state and may have any type; a struct of rows is a `#[part]`"
)]
pub trait Leaf {
    /// Its type in the interface.
    type Value: Value;
    /// How many there are.
    const LEN: usize;
    /// From one to the next, bytes.
    const STRIDE: usize;
    /// In what type they are stored.
    const STORED: Stored;
}

macro_rules! leaf {
    ($($field:ty => $value:ty, $stored:expr;)+) => {$(
        impl Leaf for $field {
            type Value = $value;
            const LEN: usize = 1;
            const STRIDE: usize = size_of::<Self>();
            const STORED: Stored = $stored;
        }
    )+};
}

leaf! {
    f64 => f64, Stored::AsIs;
    f32 => f64, Stored::Single;
    i8 => i32, Stored::Integer(IntegerType::Int8);
    u8 => i32, Stored::Integer(IntegerType::UInt8);
    i16 => i32, Stored::Integer(IntegerType::Int16);
    u16 => i32, Stored::Integer(IntegerType::UInt16);
    i32 => i32, Stored::AsIs;
    u32 => i128, Stored::Integer(IntegerType::UInt32);
    i64 => i128, Stored::Integer(IntegerType::Int64);
    u64 => i128, Stored::Integer(IntegerType::UInt64);
    bool => bool, Stored::AsIs;
}

#[cfg(feature = "std")]
leaf! {
    String => String, Stored::AsIs;
    Vec<u8> => Vec<u8>, Stored::AsIs;
}

impl<L: Leaf, const N: usize> Leaf for [L; N] {
    type Value = L::Value;
    const LEN: usize = N * L::LEN;
    const STRIDE: usize = L::STRIDE;
    const STORED: Stored = L::STORED;
}
