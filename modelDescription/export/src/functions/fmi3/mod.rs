//! The functions of FMI 3.0 whose arguments are its own: sections 2.2, 2.3, 4.2 and 5.2.

mod clocks;
mod lifecycle;
mod steps;
mod variables;

pub use clocks::*;
pub use lifecycle::*;
pub use steps::*;
pub use variables::*;

pub use crate::kind::fmi3 as kind;
