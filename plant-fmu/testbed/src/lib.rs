//! `Testbed.fmu`: the 1-DoF testbed of the paper (`fig:1dof_testbed`), a mass with friction in front of a wall.
//!
//! The physics, its equations, its parameters and its energy balance are in [`mechanics`]; this crate adds what an FMU has
//! besides and steps the plant. Every force acts on the mass and is positive along +q, toward the wall.
//!
//! ```
//! use fmu_export::{Log, Model, Step};
//! use testbed::Testbed;
//!
//! let mut plant = Testbed::default();
//! plant.forces.tau_h = 5.0;
//! plant.initialize(0.0, &mut Log::silent())?;
//! plant.step(Step::at(0.0, 5.0), &mut Log::silent())?;
//! let (shown, parameters) = (plant.outputs, plant.parameters);
//! assert!(shown.q > parameters.wall.q && shown.tau_e < 0.0); // it leans on the wall …
//! assert!(shown.tau_e + plant.forces.tau_h >= -parameters.friction.F_c); // … within friction
//! # Ok::<(), fmu_export::Refusal>(())
//! ```
//!
//! 1. Parameters are checked by [`initialize`](fmu_export::Model::initialize); the outputs then show the start state.
//! 2. [`step`](fmu_export::Model::step) holds the inputs and splits the communication step into equal substeps no longer
//!    than `substep`, so it ends exactly at t + h. The plant keeps no time of its own.
//!    With `drive.mode` = 2 or 3 the actuator is a position or velocity drive that takes `q_d` and `dq_d` and closes its loop
//!    every substep.
//! 3. Outputs follow from the state at t + h; forces (`tau_f`, `tau_e`) are means over the last substep. No output
//!    depends on an input set after the step: there is no direct feedthrough.
//!
//! | module | what |
//! |---|---|
//! | [`rows`] | the variables, one row each, with their start values |
//! | [`model`] | what initialize and step do |
#![allow(
    non_snake_case,
    reason = "the paper's symbols with its capitals: M, F_c"
)]

pub mod model;
pub mod rows;

pub use rows::Testbed;
