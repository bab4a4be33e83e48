//! The types of the two interfaces: which rows each reads and writes, and what one value reference stands for.
//!
//! FMI 2.0 has a value reference for each scalar, FMI 3.0 one for each row, which is that of its first element.

use crate::access::Value;
use crate::slots::At;
use fmu_declaration::{Access, Place, Variable};

/// The value reference of the clock that FMI 3.0's scheduled execution has; it has no row.
pub const CLOCK: u32 = 0xFFFF_FFFE;

/// The value reference of FMI 3.0's independent variable, the time; it has no row.
pub const TIME: u32 = 0xFFFF_FFFF;

/// A type of an interface.
pub trait Kind {
    /// The type of the values in the model.
    type Value: Value;
    /// Name in the standard.
    const NAME: &'static str;
    /// Whether each value reference stands for one value.
    const SCALAR: bool;

    /// Where the row's values are, if the row is of this type.
    fn at<M>(access: &Access<M>) -> Option<&Place<M, Self::Value>>;

    /// The same of a slot; none where this type has no slots.
    fn quick<M>(_: &At<M>) -> Option<&Place<M, Self::Value>> {
        None
    }

    /// Calls `visit(element, i)` for each element that a value reference stands for, where `element` is the one that FMI 2.0
    /// finds, and `first` the number of its value among all of the call, until one gives something.
    #[inline]
    fn visit<M, T>(
        row: &Variable<M>,
        element: usize,
        first: usize,
        mut visit: impl FnMut(usize, usize) -> Option<T>,
    ) -> Option<T> {
        if Self::SCALAR {
            visit(element, first)
        } else {
            (0..row.len).find_map(|element| visit(element, first + element))
        }
    }

    /// How many elements a value reference stands for.
    #[inline]
    fn len<M>(row: &Variable<M>) -> usize {
        if Self::SCALAR { 1 } else { row.len }
    }
}

macro_rules! kind {
    ($(#[$doc:meta])* $name:ident, $standard:literal, scalar $scalar:literal, $value:ty, $row:pat => $at:expr $(, in $slot:ident)?) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Kind for $name {
            type Value = $value;
            const NAME: &'static str = $standard;
            const SCALAR: bool = $scalar;

            #[inline]
            fn at<M>(access: &Access<M>) -> Option<&Place<M, $value>> {
                match access {
                    $row => $at,
                    _ => None,
                }
            }

            $(
                #[inline]
                fn quick<M>(at: &At<M>) -> Option<&Place<M, $value>> {
                    match at {
                        At::$slot(at) => Some(at),
                        _ => None,
                    }
                }
            )?
        }
    };
}

/// The types of FMI 2.0. An enumeration's items are Integers.
#[rustfmt::skip]
pub mod fmi2 {
    use super::{Access, At, Kind, Place};

    kind! { /** fmi2Real */ Real, "Real", scalar true, f64, Access::Real { at, .. } => Some(at), in Real }
    kind! { /** fmi2Integer */ Integer, "Integer", scalar true, i32, Access::Integer { at, .. } | Access::Enumeration { at, .. } => Some(at), in Whole }
    kind! { /** fmi2Boolean */ Boolean, "Boolean", scalar true, bool, Access::Boolean { at } => Some(at), in Flag }
    kind! { /** fmi2String */ Text, "String", scalar true, String, Access::String { at } => Some(at) }
}

/// The types of FMI 3.0. An enumeration's items are Int64; several types have no row.
#[rustfmt::skip]
pub mod fmi3 {
    use super::{Access, Kind, Place};

    kind! { /** fmi3Float64 */ Float64, "Float64", scalar false, f64, Access::Real { at, .. } => Some(at) }
    kind! { /** fmi3Int32 */ Int32, "Int32", scalar false, i32, Access::Integer { at, .. } => Some(at) }
    kind! { /** fmi3Int64, for the items of enumerations */ Enumeration, "Enumeration", scalar false, i32, Access::Enumeration { at, .. } => Some(at) }
    kind! { /** fmi3Boolean */ Boolean, "Boolean", scalar false, bool, Access::Boolean { at } => Some(at) }
    kind! { /** fmi3String */ Text, "String", scalar false, String, Access::String { at } => Some(at) }

    macro_rules! absent {
        ($($name:ident)*) => {$(
            #[doc = concat!("fmi3", stringify!($name), ": no row is of this type.")]
            #[derive(Clone, Copy, Debug)]
            pub struct $name;

            impl Kind for $name {
                type Value = bool; // never read nor written
                const NAME: &'static str = stringify!($name);
                const SCALAR: bool = false;

                fn at<M>(_: &Access<M>) -> Option<&Place<M, bool>> {
                    None
                }
            }
        )*};
    }
    absent! { Float32 Int8 UInt8 Int16 UInt16 UInt32 UInt64 Binary }
}
