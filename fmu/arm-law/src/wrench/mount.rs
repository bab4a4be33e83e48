//! How the sensor sits on link 3.

use admittance::parameters::check;
use admittance::{ParameterError, Real, real};
use fmu_declaration::range::FINITE;
use nalgebra::{Matrix3, Vector3};

/// Orientation of the sensor in link 3's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Mount {
    /// Roll, pitch and yaw, rad: turns about link 3's fixed axes x, then y, then z that bring its frame onto the sensor's.
    pub rpy: Vector3<Real>,
}

impl Default for Mount {
    /// The sensor's axes are link 3's.
    fn default() -> Self {
        Self {
            rpy: Vector3::zeros(),
        }
    }
}

impl Mount {
    /// R = R_z(yaw) R_y(pitch) R_x(roll): turns a vector of the sensor's frame into link 3's frame.
    pub fn R(&self) -> Matrix3<Real> {
        let (s_r, c_r) = real::sin_cos(self.rpy.x);
        let (s_p, c_p) = real::sin_cos(self.rpy.y);
        let (s_y, c_y) = real::sin_cos(self.rpy.z);
        #[rustfmt::skip]
        let R = Matrix3::new(
            c_y * c_p, c_y * s_p * s_r - s_y * c_r, c_y * s_p * c_r + s_y * s_r,
            s_y * c_p, s_y * s_p * s_r + c_y * c_r, s_y * s_p * c_r - c_y * s_r,
            -s_p,      c_p * s_r,                   c_p * c_r,
        );
        R
    }

    /// Whether a sensor can sit so.
    ///
    /// # Errors
    /// The first angle that is not finite.
    pub fn check(&self) -> Result<(), ParameterError> {
        (1..)
            .zip(&self.rpy)
            .try_for_each(|(axis, angle)| check(Some(axis), &[("ft.mount", *angle, FINITE)]))
    }
}
