//! Live gain changes that do not raise the stored energy.
//!
//! Changed gains come into force on a straight line, a [`Tuning`]; each step of it is taken over by these rules:
//!
//! | change | kept | so that |
//! |---|---|---|
//! | K K_P raised | K K_P e, the spring's force | its energy falls by the ratio |
//! | K K_P lowered | e | its energy falls by the ratio |
//! | K M_n raised | K M_n v_n² | the nominal's energy stays |
//! | K M_n lowered | v_n | it falls |
//! | f_max raised where the spring is limited | Φ(e) at most | a spring beyond its limit gains nothing |
//! | D_n, or f_max otherwise | all | neither stores; the next slip sees the new bound |

use crate::real::{self, sat};
use crate::storage::Spring;
use crate::{Gains, Law, Real};

/// Gains on their way to other ones.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tuning<G> {
    /// those of the last tick
    last: G,
    /// those of the next one
    now: G,
    wanted: G,
    /// ticks until the gains are those wanted
    remaining: u32,
}

/// Gains that change on a straight line.
pub trait Gradual: Copy + PartialEq {
    /// These gains one tick further on the straight way to `wanted`, of which `remaining` ticks are left (at least 1).
    #[must_use]
    fn toward(&self, wanted: &Self, remaining: u32) -> Self;
}

impl<G: Gradual> Tuning<G> {
    /// At their place.
    pub fn new(gains: G) -> Self {
        Self {
            last: gains,
            now: gains,
            wanted: gains,
            remaining: 0,
        }
    }

    /// On the way to the gains `wanted`, which are reached after `ticks` ticks, or at the next one. To want the same again, as
    /// an importer does that sets all it has at every step, starts nothing anew.
    pub fn want(&mut self, wanted: G, ticks: u32) {
        if wanted != self.wanted {
            self.wanted = wanted;
            self.remaining = ticks.max(1);
            self.now = self.last.toward(&wanted, self.remaining);
        }
    }

    /// The gains at this tick.
    #[inline]
    pub fn now(&self) -> &G {
        &self.now
    }

    /// The gains from which they take over at this tick, if they may be others.
    #[inline]
    pub fn changed_from(&self) -> Option<&G> {
        (self.remaining > 0).then_some(&self.last)
    }

    /// A tick has passed. Returns whether the gains of the next one may be others.
    #[inline]
    pub fn pass(&mut self) -> bool {
        if self.remaining == 0 {
            return false;
        }
        self.remaining -= 1;
        self.last = self.now;
        if self.remaining > 0 {
            self.now = self.last.toward(&self.wanted, self.remaining);
        }
        true
    }

    /// At their place at once: nothing is stored that could rise.
    pub fn finish(&mut self) {
        *self = Self::new(self.wanted);
    }
}

/// Position error (m) and nominal velocity (m/s) with which the gains `to` take over from the gains `from`.
pub fn taken_over(law: Law, from: &Gains, to: &Gains, e: Real, v_n: Real) -> (Real, Real) {
    if from == to {
        return (e, v_n);
    }
    let spring_ratio = from.K * from.K_P / (to.K * to.K_P);
    let mass_ratio = from.K * from.M_n / (to.K * to.M_n);
    let e_kept = e * spring_ratio.min(1.0);
    let e_most = Spring::new(law, to).extension(Spring::new(law, from).energy(e));
    (sat(e_kept, e_most), v_n * real::sqrt(mass_ratio.min(1.0)))
}
