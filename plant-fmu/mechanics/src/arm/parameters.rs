//! What the arm is made of, and where it starts: one row each, numbered from A1 on. A new row takes the next number that is
//! free in both FMUs of the arm: 64, and not 73 (ExoskeletonArm counts from 36 and ends at 96, ExoskeletonArms from 49; its
//! outputs stand at 101, 102, 111, 112 and 122, its inputs at 107 to 110).

use fmu_declaration::{Rows, Start};

use super::gear_loss::GearLoss;
use super::kinematics::Lengths;
use super::payload::Vacuum;
use super::rigid_body::Masses;
use super::servo::Servo;
use super::stribeck::Stribeck;
use super::surface::{Table, Wall};
use crate::drive::{DRIVE, TORQUE};

/// Hard inelastic stops of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Rows)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Stops {
    /// lower stop of the joint, hard and inelastic
    #[parameter(20, name = "stop.min[i]", unit = RADIAN, range = -10.0..=10.0)]
    pub min: f64,
    /// upper stop of the joint, at least stop.min
    #[parameter(21, name = "stop.max[i]", unit = RADIAN, range = -10.0..=10.0)]
    pub max: f64,
}

/// What the arm is made of. The start values are the exoskeleton arm with an empty pad and nothing to touch.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Parameters {
    /// Lengths, handle and pad.
    #[part]
    pub lengths: Lengths,
    /// Links, rotors, gears, gravity.
    #[part]
    pub masses: Masses,
    /// Friction of each joint.
    #[part(each)]
    #[start([friction(12.0, 16.0, 8.0), friction(14.0, 18.0, 15.0), friction(12.0, 16.0, 8.0)])]
    pub friction: [Stribeck; 3],
    /// Loss of each gear.
    #[part(each)]
    pub gear_loss: [GearLoss; 3],
    /// Stops of each joint.
    #[part(each)]
    #[start([stops(-1.2, 1.2), stops(-2.0, 1.0), stops(0.10, 2.60)])]
    pub stops: [Stops; 3],
    /// corner frequency of the torque's first-order lag; 0: no lag
    #[parameter(22, name = "drive.cutoff", unit = HERTZ, range = 0.0..=1e6, start = 318.0)]
    pub drive_cutoff: f64,
    /// what the drives take
    #[parameter(54, name = "drive.mode", items = DRIVE, start = TORQUE)]
    pub drive_mode: i32,
    /// The loop of each joint's drive, with the gains and limits that ArmController has in joint space.
    #[part(each)]
    #[start([servo(153.0), servo(259.0), servo(153.0)])]
    pub servo: [Servo; 3],
    /// mass of the payload, a point at the pad; 0: none
    #[parameter(23, name = "payload.m", unit = KILOGRAM, range = 0.0..=1e4)]
    pub payload_m: f64,
    /// The cup that holds the payload.
    #[part]
    pub vacuum: Vacuum,
    /// What is under the pad.
    #[part]
    pub table: Table,
    /// What is in front of the pad.
    #[part]
    pub wall: Wall,
}

/// Where the arm starts: at rest, handle at (0.44, 0, −0.24) m, no payload.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Start {
    /// start angle of the joint, between its stops
    #[parameter(35, name = "q_start[i]", unit = RADIAN, range = -10.0..=10.0, start = [0.0, -1.48096, 1.70138])]
    pub q: [f64; 3],
    /// start velocity of the joint
    #[parameter(36, name = "dq_start[i]", unit = RADIAN_PER_SECOND, range = -100.0..=100.0)]
    pub dq: [f64; 3],
    /// whether the payload hangs at the pad from the start on
    #[parameter(24, name = "payload.attached")]
    pub attached: bool,
}

const fn friction(F_c: f64, F_s: f64, b: f64) -> Stribeck {
    let v_s = 0.03;
    Stribeck { F_c, F_s, v_s, b }
}

const fn servo(tau_max: f64) -> Servo {
    let (K, K_P) = (400.0, 20.0);
    Servo { K, K_P, tau_max }
}

const fn stops(min: f64, max: f64) -> Stops {
    Stops { min, max }
}
