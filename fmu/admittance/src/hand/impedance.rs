//! What the hand is in a swing: a spring and a damper.

use crate::Real;
use crate::real::{hypot, quotient_if};

/// Stiffness and damping that f_h has over x in a swing of one frequency: f_h = −k x − b dx. Of a hand that holds on, they
/// are its own, whatever the robot does. Of a force that is meant, they are what the robot's inertia and damping make of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Impedance {
    /// Stiffness, N/m.
    pub k: Real,
    /// Damping, N·s/m; below 0: f_h gives energy over the swing.
    pub b: Real,
    /// Angular frequency of the swing, rad/s.
    pub omega: Real,
}

impl Impedance {
    /// |k + jωb|: amplitude of f_h over that of x, N/m.
    pub fn magnitude(&self) -> Real {
        hypot(self.k, self.omega * self.b)
    }

    /// Distance from `reference` at its frequency, over its magnitude: 0 for the same hand, infinite from none.
    pub fn apart(&self, reference: &Self) -> Real {
        let distance = hypot(
            self.k - reference.k,
            reference.omega * (self.b - reference.b),
        );
        let magnitude = reference.magnitude();
        if magnitude > 0.0 {
            quotient_if(true, distance, magnitude)
        } else {
            Real::INFINITY
        }
    }

    /// From here to `other`, by this `share` of the way.
    #[must_use]
    pub fn towards(&self, other: &Self, share: Real) -> Self {
        Self {
            k: self.k + share * (other.k - self.k),
            b: self.b + share * (other.b - self.b),
            omega: self.omega + share * (other.omega - self.omega),
        }
    }
}
