//! The gains of the joint-space form.
//!
//! K is one number for all joints. With a diagonal K that is not a multiple of I, the storage ½ v_nᵀ K M_n v_n is none
//! (K M_n is not symmetric) and a free robot can be unstable (`tests/joint_gain.rs` has one). K_P may differ from joint to
//! joint: the springs' energy ½ k eᵀ K_P e is a sum over joints whatever M_n is.

use admittance::bounds::boxed;
use admittance::parameters::{check, limit};
use admittance::retune::Gradual;
use admittance::{Bounds, Gains, ParameterError, Real};
use fmu_declaration::range::{NOT_NEGATIVE, POSITIVE};
use fmu_declaration::{Rows, Start};
use nalgebra::Vector3;

/// What may be changed during a run.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct JointGains {
    /// Nominal damping of each joint, N·m·s/rad, ≥ 0.
    pub D_n: Vector3<Real>,
    /// Control gain, N·m·s/rad, > 0: K = K·I.
    pub K: Real,
    /// Ratio of each joint's coupling spring to its damper, 1/s, > 0.
    pub K_P: Vector3<Real>,
    /// Largest torque of each joint, N·m, > 0. Infinite where nothing but the caller limits.
    pub tau_max: Vector3<Real>,
}

impl Default for JointGains {
    /// The start values of [`JointSettings`], under the torques of the exoskeleton arm.
    fn default() -> Self {
        JointSettings::default().gains(&crate::ArmParameters::default().tau_max)
    }
}

impl Gradual for JointGains {
    fn toward(&self, wanted: &Self, remaining: u32) -> Self {
        let joints = [0, 1, 2].map(|i| self.of(i).toward(&wanted.of(i), remaining));
        Self {
            D_n: Vector3::from(joints.map(|joint| joint.D_n)),
            K: joints[0].K,
            K_P: Vector3::from(joints.map(|joint| joint.K_P)),
            tau_max: Vector3::from(joints.map(|joint| joint.f_max)),
        }
    }
}

impl JointGains {
    /// Joint `i` (from 0) for the rules of one axis. They look at ratios of masses, and M_n does not change with the gains.
    pub(super) fn of(&self, i: usize) -> Gains {
        Gains {
            M_n: 1.0,
            D_n: self.D_n[i],
            K: self.K,
            K_P: self.K_P[i],
            f_max: self.tau_max[i],
        }
    }

    /// Whether a law can be built with them.
    ///
    /// # Errors
    /// The first parameter out of its range, with the joint's number.
    pub fn check(&self) -> Result<(), ParameterError> {
        check(None, &[("joint.K", self.K, POSITIVE)])?;
        (1..4)
            .zip(&self.D_n)
            .zip(&self.K_P)
            .zip(&self.tau_max)
            .try_for_each(|(((joint, D_n), K_P), tau_max)| {
                check(
                    Some(joint),
                    &[
                        ("joint.D_n", *D_n, NOT_NEGATIVE),
                        ("joint.K_P", *K_P, POSITIVE),
                        ("tau_max", limit(*tau_max), POSITIVE),
                    ],
                )
            })
    }
}

/// The parameters `joint.*`: what the form in joint space has of its own. The start values are about the task-space gains
/// (1000 N·s/m, 20 N·s/m) at the start pose: seen from the handle, D_n/(JJᵀ)_zz is 15 N·s/m and K/(JJᵀ)_zz 1500 N·s/m. The
/// unit damper alpha is then 3.7 N·s/m, so a load sinks faster than at the handle.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct JointSettings {
    /// Nominal damping of each joint in joint space (eq:nom_dyn).
    #[parameter(118, name = "joint.D_n[i]", unit = NEWTON_METRE_SECOND_PER_RADIAN, range = NOT_NEGATIVE, tunable, start = [4.0; 3])]
    pub D_n: [Real; 3],
    /// Control gain in joint space, 1/epsilon of the paper (eq:dob_input); one number for all joints, because with
    /// different ones a free robot can be unstable.
    #[parameter(119, name = "joint.K", unit = NEWTON_METRE_SECOND_PER_RADIAN, range = POSITIVE, tunable, start = 400.0)]
    pub K: Real,
    /// Ratio of each joint's coupling spring to its damper in joint space (eq:dob_input).
    #[parameter(120, name = "joint.K_P[i]", unit = PER_SECOND, range = POSITIVE, tunable, start = [20.0; 3])]
    pub K_P: [Real; 3],
    /// Largest speed of the nominal's joints in joint space; 0 = no limit.
    #[parameter(121, name = "joint.dq_n_max[i]", unit = RADIAN_PER_SECOND, range = NOT_NEGATIVE)]
    pub dq_n_max: [Real; 3],
    /// Whether the nominal keeps within joint.q_n_min and joint.q_n_max in joint space.
    #[parameter(122, name = "joint.q_n_box", boolean)]
    pub q_n_box: i32,
    /// Least angles of the nominal's joints.
    #[parameter(123, name = "joint.q_n_min[i]", unit = RADIAN, start = [-1.2, -2.0, 0.1])]
    pub q_n_min: [Real; 3],
    /// Largest angles of the nominal's joints.
    #[parameter(124, name = "joint.q_n_max[i]", unit = RADIAN, start = [1.2, 1.0, 2.6])]
    pub q_n_max: [Real; 3],
}

impl JointSettings {
    /// The gains. Each joint's limit is `tau_max` (N·m).
    pub fn gains(&self, tau_max: &[Real; 3]) -> JointGains {
        JointGains {
            D_n: self.D_n.into(),
            K: self.K,
            K_P: self.K_P.into(),
            tau_max: (*tau_max).into(),
        }
    }

    /// Limits of the nominal's angles (rad) and velocities (rad/s).
    ///
    /// # Errors
    /// A largest angle that does not exceed the least one.
    pub fn bounds(&self) -> Result<[Bounds; 3], ParameterError> {
        boxed(
            "joint.q_n_max",
            self.q_n_box != 0,
            &self.q_n_min,
            &self.q_n_max,
            &self.dq_n_max,
        )
    }
}
