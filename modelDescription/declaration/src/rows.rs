//! Macros that write declarations: a row without the derive, and the items of a choice.

/// A Real without the derive: `real!(x, unit::METRE)`, or a vector `real!(tau_a[3], unit::NEWTON_METRE)`.
#[macro_export]
macro_rules! real {
    ($field:ident, $unit:expr) => { $crate::real!(@ stringify!($field), $field, $unit) };
    ($field:ident [$len:literal], $unit:expr) => { $crate::real!(@ concat!(stringify!($field), "[i]"), $field, $unit) };
    (@ $name:expr, $field:ident, $unit:expr) => {
        $crate::Variable::new($name, $crate::Access::Real {
            unit: $unit,
            range: $crate::range::FINITE,
            at: $crate::place::of_field(::core::mem::offset_of!(Self, $field), |m: &Self| &m.$field),
        })
    };
}

/// An [`Enumeration`](crate::Enumeration): its name and what it is, then an item a line with number, name and meaning. Where
/// code asks for an item, a constant comes before its number.
///
/// ```
/// fmu_declaration::choices! { MODE "Mode" "What it does":
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
