//! The gains of the joint-space form.
//!
//! K is one number for all joints. With a diagonal K that is not a multiple of I, the storage ½ v_nᵀ K M_n v_n is none
//! (K M_n is not symmetric) and a free robot can be unstable (`tests/joint_gain.rs` has one). K_P may differ from joint to
//! joint: the springs' energy ½ k eᵀ K_P e is a sum over joints whatever M_n is.

use admittance::parameters::{LIMIT, NOT_NEGATIVE, POSITIVE, check};
use admittance::retune::Gradual;
use admittance::{Gains, ParameterError, Real};
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
    /// About the task-space gains (1000 N·s/m, 20 N·s/m) at the start pose: seen from the handle, D_n/(JJᵀ)_zz is 15 N·s/m
    /// and K/(JJᵀ)_zz 1500 N·s/m. The unit damper alpha is then 3.7 N·s/m, so a load sinks faster than at the handle.
    fn default() -> Self {
        Self {
            D_n: Vector3::repeat(4.0),
            K: 400.0,
            K_P: Vector3::repeat(20.0),
            tau_max: Vector3::new(153.0, 259.0, 153.0),
        }
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
                        ("tau_max", *tau_max, LIMIT),
                    ],
                )
            })
    }
}
