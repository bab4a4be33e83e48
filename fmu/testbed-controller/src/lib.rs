//! TestbedController: the admittance laws for the one-axis testbed, as a model that FMI can export.
//!
//! Sampled at T: at each tick it latches the position q and the human's force tau_h, runs one tick of the law and holds
//! the force tau_a until the next. All outputs are those at the tick that `tick` names.
//!
//! ```
//! use fmu_export::{Log, Model, Step};
//! use testbed_controller::TestbedController;
//!
//! let mut controller = TestbedController::default();
//! controller.inputs.tau_h = 4.0;
//! controller.initialize(0.0, &mut Log::silent())?;
//! controller.step(Step::at(0.0, 0.002), &mut Log::silent())?;
//! assert_eq!(controller.tick, 0);
//! assert!(controller.outputs.tau_a > 0.0); // towards where the nominal mass is being pushed
//! # Ok::<(), fmu_export::Refusal>(())
//! ```
//!
//! | variable | symbol | equation |
//! |---|---|---|
//! | `q`, `tau_h` | q, tau_h | what is sensed, along the axis, tau_h on the robot |
//! | `q_n`, `dq_n` | q_n, dq_n | eq:obs_dyn: M_n ddq_n + D_n dq_n = tau_h − alpha y |
//! | `e_nr` | e_nr | q_n − q |
//! | `tau_a` | tau_a | eq:dob_input: K y, y = de_nr + K_P e_nr, within ±tau_max |
//! | `energy.*` | H, G, E | what the sampled law stores and creates: [`admittance::ledger`] |
//!
//! | module | what |
//! |---|---|
//! | [`rows`] | the variables, one row each, with their start values |
//! | [`model`] | what a step does |
//! | [`controller`] | the laws, the servo form and the comparators behind one tick |

#![forbid(unsafe_code)]
#![allow(
    non_snake_case,
    reason = "fields are spelt like the paper's symbols and the interface: M_n, K_P, T"
)]

pub mod controller;
pub mod model;
pub mod rows;

pub use rows::TestbedController;
