//! Slowing down before a singularity.
//!
//! Where J loses rank, joints must move ever faster for the same motion of the handle. Below sigma_slow the nominal is
//! therefore damped more, in every direction and on every axis alike:
//!
//! ```text
//! D_n,eff = D_n + D ((sigma_slow/sigma_min)² − 1)
//! ```
//!
//! down to a quarter of sigma_slow, where the damping has reached 15 D and grows no further, so that the arm can be
//! pulled out again. A steady push then moves the handle by f_h/D_n,eff. Damping only dissipates; the passivity argument
//! holds as it is, for any course of sigma_min.
//!
//! It slows and does not stop: a push that is hard or long enough still gets there. The start values bring 7 N that pull
//! the arm straight for seconds to rest near 0.05 m/rad (a test), where the 400 N of f_max still bend the elbow against
//! friction of 12 N·m.

use serde::{Deserialize, Serialize};

/// Share of sigma_slow below which the damping grows no further.
const LEAST_SHARE: f64 = 0.25;

/// Parameters `singularity.*`. What each is stands in its row ([`rows`](crate::rows)).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "a variable is described once, in its row")]
pub struct Singularity {
    pub sigma_slow: f64,
    pub D: f64,
}

impl Default for Singularity {
    /// Two thirds of the least that the paper's experiments come to (0.18 m/rad); a damping that takes the speed from the
    /// nominal within the few centimetres that are left.
    fn default() -> Self {
        Self {
            sigma_slow: 0.12,
            D: 200.0,
        }
    }
}

impl Singularity {
    /// Whether the nominal is slowed at `sigma_min` (m/rad).
    pub fn slows(&self, sigma_min: f64) -> bool {
        sigma_min < self.sigma_slow && self.D > 0.0
    }

    /// Damping that the nominal gets on top of D_n at `sigma_min` (m/rad), N·s/m: 0 from sigma_slow on.
    pub fn damping(&self, sigma_min: f64) -> f64 {
        if !self.slows(sigma_min) {
            return 0.0;
        }
        let ratio = 1.0 / libm::fmax(sigma_min / self.sigma_slow, LEAST_SHARE);
        self.D * (ratio * ratio - 1.0)
    }

    /// Whether these can be used.
    ///
    /// # Errors
    /// The first value out of its range: its name in the interface, its value and the range.
    pub fn check(&self) -> Result<(), String> {
        for (name, value) in [("sigma_slow", self.sigma_slow), ("D", self.D)] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(format!(
                    "singularity.{name} = {value}: expected a finite value not less than 0"
                ));
            }
        }
        Ok(())
    }
}
