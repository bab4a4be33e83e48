//! The types of the two interfaces: which rows each reads and writes, and what one value reference stands for.
//!
//! FMI 2.0 has a value reference for each scalar, FMI 3.0 one for each row, which is that of its first element.

use crate::routes::{Both, Routes};
use crate::slots::At;
use crate::value::Value;
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

    /// Whether the row is of this type.
    #[inline(always)]
    fn is<M>(access: &Access<M>) -> bool {
        Self::at(access).is_some()
    }

    /// Where the row's values are, if the row is of this type.
    fn at<M>(access: &Access<M>) -> Option<Place<M, Self::Value>>;

    /// A time (s) as a value, if this is the type for times.
    fn of_time(_: f64) -> Option<Self::Value> {
        None
    }

    /// The lists of this type that are known; none where none are remembered.
    fn routes<M>(_: &Routes<M>) -> Option<&Both<M, Self::Value>> {
        None
    }

    /// The same, to learn more.
    fn routes_mut<M>(_: &mut Routes<M>) -> Option<&mut Both<M, Self::Value>> {
        None
    }

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

/// A type whose values are numbers in C, too.
pub trait Number: Kind {
    /// C's type.
    type C: Copy;

    /// A value of a row of this type, as C has it.
    fn give(value: Self::Value) -> Self::C;

    /// What C has given.
    fn take(given: Self::C) -> Self::Value;
}

macro_rules! kind {
    ($(#[$doc:meta])* $name:ident, $standard:expr, scalar $scalar:literal, $value:ty, $row:pat $(if $guard:expr)? => $at:expr $(, in $slot:ident)? $(, by $routes:ident)? $(; $of_time:item)?) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Kind for $name {
            type Value = $value;
            const NAME: &'static str = $standard;
            const SCALAR: bool = $scalar;

            #[inline(always)]
            fn at<M>(access: &Access<M>) -> Option<Place<M, $value>> {
                match access {
                    $row $(if $guard)? => Some($at),
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

            $(
                #[inline]
                fn routes<M>(routes: &Routes<M>) -> Option<&Both<M, $value>> {
                    Some(&routes.$routes)
                }

                #[inline]
                fn routes_mut<M>(routes: &mut Routes<M>) -> Option<&mut Both<M, $value>> {
                    Some(&mut routes.$routes)
                }
            )?

            $($of_time)?
        }
    };
}

macro_rules! number {
    ($($name:ident: $value:ty, $c:ty;)*) => {$(
        impl Number for $name {
            type C = $c;

            #[inline]
            fn give(value: $value) -> $c {
                value as $c // exact: the row's field is of this type
            }

            #[inline]
            fn take(given: $c) -> $value {
                given.into()
            }
        }
    )*};
}

/// The types of FMI 2.0. An enumeration's items are Integers, and single precision is Real.
#[rustfmt::skip]
pub mod fmi2 {
    use super::{Access, At, Both, Kind, Number, Place, Routes};

    kind! { /** fmi2Real */ Real, "Real", scalar true, f64, Access::Real { at, .. } => *at, in Real, by reals }
    kind! { /** fmi2Integer */ Integer, "Integer", scalar true, i32, Access::Integer { at, .. } | Access::Enumeration { at, .. } => *at, in Whole, by wholes }
    kind! { /** fmi2Boolean */ Boolean, "Boolean", scalar true, bool, Access::Boolean { at } => *at, in Flag, by flags }
    kind! { /** fmi2String */ Text, "String", scalar true, String, Access::String { at } => *at }

    number! {
        Real: f64, f64;
        Integer: i32, i32;
    }
}

/// The types of FMI 3.0. An enumeration's items are Int64.
#[rustfmt::skip]
pub mod fmi3 {
    use super::{Access, Both, Kind, Number, Place, Routes};
    use fmu_declaration::IntegerType;

    kind! {
        /** fmi3Float64 */ Float64, "Float64", scalar false, f64, Access::Real { at, .. } if !at.is_single() => *at, by reals;
        fn of_time(time: f64) -> Option<f64> { Some(time) }
    }
    kind! { /** fmi3Float32 */ Float32, "Float32", scalar false, f64, Access::Real { at, .. } if at.is_single() => *at }
    kind! { /** fmi3Boolean */ Boolean, "Boolean", scalar false, bool, Access::Boolean { at } => *at, by flags }
    kind! { /** fmi3String */ Text, "String", scalar false, String, Access::String { at } => *at }
    kind! { /** fmi3Binary */ Binary, "Binary", scalar false, Vec<u8>, Access::Binary { at, .. } => *at }

    macro_rules! integer {
        ($($name:ident in $access:ident: $value:ty, $c:ty;)*) => {$(
            kind! {
                #[doc = concat!("fmi3", stringify!($name))]
                $name, stringify!($name), scalar false, $value,
                Access::$access { at, .. } if at.integer_type() == IntegerType::$name => *at
            }
            number! { $name: $value, $c; }
        )*};
    }
    integer! {
        Int8 in Integer: i32, i8;
        UInt8 in Integer: i32, u8;
        Int16 in Integer: i32, i16;
        UInt16 in Integer: i32, u16;
        Int32 in Integer: i32, i32;
        UInt32 in Wide: i128, u32;
        UInt64 in Wide: i128, u64;
    }
    number! {
        Float64: f64, f64;
        Float32: f64, f32;
        Int64: i128, i64;
    }

    /// fmi3Int64, and the items of enumerations
    #[derive(Clone, Copy, Debug)]
    pub struct Int64;

    impl Kind for Int64 {
        type Value = i128;
        const NAME: &'static str = "Int64";
        const SCALAR: bool = false;

        #[inline]
        fn at<M>(access: &Access<M>) -> Option<Place<M, i128>> {
            match access {
                Access::Enumeration { at, .. } => Some(at.widened()),
                Access::Wide { at, .. } if at.integer_type() == IntegerType::Int64 => Some(*at),
                _ => None,
            }
        }
    }
}
