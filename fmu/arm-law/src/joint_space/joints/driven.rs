//! The joints as drives can close their couplings.

use super::super::JointGains;
use super::super::boxed::Solution;
use super::{JointProposal, Joints};
use admittance::servo::{Drivable, Drive};
use admittance::{ParameterError, Real};
use nalgebra::Vector3;

impl Joints {
    /// Whether the drives' gains are among `gains` what they were; `names` are those of K, K_P and tau_max in the message.
    ///
    /// # Errors
    /// The first one that is not.
    pub(in super::super) fn of_the_drives(
        &self,
        gains: &JointGains,
        names: [&'static str; 3],
    ) -> Result<(), ParameterError> {
        if gains.K == self.tuning.now().K {
            drive(self.tuning.now()).is_kept(&drive(gains), names)
        } else {
            Err(Drive::<3>::not_kept(names[0], None, gains.K)) // one number for all joints
        }
    }
}

impl Drivable<3> for Joints {
    fn drive(&self) -> Drive<3> {
        drive(self.tuning.now())
    }

    fn v_m(&self, driven: &Solution) -> Vector3<Real> {
        driven.v_m
    }

    fn follow(&mut self, proposal: &JointProposal, driven: &Solution, v_b: &[Option<Real>; 3]) {
        let limited = Vector3::from(v_b.map(|v_b| v_b.is_some()));
        let v_b = Vector3::from(v_b.map(|v_b| v_b.unwrap_or(0.0)));
        self.moved_on(proposal, driven, Some(&(v_b, limited)));
    }
}

/// The loops of drives with these gains.
fn drive(gains: &JointGains) -> Drive<3> {
    Drive {
        K: Vector3::repeat(gains.K),
        K_P: gains.K_P,
        f_max: gains.tau_max,
    }
}
