//! The weight of what hangs on the sensor.

use super::Wrench;
use admittance::parameters::{FINITE, NOT_NEGATIVE, check};
use admittance::{ParameterError, Real};
use nalgebra::{Matrix3, Vector3};

/// Everything beyond the sensor that the hand does not carry: handle, adapter, half of the sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tool {
    /// Mass, kg; 0 = no tool.
    pub mass: Real,
    /// Centre of gravity from the sensor's origin, sensor frame, m.
    pub cog: Vector3<Real>,
    /// Acceleration of gravity, base frame, m/s².
    pub gravity: Vector3<Real>,
}

impl Default for Tool {
    /// No tool, on an arm that stands upright.
    fn default() -> Self {
        Self {
            mass: 0.0,
            cog: Vector3::zeros(),
            gravity: Vector3::new(0.0, 0.0, -9.81),
        }
    }
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
        let force = R.tr_mul(&self.gravity) * self.mass;
        Wrench {
            force,
            torque: self.cog.cross(&force),
        }
    }

    /// Whether there can be such a tool.
    ///
    /// # Errors
    /// The first value out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        check(None, &[("ft.mass", self.mass, NOT_NEGATIVE)])?;
        for (axis, (cog, gravity)) in (1..).zip(self.cog.iter().zip(&self.gravity)) {
            check(
                Some(axis),
                &[("ft.cog", *cog, FINITE), ("ft.gravity", *gravity, FINITE)],
            )?;
        }
        Ok(())
    }
}
