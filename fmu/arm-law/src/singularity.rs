//! Slowing down before a singularity.
//!
//! Where J loses rank, joints must move ever faster for the same motion of the handle. Below sigma_slow the nominal is
//! therefore damped more, in every direction and on every axis alike:
//!
//! ```text
//! D_n,eff = D_n + D ((sigma_slow/sigma_min)² − 1)
//! ```
//!
//! down to a quarter of sigma_slow, where the damping has reached 15 D and grows no further: the nominal stays movable. A
//! steady push then moves it by f_h/D_n,eff. Damping only dissipates; the passivity argument holds as it is, for any course
//! of sigma_min.
//!
//! It slows the nominal and does not stop it, and it does not bring the arm back. What stops it are the joint limits of the
//! [`workspace`](crate::workspace), which are on at the start and end at 0.065 m/rad or more for the exoskeleton arm. Without
//! them 10 N get to 0.039 m/rad in two seconds. There the arm sticks: J leaves too little of the 400 N of f_max to overcome
//! the elbow's stiction of 16 N·m, and neither 10 N nor 20 N bring it back (scenario `arm_workspace`).

use admittance::parameters::in_range;
use admittance::{ParameterError, Real, real};
use fmu_declaration::{Rows, Start};

/// Share of sigma_slow below which the damping grows no further.
const LEAST_SHARE: Real = 0.25;

/// When and how much the nominal is slowed. The start values: two thirds of the least sigma_min that the paper's experiments
/// come to (0.18 m/rad), and a damping that takes the speed from the nominal within the few centimetres that are left.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct Singularity {
    /// sigma_min below which the nominal is damped more; 0 = off.
    #[parameter(40, name = "singularity.sigma_slow", unit = METRE_PER_RADIAN, range = NOT_NEGATIVE, start = 0.12)]
    pub sigma_slow: Real,
    /// Slowing: below sigma_slow D_n is raised by singularity.D*((sigma_slow/sigma_min)^2 - 1), at most by 15
    /// singularity.D.
    #[parameter(41, name = "singularity.D", unit = NEWTON_SECOND_PER_METRE, range = NOT_NEGATIVE, start = 200.0)]
    pub D: Real,
}

impl Singularity {
    /// Whether the nominal is slowed at `sigma_min` (m/rad).
    pub fn slows(&self, sigma_min: Real) -> bool {
        sigma_min < self.sigma_slow && self.D > 0.0
    }

    /// Damping that the nominal gets on top of D_n at `sigma_min` (m/rad), N·s/m: 0 from sigma_slow on.
    pub fn damping(&self, sigma_min: Real) -> Real {
        if !self.slows(sigma_min) {
            return 0.0;
        }
        let ratio = 1.0 / real::max(sigma_min / self.sigma_slow, LEAST_SHARE);
        self.D * (ratio * ratio - 1.0)
    }

    /// Whether these can be used.
    ///
    /// # Errors
    /// The first value out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        in_range(self)
    }
}
