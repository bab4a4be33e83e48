//! A first-order low pass on the wrench.
//!
//! ```text
//! x⁺ = x + (1 − e^{−2π f_c T}) (u − x)
//! ```
//!
//! which is the continuous filter sampled exactly for an input that holds over each sample. It costs phase: below f_c it
//! delays a signal by T a/(1 − a) with a = e^{−2π f_c T}, 1/(2π f_c) less about half a sample. 30 Hz at 1 kHz are 4.8 ms,
//! as much as five samples of delay between hand and nominal, and a stiff hand goes unstable that much earlier. Prefer
//! the deadband against a bias and this only against noise.

use super::Wrench;
use admittance::{Real, real};

/// The low pass between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LowPass {
    /// 1 − e^{−2π f_c T}; 1 = off.
    weight: Real,
    state: Wrench,
}

impl LowPass {
    /// Corner frequency `cutoff` (Hz, ≥ 0; 0 = off) at sample period `T` (s), at rest at zero.
    pub fn new(cutoff: Real, T: Real) -> Self {
        Self {
            weight: if cutoff > 0.0 {
                -real::exp_m1(-2.0 * real::consts::PI * cutoff * T)
            } else {
                1.0
            },
            state: Wrench::ZERO,
        }
    }

    /// Back to zero: the next force builds up from there.
    pub fn reset(&mut self) {
        self.state = Wrench::ZERO;
    }

    /// One sample of the finite input `u`.
    pub fn step(&mut self, u: &Wrench) -> Wrench {
        if self.at_rest().is_none() {
            return *u;
        }
        self.state = self.passed(u);
        self.state
    }

    /// What passes where nothing has come for long; none where it is off.
    #[inline]
    pub(super) fn at_rest(&self) -> Option<Wrench> {
        (self.weight != 1.0).then_some(Wrench::ZERO)
    }

    /// What passes of the finite input `u`, where it is on.
    pub(super) fn passed(&self, u: &Wrench) -> Wrench {
        let step = |x: Real, u: Real| real::floored(x + self.weight * (u - x));
        Wrench {
            force: self.state.force.zip_map(&u.force, step),
            torque: self.state.torque.zip_map(&u.torque, step),
        }
    }

    /// Goes on from what has `passed`.
    #[inline]
    pub(super) fn keep(&mut self, passed: Option<&Wrench>) {
        if let Some(passed) = passed {
            self.state = *passed;
        }
    }
}
