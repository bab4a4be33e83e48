//! The C functions, generic over the model; [`export!`](crate::export) gives them their names.
//!
//! Here is what both versions of the standard have with the same arguments; [`fmi2`] and [`fmi3`] have the rest.
//!
//! Every function here has the importer's contract of the standard as its safety contract: pointers are null or valid
//! for what the standard says is read or written through them, a component is used by one thread at a time, and not
//! after it was freed.
#![allow(
    clippy::missing_safety_doc,
    clippy::too_many_arguments,
    reason = "one safety contract for all, stated above; the signatures are the standard's"
)]

pub mod fmi2;
pub mod fmi3;
mod lifecycle;
mod states;
mod steps;

pub use lifecycle::*;
pub use states::*;
pub use steps::*;

use crate::failure::Failure;
use crate::ffi::{Component, Status};
use crate::guard::guard;
use crate::instance::refused;
use crate::legality::Call;
use crate::model::Model;

/// An argument that must be there.
fn known<T>(argument: Option<T>, name: &str) -> Result<T, Failure> {
    argument.map_or_else(|| refused(format!("{name} is null or unknown")), Ok)
}

/// A function of an optional capability that the XML does not claim: always refused.
pub unsafe fn unsupported<M: Model>(c: Component, function: impl Call, capability: &str) -> Status {
    // SAFETY: the importer's contract.
    unsafe {
        guard::<M, _>(c, function, |_| {
            refused(format!(
                "not supported ({capability} in modelDescription.xml)"
            ))
        })
    }
}
