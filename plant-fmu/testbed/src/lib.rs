//! `Testbed.fmu`: the 1-DoF testbed of the paper (`fig:1dof_testbed`), a mass with friction in front of a wall.
//!
//! The physics, its equations and its energy balance are in [`mechanics`]; this crate declares the variables and steps
//! the plant. Every force acts on the mass and is positive along +q, toward the wall.
//!
//! ```
//! use export::{Log, Model, Step};
//! use testbed::Testbed;
//!
//! let mut plant = Testbed { tau_h: 5.0, ..Testbed::default() };
//! plant.initialize(0.0, &mut Log::silent())?;
//! plant.step(Step { start_time: 0.0, t: 0.0, h: 5.0 }, &mut Log::silent())?;
//! assert!(plant.q > plant.wall.q && plant.tau_e < 0.0); // it leans on the wall …
//! assert!(plant.tau_e + plant.tau_h >= -plant.friction.F_c); // … within friction
//! # Ok::<(), export::Refusal>(())
//! ```
//!
//! 1. Parameters are checked by [`initialize`](export::Model::initialize); the outputs then show the start state.
//! 2. [`step`](export::Model::step) holds the inputs and splits the communication step into equal substeps no longer
//!    than `substep`, so it ends exactly at t + h. The plant keeps no time of its own.
//!    With `drive.mode` = 2 the actuator is a position drive that takes `q_d` and `dq_d` and closes its loop every substep.
//! 3. Outputs follow from the state at t + h; forces (`tau_f`, `tau_e`) are means over the last substep. No output
//!    depends on an input set after the step: there is no direct feedthrough.
//!
//! | module | what |
//! |---|---|
//! | [`variables`] | the interface, one row a variable |
//! | [`model`] | initialize and step |
#![allow(
    non_snake_case,
    reason = "the paper's symbols with its capitals: M, F_c"
)]

pub mod model;
pub mod variables;

use mechanics::Energy;
use mechanics::drive::Drive;
use mechanics::friction::Friction;
use mechanics::testbed::{self as plant, Parameters};
use mechanics::wall::Wall;
use serde::{Deserialize, Serialize};

/// The model: its variables as fields (units, signs and bounds in [`variables`]) and the plant's state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Testbed {
    /// Input: force of the actuator (N).
    pub tau_a: f64,
    /// Input: force of the human at the handle (N).
    pub tau_h: f64,
    /// Input: disturbance that no sensor sees (N).
    pub tau_d: f64,

    /// Output: position (m).
    pub q: f64,
    /// Output: velocity (m/s).
    pub dq: f64,
    /// Output: reading of the load cell in the handle (N).
    pub tau_h_measured: f64,
    /// Output: force of the wall (N), ≤ 0.
    pub tau_e: f64,
    /// Output: force of friction (N).
    pub tau_f: f64,
    /// Outputs: energy balance (J).
    pub energy: Energy,

    /// Parameter: moving mass (kg).
    pub M: f64,
    /// Parameters: friction of the guide.
    pub friction: Friction,
    /// Parameters: the wall.
    pub wall: Wall,
    /// Parameter: start position (m).
    pub q_start: f64,
    /// Parameter: start velocity (m/s).
    pub dq_start: f64,
    /// Parameter: longest substep (s).
    pub substep: f64,

    /// Input: position command of the drive (m).
    pub q_d: f64,
    /// Input: velocity command of the drive (m/s).
    pub dq_d: f64,
    /// Output: force that the actuator applied, mean over the step (N).
    pub tau_drive: f64,
    /// Parameters: the actuator.
    pub drive: Actuator,

    /// State, not in the interface: the plant, built anew by each initialization.
    pub plant: plant::Testbed,
}

/// The actuator: a force, or a drive with a position loop.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Actuator {
    /// Parameter: 1 applies `tau_a`, 2 is a position drive.
    pub mode: i32,
    /// Parameters: the position drive.
    pub servo: Drive,
}

impl Default for Testbed {
    /// The start values: the paper's testbed at rest at q = 0.
    fn default() -> Self {
        let Parameters { M, friction, wall } = Parameters::default();
        Self {
            tau_a: 0.0,
            tau_h: 0.0,
            tau_d: 0.0,
            q: 0.0,
            dq: 0.0,
            tau_h_measured: 0.0,
            tau_e: 0.0,
            tau_f: 0.0,
            energy: Energy::default(),
            M,
            friction,
            wall,
            q_start: 0.0,
            dq_start: 0.0,
            substep: 8e-5,
            q_d: 0.0,
            dq_d: 0.0,
            tau_drive: 0.0,
            drive: Actuator {
                mode: 1,
                servo: Drive::default(),
            },
            plant: plant::Testbed::default(),
        }
    }
}
