//! The coordinates in which the nominal lives, and the law in them.

use crate::arm_law::{Done, Shown};
use crate::handle::NotFinite;
use crate::joint_space::{JointGains, JointServo, JointSpace};
use crate::kinematics::{Kinematics, Pose};
use crate::parameters::Checked;
use crate::signals::ArmOutputs;
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

    /// One tick in the loop, `shown` once it is accepted. `request.speed` is that of the nominal's own coordinates, m/s or
    /// rad/s.
    #[inline]
    pub fn step(
        &mut self,
        pose: &Pose,
        q: &Vector3<Real>,
        f_h: &Vector3<Real>,
        request: &Request<3>,
        mut shown: Shown<'_>,
    ) -> Result<(), NotFinite> {
        match self {
            Self::Task(law) => {
                law.step(pose, q, f_h, request, |tick| shown.handle(tick))?;
                shown.no_nominal(q);
            }
            Self::Joint(law) => {
                let mut done = Done::at_rest(pose, q);
                law.step(pose, q, f_h, request, &mut done.handle, &mut done.nominal)?;
                shown.done(&done);
            }
            Self::Servo(law) => {
                let mut done = Done::at_rest(pose, q);
                law.step(pose, q, f_h, request, &mut done.handle, &mut done.nominal)?;
                shown.done(&done);
            }
        }
        Ok(())
    }

    /// One tick out of the loop.
    pub fn rest(
        &mut self,
        pose: &Pose,
        q: &Vector3<Real>,
        mut shown: Shown<'_>,
    ) -> Result<(), NotFinite> {
        let mut done = Done::at_rest(pose, q);
        let Done { handle, nominal } = &mut done;
        match self {
            Self::Task(law) => law.rest(pose, q, handle),
            Self::Joint(law) => law.rest(pose, q, handle, nominal),
            Self::Servo(law) => law.rest(pose, q, handle, nominal),
        }?;
        shown.done(&done);
        Ok(())
    }

    /// The same when the sample that ends cannot be told in finite numbers.
    pub fn abandon(&mut self, pose: &Pose, q: &Vector3<Real>, mut shown: Shown<'_>) {
        let mut done = Done::at_rest(pose, q);
        let Done { handle, nominal } = &mut done;
        match self {
            Self::Task(law) => law.abandon(pose, handle),
            Self::Joint(law) => law.abandon(pose, q, handle, nominal),
            Self::Servo(law) => law.abandon(pose, q, handle, nominal),
        }
        shown.done(&done);
    }

    /// The nominal's velocity in its own coordinates as the `outputs` show it, m/s or rad/s.
    #[inline]
    pub fn velocity(&self, outputs: &ArmOutputs) -> Vector3<Real> {
        match self {
            Self::Task(_) => outputs.dp_n.into(),
            Self::Joint(_) | Self::Servo(_) => outputs.dq_n.into(),
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
