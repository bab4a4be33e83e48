//! `ExoskeletonArm.fmu`: the powered upper limb, a geared 3-DoF arm with payload, table, wall and its sensors.
//!
//! The physics, its equations and its energy balance are in [`mechanics::arm`]; this crate declares the variables, steps
//! the plant and reads it through an encoder and a force sensor that can be as bad as real ones.
//!
//! Base frame: origin at the shoulder, x forward, y to the left, z up. q₁ is yaw about z, q₂ and q₃ are pitch about −y:
//! positive lifts. Forces act on the arm, positive along the axis: f_h at the handle, f_d and f_e at the pad.
//!
//! ```
//! use export::{Log, Model, Step};
//! use exoskeleton_arm::ExoskeletonArm;
//!
//! let mut arm = ExoskeletonArm::default();
//! arm.initialize(0.0, &mut Log::silent())?;
//! let start = arm.q; // at rest, bent: handle 0.44 m ahead, 0.24 m below the shoulder …
//! arm.step(Step { start_time: 0.0, t: 0.0, h: 1.0 }, &mut Log::silent())?;
//! assert_eq!(arm.q, start); // … and friction alone holds it there, exactly
//!
//! arm.tau_a = [0.0, 60.0, 20.0]; // both pitch joints up
//! arm.step(Step { start_time: 0.0, t: 1.0, h: 0.2 }, &mut Log::silent())?;
//! assert!(arm.dp[2] > 0.0);
//! # Ok::<(), export::Refusal>(())
//! ```
//!
//! | variable | symbol | equation | item |
//! |---|---|---|---|
//! | `q` | q | the encoder's reading of the joint angles | [`encoder::Encoder`] |
//! | `q_joint`, `dq` | q, dq | M ddq + C dq + g = τ + J_hᵀ f_h + J_pᵀ (f_d + f_e) + τ_f + stops | [`mechanics::arm`] |
//! | `p`, `dp` | p, J dq | of the handle | [`mechanics::arm::kinematics`] |
//! | `f_h_measured` | f_h + bias + noise | of the force sensor, in its frame, at its own clock | [`force_sensor::ForceSensor`] |
//! | `tau_applied` | τ | dτ/dt = 2π f (τ_a − τ), f = `drive.cutoff` | [`mechanics::arm::drive`] |
//! | `f_e` | f_e | of table and wall on the pad, where no sensor is | [`mechanics::arm::surface`] |
//! | `attached`, `tension` | | the payload that the vacuum holds, and its pull | [`mechanics::arm::payload`] |
//! | `energy.*` | | Σ work + payload − Σ loss − (E − E(0)) = residual | [`mechanics::arm::energy`] |
//!
//! 1. Parameters are checked by [`initialize`](export::Model::initialize); the outputs then show the start state.
//! 2. [`step`](export::Model::step) holds the inputs and splits the communication step into equal substeps no longer
//!    than `substep`, so it ends exactly at t + h. The plant keeps no time of its own.
//! 3. Outputs follow from the state at t + h; forces are means over the last substep. No output depends on an input set
//!    after the step: there is no direct feedthrough.
//!
//! | module | what |
//! |---|---|
//! | [`variables`] | the interface, one row a variable |
//! | [`parameters`] | the table of the arm as the interface has it, one vector a row |
//! | [`encoder`] | motor-side or joint-side counts |
//! | [`force_sensor`] | frame, bias, noise, range, failures, clock |
//! | [`noise`] | normal numbers by a counter |
//! | [`model`] | initialize and step |
#![allow(
    non_snake_case,
    reason = "the paper's symbols with its capitals: M, F_c, I_xx"
)]

pub mod encoder;
pub mod force_sensor;
pub mod model;
pub mod noise;
pub mod parameters;
mod table;
pub mod variables;

use encoder::Encoder;
use force_sensor::{ForceSensor, Reading};
use mechanics::arm::{Arm, Energy};
use parameters::Parameters;
use serde::{Deserialize, Serialize};

/// The model: its variables as fields (units, signs and bounds in [`variables`]) and the plant's state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExoskeletonArm {
    /// Input: torques asked of the drives (N·m).
    pub tau_a: [f64; 3],
    /// Input: force of the human at the handle, base frame (N).
    pub f_h: [f64; 3],
    /// Input: force at the pad that no sensor sees, base frame (N).
    pub f_d: [f64; 3],
    /// Input: whether the vacuum is on.
    pub vacuum: bool,

    /// Output: joint angles as the encoder reads them (rad).
    pub q: [f64; 3],
    /// Output: joint velocities (rad/s).
    pub dq: [f64; 3],
    /// Output: position of the handle, base frame (m).
    pub p: [f64; 3],
    /// Output: velocity of the handle, base frame (m/s).
    pub dp: [f64; 3],
    /// Output: the force sensor's reading (N).
    pub f_h_measured: [f64; 3],
    /// Output: force of table and wall at the pad, base frame (N).
    pub f_e: [f64; 3],
    /// Output: torques that arrive at the joints (N·m).
    pub tau_applied: [f64; 3],
    /// Output: torques of friction at the joints (N·m).
    pub tau_f: [f64; 3],
    /// Output: true joint angles (rad).
    pub q_joint: [f64; 3],
    /// Output: position of the pad, base frame (m).
    pub p_pad: [f64; 3],
    /// Output: whether a payload hangs at the pad.
    pub attached: bool,
    /// Output: whether table or wall pushes.
    pub contact: bool,
    /// Output: upward pull of the pad on the payload (N).
    pub tension: f64,
    /// Outputs: energy balance (J).
    pub energy: Energy,
    /// Locals: the rigid body in this pose.
    pub rigid_body: RigidBody,

    /// Parameters of the arm itself.
    pub parameters: Parameters,
    /// Parameters of the encoder.
    pub encoder: Encoder,
    /// Parameters of the force sensor.
    pub ft: ForceSensor,
    /// Parameter: longest substep (s).
    pub substep: f64,

    /// State, not in the interface: the plant, built anew by each initialization.
    pub plant: Arm,
    /// State, not in the interface: what the force sensor shows.
    pub reading: Reading,
}

/// M ddq + C dq + g = τ in the present pose, with the payload if it is attached: for those who check or compensate.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RigidBody {
    /// Mass matrix M(q), row by row (kg·m²).
    pub M: [f64; 9],
    /// Coriolis and centrifugal torques C(q, dq) dq (N·m).
    pub C_dq: [f64; 3],
    /// Torques that hold the arm against gravity (N·m).
    pub g: [f64; 3],
}

impl Default for ExoskeletonArm {
    /// The start values: the arm at rest in its start pose, nothing to touch or to carry.
    fn default() -> Self {
        Self {
            tau_a: [0.0; 3],
            f_h: [0.0; 3],
            f_d: [0.0; 3],
            vacuum: false,
            q: [0.0; 3],
            dq: [0.0; 3],
            p: [0.0; 3],
            dp: [0.0; 3],
            f_h_measured: [0.0; 3],
            f_e: [0.0; 3],
            tau_applied: [0.0; 3],
            tau_f: [0.0; 3],
            q_joint: [0.0; 3],
            p_pad: [0.0; 3],
            attached: false,
            contact: false,
            tension: 0.0,
            energy: Energy::default(),
            rigid_body: RigidBody::default(),
            parameters: Parameters::default(),
            encoder: Encoder::default(),
            ft: ForceSensor::default(),
            substep: 1e-4,
            plant: Arm::default(),
            reading: Reading::default(),
        }
    }
}
