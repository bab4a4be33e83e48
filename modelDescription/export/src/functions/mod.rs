//! The C functions, generic over the model; [`export!`](crate::export) gives them their names.
//!
//! Every function here has the importer's contract of the standard as its safety contract: pointers are null or valid
//! for what the standard says is read or written through them, a component is used by one thread at a time, and not
//! after it was freed.
#![allow(
    clippy::missing_safety_doc,
    clippy::too_many_arguments,
    reason = "one safety contract for all, stated above; the signatures are the standard's"
)]

mod lifecycle;
mod states;
mod status;
mod variables;

pub use lifecycle::*;
pub use states::*;
pub use status::*;
pub use variables::*;

use crate::failure::Failure;
use crate::instance::refused;

/// An argument that must be there.
fn known<T>(argument: Option<T>, name: &str) -> Result<T, Failure> {
    argument.map_or_else(|| refused(format!("{name} is null or unknown")), Ok)
}
