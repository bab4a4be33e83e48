//! The macros that write a row: the field's path is the variable's name.

/// Joins a field path (`energy.H`) or takes a literal name.
#[doc(hidden)]
#[macro_export]
macro_rules! row_name {
    ($first:ident $(. $rest:ident)*) => { concat!(stringify!($first) $(, ".", stringify!($rest))*) };
}

/// A Real: `real!(energy.H, unit::JOULE)`, a vector `real!(tau_a[3], unit::NEWTON_METRE)`, or with a name of its own
/// `real!("wall.q" => wall_q, unit::METRE)`, `real!("segment[i].t_on" => t_on[16], unit::SECOND)`.
#[macro_export]
macro_rules! real {
    ($name:literal => $($place:tt)*) => { $crate::real!(@ $name; $($place)*) };
    (@ $name:expr; $($field:ident).+ [$len:literal], $unit:expr) => {
        $crate::Variable::new($name, $len, $crate::Access::Real {
            unit: $unit, min: f64::NEG_INFINITY, max: f64::INFINITY, at: |m: &mut Self| &mut m.$($field).+[..],
        })
    };
    (@ $name:expr; $($field:ident).+, $unit:expr) => {
        $crate::Variable::new($name, 1, $crate::Access::Real {
            unit: $unit, min: f64::NEG_INFINITY, max: f64::INFINITY,
            at: |m: &mut Self| ::core::slice::from_mut(&mut m.$($field).+),
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
    ($name:literal => $($field:ident).+ [$len:literal]) => {
        $crate::Variable::new($name, $len, $crate::Access::Integer {
            min: i32::MIN, max: i32::MAX, at: |m: &mut Self| &mut m.$($field).+[..],
        })
    };
    ($name:literal => $($field:ident).+) => {
        $crate::Variable::new($name, 1, $crate::Access::Integer {
            min: i32::MIN, max: i32::MAX, at: |m: &mut Self| ::core::slice::from_mut(&mut m.$($field).+),
        })
    };
    ($($field:ident).+) => {
        $crate::Variable::new($crate::row_name!($($field).+), 1, $crate::Access::Integer {
            min: i32::MIN, max: i32::MAX, at: |m: &mut Self| ::core::slice::from_mut(&mut m.$($field).+),
        })
    };
}

/// A Boolean: `boolean!(engage)`, or with a name of its own `boolean!("payload.attached" => attached_at_start)`.
#[macro_export]
macro_rules! boolean {
    ($name:literal => $($field:ident).+) => {
        $crate::Variable::new($name, 1, $crate::Access::Boolean {
            at: |m: &mut Self| ::core::slice::from_mut(&mut m.$($field).+),
        })
    };
    ($($field:ident).+) => {
        $crate::Variable::new($crate::row_name!($($field).+), 1, $crate::Access::Boolean {
            at: |m: &mut Self| ::core::slice::from_mut(&mut m.$($field).+),
        })
    };
}

/// A String: `string!(label)`.
#[macro_export]
macro_rules! string {
    ($($field:ident).+) => {
        $crate::Variable::new($crate::row_name!($($field).+), 1, $crate::Access::String {
            at: |m: &mut Self| ::core::slice::from_mut(&mut m.$($field).+),
        })
    };
}

/// One of an enumeration's items, held as its value and declared as an Integer, which every importer can set (see
/// [`typed`](crate::Variable::typed)): `enumeration!(law, &LAW)`, or a vector with a name of its own
/// `enumeration!("segment[i].kind" => segment.kind[16], &KIND)`.
#[macro_export]
macro_rules! enumeration {
    ($name:literal => $($field:ident).+ [$len:literal], $of:expr) => {
        $crate::Variable::new($name, $len, $crate::Access::Enumeration {
            of: $of, declared: $crate::Declared::Integer, at: |m: &mut Self| &mut m.$($field).+[..],
        })
    };
    ($($field:ident).+, $of:expr) => {
        $crate::Variable::new($crate::row_name!($($field).+), 1, $crate::Access::Enumeration {
            of: $of, declared: $crate::Declared::Integer, at: |m: &mut Self| ::core::slice::from_mut(&mut m.$($field).+),
        })
    };
}
