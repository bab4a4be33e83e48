//! What counts as a stiff hand and what is done about it.

use crate::parameters::{POSITIVE, Range, check};
use crate::real::{consts::TAU, exp_m1};
use crate::{ParameterError, Real};

/// Samples that half a period of `f_high` has at least.
const FEWEST_SAMPLES: Real = 4.0;

/// The parameters `stiff_hand.*`, the same on all axes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StiffHand {
    /// Whether anybody watches. If not, nothing is computed and D is 0.
    pub active: bool,
    /// Damping that comes on top of D_n, N·s/m.
    pub D_max: Real,
    /// Lower edge of the band, Hz: above the motions that an operator means.
    pub f_low: Real,
    /// Upper edge of the band, Hz.
    pub f_high: Real,
    /// Amplitude of f_h in the band from which on a swing counts, N: above the force sensor's noise.
    pub f_min: Real,
    /// Factor by which a half swing has to be stronger than the one a period before, > 1.
    pub growth: Real,
    /// Time in which D goes from 0 to D_max, s.
    pub attack: Real,
    /// Time without a swing after which the damping is given back, s.
    pub quiet: Real,
    /// Time in which D goes from D_max to 0, s.
    pub release: Real,
}

impl Default for StiffHand {
    /// Off. The band holds the unstable swings of the arm from 300 to 10000 N/m (1.1 to 7 Hz) and none of the paper's motions
    /// (0.25 to 0.8 Hz); D_max holds a hand of 2762 N/m on the arm's x axis with the paper's gains.
    fn default() -> Self {
        Self {
            active: false,
            D_max: 200.0,
            f_low: 1.0,
            f_high: 8.0,
            f_min: 1.0,
            growth: 1.1,
            attack: 0.1,
            quiet: 2.0,
            release: 1.0,
        }
    }
}

/// Parameters that have been checked, with what follows from them and the sample period.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Watch {
    hand: StiffHand,
    T: Real,
    a_low: Real,
    a_high: Real,
}

/// Greater than 1, finite.
const ABOVE_ONE: Range = ("a finite value greater than 1", |x| {
    x > 1.0 && x.is_finite()
});

impl Watch {
    /// A watch with sample period `T` (s).
    ///
    /// # Errors
    /// The first parameter out of its range, also where nobody watches.
    pub fn new(hand: StiffHand, T: Real) -> Result<Self, ParameterError> {
        check(
            None,
            &[
                ("T", T, POSITIVE),
                ("stiff_hand.D_max", hand.D_max, POSITIVE),
                ("stiff_hand.f_low", hand.f_low, POSITIVE),
                ("stiff_hand.f_high", hand.f_high, POSITIVE),
                ("stiff_hand.f_min", hand.f_min, POSITIVE),
                ("stiff_hand.growth", hand.growth, ABOVE_ONE),
                ("stiff_hand.attack", hand.attack, POSITIVE),
                ("stiff_hand.quiet", hand.quiet, POSITIVE),
                ("stiff_hand.release", hand.release, POSITIVE),
            ],
        )?;
        let in_order = hand.f_high > hand.f_low;
        if !in_order || hand.active && 2.0 * hand.f_high * T * FEWEST_SAMPLES > 1.0 {
            return Err(ParameterError::OutOfRange {
                name: "stiff_hand.f_high",
                axis: None,
                value: hand.f_high,
                expected: if in_order {
                    "at most 1/(8 T)"
                } else {
                    "a value greater than stiff_hand.f_low"
                },
            });
        }
        Ok(Self {
            hand,
            T,
            a_low: -exp_m1(-TAU * hand.f_low * T),
            a_high: -exp_m1(-TAU * hand.f_high * T),
        })
    }

    /// The parameters.
    pub fn hand(&self) -> &StiffHand {
        &self.hand
    }

    /// Sample period, s.
    pub fn T(&self) -> Real {
        self.T
    }

    /// 1 − exp(−2π f_low T)
    pub(super) fn a_low(&self) -> Real {
        self.a_low
    }

    /// 1 − exp(−2π f_high T)
    pub(super) fn a_high(&self) -> Real {
        self.a_high
    }

    /// Half a period of `f_high`, s: a shorter half swing does not count.
    pub(super) fn shortest(&self) -> Real {
        0.5 / self.hand.f_high
    }

    /// Half a period of `f_low`, samples: a half swing that has not ended by then does not count.
    pub(super) fn longest(&self) -> Real {
        0.5 / (self.hand.f_low * self.T)
    }
}
