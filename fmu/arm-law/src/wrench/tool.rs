//! The weight of what hangs on the sensor.

use super::Wrench;
use admittance::parameters::in_range;
use admittance::{ParameterError, Real};
use fmu_declaration::{Rows, Start};
use nalgebra::{Matrix3, Vector3};

/// Everything beyond the sensor that the hand does not carry: handle, adapter, half of the sensor. At the start there is none,
/// on an arm that stands upright.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct Tool {
    /// Mass of the tool behind the sensor, whose weight is taken off; 0 = none.
    #[parameter(79, name = "ft.mass", unit = KILOGRAM, range = NOT_NEGATIVE)]
    pub mass: Real,
    /// Centre of gravity of the tool from the sensor's origin; sensor frame.
    #[parameter(80, name = "ft.cog[i]", unit = METRE)]
    pub cog: [Real; 3],
    /// Acceleration of gravity; base frame.
    #[parameter(81, name = "ft.gravity[i]", unit = METRE_PER_SECOND_SQUARED, start = [0.0, 0.0, -9.81])]
    pub gravity: [Real; 3],
}

impl Tool {
    /// What the weight does to the sensor, in the sensor's frame and about its origin, when `R` turns a vector of the
    /// sensor's frame into the base frame.
    ///
    /// ```text
    /// f = m Rᵀ g,   n = c × f
    /// ```
    pub fn weight(&self, R: &Matrix3<Real>) -> Wrench {
        if self.mass == 0.0 {
            return Wrench::ZERO; // and not −0, which a subtraction would not leave bit for bit
        }
        let force = R.tr_mul(&Vector3::from(self.gravity)) * self.mass;
        Wrench {
            force,
            torque: Vector3::from(self.cog).cross(&force),
        }
    }

    /// Whether there can be such a tool.
    ///
    /// # Errors
    /// The first value out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        in_range(self)
    }
}
