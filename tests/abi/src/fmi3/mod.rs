//! The same libraries through the functions of FMI 3.0.
//!
//! | module | what |
//! |---|---|
//! | [`types`] | C types |
//! | [`library`] | the 75 functions of a shared library |
//! | [`fmu`] | a built FMU with its rows: what one value reference of FMI 3.0 stands for |
//! | `every_type` | the test model that FMI 2.0 cannot show |
//! | [`instance`] | one instance, co-simulation or scheduled execution |
//! | [`standard`] | what the standard's state descriptions allow, and the deviations |
//! | [`calls`] | every function with good arguments |
//! | [`mirror`] | random calls, each made on an instance of FMI 2.0 too |

pub mod calls;
mod every_type;
pub mod fmu;
pub mod instance;
pub mod library;
pub mod mirror;
pub mod standard;
pub mod types;

pub use fmu::{Fmu, Row, Type, Value};
pub use instance::{Instance, Interface, Setup};
pub use library::Library;
