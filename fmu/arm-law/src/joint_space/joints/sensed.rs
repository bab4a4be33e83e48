//! What is known and asked of the joints at a tick, and what they ask for.

use super::super::boxed::Solution;
use super::super::midpoint::Sample;
use crate::kinematics::{SinCos, sin_cos};
use crate::nominal::RigidBody;
use admittance::Real;
use admittance::bounds::Interval;
use nalgebra::{Matrix3, Vector3};

/// Joint angles, with sines and cosines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angles {
    pub(super) q: Vector3<Real>,
    pub(super) sin_cos: SinCos,
}

/// The joints at a tick, once the position is known: what they store, before they act.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointSensed {
    pub(super) q: Vector3<Real>,
    pub(super) body: RigidBody,
    pub(super) dq: Vector3<Real>,
    pub(super) e: Vector3<Real>,
    pub(super) v_n: Vector3<Real>,
}

/// What is asked of the joints at a tick, beside their inputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointRequest {
    /// Whether the nominal stays where it is.
    pub hold: bool,
    /// Speed that the nominal must not exceed, beside its bounds, rad/s, ≥ 0; infinite for no limit.
    pub speed: Vector3<Real>,
    /// Damping on top of D_n, N·m·s/rad, symmetric and not negative, block diagonal like M_n.
    pub damping: Matrix3<Real>,
}

impl Default for JointRequest {
    /// The law alone.
    fn default() -> Self {
        Self {
            hold: false,
            speed: Vector3::repeat(Real::INFINITY),
            damping: Matrix3::zeros(),
        }
    }
}

/// What the joints ask for at a tick. Nothing has happened until it is committed; it may be dropped.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct JointProposal {
    pub(super) q: Vector3<Real>,
    pub(super) body: RigidBody,
    pub(super) intervals: [Interval; 3],
    pub(super) sample: Sample,
    pub(super) wish: Solution,
    pub(super) tau_demand: Vector3<Real>,
}

impl Angles {
    /// The angles `q` (rad).
    pub fn new(q: &Vector3<Real>) -> Self {
        Self::with(q, &sin_cos(q))
    }

    /// The angles `q` (rad), whose sines and cosines are known.
    #[inline]
    pub(crate) fn with(q: &Vector3<Real>, sin_cos: &SinCos) -> Self {
        Self {
            q: *q,
            sin_cos: *sin_cos,
        }
    }
}
