//! The admittance law on a 3-DoF arm: where the handle is, what the joints deliver, what energy it takes at the joints.
//!
//! | module | what |
//! |---|---|
//! | [`parameters`], [`signals`], [`choices`] | what the FMU and the C library show of it: parameters; inputs and outputs; the items of its choices |
//! | [`displacement`] | the handle's displacement from a pose, for single precision |
//! | [`encoders`] | the checks of the joint encoders |
//! | [`handle`] | a tick of the law as it shows at the handle and at the joints |
//! | [`joint_space`] | the law in joint space, with M_n(q) and C_n(q, dq) |
//! | [`arm_law`] | the complete law: from what is sensed at a tick to the torques |
//! | [`kinematics`] | position, Jacobian, smallest singular value and frame of link 3 |
//! | [`limits`] | what the joints deliver of a torque: one common factor, or each joint clipped |
//! | [`nominal`] | the nominal arm: M_n(q), C_n(q, dq), transport of the nominal velocity |
//! | [`space`] | the coordinates in which the nominal lives, and the law in them |
//! | [`singularity`] | the damping that slows before a singularity |
//! | [`stiff_hand`] | the damping that ends the swing at a hand too stiff for the gains |
//! | [`supervision`] | when the law may act: states, faults, their diagnostics |
//! | [`workspace`] | where the nominal may go: joint limits inside the law |
//! | [`wrench`] | the hand's force from a six-axis force sensor: tare, tool weight, lever arm, faults, filter, deadband |
//! | [`task_space`] | the law at the handle, its torques and its ledger at the joints |
//!
//! No heap, no clock, no I/O, no unsafe, no panic; it depends on `admittance`, `nalgebra` and the rows of `declaration`.
//! The feature `serde` makes the state storable. The package `arm-law-f32` compiles these sources in single precision.

#![no_std]
#![forbid(unsafe_code)]
#![allow(
    non_snake_case,
    reason = "the paper's symbols with its capitals: Lambda_n, K_P, J, T"
)]

pub mod arm_law;
pub mod choices;
pub mod displacement;
pub mod encoders;
pub mod handle;
pub mod joint_space;
pub mod kinematics;
pub mod limits;
pub mod nominal;
pub mod parameters;
pub mod signals;
pub mod singularity;
pub mod space;
pub mod stiff_hand;
pub mod supervision;
pub mod task_space;
pub mod workspace;
pub mod wrench;

pub use admittance::{ParameterError, Real};
pub use arm_law::ArmLaw;
pub use parameters::ArmParameters;
pub use signals::{ArmInputs, ArmOutputs};
