//! `ExoskeletonArm.fmu`: the powered upper limb, a geared 3-DoF arm with payload, table, wall and its sensors.
//!
//! The physics, its equations, parameters and energy balance are in [`mechanics::arm`]; this crate steps the plant and reads
//! it through an encoder and a force sensor that can be as bad as real ones.
//!
//! Base frame: origin at the shoulder, x forward, y to the left, z up. q₁ is yaw about z, q₂ and q₃ are pitch about −y:
//! positive lifts. Forces act on the arm, positive along the axis: f_h at the handle, f_d and f_e at the pad.
//!
//! ```
//! use fmu_export::{Log, Model, Step};
//! use exoskeleton_arm::ExoskeletonArm;
//!
//! let mut arm = ExoskeletonArm::default();
//! arm.initialize(0.0, &mut Log::silent())?;
//! let start = arm.outputs.q; // at rest, bent: handle 0.44 m ahead, 0.24 m below the shoulder …
//! arm.step(Step::at(0.0, 1.0), &mut Log::silent())?;
//! assert_eq!(arm.outputs.q, start); // … and friction alone holds it there, exactly
//!
//! arm.inputs.tau_a = [0.0, 60.0, 20.0]; // both pitch joints up
//! arm.step(Step::at(1.0, 0.2), &mut Log::silent())?;
//! assert!(arm.outputs.dp[2] > 0.0);
//! # Ok::<(), fmu_export::Refusal>(())
//! ```
//!
//! | variable | symbol | equation | item |
//! |---|---|---|---|
//! | `q` | q | the encoder's reading of the joint angles | [`encoder::Encoder`] |
//! | `q_joint`, `dq` | q, dq | M ddq + C dq + g = τ + J_hᵀ f_h + J_pᵀ (f_d + f_e) + τ_f + stops | [`mechanics::arm`] |
//! | `p`, `dp` | p, J dq | of the handle | [`mechanics::arm::kinematics`] |
//! | `f_h_measured` | f_h + tool's weight + lag + bias + drift + noise | of the force sensor, in its frame, at its own clock | [`force_sensor::ForceSensor`] |
//! | `tau_applied` | τ | dτ/dt = 2π f (τ_a − τ), f = `drive.cutoff` | [`mechanics::arm::drive`] |
//! | `f_e` | f_e | of table and wall on the pad, where no sensor is | [`mechanics::arm::surface`] |
//! | `attached`, `tension`, `shear` | | the payload that the vacuum holds, and the pad's force on it | [`mechanics::arm::payload`] |
//! | `energy.*` | | Σ work + payload − Σ loss − (E − E(0)) = residual | [`mechanics::arm::energy`] |
//!
//! 1. Parameters are checked by [`initialize`](fmu_export::Model::initialize); the outputs then show the start state.
//! 2. [`step`](fmu_export::Model::step) holds the inputs and splits the communication step into equal substeps no longer
//!    than `substep`, so it ends exactly at t + h. The plant keeps no time of its own.
//! 3. Outputs follow from the state at t + h; forces are means over the last substep. No output depends on an input set
//!    after the step: there is no direct feedthrough.
//!
//! | module | what |
//! |---|---|
//! | [`rows`] | the variables, one row each, with their start values |
//! | [`encoder`] | motor-side or joint-side counts |
//! | [`force_sensor`] | frame, tool, hysteresis, bias, drift, noise, range, failures, clock |
//! | [`noise`] | normal numbers by a counter |
//! | [`model`] | what initialize and step do |
#![allow(
    non_snake_case,
    reason = "the paper's symbols with its capitals: M, F_c, I_xx"
)]

pub mod encoder;
pub mod force_sensor;
pub mod model;
pub mod noise;
pub mod rows;

pub use rows::ExoskeletonArm;
