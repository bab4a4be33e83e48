//! What counts as a stiff hand and what is done about it.

use crate::parameters::{check, in_range};
use crate::real::{consts::TAU, exp_m1};
use crate::{ParameterError, Real};
use fmu_declaration::range::POSITIVE;
use fmu_declaration::{Rows, Start};

/// Samples that half a period of `f_high` has at least.
const FEWEST_SAMPLES: Real = 4.0;

/// The parameters `stiff_hand.*`, the same on all axes. At the start nobody watches. The band holds the unstable swings of the
/// arm from 300 to 10000 N/m (1.1 to 7 Hz) and none of the paper's motions (0.25 to 0.8 Hz); D_max holds a hand of 2762 N/m
/// on the arm's x axis with the paper's gains.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct StiffHand {
    /// Whether a hand too stiff for the gains is looked for and answered with damping.
    #[parameter(54, name = "stiff_hand.active", boolean)]
    pub active: i32,
    /// Largest damping on top of D_n, for a stiff hand that is detected.
    #[parameter(55, name = "stiff_hand.D_max", unit = NEWTON_SECOND_PER_METRE, range = POSITIVE, start = 200.0)]
    pub D_max: Real,
    /// Lower edge of the band in which a stiff hand is looked for, above the motions that the operator means.
    #[parameter(56, name = "stiff_hand.f_low", unit = HERTZ, range = POSITIVE, start = 1.0)]
    pub f_low: Real,
    /// Upper edge of that band, above stiff_hand.f_low and at most 1/(8*T).
    #[parameter(57, name = "stiff_hand.f_high", unit = HERTZ, range = POSITIVE, start = 8.0)]
    pub f_high: Real,
    /// Amplitude of f_h in the band from which on a swing counts.
    #[parameter(58, name = "stiff_hand.f_min", unit = NEWTON, range = POSITIVE, start = 1.0)]
    pub f_min: Real,
    /// Factor, greater than 1, by which f_h has to grow from one period of a swing to the next to be probed before it has
    /// lasted.
    #[parameter(59, name = "stiff_hand.growth", range = AT_LEAST_ONE, start = 1.1)]
    pub growth: Real,
    /// Time in which the damping rises to stiff_hand.D_max.
    #[parameter(60, name = "stiff_hand.attack", unit = SECOND, range = POSITIVE, start = 0.1)]
    pub attack: Real,
    /// Time without a swing of that hand after which the damping is given back.
    #[parameter(61, name = "stiff_hand.quiet", unit = SECOND, range = POSITIVE, start = 2.0)]
    pub quiet: Real,
    /// Time in which it is given back.
    #[parameter(62, name = "stiff_hand.release", unit = SECOND, range = POSITIVE, start = 1.0)]
    pub release: Real,
    /// Number of periods that a swing which does not grow has to last, with one and the same hand, before it is probed.
    #[parameter(180, name = "stiff_hand.periods", integers = 2..=100, start = 3)]
    pub periods: i32,
    /// Damping that probes whether a swing is meant, over the magnitude of the hand's impedance f_h/dp in it. The
    /// stiffness of a hand stays under the probe; what a meant force seems to have of it changes by about this share.
    #[parameter(181, name = "stiff_hand.probe", range = POSITIVE, start = 0.5)]
    pub probe: Real,
    /// Time after a swing that was found to be meant in which no other one is probed, unless it ends before.
    #[parameter(182, name = "stiff_hand.pause", unit = SECOND, range = POSITIVE, start = 10.0)]
    pub pause: Real,
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

impl Watch {
    /// A watch with sample period `T` (s).
    ///
    /// # Errors
    /// The first parameter out of its range, also where nobody watches.
    pub fn new(hand: StiffHand, T: Real) -> Result<Self, ParameterError> {
        check(None, &[("T", T, POSITIVE)])?;
        in_range(&hand)?;
        // The row's range includes its end, like every `min` of FMI.
        if hand.growth <= 1.0 {
            let expected = "a value greater than 1";
            return Err(ParameterError::of(
                "stiff_hand.growth",
                None,
                hand.growth,
                expected,
            ));
        }
        let in_order = hand.f_high > hand.f_low;
        if !in_order || hand.active != 0 && 2.0 * hand.f_high * T * FEWEST_SAMPLES > 1.0 {
            let expected = if in_order {
                "at most 1/(8 T)"
            } else {
                "a value greater than stiff_hand.f_low"
            };
            return Err(ParameterError::of(
                "stiff_hand.f_high",
                None,
                hand.f_high,
                expected,
            ));
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
