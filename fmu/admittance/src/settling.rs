//! A sample that has ended: what it created, and what is given up for it.

use crate::ledger::{Flow, Ledger};
use crate::tick::Coordinates;
use crate::{Real, real};
use nalgebra::SVector;

/// The sample that ended, settled: what [`Ledger::book`] takes over. Nothing has happened until then.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Settlement<const N: usize> {
    /// Its motion, m, if it can foretell the next one.
    pub(crate) step: Option<SVector<Real, N>>,
    /// Whether that motion left the reach.
    pub(crate) outside: bool,
    pub(crate) H: Real,
    pub(crate) G: Real,
    pub(crate) tank: Real,
    pub(crate) rounding: Real,
}

impl<const N: usize> Settlement<N> {
    /// G, created up to this tick, J; negative: dissipated.
    pub fn G(&self) -> Real {
        self.G
    }

    /// Whether the motion exceeded the reach, to which the passivity argument is restricted.
    pub fn is_outside(&self) -> bool {
        self.outside
    }

    /// The same without a motion to judge the next one by: the law engages, and what was sensed before need not have been
    /// the robot.
    pub fn without_motion(self) -> Self {
        Self {
            step: None,
            outside: false,
            ..self
        }
    }
}

/// What is kept of the stored energy: fractions of e and of v_n in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Keep {
    /// Fraction of every position error.
    pub e: Real,
    /// Fraction of every nominal velocity.
    pub v_n: Real,
}

/// What rounding may take from the tank in a sample, relative to the terms of ΔG.
const A_SAMPLE: Real = 64.0 * Real::EPSILON;

impl<const N: usize> Ledger<N> {
    /// Settles the sample that ends now at the position `q` (m). Where the tank is kept, the law as it was `sensed` gives up
    /// as much of what it stores as must be for the tank to stay ≥ 0.
    #[inline]
    #[expect(
        clippy::neg_cmp_op_on_partial_ord,
        reason = "what was created is no number: it is not afforded either"
    )]
    pub fn settle<L: Coordinates<N>>(
        &self,
        law: &L,
        sensed: &mut L::Sensed,
        q: &SVector<Real, N>,
    ) -> Settlement<N> {
        let H = law.stored(sensed);
        let created = self.created(H, q);
        if self.terms.kept && !(created <= self.tank) {
            let (kept, settlement) = self.settle_reduced(law, *sensed, q);
            *sensed = kept;
            return settlement;
        }
        self.closed(H, q, created)
    }

    /// The same where something is given up: what is left of the law.
    #[cold]
    #[inline(never)]
    fn settle_reduced<L: Coordinates<N>>(
        &self,
        law: &L,
        mut sensed: L::Sensed,
        q: &SVector<Real, N>,
    ) -> (L::Sensed, Settlement<N>) {
        let keep = self.affordable(law.springs(&sensed), law.masses(&sensed), q);
        law.reduce(&mut sensed, keep);
        let settlement = self.close(law.stored(&sensed), q);
        (sensed, settlement)
    }

    /// What may be kept at this tick, with the position `q` (m), of the energy that the law stores in its springs and in its
    /// nominal masses (J), for the tank to stay ≥ 0: what is given up is taken from the springs first.
    ///
    /// It is found without the springs' energy, which can be many times what is left of it: a difference of the two would
    /// leave the larger one's rounding.
    #[cold]
    fn affordable(&self, spring: Real, masses: Real, q: &SVector<Real, N>) -> Keep {
        let affordable = self.tank - self.created(0.0, q);
        let fraction = |energy: Real, affordable: Real| {
            if affordable <= 0.0 {
                0.0
            } else if affordable < energy {
                real::sqrt(affordable / energy)
            } else {
                1.0
            }
        };
        Keep {
            e: fraction(spring, affordable - masses),
            v_n: fraction(masses, affordable),
        }
    }

    /// Settles the sample that ends now with the energy `H` (J) that the law stores now and the position `q` (m). Nothing is
    /// given up.
    #[cold]
    #[inline(never)]
    pub fn close(&self, H: Real, q: &SVector<Real, N>) -> Settlement<N> {
        self.closed(H, q, self.created(H, q))
    }

    /// The same where it is known what the sample `created`, J.
    #[inline]
    fn closed(&self, H: Real, q: &SVector<Real, N>, created: Real) -> Settlement<N> {
        let step = self.q.as_ref().map(|last| q - last);
        let reach = &self.terms.reach;
        let outside = step.is_some_and(|step| reach.is_left(&step, self.step.as_ref()));
        if !self.terms.defined {
            return self.unpaid(step, outside);
        }
        self.paid(step, outside, H, created, || self.size(H, q))
    }

    /// Settles the sample that ends now at a position that is not known, with nothing left stored: the tank pays for the most
    /// that the force can have done, and, with a delay, at the next sample again. Where that is beyond all numbers the ledger
    /// keeps what it last knew.
    pub fn close_unseen(&self) -> Settlement<N> {
        let most = self.work_unseen();
        let created = most - self.H - self.flow.supplied;
        if !self.terms.defined || !(self.G + created).is_finite() {
            return self.unpaid(None, false);
        }
        self.paid(None, false, 0.0, created, || {
            let Flow {
                supplied,
                exchanged,
            } = self.flow;
            real::abs(self.tank) + real::abs(most) + self.H + real::abs(supplied) + exchanged
        })
    }

    /// A sample with the motion `step` (m), that left the reach or not, for which nothing is paid.
    fn unpaid(&self, step: Option<SVector<Real, N>>, outside: bool) -> Settlement<N> {
        Settlement {
            step,
            outside,
            H: self.H,
            G: self.G,
            tank: self.tank,
            rounding: self.rounding,
        }
    }

    /// The same paid for by the tank: the sample `created` so much (J), and `H` (J) is stored now. `size` gives the terms of
    /// ΔG at their sizes, J.
    #[inline]
    fn paid(
        &self,
        step: Option<SVector<Real, N>>,
        outside: bool,
        H: Real,
        created: Real,
        size: impl FnOnce() -> Real,
    ) -> Settlement<N> {
        // With a delay, a force has been said that acts only now: what may cover it is not poured away.
        let most = if self.terms.delayed {
            self.most_kept(step, outside)
        } else {
            self.terms.E_0
        };
        let tank = real::at_most(self.tank - created, most);
        Settlement {
            step,
            outside,
            H,
            G: self.G + created,
            tank,
            rounding: if tank < 0.0 {
                real::max(self.rounding, A_SAMPLE * size())
            } else {
                0.0
            },
        }
    }

    /// What the tank may hold after the motion `step` (m) where a force has been said before.
    #[cold]
    #[inline(never)]
    fn most_kept(&self, step: Option<SVector<Real, N>>, outside: bool) -> Real {
        real::max(self.terms.E_0, self.reserved(step.as_ref(), outside))
    }

    /// ΔG, J, of the sample that ends now, with `H` (J) stored now and the position `q` (m).
    #[inline]
    fn created(&self, H: Real, q: &SVector<Real, N>) -> Real {
        H - self.H + self.work(q) - self.flow.supplied
    }

    /// The terms of ΔG at their sizes, J.
    fn size(&self, H: Real, q: &SVector<Real, N>) -> Real {
        let work = self.work_size(q);
        let Flow {
            supplied,
            exchanged,
        } = self.flow;
        real::abs(self.tank) + H + self.H + work + real::abs(supplied) + exchanged
    }
}
