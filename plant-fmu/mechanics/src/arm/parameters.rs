//! What the arm is made of, and where it starts.

use super::kinematics::{InPlane, Lengths};
use super::payload::Vacuum;
use super::rigid_body::{Link, Masses};
use super::stribeck::Stribeck;
use super::surface::Surface;

/// Hard inelastic stops of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Stops {
    /// Lower stop (rad).
    pub min: f64,
    /// Upper stop (rad).
    pub max: f64,
}

/// What the arm is made of. The default is the exoskeleton arm with an empty pad and nothing to touch.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Parameters {
    /// Lengths, handle and pad.
    pub lengths: Lengths,
    /// Links, rotors, gears, gravity.
    pub masses: Masses,
    /// Friction of each joint.
    pub friction: [Stribeck; 3],
    /// Stops of each joint.
    pub stops: [Stops; 3],
    /// Corner frequency of the torque's first-order lag (Hz); 0 = no lag.
    pub drive_cutoff: f64,
    /// Mass of the payload (kg), a point at the pad; 0 = none.
    pub payload_m: f64,
    /// The cup that holds the payload.
    pub vacuum: Vacuum,
    /// Horizontal surface under the pad; its position is z, −10 m is out of reach.
    pub table: Surface,
    /// Vertical surface in front of the pad; its position is x, 10 m is out of reach.
    pub wall: Surface,
}

/// Where the arm starts.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Start {
    /// Joint angles (rad).
    pub q: [f64; 3],
    /// Joint velocities (rad/s).
    pub dq: [f64; 3],
    /// Whether the payload hangs at the pad already.
    pub attached: bool,
}

impl Default for Start {
    /// At rest, handle at (0.44, 0, −0.24) m, no payload.
    fn default() -> Self {
        Self {
            q: [0.0, -1.48096, 1.70138],
            dq: [0.0; 3],
            attached: false,
        }
    }
}

impl Default for Parameters {
    fn default() -> Self {
        let link = |m, (x, z), [I_xx, I_yy, I_zz, I_xz]: [f64; 4]| Link {
            m,
            x,
            z,
            I_xx,
            I_yy,
            I_zz,
            I_xz,
        };
        let friction = |F_c, F_s, b| Stribeck {
            F_c,
            F_s,
            v_s: 0.03,
            b,
        };
        let stops = |min, max| Stops { min, max };
        let surface = |position| Surface {
            position,
            k: 1e5,
            c: 300.0,
            mu: 0.4,
        };
        Self {
            lengths: Lengths {
                A_1: 0.06,
                L_1: 0.32,
                handle: InPlane { x: 0.36, z: 0.0 },
                pad: InPlane { x: 0.36, z: -0.12 },
            },
            masses: Masses {
                links: [
                    link(4.0, (0.03, 0.02), [0.012, 0.012, 0.010, 0.0]),
                    link(3.5, (0.20, 0.01), [0.006, 0.035, 0.034, 0.001]),
                    link(2.5, (0.18, -0.03), [0.004, 0.028, 0.027, -0.001]),
                ],
                rotor: [2.0e-5; 3],
                gear: [354.0, 600.0, 354.0],
                gravity: [0.0, 0.0, -9.81],
            },
            friction: [
                friction(12.0, 16.0, 8.0),
                friction(14.0, 18.0, 15.0),
                friction(12.0, 16.0, 8.0),
            ],
            stops: [stops(-1.2, 1.2), stops(-2.0, 1.0), stops(0.10, 2.60)],
            drive_cutoff: 318.0,
            payload_m: 0.0,
            vacuum: Vacuum::default(),
            table: surface(-10.0),
            wall: surface(10.0),
        }
    }
}
