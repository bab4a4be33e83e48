//! The limits as edges of the handle's velocity.

use super::Workspace;
use crate::kinematics::{Kinematics, Pose, Slopes};
use admittance::edges::Edge;
use admittance::{Real, real};
use nalgebra::Vector3;

/// Edges of the workspace: two for each joint, one for the yaw axis.
pub const EDGES: usize = 7;

/// Distance from a limit (rad) from which on it is looked at, beside what slowing takes: more than a nominal that runs ahead
/// of its joint.
const LOOK: Real = 0.25;
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
    /// slowing_time in samples: how much further a joint goes that is slowed from now on, over what it moved in the last one
    samples: Real,
    /// distance from the yaw axis below which it is near, m
    radius: Real,
    /// the handle's largest distance from the pitch axes, m
    arm: Real,
}

/// The limits where any is near: n·dp ≤ d/slowing_time at the robot, two for each joint and one for the yaw axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    n: [Vector3<Real>; EDGES],
    d: [Real; EDGES],
    slowing_time: Real,
}

impl Limits {
    /// Those of `workspace` on an arm of these lengths; joint angles are counted from zero.
    pub fn new(workspace: Workspace, kinematics: Kinematics, T: Real) -> Self {
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
            samples: workspace.slowing_time / T,
            radius: workspace.radius_min + LOOK_RADIUS,
            arm: kinematics.L1 + kinematics.handle_x + real::abs(kinematics.handle_z),
        }
    }

    /// The same with joint angles counted from `q_0` (rad).
    #[must_use]
    pub fn counted_from(self, q_0: &Vector3<Real>) -> Self {
        Self {
            q_0: *q_0,
            middle: self.middle + self.q_0 - q_0,
            ..self
        }
    }

    /// Whether no limit is near at joint angles `q` (rad), where the arm is at `pose` and comes from a `motion` (rad) in a
    /// sample, as far as that is known.
    #[inline]
    pub fn are_far(&self, q: &Vector3<Real>, motion: Option<&Vector3<Real>>, pose: &Pose) -> bool {
        let Some(motion) = motion else {
            return false;
        };
        let moved = real::abs(motion.x) + real::abs(motion.y) + real::abs(motion.z);
        let go_on = moved * self.samples;
        let radius = pose.J.m21 * pose.sin_cos[0].1 - pose.J.m11 * pose.sin_cos[0].0;
        (0..3).all(|i| real::abs(q[i] - self.middle[i]) + go_on < self.wide[i])
            && self.radius + go_on * self.arm < radius
    }

    /// The limits at joint angles `q` (rad), where the arm is at `pose`.
    #[cold]
    pub fn at(&self, q: &Vector3<Real>, pose: &Pose) -> Near {
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
        let angle = q + self.q_0;
        // Times |scale|, so that an elbow bent the other way counts the right way round.
        let up = |i: usize| joints[i] * if scales[i] < 0.0 { -1.0 } else { 1.0 };
        let above = |i: usize| (q_max[i] - angle[i]) * real::abs(scales[i]);
        let below = |i: usize| (angle[i] - q_min[i]) * real::abs(scales[i]);
        let (sin, cos) = pose.sin_cos[0];
        let inwards = Vector3::new(-cos, -sin, 0.0);
        let [one, two, three] = [up(0), up(1), up(2)];
        Near {
            n: [one, -one, two, -two, three, -three, inwards],
            d: [
                above(0),
                below(0),
                above(1),
                below(1),
                above(2),
                below(2),
                radius - radius_min,
            ],
            slowing_time,
        }
    }
}

impl Near {
    /// The edges of a nominal that is `e` (m) ahead of the handle.
    pub fn edges(&self, e: &Vector3<Real>) -> [Edge<3>; EDGES] {
        core::array::from_fn(|j| {
            let (n, d) = (self.n[j], self.d[j]);
            Edge {
                n,
                c: real::max(0.0, d - n.dot(e)) / self.slowing_time,
            }
        })
    }
}
