//! One axis among several: its gains, its bounds, and what follows from both. What the axes do at a tick stands in
//! [`axes`](crate::axes).

use crate::midpoint::Rule;
use crate::retune::Tuning;
use crate::{Bounds, Gains, Real, Settings};

/// One axis of the law.
///
/// M_n ddq_n + D_n dq_n = f_h − alpha y,  y = de_nr + K_P e_nr,  tau_a = K y        eq:obs_dyn, eq:dob_input
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Axis {
    tuning: Tuning<Gains>,
    /// that of the gains at this tick
    pub(crate) rule: Rule,
    /// none where nothing is bounded
    pub(crate) bounds: Option<Bounds>,
}

impl Axis {
    /// At its gains, without bounds. The caller has checked the gains.
    pub fn new(settings: &Settings, gains: Gains) -> Self {
        Self {
            tuning: Tuning::new(gains),
            rule: Rule::new(settings, &gains),
            bounds: None,
        }
    }

    /// On its way to other gains, which it has after `ticks` ticks. The caller has checked them.
    pub fn tune(&mut self, wanted: Gains, ticks: u32, settings: &Settings) {
        self.tuning.want(wanted, ticks);
        self.rule = Rule::new(settings, self.tuning.now());
    }

    /// At the gains last wanted, at once: the axis is out of the loop.
    pub fn settle_gains(&mut self, settings: &Settings) {
        self.tuning.finish();
        self.rule = Rule::new(settings, self.tuning.now());
    }

    /// Within other bounds from the next tick on. The caller has checked them.
    pub fn bound(&mut self, bounds: Bounds) {
        self.bounds = (bounds != Bounds::default()).then_some(bounds);
    }

    /// Its gains at this tick.
    #[inline]
    pub fn gains(&self) -> &Gains {
        &self.rule.gains
    }

    /// The gains from which they take over at this tick, if they may be others.
    #[inline]
    pub(crate) fn changed_from(&self) -> Option<&Gains> {
        self.tuning.changed_from()
    }

    /// A tick has passed: gains on their way come a step nearer.
    #[inline]
    pub(crate) fn pass(&mut self, settings: &Settings) {
        if self.tuning.pass() {
            self.rule = Rule::new(settings, self.tuning.now());
        }
    }

    /// What a force of `f` (N) amounts to as a velocity y, m/s.
    #[inline]
    pub(crate) fn y(&self, f: Real) -> Real {
        f / self.rule.gains.K
    }
}
