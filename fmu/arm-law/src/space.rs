//! The coordinates in which the nominal lives, and the law in them.

use crate::handle::{HandleTick, NotFinite};
use crate::joint_space::{JointGains, JointServo, JointSpace, Nominal};
use crate::kinematics::{Kinematics, Pose};
use crate::parameters::Checked;
use crate::task_space::TaskSpace;
use admittance::{Gains, Ledger, ParameterError, Real, Request};
use nalgebra::Vector3;

/// The coordinates in which the nominal lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Space {
    /// The handle's: a mass at the handle (eq:obs_dyn_cart).
    Task,
    /// The joints': a light arm of rigid links (eq:obs_dyn). It knows no singularity.
    Joint,
}

/// The law in one of its spaces.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[allow(
    clippy::large_enum_variant,
    reason = "there is no heap to put the larger one on"
)]
pub(crate) enum InSpace {
    Task(TaskSpace),
    Joint(JointSpace),
    /// joint space, for drives that take positions
    Servo(JointServo),
}

impl InSpace {
    /// The law at the handle.
    #[inline(never)]
    pub fn task(checked: &Checked, kinematics: Kinematics) -> Result<Self, ParameterError> {
        let Checked {
            settings,
            gains,
            bounds,
            reach,
            limits,
            workspace,
            ..
        } = *checked;
        let law = TaskSpace::new(settings, gains, bounds, reach, limits)?;
        Ok(Self::Task(law.within(workspace, kinematics)))
    }

    /// The law at the joints.
    #[inline(never)]
    pub fn joint(checked: &Checked, kinematics: Kinematics) -> Result<Self, ParameterError> {
        let Checked {
            settings,
            reach,
            limits,
            joint,
            workspace,
            ..
        } = *checked;
        let law = JointSpace::new(settings, &joint, kinematics, reach, limits)?;
        Ok(Self::Joint(law.within(workspace)))
    }

    /// The same for joints with drives.
    #[inline(never)]
    pub fn servo(checked: &Checked, kinematics: Kinematics) -> Result<Self, ParameterError> {
        let Checked {
            settings,
            reach,
            limits,
            joint,
            workspace,
            ..
        } = *checked;
        let law = JointServo::new(settings, &joint, kinematics, reach, limits.tau_max)?;
        Ok(Self::Servo(law.within(workspace)))
    }

    /// Other gains at the handle; in joint space they are checked and have no effect.
    pub fn tune(&mut self, gains: [Gains; 3]) -> Result<(), ParameterError> {
        match self {
            Self::Task(law) => law.tune(gains),
            Self::Joint(_) | Self::Servo(_) => (1..)
                .zip(&gains)
                .try_for_each(|(axis, gains)| gains.check(Some(axis))),
        }
    }

    /// Other gains of the joints; in task space they are checked and have no effect.
    pub fn tune_joints(&mut self, gains: JointGains) -> Result<(), ParameterError> {
        match self {
            Self::Task(_) => gains.check(),
            Self::Joint(law) => law.tune(gains),
            Self::Servo(law) => law.tune(gains),
        }
    }

    /// Whether the nominal is to be slowed before a singularity.
    pub const fn knows_singularities(&self) -> bool {
        match self {
            Self::Task(_) => true,
            Self::Joint(_) | Self::Servo(_) => false,
        }
    }

    /// One tick in the loop. `request.speed` is that of the nominal's own coordinates, m/s or rad/s; `nominal` is one at rest
    /// without a mass, and stays so in task space.
    #[inline]
    pub fn step(
        &mut self,
        pose: &Pose,
        q: &Vector3<Real>,
        f_h: &Vector3<Real>,
        request: &Request<3>,
        shown: &mut HandleTick,
        nominal: &mut Nominal,
    ) -> Result<(), NotFinite> {
        match self {
            Self::Task(law) => {
                nominal.q_n = *q; // it has no joints of its own
                law.step(pose, q, f_h, request, shown)
            }
            Self::Joint(law) => law.step(pose, q, f_h, request, shown, nominal),
            Self::Servo(law) => law.step(pose, q, f_h, request, shown, nominal),
        }
    }

    /// One tick out of the loop.
    pub fn rest(
        &mut self,
        pose: &Pose,
        q: &Vector3<Real>,
        shown: &mut HandleTick,
        nominal: &mut Nominal,
    ) -> Result<(), NotFinite> {
        match self {
            Self::Task(law) => {
                nominal.q_n = *q; // it has no joints of its own
                law.rest(pose, q, shown)
            }
            Self::Joint(law) => law.rest(pose, q, shown, nominal),
            Self::Servo(law) => law.rest(pose, q, shown, nominal),
        }
    }

    /// The same when the sample that ends cannot be told in finite numbers.
    pub fn abandon(
        &mut self,
        pose: &Pose,
        q: &Vector3<Real>,
        shown: &mut HandleTick,
        nominal: &mut Nominal,
    ) {
        match self {
            Self::Task(law) => {
                nominal.q_n = *q; // it has no joints of its own
                law.abandon(pose, shown);
            }
            Self::Joint(law) => law.abandon(pose, q, shown, nominal),
            Self::Servo(law) => law.abandon(pose, q, shown, nominal),
        }
    }

    /// The nominal's velocity in its own coordinates, m/s or rad/s.
    pub const fn velocity<'a>(
        &self,
        shown: &'a HandleTick,
        nominal: &'a Nominal,
    ) -> &'a Vector3<Real> {
        match self {
            Self::Task(_) => &shown.dp_n,
            Self::Joint(_) | Self::Servo(_) => &nominal.dq_n,
        }
    }

    /// Sample period, s.
    pub fn T(&self) -> Real {
        match self {
            Self::Task(law) => law.T(),
            Self::Joint(law) => law.T(),
            Self::Servo(law) => law.T(),
        }
    }

    /// A torque begins to act this `part` of a sample after its tick; only with a delay.
    pub fn lag(&mut self, part: Real) {
        match self {
            Self::Task(law) => law.lag(part),
            Self::Joint(law) => law.lag(part),
            Self::Servo(_) => {} // the torque is measured as it acts
        }
    }

    /// The torque of the last tick begins to act at the joint angles `q` (rad); `None` where they are not known.
    pub fn acts(&mut self, q: Option<&Vector3<Real>>) {
        match self {
            Self::Task(law) => law.acts(q),
            Self::Joint(law) => law.acts(q),
            Self::Servo(_) => {}
        }
    }

    /// What the joints last got, N·m.
    pub fn tau(&self) -> &Vector3<Real> {
        match self {
            Self::Task(law) => law.tau(),
            Self::Joint(law) => law.tau(),
            Self::Servo(law) => law.tau(),
        }
    }

    /// Energy stored and created, as of the last tick.
    pub fn ledger(&self) -> &Ledger<3> {
        match self {
            Self::Task(law) => law.ledger(),
            Self::Joint(law) => law.ledger(),
            Self::Servo(law) => law.ledger(),
        }
    }
}
