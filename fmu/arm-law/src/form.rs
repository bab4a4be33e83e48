//! The coordinates in which the nominal lives, and the law in them.

use crate::joint_space::{JointGains, JointParameters, JointSpace, Nominal};
use crate::kinematics::{Kinematics, Pose};
use crate::limits::Limits;
use crate::task_space::{Outcome, TaskSpace};
use admittance::{Bounds, Gains, Ledger, ParameterError, Reach, Real, Request, Settings};
use nalgebra::{Matrix3, Vector3};

/// The coordinates in which the nominal lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Space {
    /// The handle's: a mass at the handle (eq:obs_dyn_cart).
    Task,
    /// The joints': a light arm of rigid links (eq:obs_dyn). It knows no singularity.
    Joint,
}

/// The law in one of its coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[allow(
    clippy::large_enum_variant,
    reason = "there is no heap to put the larger one on"
)]
pub(crate) enum Form {
    Task(TaskSpace),
    Joint(JointSpace),
}

impl Form {
    /// At the handle. The caller has checked `limits`.
    pub fn task(
        settings: Settings,
        gains: [Gains; 3],
        bounds: [Bounds; 3],
        reach: Reach<3>,
        limits: Limits,
    ) -> Result<Self, ParameterError> {
        TaskSpace::new(settings, gains, bounds, reach, limits).map(Self::Task)
    }

    /// In the joints. The caller has checked `limits`.
    pub fn joint(
        settings: Settings,
        parameters: &JointParameters,
        kinematics: Kinematics,
        reach: Reach<3>,
        limits: Limits,
    ) -> Result<Self, ParameterError> {
        JointSpace::new(settings, parameters, kinematics, reach, limits).map(Self::Joint)
    }

    /// Other gains at the handle; in joint space they are checked and have no effect.
    pub fn tune(&mut self, gains: [Gains; 3]) -> Result<(), ParameterError> {
        match self {
            Self::Task(law) => law.tune(gains),
            Self::Joint(_) => (1..)
                .zip(&gains)
                .try_for_each(|(axis, gains)| gains.check(Some(axis))),
        }
    }

    /// Other gains of the joints; in task space they are checked and have no effect.
    pub fn tune_joints(&mut self, gains: JointGains) -> Result<(), ParameterError> {
        match self {
            Self::Task(_) => gains.check(),
            Self::Joint(law) => law.tune(gains),
        }
    }

    /// Whether the nominal is to be slowed before a singularity.
    pub fn knows_singularities(&self) -> bool {
        matches!(self, Self::Task(_))
    }

    /// One tick in the loop. `request.speed` is that of the nominal's own coordinates, m/s or rad/s.
    pub fn step(
        &mut self,
        pose: &Pose,
        q: &Vector3<Real>,
        f_h: &Vector3<Real>,
        request: &Request<3>,
    ) -> (Outcome, Nominal) {
        match self {
            Self::Task(law) => (law.step(pose, q, f_h, request), no_joints(q)),
            Self::Joint(law) => law.step(pose, q, f_h, request),
        }
    }

    /// One tick out of the loop.
    pub fn rest(&mut self, pose: &Pose, q: &Vector3<Real>) -> (Outcome, Nominal) {
        match self {
            Self::Task(law) => (law.rest(pose, q), no_joints(q)),
            Self::Joint(law) => law.rest(pose, q),
        }
    }

    /// The same when the sample that ends cannot be told in finite numbers.
    pub fn abandon(&mut self, pose: &Pose, q: &Vector3<Real>) -> (Outcome, Nominal) {
        match self {
            Self::Task(law) => (law.abandon(pose), no_joints(q)),
            Self::Joint(law) => law.abandon(pose, q),
        }
    }

    /// The nominal's velocity in its own coordinates, m/s or rad/s.
    pub fn velocity(&self, outcome: &Outcome, nominal: &Nominal) -> Vector3<Real> {
        match self {
            Self::Task(_) => outcome.dp_n,
            Self::Joint(_) => nominal.dq_n,
        }
    }

    /// Energy stored and created, as of the last tick.
    pub fn ledger(&self) -> &Ledger<3> {
        match self {
            Self::Task(law) => law.ledger(),
            Self::Joint(law) => law.ledger(),
        }
    }
}

/// The joints of a nominal that lives at the handle: the robot's, at rest.
fn no_joints(q: &Vector3<Real>) -> Nominal {
    Nominal::at(q, Matrix3::zeros())
}
