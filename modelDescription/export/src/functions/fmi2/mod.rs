//! The functions of FMI 2.0 whose arguments are its own: sections 2.1 and 4.2.

mod lifecycle;
mod status;
mod variables;

pub use lifecycle::*;
pub use status::*;
pub use variables::*;

pub use crate::kind::fmi2 as kind;
