//! The checks of the joint encoders: parameters `encoder.*`. What they do: [`admittance::encoder`].

use admittance::encoder::{Checks, Encoders};
use admittance::{Reach, Real};
use fmu_declaration::{Rows, Start};

/// What the joints' positions must keep to. The arm's joints turn less than once.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct EncoderParameters {
    /// Largest absolute joint angle: a reading beyond it cannot be.
    #[parameter(138, name = "encoder.range[i]", unit = RADIAN, range = POSITIVE, start = [2.0 * core::f64::consts::PI as Real; 3])]
    pub range: [Real; 3],
    /// Change of a joint's torque in which its angle must change, too, in its last bit at least; 0 = off. Above what
    /// friction holds.
    #[parameter(139, name = "encoder.stuck_torque[i]", unit = NEWTON_METRE, range = NOT_NEGATIVE)]
    pub stuck_torque: [Real; 3],
    /// Readings in a row after which a jump beyond dq_max or encoder.range is a fault, and after which a fault is over; 0 =
    /// jumps are believed.
    #[parameter(140, name = "encoder.samples", integers = 0.., start = 5)]
    pub samples: i32,
}

impl EncoderParameters {
    /// The checks of joints with this `reach` at a sample period of `T` (s).
    pub fn checks(&self, reach: &Reach<3>, T: Real) -> Encoders<3> {
        let checks = Checks {
            range: self.range.into(),
            stuck: self.stuck_torque.into(),
            samples: self.samples.unsigned_abs(),
        };
        Encoders::new(checks, reach, T)
    }
}
