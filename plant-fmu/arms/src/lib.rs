//! `ExoskeletonArms.fmu`: two powered upper limbs, left and right, that share one payload rigidly.
//!
//! The physics of an arm is in [`mechanics::arm`], that of the closed chain in [`mechanics::pair`]. This crate declares the
//! variables and steps the plant. Ports and sensors are those of `ExoskeletonArm.fmu` with the prefix `left.` or `right.`;
//! the parameters are shared, without prefix. There is no force sensor model here, and the encoders are ideal: for sensors
//! as bad as real ones take two `ExoskeletonArm.fmu`.
//!
//! Base frame: origin between the shoulders, x forward, y to the left, z up; the shoulders are at y = ± `base.y`. Forces act
//! on the arms, positive along the axis.
//!
//! ```
//! use export::{Log, Model, Step};
//! use exoskeleton_arms::ExoskeletonArms;
//!
//! let mut arms = ExoskeletonArms::default();
//! arms.parameters.payload_m = 35.0;
//! arms.parameters.payload_attached = true;
//! arms.initialize(0.0, &mut Log::silent())?;
//! assert_eq!(arms.left.p[1] - arms.right.p[1], 2.0 * arms.base.y);
//!
//! (arms.left.vacuum, arms.right.vacuum) = (true, true);
//! arms.left.tau_a = [0.0, 300.0, 150.0]; // the left arm lifts alone, the right one's drives are off …
//! arms.step(Step { start_time: 0.0, t: 0.0, h: 0.5 }, &mut Log::silent())?;
//! assert!(arms.attached && arms.right.p[2] > -0.24); // … and comes along
//! assert!(arms.gap < 1e-5 && arms.lambda[2] < 0.0);
//! # Ok::<(), export::Refusal>(())
//! ```
//!
//! | variable | symbol | equation | item |
//! |---|---|---|---|
//! | `left.*`, `right.*` | | as of `ExoskeletonArm.fmu` | [`exoskeleton_arm`] |
//! | `gap` | \|g\| | g = p_L − p_R − r, r = p_L − p_R at the grip | [`mechanics::pair::Pair::gap`] |
//! | `lambda` | λ | of the payload's right half on its left one: −k g − c dg/dt | [`mechanics::pair::bond`] |
//! | `attached` | | by both cups or by none | [`mechanics::pair`] |
//! | `energy.*` | | of both arms and the bond together | [`mechanics::pair::Balance`] |
//!
//! | module | what |
//! |---|---|
//! | [`variables`] | the interface, one row a variable |
//! | [`model`] | initialize and step |
#![allow(
    non_snake_case,
    reason = "the paper's symbols with its capitals: M, F_c, I_xx"
)]

pub mod model;
pub mod variables;

use exoskeleton_arm::parameters::Parameters;
use mechanics::arm::Energy;
use mechanics::pair::{Bond, Pair};
use serde::{Deserialize, Serialize};

/// The model: its variables as fields (units, signs and bounds in [`variables`]) and the plant's state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExoskeletonArms {
    /// Ports and sensors of the left arm.
    pub left: Side,
    /// Ports and sensors of the right arm.
    pub right: Side,
    /// Output: whether the payload hangs at both pads.
    pub attached: bool,
    /// Output: by how much the pads have left the offset that they had at the grip (m).
    pub gap: f64,
    /// Output: force of the payload's right half on its left one, base frame (N).
    pub lambda: [f64; 3],
    /// Outputs: energy balance of both arms and the bond (J).
    pub energy: Energy,
    /// Outputs: energy of the bond (J).
    pub bond_energy: BondEnergy,

    /// Parameters of each arm; `payload_m` is the whole payload.
    pub parameters: Parameters,
    /// Parameters of the bond.
    pub bond: Bond,
    /// Parameters: where the shoulders are.
    pub base: Base,
    /// Parameter: longest substep (s).
    pub substep: f64,

    /// State, not in the interface: the plant, built anew by each initialization.
    pub plant: Pair,
}

/// Ports and sensors of one arm.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Side {
    /// Input: torques asked of the drives (N·m).
    pub tau_a: [f64; 3],
    /// Input: force of the human at the handle, base frame (N).
    pub f_h: [f64; 3],
    /// Input: force at the pad that no sensor sees, base frame (N).
    pub f_d: [f64; 3],
    /// Input: whether this cup's vacuum is on.
    pub vacuum: bool,
    /// Output: joint angles (rad).
    pub q: [f64; 3],
    /// Output: joint velocities (rad/s).
    pub dq: [f64; 3],
    /// Output: position of the handle, base frame (m).
    pub p: [f64; 3],
    /// Output: velocity of the handle, base frame (m/s).
    pub dp: [f64; 3],
    /// Output: position of the pad, base frame (m).
    pub p_pad: [f64; 3],
    /// Output: force of table and wall at the pad, base frame (N).
    pub f_e: [f64; 3],
    /// Output: torques that arrive at the joints (N·m).
    pub tau_applied: [f64; 3],
    /// Output: torques of friction at the joints (N·m).
    pub tau_f: [f64; 3],
    /// Output: whether table or wall pushes.
    pub contact: bool,
    /// Output: upward pull of this pad on the payload (N).
    pub tension: f64,
}

/// Energy of the bond (J).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BondEnergy {
    /// Stored: ½ k g².
    pub stored: f64,
    /// Heat since the start.
    pub loss: f64,
}

/// Where the shoulders are.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Base {
    /// y of the left shoulder (m); that of the right one is −y.
    pub y: f64,
}

impl Default for ExoskeletonArms {
    /// The start values: both arms at rest in their start pose, 0.4 m apart, nothing to touch or to carry.
    fn default() -> Self {
        Self {
            left: Side::default(),
            right: Side::default(),
            attached: false,
            gap: 0.0,
            lambda: [0.0; 3],
            energy: Energy::default(),
            bond_energy: BondEnergy::default(),
            parameters: Parameters::default(),
            bond: Bond::default(),
            base: Base { y: 0.2 },
            substep: 1e-4,
            plant: Pair::default(),
        }
    }
}
