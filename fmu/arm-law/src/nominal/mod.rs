//! The arm that the human is to feel in joint space: a light, frictionless, weightless rigid body of its own.
//!
//! It has the robot's geometry ([`Kinematics`](crate::kinematics::Kinematics)) and its own masses, centres of mass,
//! inertias and rotors. Nothing here knows the robot's: the paper's law works without them, and M_n, C_n are a choice.
//!
//! | symbol | what | unit | item |
//! |---|---|---|---|
//! | M_n(q) | nominal mass matrix, symmetric and positive definite | kg·m² | [`RigidBody::M`] |
//! | C_n(q, dq) | of the Christoffel symbols: dM_n/dt − 2C_n is skew-symmetric | kg·m²/s | [`RigidBody::C`] |
//! | M_n dv + C_n(q, dq) v dt = 0 | the nominal velocity carried along a motion of the robot | rad/s | [`transport`] |
//!
//! Gravity does not act on the nominal: it is what the robot is to feel like, not what it is.

pub mod rigid_body;
pub mod transport;

pub use rigid_body::{Link, NominalArm, RigidBody};
