//! From where joint angles and positions are counted.

use super::{ArmLaw, NotFinite};
use crate::displacement::Origin;
use crate::kinematics::{Pose, sin_cos};
use crate::signals::ArmInputs;
use crate::space::InSpace;
use admittance::origin::Move;
use admittance::{ParameterError, Real};
use nalgebra::Vector3;

impl ArmLaw {
    /// Counts from the joint angles `q_0` (rad) and from where the handle is there, from the next tick on: `q` of the
    /// [`ArmInputs`], and p, p_n of the [`ArmOutputs`](crate::ArmOutputs). The [`Bounds`](admittance::Bounds) stay where they are.
    /// Only while the law is out of the loop, and in task space; in joint space nothing changes.
    ///
    /// Single precision needs it, see [`displacement`](crate::displacement).
    ///
    /// # Errors
    /// A bound that the origin's distance rounds away; the origin stays as it was.
    pub fn count_from(&mut self, q_0: &Vector3<Real>) -> Result<(), ParameterError> {
        let task_space = match &mut self.law {
            InSpace::Task(law) => law,
            InSpace::Joint(_) | InSpace::Servo(_) => return Ok(()),
        };
        let origin = Origin::new(&self.kinematics, q_0);
        let mut bounds = self.bounds;
        for (bounds, p_0) in bounds.iter_mut().zip(origin.p()) {
            bounds.q_min -= p_0;
            bounds.q_max -= p_0;
        }
        let by = q_0 - self.origin.map_or(Vector3::zeros(), |before| *before.q());
        task_space.count_from(q_0, &by, bounds)?;
        self.q -= by;
        self.origin = Some(origin);
        Ok(())
    }

    /// Position of the handle from which positions are counted, base frame, m; `None`: from zero.
    pub fn origin(&self) -> Option<&Vector3<Real>> {
        self.origin.as_ref().map(Origin::p)
    }

    /// Joint angles counted from zero, rad.
    pub fn absolute(&self, q: &Vector3<Real>) -> Vector3<Real> {
        self.origin.map_or(*q, |origin| origin.q() + q)
    }

    /// The handle at the joint angles `q` (rad).
    #[inline]
    pub(super) fn pose(&self, q: &Vector3<Real>) -> Pose {
        match &self.origin {
            Some(origin) => origin.displaced(&self.kinematics, q),
            None => self.kinematics.turned(&sin_cos(q)),
        }
    }

    /// Whether it may engage at a tick, and positions are counted.
    pub(super) fn may_engage(&self, inputs: &ArmInputs) -> bool {
        match self.law {
            InSpace::Task(_) => inputs.engage != 0,
            InSpace::Joint(_) | InSpace::Servo(_) => false,
        }
    }

    /// The joint angles `q` (rad) from where they are counted. In joint space that is zero: the nominal arm is one at the
    /// angles themselves.
    pub(super) fn counted(
        &mut self,
        q: &Vector3<f64>,
        inputs: &ArmInputs,
    ) -> Result<Vector3<Real>, NotFinite> {
        let may_engage = self.may_engage(inputs);
        if let Some(Move { q_0, .. }) = self.counting.moves(q, may_engage) {
            self.count_from(&q_0).map_err(|_| NotFinite)?;
        }
        Ok(self.counting.counted(q))
    }
}
