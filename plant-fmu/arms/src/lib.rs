//! `ExoskeletonArms.fmu`: two powered upper limbs, left and right, that share one payload rigidly.
//!
//! The physics of an arm is in [`mechanics::arm`], that of the closed chain in [`mechanics::pair`]. This crate steps the
//! plant. Ports and sensors are those of `ExoskeletonArm.fmu` with the prefix `left.` or `right.`;
//! the parameters are shared, without prefix. There is no force sensor model here, and the encoders are ideal: for sensors
//! as bad as real ones take two `ExoskeletonArm.fmu`.
//!
//! Base frame: origin between the shoulders, x forward, y to the left, z up; the shoulders are at y = ± `base.y`. Forces act
//! on the arms, positive along the axis.
//!
//! ```
//! use fmu_export::{Log, Model, Step};
//! use exoskeleton_arms::ExoskeletonArms;
//!
//! let mut arms = ExoskeletonArms::default();
//! arms.parameters.arm.payload_m = 35.0;
//! arms.start.attached = true;
//! arms.initialize(0.0, &mut Log::silent())?;
//! assert_eq!(arms.outputs.left.p[1] - arms.outputs.right.p[1], 2.0 * arms.base.y);
//!
//! (arms.inputs.left.vacuum, arms.inputs.right.vacuum) = (true, true);
//! arms.inputs.left.tau_a = [0.0, 300.0, 150.0]; // the left arm lifts alone, the right one's drives are off …
//! arms.step(Step::at(0.0, 0.5), &mut Log::silent())?;
//! let shown = arms.outputs;
//! assert!(shown.attached && shown.right.p[2] > -0.24); // … and comes along
//! assert!(shown.gap < 1e-5 && shown.lambda[2] < 0.0);
//! # Ok::<(), fmu_export::Refusal>(())
//! ```
//!
//! | variable | symbol | equation | item |
//! |---|---|---|---|
//! | `left.*`, `right.*` | | as of `ExoskeletonArm.fmu` | [`exoskeleton_arm`] |
//! | `gap` | \|g\| | g = p_L − p_R − r, r = p_L − p_R at the grip | [`mechanics::pair::Pair::gap`] |
//! | `lambda` | λ | of the payload's right half on its left one: −k g − c dg/dt | [`mechanics::pair::bond`] |
//! | `wrist` | | (p_L − p_R) × λ: moment of the stiff wrists on the payload, which keeps its direction | [`mechanics::pair::Pair::wrist`] |
//! | `attached` | | by both cups or by none | [`mechanics::pair`] |
//! | `energy.*` | | of both arms and the bond together | [`mechanics::pair::Balance`] |
//!
//! | module | what |
//! |---|---|
//! | [`rows`] | the variables, one row each, with their start values |
//! | [`model`] | what initialize and step do |
#![allow(
    non_snake_case,
    reason = "the paper's symbols with its capitals: M, F_c, I_xx"
)]

pub mod model;
pub mod rows;

pub use rows::ExoskeletonArms;
