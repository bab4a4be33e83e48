//! A force and a moment about a point, and how they read in another frame and about another point.

use admittance::Real;
use core::ops::Sub;
use nalgebra::{Matrix3, Vector3};

/// What acts on the tool: a force and its moment about a point that the owner of the value names.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Wrench {
    /// Force, N.
    pub force: Vector3<Real>,
    /// Moment, N·m.
    pub torque: Vector3<Real>,
}

impl Wrench {
    /// Nothing acts.
    pub const ZERO: Self = Self {
        force: Vector3::new(0.0, 0.0, 0.0),
        torque: Vector3::new(0.0, 0.0, 0.0),
    };

    /// The same wrench about the point that lies `r` (m, same frame) from the present one.
    ///
    /// ```text
    /// f′ = f,   n′ = n − r × f
    /// ```
    pub fn about(&self, r: &Vector3<Real>) -> Self {
        Self {
            force: self.force,
            torque: self.torque - r.cross(&self.force),
        }
    }

    /// The same wrench in the frame whose coordinates are `R` times those of the present one.
    pub fn turned(&self, R: &Matrix3<Real>) -> Self {
        Self {
            force: R * self.force,
            torque: R * self.torque,
        }
    }

    /// Force, then moment.
    pub fn components(&self) -> [Real; 6] {
        let (f, n) = (&self.force, &self.torque);
        [f.x, f.y, f.z, n.x, n.y, n.z]
    }
}

impl From<[Real; 6]> for Wrench {
    /// Force, then moment.
    fn from([f_x, f_y, f_z, n_x, n_y, n_z]: [Real; 6]) -> Self {
        Self {
            force: Vector3::new(f_x, f_y, f_z),
            torque: Vector3::new(n_x, n_y, n_z),
        }
    }
}

impl Sub for Wrench {
    type Output = Self;

    /// Component by component: both about the same point and in the same frame.
    fn sub(self, other: Self) -> Self {
        Self {
            force: self.force - other.force,
            torque: self.torque - other.torque,
        }
    }
}
