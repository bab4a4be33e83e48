//! Rows of a struct, of its parts and of its arrays of parts: one list, by number, made at compile time.

use crate::variable::{Access, IN_ORDER, Variable};

/// A struct whose fields are rows. Derived: see [`Rows`](macro@crate::Rows).
///
/// What cannot be is no row; the compiler says so:
///
/// ```compile_fail
/// #[derive(fmu_declaration::Rows)]
/// struct Twice {
///     /// One.
///     #[input(3)]
///     one: f64,
///     /// Another one, with the number of the first.
///     #[input(3)]
///     other: f64,
/// }
/// const ROWS: usize = <Twice as fmu_declaration::Rows>::ROWS.len();
/// ```
///
/// ```compile_fail
/// #[derive(fmu_declaration::Rows)]
/// struct Unknown {
///     /// No such key.
///     #[parameter(0, units = METRE)]
///     x: f64,
/// }
/// ```
///
/// ```compile_fail
/// #[derive(fmu_declaration::Rows)]
/// struct Foreign {
///     /// No type of the interface.
///     #[parameter(0)]
///     x: u128,
/// }
/// ```
///
/// ```compile_fail
/// #[derive(fmu_declaration::Rows)]
/// struct Beyond {
///     /// No u8 is 256.
///     #[parameter(0, integers = 0..=256)]
///     x: u8,
/// }
/// ```
///
/// ```compile_fail
/// #[derive(fmu_declaration::Rows)]
/// struct Beyond {
///     /// No f32 is 1e39.
///     #[parameter(0, range = 0.0..=1e39)]
///     x: f32,
/// }
/// const ROWS: usize = <Beyond as fmu_declaration::Rows>::ROWS.len();
/// ```
///
/// ```compile_fail
/// #[derive(fmu_declaration::Rows)]
/// struct Misplaced {
///     /// Integers have no unit.
///     #[parameter(0, unit = METRE)]
///     x: u8,
/// }
/// ```
///
/// ```compile_fail
/// #[derive(fmu_declaration::Rows)]
/// struct Inner {
///     /// There.
///     #[input(0)]
///     x: f64,
/// }
/// #[derive(fmu_declaration::Rows)]
/// struct Outer {
///     #[part(about = [("y", "not there")])]
///     inner: Inner,
/// }
/// const ROWS: usize = <Outer as fmu_declaration::Rows>::ROWS.len();
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no rows",
    label = "a `#[part]` is a struct with rows",
    note = "write `#[group]` above it, or derive `Rows` and `Start`"
)]
pub trait Rows: Sized + 'static {
    /// The rows, by number.
    const ROWS: &'static [Variable<Self>];
}

/// How the rows of a part stand in the whole.
#[derive(Clone, Copy)]
pub struct Part {
    /// Where the part lies, bytes from the begin of the whole.
    pub offset: usize,
    /// How many there are: more than one for an array of parts, whose rows then are vectors.
    pub each: usize,
    /// What is added to the rows' numbers.
    pub from: u32,
    /// What comes before the rows' names.
    pub prefix: &'static str,
    /// What some rows are in this whole, by their names: their descriptions here.
    pub about: &'static [(&'static str, &'static str)],
}

/// Writes `rows` of the struct `S`, a part of `M`, into `all` from position `n` on; returns the position after the last.
///
/// # Panics
/// When the part describes a row that is not there (at compile time: rows are constants).
#[doc(hidden)]
pub const fn lifted<M, S>(
    all: &mut [Variable<M>],
    mut n: usize,
    rows: &[Variable<S>],
    part: Part,
) -> usize {
    let (mut i, mut described) = (0, 0);
    while i < rows.len() {
        all[n] = in_whole(&rows[i], part);
        let mut k = 0;
        while k < part.about.len() {
            let (name, about) = part.about[k];
            if equal(name, rows[i].name) {
                all[n].about = about;
                described += 1;
            }
            k += 1;
        }
        n += 1;
        i += 1;
    }
    assert!(
        described == part.about.len(),
        "about names a row that is not there"
    );
    n
}

/// Whether two texts are equal, also in a constant.
pub const fn equal(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut i = 0;
    while i < a.len() && i < b.len() && a[i] == b[i] {
        i += 1;
    }
    i == a.len() && i == b.len()
}

const fn in_whole<M, S>(row: &Variable<S>, part: Part) -> Variable<M> {
    macro_rules! place {
        ($at:expr) => {
            if part.each > 1 {
                $at.each(part.each)
            } else {
                *$at
            }
            .within(part.offset)
        };
    }
    let access = match &row.access {
        Access::Real { unit, range, at } => Access::Real {
            unit: *unit,
            range: *range,
            at: place!(at),
        },
        Access::Integer { min, max, at } => Access::Integer {
            min: *min,
            max: *max,
            at: place!(at),
        },
        Access::Wide { min, max, at } => Access::Wide {
            min: *min,
            max: *max,
            at: place!(at),
        },
        Access::Boolean { at } => Access::Boolean { at: place!(at) },
        #[cfg(feature = "std")]
        Access::String { at } => Access::String { at: place!(at) },
        #[cfg(feature = "std")]
        Access::Binary {
            mime_type,
            max_size,
            at,
        } => Access::Binary {
            mime_type,
            max_size: *max_size,
            at: place!(at),
        },
        Access::Enumeration { of, declared, at } => Access::Enumeration {
            of,
            declared: *declared,
            at: place!(at),
        },
    };
    let whole = Variable::new(row.name, access);
    Variable {
        number: row.number + part.from,
        prefix: if part.prefix.is_empty() {
            row.prefix
        } else {
            part.prefix
        },
        causality: row.causality,
        variability: row.variability,
        initially_from: row.initially_from,
        may_be_nan: row.may_be_nan,
        about: row.about,
        ..whole
    }
}

/// The rows as they are written, with their places as numbers.
#[doc(hidden)]
pub const fn in_order<M, const N: usize>(mut rows: [Variable<M>; N]) -> [Variable<M>; N] {
    let mut i = 0;
    while i < N {
        rows[i].number = i as u32;
        i += 1;
    }
    rows
}

/// The rows in ascending order of their numbers.
///
/// # Panics
/// When two rows have one number (at compile time: rows are constants).
#[doc(hidden)]
pub const fn sorted<M, const N: usize>(mut rows: [Variable<M>; N]) -> [Variable<M>; N] {
    let mut i = 1;
    while i < N {
        let mut j = i;
        while j > 0 && rows[j - 1].number > rows[j].number {
            let later = rows[j - 1];
            rows[j - 1] = rows[j];
            rows[j] = later;
            j -= 1;
        }
        i += 1;
    }
    let mut i = 1;
    while i < N {
        assert!(
            rows[i - 1].number < rows[i].number,
            "two rows have one number"
        );
        assert!(rows[i].number < IN_ORDER, "a row has no number");
        i += 1;
    }
    rows
}
