//! What a substep solves: a velocity and the impulses of all set-valued forces, together.

use nalgebra::{Matrix3, Vector3};

use super::order::{least, most};
use super::surface::Facing;

/// The surfaces, in the order of every array of two.
pub const FACINGS: [Facing; 2] = [Facing::Up, Facing::Back];

/// Find v with
///
/// ```text
/// A v = b + λ + Jᵀ (t + Σ d n)                                              A = M + dt B
/// λᵢ  = −against Sgn(vᵢ) + stop, low ≤ vᵢ ≤ high,  stop ≤ 0 only at high, ≥ 0 only at low    joint i
/// n   = max(0, push − κ dt d·w)                                             normal of a surface, w = J v
/// t   = Σ tₖ,   −tₖ ∈ μ n Sgn(wₖ),   Sgn(w) = w/|w|, Sgn(0) = unit disc     friction of a surface, wₖ = w in its plane
/// ```
///
/// Impulses in N·m·s at the joints, in N·s at the pad (base frame). A is positive definite, so v is unique for given limits; where more forces hold
/// than are needed, how they share the load is not determined by any equation, and v does not depend on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Problem {
    /// M + dt B (kg·m²): viscous friction is implicit.
    pub A: Matrix3<f64>,
    /// M v₀ + dt (all other torques) (N·m·s).
    pub b: Vector3<f64>,
    /// Friction and stops of the joints.
    pub joints: [Joint; 3],
    /// Jacobian of the pad, base frame (m/rad).
    pub J: Matrix3<f64>,
    /// Table and wall.
    pub contacts: [Contact; 2],
}

/// Set-valued forces on a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// Largest impulse of dry friction against the positive and against the negative direction (N·m·s).
    pub against: [f64; 2],
    /// Velocity that reaches the lower stop within the substep (rad/s), ≤ 0.
    pub low: f64,
    /// Velocity that reaches the upper stop within the substep (rad/s), ≥ 0.
    pub high: f64,
}

/// Contact of the pad with a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Impulse if the pad did not move along the normal (N·s); negative: a gap.
    pub push: f64,
    /// By how much the impulse shrinks per velocity along the push: κ dt (kg).
    pub kappa_dt: f64,
    /// Coefficient of friction.
    pub mu: f64,
}

/// Velocity and impulses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// Joint velocities at the end of the substep (rad/s).
    pub v: Vector3<f64>,
    /// Impulse of friction and stop on each joint (N·m·s).
    pub joint: Vector3<f64>,
    /// Impulse of each surface along its normal, on the pad (N·s), ≥ 0.
    pub normal: [f64; 2],
    /// Impulse of friction on the pad, of both surfaces together; base frame (N·s).
    pub tangent: Vector3<f64>,
    /// How it was found.
    pub path: Path,
}

/// How a solution was found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Path {
    /// The forces that held, slid and pushed in the last substep still did.
    #[default]
    Guessed,
    /// After this many changes of the guess.
    Revised(u32),
    /// After this many sweeps of projected Gauss–Seidel, when revisions went in circles.
    Swept(u32),
}

impl Problem {
    /// Impulse of the surfaces on the pad, base frame (N·s): t + Σ d n.
    pub fn on_pad(&self, normal: &[f64; 2], tangent: &Vector3<f64>) -> Vector3<f64> {
        let mut impulse = *tangent;
        for (k, facing) in FACINGS.iter().enumerate() {
            impulse[facing.axis()] += facing.sign() * normal[k];
        }
        impulse
    }

    /// Impulses that count as rounding (N·m·s, N·s): 1e-14 of the largest in the equation. Solving it costs some 50
    /// roundings of 1e-16 each, times a condition number of A of 10 to 30 that acts on the velocity only.
    pub(crate) fn rounding(&self) -> f64 {
        let mut scale = self.b.iter().fold(0.0, |scale, b| most(scale, b.abs()));
        for joint in &self.joints {
            scale = most(scale, most(joint.against[0], joint.against[1]));
        }
        for contact in &self.contacts {
            scale = most(scale, contact.push);
        }
        1e-14 * scale
    }
}

impl Contact {
    /// push − κ dt d·w: impulse of the surface if it could also pull (N·s), for the velocity `w` of the pad (m/s).
    pub fn pressure(&self, facing: Facing, w: &Vector3<f64>) -> f64 {
        self.push - self.kappa_dt * facing.sign() * w[facing.axis()]
    }

    /// `friction` (N·s), shortened to what the normal impulse `n` (N·s) allows.
    #[inline]
    pub(crate) fn within(&self, n: f64, friction: &Vector3<f64>) -> Vector3<f64> {
        let (most, square) = (self.mu * n.max(0.0), friction.norm_squared());
        if square > most * most {
            friction * (most / libm::sqrt(square))
        } else {
            *friction
        }
    }
}

impl Joint {
    /// Least impulse of a joint that friction and stops keep at rest: friction's, or any where it leans on the upper stop.
    pub(crate) fn least(&self) -> f64 {
        if self.high > 0.0 {
            -self.against[0]
        } else {
            f64::NEG_INFINITY
        }
    }

    /// Largest impulse of a joint that friction and stops keep at rest: friction's, or any where it leans on the lower stop.
    pub(crate) fn most(&self) -> f64 {
        if self.low < 0.0 {
            self.against[1]
        } else {
            f64::INFINITY
        }
    }

    /// The share of friction in the impulse `joint` (N·m·s); the rest is the stop's.
    pub fn friction(&self, joint: f64) -> f64 {
        least(most(joint, -self.against[0]), self.against[1])
    }
}
