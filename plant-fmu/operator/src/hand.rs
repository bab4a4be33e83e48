//! The impedance hand: it pulls the handle toward where it wants to be, by what it felt a reflex ago.

use crate::history::{History, Sample};
use crate::target::Motion;
use fmu_export::Refusal;
use serde::{Deserialize, Serialize};

/// A hand with a stiffness `k_h` and a damping `b_h` along each axis and a reflex delay.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hand {
    k_h: [f64; 3],
    b_h: [f64; 3],
    p_intended: [f64; 3],
    history: History,
}

impl Default for Hand {
    /// A hand without force.
    fn default() -> Self {
        Self::new([0.0; 3], [0.0; 3], 0.0, [0.0; 3], Sample::default())
    }
}

impl Hand {
    /// A hand of `k_h` (N/m) and `b_h` (N·s/m) along each axis that wants to be at `p_intended` (m), or as far from it
    /// as its target is, and acts `delay` (s) late. Until now it felt what `first` says.
    pub fn new(
        k_h: [f64; 3],
        b_h: [f64; 3],
        delay: f64,
        p_intended: [f64; 3],
        first: Sample,
    ) -> Self {
        Self {
            k_h,
            b_h,
            p_intended,
            history: History::new(delay, first),
        }
    }

    /// Refuses a hand that came as bytes and is not one of this reflex `delay` (s).
    ///
    /// # Errors
    /// What [`History::check`] says.
    pub fn check(&self, delay: f64) -> Result<(), Refusal> {
        self.history.check(delay)
    }

    /// Takes hold anew: wants to be at `p_intended` (m), and until now felt what `first` says.
    pub fn take_hold(&mut self, p_intended: [f64; 3], first: Sample) {
        self.p_intended = p_intended;
        self.history.restart(first);
    }

    /// Feels where the handle is now.
    pub fn feel(&mut self, now: Sample) {
        self.history.take(now);
    }

    /// Where the hand wants to be (m), its target being displaced by `target`.
    pub fn target(&self, target: &Motion) -> [f64; 3] {
        core::array::from_fn(|i| self.p_intended[i] + target.p[i])
    }

    /// Force on the handle (N), the target being displaced and moving as `target` says:
    ///
    /// ```text
    /// f_hand = k_h (p_target − p(t − delay)) − b_h (dp(t − delay) − dp_target),  p_target = p_intended + target
    /// ```
    ///
    /// The damper hangs between handle and target: a hand that moves along with its target is not slowed down by itself.
    pub fn force(&self, target: &Motion) -> [f64; 3] {
        let (Sample { p, dp, .. }, wanted) = (self.history.felt(), self.target(target));
        core::array::from_fn(|i| {
            self.k_h[i] * (wanted[i] - p[i]) - self.b_h[i] * (dp[i] - target.dp[i])
        })
    }
}
