//! The C interfaces of any model: FMI 2.0 co-simulation, FMI 3.0 co-simulation and scheduled execution.
//!
//! A model is a struct whose fields are its variables ([`interface`](macro@interface), [`declaration`]) and which can be initialized and
//! stepped ([`Model`]). [`export!`] turns it into the 34 C functions of FMI 2.0 and the 75 of FMI 3.0. This crate knows no robot; the
//! smallest model, an integrator, is in `examples/integrator.rs`.
//!
//! The life of a call, for every function alike:
//! 1. the C function ([`export!`], module [`functions`]) hands over to the guard with its name and a closure;
//! 2. the guard ([`guard`]) checks the component, looks the function up in the legality table ([`legality`]) for the
//!    instance's current phase, runs the closure with panics caught, logs a refusal and returns the status;
//! 3. the closure is a method of [`instance::Instance`], which checks arguments, then changes the instance.
//!
//! What errors mean. A *refused call* (argument, order, value, bytes) returns `fmi2Error`, changes nothing and leaves
//! the instance in the phase it was in. A caught panic or a failed model step returns `fmi2Error` too and enters the
//! error phase, which only `fmi2Reset`, `fmi2SetFMUstate` and `fmi2FreeInstance` leave. `fmi2Warning`,
//! `fmi2Discard`, `fmi2Pending` and `fmi2Fatal` are never returned. FMI 3.0 has the same under its own names; its state
//! after an error is *Terminated*.
//!
//! An instance knows no version. The functions of the two differ where their arguments do ([`functions`]); FMI 3.0 reads and
//! writes all elements of a row at once. A state saved by one version goes on by the other.
//!
//! | module | what | FMI 2.0.5 |
//! |---|---|---|
//! | [`model`] | what a model must offer | |
//! | [`clock`] | the time of an instance: which step can follow, and the sum of the steps | 4.2.1 |
//! | [`time`] | communication steps, ticks, substeps | 4.2.1 |
//! | [`log`] | messages by category | 2.1.5 |
//! | [`ffi`] | C types and callbacks, for each version | 2.1.2, 2.1.5 |
//! | [`legality`] | which call is legal in which phase, one table for each version | 4.2.4 |
//! | [`failure`] | refused or broken: what a call may come back with | 2.1.3 |
//! | [`guard`] | null, phase, panic, log, status | 2.1.3 |
//! | [`instance`] | one instance: life cycle, variables, steps | 2.1.6, 2.1.7, 4.2.2 |
//! | [`access`] | Get and Set by value reference | 2.1.7 |
//! | `value` | what a row demands of a value | 2.1.7 |
//! | `outputs` | nothing but finite numbers leaves a model | |
//! | [`provenance`] | version and git hash, which every model has | |
//! | `interface` | what `cargo fmu` reads, in a build for it alone | |
//! | [`arrays`] | arrays of any length as a part of a state | |
//! | [`snapshot`] | FMU state as bytes with a checked format | 2.1.8 |
//! | `stop` | the stop time, and which step leads past it | 2.1.6 |
//! | [`resource`] | `fmuResourceLocation` as a path | 2.1.5 |
//! | `kind` | the types of the two interfaces | |
//! | [`functions`] | the C functions, generic over the model | 2.1, 4.2 |

extern crate self as fmu_export;

pub mod access;
pub mod arrays;
pub mod clock;
pub mod failure;
pub mod ffi;
pub mod functions;
pub mod guard;
mod handle;
mod identity;
pub mod instance;
#[cfg(feature = "interface")]
pub mod interface;
mod kind;
pub mod legality;
pub mod log;
pub mod model;
mod outputs;
pub mod provenance;
pub mod resource;
pub mod routes;
mod sampler;
mod shape;
mod slots;
pub mod snapshot;
mod stop;
mod symbols;
pub mod time;
mod value;

pub use clock::Clock;
pub use fmu_declaration as declaration;
pub use fmu_declaration::{Declare, Start, Unit, choices, compose::Rows, unit};
#[doc(inline)]
pub use fmu_declaration_derive::{ExportedRows as Rows, group, interface};
pub use log::Log;
pub use model::{Model, Refusal};
pub use sampler::{Sample, Sampler};
pub use serde;
pub use time::Step;
