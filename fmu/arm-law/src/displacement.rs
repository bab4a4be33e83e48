//! The handle's displacement from a pose: what single precision needs to see small motions.
//!
//! p(q) − p(q_0) as the difference of two positions loses the digits that they share, and the law divides the difference of
//! two ticks by T. Here it is computed from δ = q − q_0 without such a difference:
//!
//! ```text
//! sin(q_0 + δ) − sin q_0 =  cos q_0 sin δ − sin q_0 (1 − cos δ)
//! cos(q_0 + δ) − cos q_0 = −sin q_0 sin δ − cos q_0 (1 − cos δ),   1 − cos δ = 2 sin²(δ/2)
//! Δϱ = Δx = L₁ Δcos q₂ + h_x Δcos β − h_z Δsin β,   Δz = L₁ Δsin q₂ + h_x Δsin β + h_z Δcos β,   β = q₂ + q₃
//! Δp = (Δϱ cos q₁ + ϱ_0 Δcos q₁,  Δϱ sin q₁ + ϱ_0 Δsin q₁,  Δz)
//! ```
//!
//! Each term is a product with a small factor, so that the error of Δp is a few roundings of |Δp|-sized terms, not of |p|:
//! it vanishes with the displacement.

use crate::kinematics::{Kinematics, Pose};
use admittance::{Real, real};
use nalgebra::Vector3;

/// A pose from which joint angles and the handle's position are counted.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Origin {
    q: Vector3<Real>,
    /// sin and cos of q₁, q₂, q₃ and β there
    angles: [Angle; 4],
    rho: Real,
    p: Vector3<Real>,
}

/// An angle by its sine and cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Angle {
    sin: Real,
    cos: Real,
}

impl Angle {
    fn of(angle: Real) -> Self {
        let (sin, cos) = real::sin_cos(angle);
        Self { sin, cos }
    }

    /// By how much sine and cosine change when the angle grows by `delta` (rad).
    fn change(&self, delta: Real) -> Self {
        let Self { sin, cos } = *self;
        let (half, _) = real::sin_cos(0.5 * delta);
        let (sin_delta, versine) = (real::sin_cos(delta).0, 2.0 * half * half);
        Self {
            sin: cos * sin_delta - sin * versine,
            cos: -sin * sin_delta - cos * versine,
        }
    }
}

impl Origin {
    /// The pose at the joint angles `q` (rad).
    pub fn new(kinematics: &Kinematics, q: &Vector3<Real>) -> Self {
        let angles = [q[0], q[1], q[2], q[1] + q[2]].map(Angle::of);
        let [_, two, _, beta] = &angles;
        let Kinematics {
            A1,
            L1,
            handle_x,
            handle_z,
        } = *kinematics;
        Self {
            q: *q,
            angles,
            rho: A1 + L1 * two.cos + handle_x * beta.cos - handle_z * beta.sin,
            p: kinematics.at(q).p,
        }
    }

    /// The joint angles there, rad.
    pub fn q(&self) -> &Vector3<Real> {
        &self.q
    }

    /// Position of the handle there, base frame, m.
    pub fn p(&self) -> &Vector3<Real> {
        &self.p
    }

    /// The handle when the joints have moved on by `delta` (rad): J and R as [`Kinematics::at`] gives them, but p counted
    /// from here.
    pub fn displaced(&self, kinematics: &Kinematics, delta: &Vector3<Real>) -> Pose {
        let [one, two, three, beta] = &self.angles;
        let (d_1, d_2, d_3) = (
            one.change(delta[0]),
            two.change(delta[1]),
            three.change(delta[2]),
        );
        let d_b = beta.change(delta[1] + delta[2]);
        let Kinematics {
            L1,
            handle_x,
            handle_z,
            ..
        } = *kinematics;
        let (c_1, s_1) = (one.cos + d_1.cos, one.sin + d_1.sin);
        let d_rho = L1 * d_2.cos + handle_x * d_b.cos - handle_z * d_b.sin;
        let d_z = L1 * d_2.sin + handle_x * d_b.sin + handle_z * d_b.cos;
        let pose = kinematics.turned(&[
            (s_1, c_1),
            (two.sin + d_2.sin, two.cos + d_2.cos),
            (three.sin + d_3.sin, three.cos + d_3.cos),
        ]);
        Pose {
            p: Vector3::new(
                d_rho * c_1 + self.rho * d_1.cos,
                d_rho * s_1 + self.rho * d_1.sin,
                d_z,
            ),
            ..pose
        }
    }
}
