//! What the joints deliver of the torque that they are asked for.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// How torques beyond ±tau_max are brought within.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum TorqueLimiting {
    /// All joints by one factor s = min(1, tau_max_i/|tau_i|): the force at the handle keeps its direction.
    Scale = 1,
    /// Each joint by itself: the force at the handle turns, and no factor says what the nominal should feel.
    Clip = 2,
}

/// The limits of the three joints.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Limits {
    /// Largest absolute torque of each joint, N·m, > 0.
    pub tau_max: Vector3<f64>,
    /// How they act.
    pub limiting: TorqueLimiting,
}

/// What the joints deliver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delivered {
    /// Torques, N·m, within ±tau_max.
    pub tau: Vector3<f64>,
    /// Share of the force that this amounts to, in [0, 1]; 1 when clipped, which no share describes.
    pub s: f64,
    /// Whether any joint delivers less than it was asked for.
    pub limited: bool,
}

impl TryFrom<i32> for TorqueLimiting {
    type Error = String;

    fn try_from(number: i32) -> Result<Self, String> {
        [Self::Scale, Self::Clip]
            .into_iter()
            .find(|limiting| *limiting as i32 == number)
            .ok_or_else(|| format!("torque_limiting = {number}: expected 1 (scale), 2 (clip)"))
    }
}

impl Limits {
    /// What is delivered of `tau` (N·m), which is finite.
    pub fn deliver(&self, tau: &Vector3<f64>) -> Delivered {
        let within = |tau: f64, tau_max: f64| tau.min(tau_max).max(-tau_max);
        let s = tau
            .zip_map(&self.tau_max, |tau, tau_max| tau_max / libm::fabs(tau))
            .fold(1.0, f64::min);
        match self.limiting {
            TorqueLimiting::Scale => Delivered {
                tau: (tau * s).zip_map(&self.tau_max, within), // the product's rounding may exceed tau_max
                s,
                limited: s < 1.0,
            },
            TorqueLimiting::Clip => Delivered {
                tau: tau.zip_map(&self.tau_max, within),
                s: 1.0,
                limited: s < 1.0,
            },
        }
    }
}
