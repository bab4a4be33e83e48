//! The built FMUs as an importer meets them: unpacked, loaded with dlopen, called through the C interface.
//!
//! ```no_run
//! use abi::{Fmu, Status};
//!
//! let fmu = Fmu::open("Testbed");                       // target/fmu/Testbed.fmu
//! let testbed = fmu.instantiate();
//! testbed.initialize(0.0);
//! assert_eq!(testbed.set_real(&[fmu.reference("tau_h")], &[5.0]), Status::OK);
//! assert_eq!(testbed.step(0.0, 0.002), Status::OK);
//! assert!(testbed.real(fmu.reference("q")) > 0.0);      // freed at the end of its scope
//! ```
//!
//! Nothing here comes from the exporter: types, function signatures and the phases that tests expect are written from
//! the standard a second time.
//!
//! | module | what |
//! |---|---|
//! | [`types`] | C types, statuses, callbacks |
//! | [`library`] | the 34 functions of a shared library |
//! | [`messages`] | what an instance told its logger |
//! | [`instance`] | one instance, with slices for arrays |
//! | [`both`] | the calls that FMI 3.0 has, too, under names of their own |
//! | [`description`], [`variable`] | `modelDescription.xml`: guid, names, value references, types |
//! | [`fmu`], [`lag`] | the archive, or the test model's bare library |
//! | [`phase`] | the phases of an instance's life, and how to get there |
//! | [`refusal`] | what a refused call is |
//! | [`standard`] | the standard's table: which call is legal in which phase, and the deviations |
//! | [`rights`] | which variable may be set or got in which phase |
//! | [`calls`] | every function with good arguments |
//! | [`sequence`] | random calls in random order |
//! | [`fmi3`] | the same libraries through the functions of FMI 3.0 |
//!
//! `src/bin/native_loop.rs` is the harness's zero-delay loop without the harness; `src/bin/call_sequences.rs` plays random
//! calls.

pub mod both;
pub mod calls;
pub mod description;
pub mod fmi3;
pub mod fmu;
pub mod instance;
pub mod lag;
pub mod library;
pub mod messages;
pub mod phase;
pub mod refusal;
pub mod rights;
pub mod sequence;
pub mod standard;
pub mod types;
pub mod variable;

pub use fmu::Fmu;
pub use instance::{Instance, Setup};
pub use library::Library;
pub use messages::Message;
pub use phase::Phase;
pub use types::Status;
pub use variable::{Kind, Variable};
