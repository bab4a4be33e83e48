//! What goes into a tick of the servo form, and what the drives are told after it.

use crate::tick::{Coordinates, Tick};
use crate::{Real, real};
use nalgebra::SVector;

/// What is sensed and asked for at a tick.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a, L: Coordinates<N>, const N: usize> {
    /// Where the robot is, in the law's coordinates.
    pub place: &'a L::Place,
    /// The drives' positions, m or rad.
    pub q: &'a SVector<Real, N>,
    /// Forces of the human along the law's coordinates, N.
    pub f_h: &'a SVector<Real, N>,
    /// Forces of the drives, means over the sample that ended, N.
    pub tau_m: &'a SVector<Real, N>,
    /// What is asked of the nominals.
    pub request: &'a L::Request,
    /// Sample periods that have passed since the place before this one was read; 1: the tick is in time.
    pub after: Real,
}

/// What came of a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Command<const N: usize> {
    /// Positions for the drives, m: the nominals' in the middle of the sample that begins.
    pub q_d: SVector<Real, N>,
    /// Velocities for the drives, m/s: the nominals' means in that sample.
    pub dq_d: SVector<Real, N>,
    /// The law's tick, without a force of its own. It is saturated where a drive's force reached f_max in the sample that
    /// ended, or a spring is at the bound at which it slips.
    pub tick: Tick<N>,
}

impl<const N: usize> Command<N> {
    /// To stand still at `q` (m), out of the loop.
    pub fn at_rest(q: &SVector<Real, N>) -> Self {
        Self {
            q_d: *q,
            dq_d: SVector::zeros(),
            tick: Tick::at_rest(q),
        }
    }

    /// Whether drives can be told so.
    pub fn is_finite(&self) -> bool {
        let Self { q_d, dq_d, tick } = self;
        real::are_finite([q_d, dq_d, &tick.q_n, &tick.dq_n])
    }
}
