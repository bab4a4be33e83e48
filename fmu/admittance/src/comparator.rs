//! What the two comparators share. They are not laws of the paper: they show what other admittance controllers solve.
//!
//! | comparator | module | solves | leaves open |
//! |---|---|---|---|
//! | natural admittance control | [`natural`](crate::natural) | friction, with a passive hand port | sticks to walls, M_n is the robot's |
//! | sliding-mode position control | [`sliding_mode`](crate::sliding_mode) | return from saturation without overshoot | sticks to walls, passivity |
//!
//! Neither has a reaction on its model, so there is no storage function with the robot's port and no ledger: where the
//! four laws show an energy, a comparator shows 0. Both are for one axis.

use crate::parameters::check;
use crate::{ParameterError, Real, Settings};
use declaration::range::{NOT_NEGATIVE, POSITIVE};

/// What a comparator did at a tick; every value is the one at t_k.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick {
    /// Force on the robot, N, within ±f_max, held until the next tick.
    pub f: Real,
    /// The force before the limit, N.
    pub f_demand: Real,
    /// Position of the desired model, m.
    pub q_n: Real,
    /// Velocity of the desired model, m/s.
    pub dq_n: Real,
    /// q_n − q, m.
    pub e_nr: Real,
    /// The robot's velocity as the controller used it, m/s.
    pub dq: Real,
}

impl Tick {
    /// Out of the loop at the position `q` (m).
    pub fn at_rest(q: Real) -> Self {
        Self {
            f: 0.0,
            f_demand: 0.0,
            q_n: q,
            dq_n: 0.0,
            e_nr: 0.0,
            dq: 0.0,
        }
    }

    /// Whether f_max leaves less than was asked for.
    pub fn is_saturated(&self) -> bool {
        self.f != self.f_demand
    }
}

/// Whether the settings that a comparator uses are in range: T and dq_cutoff.
///
/// # Errors
/// The first one out of its range.
pub(crate) fn check_sampling(settings: &Settings) -> Result<(), ParameterError> {
    check(
        None,
        &[
            ("T", settings.T, POSITIVE),
            ("dq_cutoff", settings.dq_cutoff, NOT_NEGATIVE),
        ],
    )
}
