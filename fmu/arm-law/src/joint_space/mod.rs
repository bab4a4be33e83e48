//! The law in joint space: eq:obs_dyn and eq:dob_input as the paper writes them.
//!
//! ```text
//! M_n(q) ddq_n + (C_n(q, dq) + D_n) dq_n = tau_h − alpha y,   tau_h = Jᵀ f_h        eq:obs_dyn
//! y = de_nr + K_P e_nr,   tau_a = K y,   K = k·I                                     eq:dob_input
//! ```
//!
//! The human feels a light arm of rigid links in place of a mass at the handle. There is no inverse of J and so no
//! singularity to slow down for.
//!
//! Sampled at T: at t_k the pose is known, and M_n is frozen at M_n(q_k) until t_{k+1}. C_n is the effect of the pose's
//! change on v_n; it is applied when the change is known, at t_{k+1}, as [`transport`](crate::nominal::transport) of v_n
//! along it, which keeps ½ v_nᵀ M_n v_n for any motion. Between, [`midpoint`] conserves energy step by step, so that
//!
//! ```text
//! H = k (½ v_nᵀ M_n v_n/alpha + ½ eᵀ K_P e)
//! ΔG = ΔH + tau·Δq − (k/alpha) tau_h·v_m T
//!    = −(k/alpha) v_mᵀ D_n v_m T − k T |w|² + k Σ (1 − K_P T/2) w δ + ½ k Σ K_P δ²     while nothing is limited,
//! ```
//!
//! with w = v_m − dq and δ = Δq − T dq: that of one axis, summed. M_n and C_n do not appear, so smooth motion costs
//! nothing.
//!
//! A limited joint keeps to its own limit: under `passive_applied` and `passive_bounded` the torques are clamped joint by
//! joint, which is the projection that makes (y_s − K_P e)·de_nr ≥ 0; one common factor for all joints does not. The price
//! is that the force at the handle turns while some joints are limited and others are not.
//!
//! | module | what |
//! |---|---|
//! | [`gains`] | D_n, K, K_P, tau_max; why K is one number |
//! | [`midpoint`] | the arithmetic of one sample |
//! | [`boxed`] | its linear system within the nominal's limits |
//! | [`stored`] | the springs' energy; gain changes that do not raise it |
//! | [`joints`] | the law between two ticks |
//! | [`law`] | a tick with its limits, ledger and budget |
//! | [`servo`] | the same for joints whose drives take positions and velocities |

pub mod boxed;
pub mod gains;
pub mod joints;
pub mod law;
pub mod midpoint;
pub mod servo;
pub mod stored;

pub use gains::{JointGains, JointSettings};
pub use joints::{Angles, JointProposal, JointRequest, JointSensed, Joints};
pub use law::{JointParameters, JointSpace, Nominal};
pub use servo::JointServo;
