//! The table of the arm as the interface has it: one vector a row, where [`mechanics::arm::Parameters`] has one link, one
//! joint at a time.

use mechanics::arm::kinematics::{InPlane, Lengths};
use mechanics::arm::parameters::Stops;
use mechanics::arm::payload::Vacuum;
use mechanics::arm::rigid_body::{self, Masses};
use mechanics::arm::stribeck::Stribeck;
use mechanics::arm::surface::Surface;
use mechanics::arm::{self, Start};
use serde::{Deserialize, Serialize};

/// What the arm is made of and where it starts. Units and bounds in [`variables`](crate::variables).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "a variable is described once, in its row")]
pub struct Parameters {
    pub A_1: f64,
    pub L_1: f64,
    pub handle: InPlane,
    pub pad: InPlane,
    pub link: Links,
    pub rotor_I: [f64; 3],
    pub gear: [f64; 3],
    pub gravity: [f64; 3],
    pub friction: Friction,
    pub stop_min: [f64; 3],
    pub stop_max: [f64; 3],
    pub drive_cutoff: f64,
    pub payload_m: f64,
    pub payload_attached: bool,
    pub vacuum: Vacuum,
    pub table: Surface,
    pub wall: Surface,
    pub q_start: [f64; 3],
    pub dq_start: [f64; 3],
}

/// The links, element i of each field one link.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "a variable is described once, in its row")]
pub struct Links {
    pub m: [f64; 3],
    pub x: [f64; 3],
    pub z: [f64; 3],
    pub I_xx: [f64; 3],
    pub I_yy: [f64; 3],
    pub I_zz: [f64; 3],
    pub I_xz: [f64; 3],
}

/// Friction of the joints, element i of each field one joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "a variable is described once, in its row")]
pub struct Friction {
    pub F_c: [f64; 3],
    pub F_s: [f64; 3],
    pub v_s: [f64; 3],
    pub b: [f64; 3],
}

impl Default for Parameters {
    /// Those of [`mechanics::arm::Parameters`] and [`Start`].
    fn default() -> Self {
        let arm::Parameters {
            lengths,
            masses,
            friction,
            stops,
            drive_cutoff,
            payload_m,
            vacuum,
            table,
            wall,
        } = arm::Parameters::default();
        let Start { q, dq, attached } = Start::default();
        let Lengths {
            A_1,
            L_1,
            handle,
            pad,
        } = lengths;
        let links = masses.links;
        Self {
            A_1,
            L_1,
            handle,
            pad,
            link: Links {
                m: links.map(|link| link.m),
                x: links.map(|link| link.x),
                z: links.map(|link| link.z),
                I_xx: links.map(|link| link.I_xx),
                I_yy: links.map(|link| link.I_yy),
                I_zz: links.map(|link| link.I_zz),
                I_xz: links.map(|link| link.I_xz),
            },
            rotor_I: masses.rotor,
            gear: masses.gear,
            gravity: masses.gravity,
            friction: Friction {
                F_c: friction.map(|joint| joint.F_c),
                F_s: friction.map(|joint| joint.F_s),
                v_s: friction.map(|joint| joint.v_s),
                b: friction.map(|joint| joint.b),
            },
            stop_min: stops.map(|joint| joint.min),
            stop_max: stops.map(|joint| joint.max),
            drive_cutoff,
            payload_m,
            payload_attached: attached,
            vacuum,
            table,
            wall,
            q_start: q,
            dq_start: dq,
        }
    }
}

impl Parameters {
    /// As the plant takes them.
    pub fn plant(&self) -> (arm::Parameters, Start) {
        let link = |i: usize| rigid_body::Link {
            m: self.link.m[i],
            x: self.link.x[i],
            z: self.link.z[i],
            I_xx: self.link.I_xx[i],
            I_yy: self.link.I_yy[i],
            I_zz: self.link.I_zz[i],
            I_xz: self.link.I_xz[i],
        };
        let friction = |i: usize| Stribeck {
            F_c: self.friction.F_c[i],
            F_s: self.friction.F_s[i],
            v_s: self.friction.v_s[i],
            b: self.friction.b[i],
        };
        let stops = |i: usize| Stops {
            min: self.stop_min[i],
            max: self.stop_max[i],
        };
        let parameters = arm::Parameters {
            lengths: Lengths {
                A_1: self.A_1,
                L_1: self.L_1,
                handle: self.handle,
                pad: self.pad,
            },
            masses: Masses {
                links: [0, 1, 2].map(link),
                rotor: self.rotor_I,
                gear: self.gear,
                gravity: self.gravity,
            },
            friction: [0, 1, 2].map(friction),
            stops: [0, 1, 2].map(stops),
            drive_cutoff: self.drive_cutoff,
            payload_m: self.payload_m,
            vacuum: self.vacuum,
            table: self.table,
            wall: self.wall,
        };
        let start = Start {
            q: self.q_start,
            dq: self.dq_start,
            attached: self.payload_attached,
        };
        (parameters, start)
    }
}
