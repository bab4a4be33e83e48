//! The encoders of the joints.

use core::f64::consts::PI;
use serde::{Deserialize, Serialize};

/// `encoder.kind`: reads the true angle.
pub const IDEAL: i32 = 1;
/// `encoder.kind`: counts on the motor's shaft, before the gear.
pub const MOTOR: i32 = 2;
/// `encoder.kind`: bits on the joint, behind the gear.
pub const JOINT: i32 = 3;

/// An encoder on each joint. It has no clock: it shows the count of the instant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Encoder {
    /// Where it sits: [`IDEAL`], [`MOTOR`] or [`JOINT`].
    pub kind: i32,
    /// Counts per revolution of the motor.
    pub counts: i32,
    /// Bits per revolution of the joint.
    pub bits: i32,
}

impl Default for Encoder {
    /// Ideal, as in the paper's experiments; 2000 counts or 17 bit otherwise.
    fn default() -> Self {
        Self {
            kind: IDEAL,
            counts: 2000,
            bits: 17,
        }
    }
}

impl Encoder {
    /// Angle of one count at a joint with this `gear` ratio (rad); 0 for an ideal encoder.
    ///
    /// ```text
    /// motor side: 2π/(counts · gear),   joint side: 2π/2^bits
    /// ```
    pub fn resolution(&self, gear: f64) -> f64 {
        match self.kind {
            MOTOR => 2.0 * PI / (f64::from(self.counts) * gear),
            JOINT => libm::ldexp(2.0 * PI, -self.bits),
            _ => 0.0,
        }
    }

    /// What it reads at the joint angle `q` (rad): the nearest count, 0 at q = 0.
    pub fn read(&self, q: f64, gear: f64) -> f64 {
        let resolution = self.resolution(gear);
        if resolution > 0.0 {
            libm::round(q / resolution) * resolution
        } else {
            q
        }
    }
}
