//! The joint-space form: the parameters `joint.*` and `nominal.*`.

use crate::Real;
use crate::gains::bounds;
use crate::refusal::{Bad, truth};
use admittance::Bounds;
use arm_law::joint_space::JointGains;
use arm_law::nominal::{Link, NominalArm};
use nalgebra::Vector3;

/// Gains of the joints, used in joint space.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct ArmJointGains {
    /// Nominal damping of each joint, N·m·s/rad, ≥ 0.
    pub D_n: [Real; 3],
    /// Control gain, N·m·s/rad, > 0.
    pub K: Real,
    /// Ratio of each joint's coupling spring to its damper, 1/s, > 0.
    pub K_P: [Real; 3],
}

/// Limits of the nominal in joint space.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct ArmJoint {
    /// Largest speed of each nominal joint, rad/s; 0 = no limit.
    pub dq_n_max: [Real; 3],
    /// Whether the nominal keeps to q_n_min … q_n_max.
    pub q_n_box: i32,
    /// Least angle of each nominal joint, rad.
    pub q_n_min: [Real; 3],
    /// Largest angle of each nominal joint, rad.
    pub q_n_max: [Real; 3],
}

/// The nominal arm of the joint-space form, by link; moments of inertia about the centre of gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct ArmNominal {
    /// Mass, kg.
    pub m: [Real; 3],
    /// Centre of gravity along the link, m.
    pub x: [Real; 3],
    /// Centre of gravity across the link, m.
    pub z: [Real; 3],
    /// kg·m².
    pub I_xx: [Real; 3],
    /// kg·m².
    pub I_yy: [Real; 3],
    /// kg·m².
    pub I_zz: [Real; 3],
    /// kg·m².
    pub I_xz: [Real; 3],
    /// Inertia of each joint about its own axis, kg·m², > 0.
    pub rotor: [Real; 3],
}

impl Default for ArmJointGains {
    /// Those of ArmController.fmu.
    fn default() -> Self {
        let JointGains { D_n, K, K_P, .. } = JointGains::default();
        Self {
            D_n: D_n.into(),
            K,
            K_P: K_P.into(),
        }
    }
}

impl Default for ArmJoint {
    /// Those of ArmController.fmu.
    fn default() -> Self {
        Self {
            dq_n_max: [0.0; 3],
            q_n_box: 0,
            q_n_min: [-1.2, -2.0, 0.1],
            q_n_max: [1.2, 1.0, 2.6],
        }
    }
}

impl Default for ArmNominal {
    /// Those of ArmController.fmu.
    fn default() -> Self {
        let NominalArm { links, rotor } = NominalArm::default();
        Self {
            m: links.map(|link| link.m),
            x: links.map(|link| link.x),
            z: links.map(|link| link.z),
            I_xx: links.map(|link| link.I_xx),
            I_yy: links.map(|link| link.I_yy),
            I_zz: links.map(|link| link.I_zz),
            I_xz: links.map(|link| link.I_xz),
            rotor: rotor.into(),
        }
    }
}

impl ArmJointGains {
    /// The law's gains; each joint's limit is `tau_max` (N·m).
    pub(crate) fn of_law(&self, tau_max: &[Real; 3]) -> JointGains {
        JointGains {
            D_n: self.D_n.into(),
            K: self.K,
            K_P: self.K_P.into(),
            tau_max: (*tau_max).into(),
        }
    }
}

impl ArmJoint {
    /// The law's limits.
    pub(crate) fn of_law(&self) -> Result<[Bounds; 3], Bad> {
        let is_boxed = truth("joint.q_n_box", self.q_n_box)?;
        let of_joint = |speed, low, high| bounds(speed, is_boxed.then_some((low, high)));
        let all: [Bounds; 3] = Vector3::from(self.dq_n_max)
            .zip_zip_map(&self.q_n_min.into(), &self.q_n_max.into(), of_joint)
            .into();
        for (joint, bounds) in (1..).zip(&all) {
            bounds
                .check(Some(joint))
                .map_err(|error| Bad::from_law(error, renamed))?;
        }
        Ok(all)
    }
}

/// A name of a limit under its name in this interface.
fn renamed(name: &'static str) -> &'static str {
    match name {
        "speed_max" => "joint.dq_n_max",
        "q_min" => "joint.q_n_min",
        "q_max" => "joint.q_n_max",
        other => other,
    }
}

impl ArmNominal {
    /// The law's nominal arm.
    pub(crate) fn of_law(&self) -> NominalArm {
        let [m, x, z, I_xx, I_yy, I_zz, I_xz] = [
            self.m, self.x, self.z, self.I_xx, self.I_yy, self.I_zz, self.I_xz,
        ]
        .map(Vector3::from);
        let place = m.zip_zip_map(&x, &z, |m, x, z| (m, x, z));
        let inertia = I_xx.zip_zip_map(&I_yy, &I_zz, |I_xx, I_yy, I_zz| (I_xx, I_yy, I_zz));
        let link = |(m, x, z), (I_xx, I_yy, I_zz), I_xz| Link {
            m,
            x,
            z,
            I_xx,
            I_yy,
            I_zz,
            I_xz,
        };
        NominalArm {
            links: place.zip_zip_map(&inertia, &I_xz, link).into(),
            rotor: self.rotor.into(),
        }
    }
}
