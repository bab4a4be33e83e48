//! The variables of the joint-space form, and the law's parameters made of them.

use admittance::Bounds;
use arm_law::joint_space::{JointGains, JointParameters};
use arm_law::nominal::{Link, NominalArm};
use serde::{Deserialize, Serialize};

/// The variables `joint.*`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "a variable is described once, in its row")]
pub struct Joint {
    pub D_n: [f64; 3],
    pub K: f64,
    pub K_P: [f64; 3],
    pub dq_n_max: [f64; 3],
    pub q_n_box: bool,
    pub q_n_min: [f64; 3],
    pub q_n_max: [f64; 3],
}

/// The variables `nominal.*`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "a variable is described once, in its row")]
pub struct Nominal {
    pub m: [f64; 3],
    pub x: [f64; 3],
    pub z: [f64; 3],
    pub I_xx: [f64; 3],
    pub I_yy: [f64; 3],
    pub I_zz: [f64; 3],
    pub I_xz: [f64; 3],
    pub rotor: [f64; 3],
}

impl Default for Joint {
    fn default() -> Self {
        let JointGains { D_n, K, K_P, .. } = JointGains::default();
        Self {
            D_n: D_n.into(),
            K,
            K_P: K_P.into(),
            dq_n_max: [0.0; 3],
            q_n_box: false,
            q_n_min: [-1.2, -2.0, 0.1],
            q_n_max: [1.2, 1.0, 2.6],
        }
    }
}

impl Default for Nominal {
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

impl Joint {
    /// The gains. Each joint's limit is `tau_max` (N·m).
    pub fn gains(&self, tau_max: [f64; 3]) -> JointGains {
        JointGains {
            D_n: self.D_n.into(),
            K: self.K,
            K_P: self.K_P.into(),
            tau_max: tau_max.into(),
        }
    }

    /// The law's parameters, with the nominal arm and each joint's limit `tau_max` (N·m).
    pub fn parameters(&self, nominal: &Nominal, tau_max: [f64; 3]) -> JointParameters {
        JointParameters {
            arm: nominal.arm(),
            gains: self.gains(tau_max),
            bounds: std::array::from_fn(|i| self.bounds(i)),
        }
    }

    /// Limits of joint `i` (from 0) of the nominal; a speed of 0 stands for none.
    fn bounds(&self, i: usize) -> Bounds {
        let none = Bounds::default();
        Bounds {
            speed: if self.dq_n_max[i] == 0.0 {
                none.speed
            } else {
                self.dq_n_max[i]
            },
            q_min: if self.q_n_box {
                self.q_n_min[i]
            } else {
                none.q_min
            },
            q_max: if self.q_n_box {
                self.q_n_max[i]
            } else {
                none.q_max
            },
        }
    }
}

impl Nominal {
    fn arm(&self) -> NominalArm {
        let link = |i: usize| Link {
            m: self.m[i],
            x: self.x[i],
            z: self.z[i],
            I_xx: self.I_xx[i],
            I_yy: self.I_yy[i],
            I_zz: self.I_zz[i],
            I_xz: self.I_xz[i],
        };
        NominalArm {
            links: [link(0), link(1), link(2)],
            rotor: self.rotor.into(),
        }
    }
}
