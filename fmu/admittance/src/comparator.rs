//! What the two comparators share. They are not laws of the paper: they show what other admittance controllers solve.
//!
//! | comparator | module | solves | leaves open |
//! |---|---|---|---|
//! | natural admittance control | [`natural`](crate::natural) | friction, with a passive hand port | sticks to walls, M_n is the robot's |
//! | sliding-mode position control | [`sliding_mode`](crate::sliding_mode) | return from saturation without overshoot | sticks to walls, passivity |
//!
//! Neither has a reaction on its model, so there is no storage function with the robot's port and no ledger: where the
//! four laws show an energy, a comparator shows 0. Both are for one axis.

use crate::midpoint::{self, Rule, Sample};
use crate::motion::Sampling;
use crate::parameters::check;
use crate::real::floored;
use crate::{Gains, Motion, ParameterError, Real, Settings};
use fmu_declaration::range::{NOT_NEGATIVE, POSITIVE};

/// The desired model of a comparator between two ticks, and the robot's motion beside it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Desired {
    pub settings: Settings,
    pub rule: Rule,
    sampling: Sampling,
    q_n: Option<Real>,
    v_n: Real,
    motion: Motion,
}

impl Desired {
    /// Out of the loop. Of the settings only T and dq_cutoff matter.
    ///
    /// # Errors
    /// The first parameter out of its range.
    pub fn new(settings: Settings, gains: &Gains) -> Result<Self, ParameterError> {
        check(
            None,
            &[
                ("T", settings.T, POSITIVE),
                ("dq_cutoff", settings.dq_cutoff, NOT_NEGATIVE),
            ],
        )?;
        gains.check(None)?;
        Ok(Self {
            rule: Rule::new(&settings, gains),
            sampling: Sampling::new(&settings),
            settings,
            q_n: None,
            v_n: 0.0,
            motion: Motion::default(),
        })
    }

    /// Other gains from the next tick on.
    ///
    /// # Errors
    /// The first one out of its range; the gains stay as they were.
    pub fn tune(&mut self, gains: &Gains) -> Result<(), ParameterError> {
        gains.check(None)?;
        self.rule = Rule::new(&self.settings, gains);
        Ok(())
    }

    /// A tick at position `q` (m) with the human's force `f_h` (N): the model's position q_n (m), and the sample that begins.
    /// The first one engages with q_n = q, v_n = 0.
    pub fn sense(&mut self, q: Real, f_h: Real) -> (Real, Sample) {
        let dq = self.motion.dq(q, 1.0, &self.sampling);
        self.motion = Motion::at(q, dq);
        let q_n = self.q_n.unwrap_or(q);
        let sample = Sample {
            e: q_n - q,
            v_n: self.v_n,
            dq,
            f_h,
            damping: 0.0,
        };
        (q_n, sample)
    }

    /// The model moves on from `q_n` (m) with the velocity `v_m` (m/s) in the middle of the `sample`.
    pub fn advance(&mut self, q_n: Real, sample: &Sample, v_m: Real) {
        self.v_n = floored(midpoint::end(sample.v_n, v_m));
        self.q_n = Some(q_n + self.settings.T * v_m);
    }

    /// Out of the loop: the next tick engages anew.
    pub fn rest(&mut self) {
        (self.q_n, self.v_n, self.motion) = (None, 0.0, Motion::default());
    }
}

/// What a comparator did at a tick; every value is the one at t_k.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComparatorTick {
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

impl ComparatorTick {
    /// With the model at `q_n` (m), at the begin of the `sample`.
    pub(crate) fn of(q_n: Real, sample: &Sample, f: Real, f_demand: Real) -> Self {
        Self {
            f,
            f_demand,
            q_n,
            dq_n: sample.v_n,
            e_nr: sample.e,
            dq: sample.dq,
        }
    }

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
