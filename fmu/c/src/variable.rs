//! The variables of the structs, for programs that look them up by name: to record, to replay, to show.

use crate::pointer::{self, Place};
use crate::refusal::{Status, text};
use core::ffi::c_char;
use fmu_declaration::place::Stored;
use fmu_declaration::{Access, Rows, Variable as Row};

/// In which struct a variable lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum Role {
    /// In the parameters.
    Parameter = 0,
    /// In the inputs.
    Input = 1,
    /// In the outputs.
    Output = 2,
}

/// What a variable is in its struct.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum Kind {
    /// An `exo_real`.
    Real = 0,
    /// A `double` in both precisions.
    Double = 1,
    /// An `int32_t`: a count, a choice or a Boolean.
    Integer = 2,
}

/// One variable of a struct.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Variable {
    /// Its name in the FMU, without an index.
    pub name: [c_char; 40],
    /// In which struct it lies.
    pub role: Role,
    /// What it is there.
    pub kind: Kind,
    /// How many elements it has.
    pub count: i32,
    /// The first element, bytes from the begin of the struct.
    pub offset: usize,
    /// From one element to the next, bytes.
    pub stride: usize,
}

/// Writes the description of variable `i` of the three structs.
pub(crate) fn describe<P: Rows, I: Rows, O: Rows>(i: usize, variable: *mut Variable) -> Status {
    let found = nth(i, P::ROWS, Role::Parameter)
        .or_else(|| nth(i.checked_sub(P::ROWS.len())?, I::ROWS, Role::Input))
        .or_else(|| {
            nth(
                i.checked_sub(P::ROWS.len() + I::ROWS.len())?,
                O::ROWS,
                Role::Output,
            )
        });
    pointer::status(Place::at(variable).and_then(|place| {
        place.write(found.ok_or(Status::NoSuchVariable)?);
        Ok(())
    }))
}

fn nth<S>(i: usize, rows: &[Row<S>], role: Role) -> Option<Variable> {
    let row = rows.get(i)?;
    let (kind, (offset, stride, _)) = match &row.access {
        Access::Real { at, .. } => {
            let is_real = matches!(at.layout().2, Stored::Single) == cfg!(feature = "f32");
            let kind = if is_real { Kind::Real } else { Kind::Double };
            (kind, at.layout())
        }
        Access::Integer { at, .. } | Access::Enumeration { at, .. } => (Kind::Integer, at.layout()),
        Access::Boolean { at } => (Kind::Integer, at.layout()),
        #[allow(
            unreachable_patterns,
            reason = "the feature `std` of the rows has strings, which no struct here has"
        )]
        _ => return None,
    };
    Some(Variable {
        name: text(row.base_name()),
        role,
        kind,
        count: i32::try_from(row.len).unwrap_or(i32::MAX),
        offset,
        stride,
    })
}
