//! The band in which a stiff hand swings.

use super::Watch;
use crate::Real;
use crate::real::floored;

/// Band pass of one signal: twice a first-order high pass at `f_low`, then a first-order low pass at `f_high`, each exact for
/// a signal held over the sample. At rest at the first sample, whatever that is.
///
/// With a_low = 1 − exp(−2π f_low T) and a_high likewise:
/// l₁ ← l₁ + a_low (s − l₁),  l₂ ← l₂ + a_low (s − l₁ − l₂),  b ← b + a_high (s − l₁ − l₂ − b)
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Band {
    level: Option<Real>,
    slow: Real,
    b: Real,
}

impl Band {
    /// After the sample `s`, which is finite, and what of it lies in the band.
    #[must_use]
    pub fn passed(self, s: Real, watch: &Watch) -> (Self, Real) {
        let level = self.level.unwrap_or(s);
        let level = level + watch.a_low() * (s - level);
        let above = s - level;
        let slow = floored(self.slow + watch.a_low() * (above - self.slow));
        let b = floored(self.b + watch.a_high() * (above - slow - self.b));
        let next = Self {
            level: Some(level),
            slow,
            b,
        };
        (next, b)
    }
}
