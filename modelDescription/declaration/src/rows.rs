//! The macros that write a row: the field's path is the variable's name.

/// Joins a field path (`energy.H`) or takes a literal name.
#[doc(hidden)]
#[macro_export]
macro_rules! row_name {
    ($first:ident $(. $rest:ident)*) => { concat!(stringify!($first) $(, ".", stringify!($rest))*) };
}

/// The place of a field path in `Self`.
#[doc(hidden)]
#[macro_export]
macro_rules! row_place {
    ($($field:ident).+) => {
        $crate::place::of_field(::core::mem::offset_of!(Self, $($field).+), |m: &Self| &m.$($field).+)
    };
    ($($field:ident).+ [$len:literal]) => {
        $crate::place::of_field::<Self, [_; $len]>(::core::mem::offset_of!(Self, $($field).+), |m: &Self| &m.$($field).+)
    };
}

/// A Real: `real!(energy.H, unit::JOULE)`, a vector `real!(tau_a[3], unit::NEWTON_METRE)`, or with a name of its own
/// `real!("wall.q" => wall_q, unit::METRE)`, `real!("segment[i].t_on" => t_on[16], unit::SECOND)`.
#[macro_export]
macro_rules! real {
    ($name:literal => $($place:tt)*) => { $crate::real!(@ $name; $($place)*) };
    (@ $name:expr; $($field:ident).+ $([$len:literal])?, $unit:expr) => {
        $crate::Variable::new($name, $crate::Access::Real {
            unit: $unit, range: $crate::range::FINITE, at: $crate::row_place!($($field).+ $([$len])?),
        })
    };
    ($($field:ident).+ [$len:literal], $unit:expr) => {
        $crate::real!(@ concat!($crate::row_name!($($field).+), "[i]"); $($field).+ [$len], $unit)
    };
    ($($field:ident).+, $unit:expr) => { $crate::real!(@ $crate::row_name!($($field).+); $($field).+, $unit) };
}

/// An Integer: `integer!(tick)`, or with a name of its own `integer!("delay" => delay_ticks)`, also a vector
/// `integer!("segment[i].axis" => segment.axis[16])`.
#[macro_export]
macro_rules! integer {
    ($name:literal => $($field:ident).+ $([$len:literal])?) => {
        $crate::Variable::new($name, $crate::Access::Integer {
            min: i32::MIN, max: i32::MAX, at: $crate::row_place!($($field).+ $([$len])?),
        })
    };
    ($($field:ident).+) => {
        $crate::Variable::new($crate::row_name!($($field).+), $crate::Access::Integer {
            min: i32::MIN, max: i32::MAX, at: $crate::row_place!($($field).+),
        })
    };
}

/// A Boolean: `boolean!(engage)`, or with a name of its own `boolean!("payload.attached" => attached_at_start)`.
#[macro_export]
macro_rules! boolean {
    ($name:literal => $($field:ident).+) => {
        $crate::Variable::new($name, $crate::Access::Boolean { at: $crate::row_place!($($field).+) })
    };
    ($($field:ident).+) => {
        $crate::Variable::new($crate::row_name!($($field).+), $crate::Access::Boolean { at: $crate::row_place!($($field).+) })
    };
}

/// A String: `string!(label)`.
#[macro_export]
macro_rules! string {
    ($($field:ident).+) => {
        $crate::Variable::new($crate::row_name!($($field).+), $crate::Access::String { at: $crate::row_place!($($field).+) })
    };
}

/// One of an enumeration's items, held as its value and declared as an Integer, which every importer can set (see
/// [`typed`](crate::Variable::typed)): `enumeration!(law, &LAW)`, or a vector with a name of its own
/// `enumeration!("segment[i].kind" => segment.kind[16], &KIND)`.
#[macro_export]
macro_rules! enumeration {
    ($name:literal => $($field:ident).+ $([$len:literal])?, $of:expr) => {
        $crate::Variable::new($name, $crate::Access::Enumeration {
            of: $of, declared: $crate::Declared::Integer, at: $crate::row_place!($($field).+ $([$len])?),
        })
    };
    ($($field:ident).+, $of:expr) => {
        $crate::Variable::new($crate::row_name!($($field).+), $crate::Access::Enumeration {
            of: $of, declared: $crate::Declared::Integer, at: $crate::row_place!($($field).+),
        })
    };
}

/// An [`Enumeration`](crate::Enumeration): its name and what it is, then an item a line with number, name and meaning. Where
/// code asks for an item, a constant comes before its number.
///
/// ```
/// declaration::choices! { MODE "Mode" "What it does":
///     IDLE = 1 "idle" "nothing";
///     4 "busy" "something";
/// }
/// assert_eq!((MODE.items[0].value, MODE.items[1].name), (IDLE, "busy"));
/// ```
#[macro_export]
macro_rules! choices {
    ($ENUMERATION:ident $type_name:literal $type_about:literal:
     $($($ITEM:ident =)? $value:literal $name:literal $about:literal;)*) => {
        $($(
            #[doc = $about]
            pub const $ITEM: i32 = $value;
        )?)*

        #[doc = $type_about]
        pub const $ENUMERATION: $crate::Enumeration = $crate::Enumeration {
            name: $type_name,
            about: $type_about,
            items: &[$($crate::Item::new($value, $name, $about)),*],
        };
    };
}
