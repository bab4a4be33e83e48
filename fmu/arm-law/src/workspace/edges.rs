//! The limits as edges of the handle's velocity.

use super::Workspace;
use crate::kinematics::{Kinematics, Pose, Slopes};
use admittance::edges::Edge;
use admittance::{Real, real};
use nalgebra::Vector3;

/// Distance from a limit (rad) from which on it is looked at: more than a nominal that runs ahead of its joint.
const LOOK: Real = 0.4;
/// The same for the distance from the yaw axis, m.
const LOOK_RADIUS: Real = 0.05;

/// The workspace of an arm, with what tells in a few comparisons whether any limit is near.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Limits {
    workspace: Workspace,
    kinematics: Kinematics,
    /// from where joint angles are counted, rad
    q_0: Vector3<Real>,
    /// the middle of each joint's range, counted from there, and how far from it no limit is near
    middle: Vector3<Real>,
    wide: Vector3<Real>,
    /// sigma_min above which the yaw axis is not near: it is no larger than the distance from it
    sigma: Real,
}

/// The limits where any is near: n·dp ≤ d/slowing_time at the robot, one for each joint and one for the yaw axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    n: [Vector3<Real>; 4],
    d: [Real; 4],
    slowing_time: Real,
}

impl Limits {
    /// Those of `workspace` on an arm of these lengths; joint angles are counted from zero.
    pub fn new(workspace: Workspace, kinematics: Kinematics) -> Self {
        let (q_min, q_max) = (
            Vector3::from(workspace.q_min),
            Vector3::from(workspace.q_max),
        );
        Self {
            workspace,
            kinematics,
            q_0: Vector3::zeros(),
            middle: (q_min + q_max) / 2.0,
            wide: (q_max - q_min).map(|range| range / 2.0 - LOOK),
            sigma: workspace.radius_min + LOOK_RADIUS,
        }
    }

    /// The same with joint angles counted from `q_0` (rad).
    #[must_use]
    pub fn counted_from(self, q_0: &Vector3<Real>) -> Self {
        let mut limits = Self::new(self.workspace, self.kinematics);
        limits.q_0 = *q_0;
        limits.middle -= q_0;
        limits
    }

    /// The limits at joint angles `q` (rad), where the arm is at `pose`; `None`: none is near.
    #[inline]
    pub fn near(&self, q: &Vector3<Real>, pose: &Pose) -> Option<Near> {
        let is_far = pose.sigma_min > self.sigma
            && (0..3).all(|i| real::abs(q[i] - self.middle[i]) < self.wide[i]);
        if is_far { None } else { Some(self.at(q, pose)) }
    }

    #[cold]
    fn at(&self, q: &Vector3<Real>, pose: &Pose) -> Near {
        let Workspace {
            q_min,
            q_max,
            radius_min,
            slowing_time,
            ..
        } = self.workspace;
        let Slopes {
            joints,
            scales,
            radius,
        } = self.kinematics.slopes(&pose.sin_cos);
        // The nearer limit of each joint; times |scale|, so that an elbow bent the other way counts the right way round.
        let side = Vector3::from_fn(|i, _| if q[i] > self.middle[i] { 1.0 } else { -1.0 });
        let angle = q + self.q_0;
        let sense = |i: usize| if scales[i] < 0.0 { -side[i] } else { side[i] };
        let left = |i: usize| real::min(q_max[i] - angle[i], angle[i] - q_min[i]);
        let away = Vector3::new(pose.sin_cos[0].1, pose.sin_cos[0].0, 0.0);
        Near {
            n: [
                joints[0] * sense(0),
                joints[1] * sense(1),
                joints[2] * sense(2),
                -away,
            ],
            d: [
                left(0) * real::abs(scales[0]),
                left(1) * real::abs(scales[1]),
                left(2) * real::abs(scales[2]),
                radius - radius_min,
            ],
            slowing_time,
        }
    }
}

impl Near {
    /// The edges of a nominal that is `e` (m) ahead of the handle.
    pub fn edges(&self, e: &Vector3<Real>) -> [Edge<3>; 4] {
        core::array::from_fn(|j| {
            let (n, d) = (self.n[j], self.d[j]);
            Edge {
                n,
                c: real::max(0.0, d - n.dot(e)) / self.slowing_time,
            }
        })
    }
}
