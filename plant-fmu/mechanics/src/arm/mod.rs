//! The powered upper limb: a geared 3-DoF arm that holds exactly below stiction, lifts, presses and rubs.
//!
//! ```
//! use mechanics::arm::{Arm, Inputs, Parameters, Start};
//!
//! let mut parameters = Parameters::default();
//! parameters.table.z = -0.45; // the pad starts 93 mm above it
//! let mut arm = Arm::new(parameters, &Start::default())?;
//! let start = arm.q();
//!
//! arm.advance(&Inputs::default(), 10_000, 1e-4); // 1 s: stiction bears the links …
//! assert_eq!(arm.q(), start); // … exactly
//!
//! let press = Inputs { f_h: [0.0, 0.0, -150.0], ..Inputs::default() };
//! arm.advance(&press, 10_000, 1e-4);
//! assert!(arm.contact() && arm.f_e().z > 50.0);
//! let energy = arm.energy();
//! assert!(energy.residual.abs() < 0.01 * energy.work());
//! # Ok::<(), mechanics::ParameterError>(())
//! ```
//!
//! Base frame: origin at the shoulder, x forward, y to the left, z up. Every force acts on the arm and is given in the
//! base frame. q₁ is yaw about z, q₂ and q₃ are pitch about −y: positive lifts.
//!
//! | symbol | equation | unit | item |
//! |---|---|---|---|
//! | M, C, g | M ddq + C dq + g = τ + J_hᵀ f_h + J_pᵀ (f_d + f_e) + τ_f + stops | kg·m², N·m | [`rigid_body::RigidBody`] |
//! | p, J | dp = J dq, of handle (h) and pad (p) | m, m/rad | [`kinematics::Point`] |
//! | τ | dτ/dt = ω (τ_a − τ) | N·m | [`drive::Drive`] |
//! | τ_a | with a position or velocity drive: clip(K((dq_d − dq) + K_P (q_d − q)), ±τ_max) | N·m | [`servo::Servo`] |
//! | τ_f | −τ_f ∈ F(dq) Sgn(dq) + b dq, Sgn(0) = \[−1, 1\] | N·m | [`stribeck::Stribeck`] |
//! | loss | grows with the torque that a gear carries, F + loss | N·m | [`gear_loss::GearLoss`] |
//! | F | F_c + (F_s − F_c) exp(−(dq/v_s)²) | N·m | [`stribeck::Stribeck::limit`] |
//! | f_e | normal: 0 ≤ λ ⟂ s − pen ≥ 0, λ = k s + c ds/dt; tangential: −f_t ∈ μ λ Sgn(w_t), Sgn(0) a disc | N | [`surface::Surface`] |
//! | v | the velocity at the end of a substep and all set-valued forces, together | rad/s | [`problem::Problem`] |
//! | hold | m (a − g) − f_e: tension, shear | N | [`payload::Hold`] |
//! | residual | Σ work + payload − Σ loss − (E − E(0)), first order in dt | J | [`energy::Energy::residual`] |
//!
//! # A substep
//!
//! 1. The drive's demand, its torque and the rigid body at q, with the payload if one is held: [`servo`], [`drive`], [`rigid_body`].
//! 2. The implicit velocity problem: friction of three joints, stops, two surfaces, friction on them: [`problem`].
//! 3. Its solution, exact up to rounding: [`guess`] and [`solver`], with friction on a surface projected on its [`disc`];
//!    [`gauss_seidel`] is the last resort.
//! 4. q⁺ = q + dt v, the surfaces' deflections, the energy: [`substep`], [`flow`], [`energy`].
//! 5. The payload is gripped, released or lost: [`payload`].
//!
//! Configuration-dependent terms are those at the begin of the substep, so the scheme is first order: 8e-6 m over a press
//! and lift at 1e-4 s.

mod check;
pub mod disc;
pub mod drive;
pub mod energy;
pub mod flow;
pub mod gauss_seidel;
pub mod gear_loss;
pub mod guess;
pub mod kinematics;
pub(crate) mod linear;
mod order;
pub mod parameters;
pub mod payload;
pub mod plant;
pub mod problem;
mod quotient;
mod revision;
pub mod rigid_body;
mod rubbing;
pub mod servo;
pub mod solver;
pub mod state;
pub mod stribeck;
pub mod substep;
pub mod surface;

pub use energy::Energy;
pub use parameters::{Parameters, Start};
pub use plant::Arm;
pub use servo::Command;
pub use state::{Inputs, State};

/// `x`, or zero where it has decayed below what any energy can show.
fn floored(x: f64) -> f64 {
    if x.abs() < crate::FLOOR { 0.0 } else { x }
}
