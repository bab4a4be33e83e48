//! The nominal velocity carried along a motion of the robot.
//!
//! The nominal of eq:obs_dyn has its inertia at the robot's pose q, and C_n(q, dq) is what a change of that pose does to
//! v_n. Without any torque
//!
//! ```text
//! M_n(q) dv_n/dt + C_n(q, dq) v_n = 0,    C_n = ½ dM_n/dt + S,  S skew,    hence  d(½ v_nᵀ M_n v_n)/dt = 0
//! ```
//!
//! which is parallel transport of v_n along q(t): only where the robot has been matters, not when. So it needs no velocity:
//! from the pose before to the pose now, with Δq between them, the midpoint rule is
//!
//! ```text
//! (M̄ + ½ Δ) v = (M̄ − ½ Δ) v_before,    M̄ = ½ (M_before + M_now),  Δ = ½ (M_now − M_before) + S̄(Δq)
//! ```
//!
//! It is of second order. ½ vᵀ M_n v changes by a third-order error only, and that is taken out by scaling v: the energy
//! is kept to rounding for every Δq, also one that no robot makes in a sample.

use super::RigidBody;
use admittance::{Real, real};
use nalgebra::Vector3;

/// The velocity `v` (rad/s) of the nominal `before`, carried to the nominal `now` by a motion of `delta_q` (rad), with
/// ½ vᵀ M_n v kept.
///
/// 4(M̄ + ½ Δ) = 3 M_now + M_before + 2 S̄ is a positive definite plus a skew-symmetric matrix and so invertible. Should its
/// numbers leave the range of the floating point, v comes to rest, which costs energy and creates none.
pub fn transported(
    before: &RigidBody,
    now: &RigidBody,
    delta_q: &Vector3<Real>,
    v: &Vector3<Real>,
) -> Vector3<Real> {
    let S_2 = before.S(delta_q) + now.S(delta_q); // 2 S̄
    let left = now.M * 3.0 + before.M + S_2;
    let right = (now.M + before.M * 3.0 - S_2) * v;
    let Some(inverse) = left.try_inverse() else {
        return Vector3::zeros();
    };
    let carried = inverse * right;
    let (energy, turned) = (before.kinetic(v), now.kinetic(&carried));
    if energy > 0.0 && turned > 0.0 {
        carried * real::sqrt(energy / turned)
    } else {
        Vector3::zeros()
    }
}
