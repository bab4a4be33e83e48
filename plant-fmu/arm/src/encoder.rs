//! The encoders of the joints.

use core::f64::consts::PI;
use fmu_declaration::{Rows, Start, choices};
use serde::{Deserialize, Serialize};

choices! { ENCODER "EncoderKind" "Where the encoders sit":
    IDEAL = 1 "ideal" "reads the true angle";
    MOTOR = 2 "motor" "on the motor's shaft: encoder.counts times the gear ratio per revolution of the joint";
    JOINT = 3 "joint" "on the joint: 2 to the power of encoder.bits per revolution";
}

/// An encoder on each joint. It has no clock: it shows the count of the instant. At the start ideal, as in the paper's
/// experiments; 2000 counts or 17 bit otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Rows, Start)]
pub struct Encoder {
    /// where the encoders sit
    #[parameter(73, name = "encoder.kind", items = ENCODER, start = IDEAL)]
    pub kind: i32,
    /// counts per revolution of the motor, on the motor's side
    #[parameter(74, name = "encoder.counts", integers = 1..=1_000_000_000, start = 2000)]
    pub counts: i32,
    /// bits per revolution of the joint, on the joint's side
    #[parameter(75, name = "encoder.bits", integers = 1..=40, start = 17)]
    pub bits: i32,
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
