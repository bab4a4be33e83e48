//! Supervision: when the law may act, how it starts, how it stops, and why it does not run.
//!
//! It knows no robot. It sees what an operator and a machine's other parts say (enable, engage, acknowledge, emergency
//! stop, a heartbeat, whether the sensors are valid, the magnitude of the human's force) and tells the law what to do.
//!
//! ```
//! use arm_law::supervision::{Demand, Inputs, Parameters, Report, State, Supervisor};
//!
//! let parameters = Parameters { heartbeat_timeout: 0.0, ..Parameters::default() }; // nobody sends one here
//! let mut supervisor = Supervisor::new(&parameters, 0.001)?;
//! let mut tick = |inputs: &Inputs| {
//!     let demand = supervisor.step(inputs);             // 1. what the law must do
//!     (demand, supervisor.judge(&Report::default()))    // 2. the law ran; what came of it
//! };
//!
//! let waiting = Inputs { enable: true, ..Inputs::default() };
//! for _ in 0..200 {
//!     assert_eq!(tick(&waiting).0, Demand::Rest);
//! }
//! let (demand, status) = tick(&Inputs { engage: true, ..waiting });
//! assert_eq!(status.state, State::Engaged);
//! assert_eq!(demand, Demand::Run { authority: 0.0, freedom: 1.0 }); // no bump
//! # Ok::<(), arm_law::ParameterError>(())
//! ```
//!
//! | module | what |
//! |---|---|
//! | [`state`] | the seven states |
//! | [`condition`] | what can hold at a tick: the table's columns |
//! | [`table`] | which state follows, in order of priority: all of it, as data |
//! | [`diagnostic`] | the reasons by number and name |
//! | [`parameters`] | times and thresholds, and their checks |
//! | [`watch`] | heartbeat, rising edges, a hand at rest: conditions that need a memory |
//! | [`drift`] | a force that nobody varies: how far it may move the nominal, and what it is taken for |
//! | [`ramp`] | authority and freedom of the nominal between states |
//! | [`supervisor`] | one tick |
//!
//! All times are counted in ticks. The states, their table and its drawing: `docs/supervision.md`.

pub mod condition;
pub mod diagnostic;
pub mod drift;
pub mod parameters;
pub mod ramp;
pub mod state;
pub mod supervisor;
pub mod table;
pub mod watch;

pub use condition::{Condition, Conditions};
pub use diagnostic::Diagnostic;
pub use drift::Felt;
pub use parameters::Parameters;
pub use state::State;
pub use supervisor::{Demand, Inputs, Report, Status, Supervisor};
