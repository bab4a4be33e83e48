//! What is asked of several axes.

use crate::{Real, real};
use nalgebra::SVector;

/// What is asked of the law at a tick, beside its inputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request<const N: usize> {
    /// Part of the force that the robot is to get, in [0, 1]: for fading in and out. A NaN counts as 0.
    pub authority: Real,
    /// Whether the nominal stays where it is: the coupling then supports any load without drift.
    pub hold: bool,
    /// Damping on top of D_n, N·s/m, ≥ 0.
    pub damping: SVector<Real, N>,
    /// Speed that the nominal must not exceed, beside its bounds, m/s, ≥ 0; infinite for no limit.
    pub speed: SVector<Real, N>,
    /// Sample periods that have passed since the position before this one was read; 1: the tick is in time.
    pub after: Real,
}

impl<const N: usize> Default for Request<N> {
    /// The law alone.
    fn default() -> Self {
        Self {
            authority: 1.0,
            hold: false,
            damping: SVector::zeros(),
            speed: SVector::repeat(Real::INFINITY),
            after: 1.0,
        }
    }
}

impl<const N: usize> Request<N> {
    /// The authority within [0, 1].
    pub fn authority(&self) -> Real {
        if self.authority > 0.0 {
            real::min(self.authority, 1.0)
        } else {
            0.0
        }
    }

    /// Whether the nominals may move as they like, but for their bounds.
    #[inline]
    pub(super) fn leaves_free(&self) -> bool {
        !self.hold && self.speed.iter().all(|speed| *speed == Real::INFINITY)
    }
}
