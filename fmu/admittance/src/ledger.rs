//! What the sampled law created, and the tank that it draws on.
//!
//! Over one sample, with Δq what the robot moved and f the force that acted meanwhile, summed over the axes:
//!
//! ```text
//! ΔG = ΔH + f·Δq − (K/alpha) f_h v_m T        energy created
//! G ← G + ΔG,   E ← min(E_0, E − ΔG)          G(0) = 0, E(0) = E_0
//! ```
//!
//! A held force does f·Δq of work whatever the path, so this is exact, one sample later: at t_{k+1}, after the slip.
//! The ports are (f_h ; K v_m/alpha) and (dq ; −tau_a).
//!
//! Under a law that keeps its tank ([`Row::keeps_tank`](crate::law::Row::keeps_tank)) the tank stays ≥ 0, and with it G ≤ E_0,
//! for every motion within the [`Reach`]:
//! 1. [`settle`](Ledger::settle), at the sample's end: the springs are given up as far as must be, so that what did happen is
//!    paid for. A motion beyond the reach may leave a debt, E < 0; there is no force until it is repaid.
//! 2. [`covers`](Ledger::covers), at the next one's beginning: whether the tank covers a force whatever the robot does, and if
//!    not, what [`share`](Ledger::share) of it.
//! 3. [`book`](Ledger::book): both are taken over.
//!
//! Under the other laws the tank is observed only.
//!
//! With alpha = 0 there is no such port and no storage: [`Ledger::is_defined`] says so, and all values are 0.

use crate::budget::{self, SampleReach};
use crate::settling::Settlement;
use crate::{Reach, Real, Settings, real};
use nalgebra::SVector;

/// The ledger of N coordinates with one tank.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ledger<const N: usize> {
    pub(crate) terms: Terms<N>,
    pub(crate) H: Real,
    pub(crate) G: Real,
    pub(crate) tank: Real,
    pub(crate) q: Option<SVector<Real, N>>,
    /// the last motion, m
    pub(crate) step: Option<SVector<Real, N>>,
    outside: bool,
    /// the force that the last tick said
    commanded: SVector<Real, N>,
    /// the force that acts now: with a delay the one before
    pub(crate) acting: SVector<Real, N>,
    /// since when it does, if that was within this sample
    switched: Option<Switched<N>>,
    pub(crate) flow: Flow,
    /// how far rounding may have carried the tank below zero since it was last above
    pub(crate) rounding: Real,
}

/// What stays fixed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Terms<const N: usize> {
    /// whether there is a storage: alpha > 0
    pub defined: bool,
    /// whether the tank is kept ≥ 0
    pub kept: bool,
    /// whether a force acts later than it is said
    pub delayed: bool,
    /// by what part of a sample, in (0, 1]
    pub lag: Real,
    pub E_0: Real,
    pub reach: SampleReach<N>,
}

/// Where, within a sample, a force began to act.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Switched<const N: usize> {
    /// The position, m, if it is known.
    q: Option<SVector<Real, N>>,
    /// Work of the force before it, J.
    done: Real,
}

/// Energies of the sample that begins, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Flow {
    /// What the human's port brings: (K/alpha) f_h v_m T.
    pub supplied: Real,
    /// The terms of what passes the coupling, at their sizes.
    pub exchanged: Real,
}

impl<const N: usize> Ledger<N> {
    /// Nothing stored, nothing created, nothing acting.
    pub fn new(settings: &Settings, reach: &Reach<N>) -> Self {
        let defined = settings.alpha > 0.0;
        Self {
            terms: Terms {
                defined,
                kept: defined && settings.law.row().keeps_tank,
                delayed: settings.delayed,
                lag: 1.0,
                E_0: settings.E_0,
                reach: SampleReach::new(reach, settings.T),
            },
            H: 0.0,
            G: 0.0,
            tank: if defined { settings.E_0 } else { 0.0 },
            q: None,
            step: None,
            outside: false,
            commanded: SVector::zeros(),
            acting: SVector::zeros(),
            switched: None,
            flow: Flow::default(),
            rounding: 0.0,
        }
    }

    /// Whether the tank covers the force `f` (N), whatever the robot does within its reach after the sample that ended with
    /// `settlement`. `taken` is the energy (J) that the law is sure to take in the sample that begins.
    ///
    /// need = max f·Δq − taken ≤ E
    ///
    /// With a delay the force works one sample later, and the one before it works now; both are looked at.
    #[inline]
    pub fn covers(&self, settlement: &Settlement<N>, f: &SVector<Real, N>, taken: Real) -> bool {
        if !self.terms.kept {
            return true;
        }
        let [reserved, work] = self.most_work(settlement, f);
        reserved + work - taken <= settlement.tank
    }

    /// The share of the force `f` (N) that the tank covers where it does not cover the whole: the largest σ in [0, 1) with
    /// need(σ) ≤ E. `taken(σ)` is the energy (J) that the law is sure to take under it.
    ///
    /// need(σ) = σ max f·Δq − taken(σ)
    #[cold]
    pub fn share(
        &self,
        settlement: &Settlement<N>,
        f: &SVector<Real, N>,
        taken: impl Fn(Real) -> Real,
    ) -> Real {
        let [reserved, work] = self.most_work(settlement, f);
        budget::share(|s| reserved + s * work - taken(s), settlement.tank)
    }

    /// Most work (J) in the sample that begins after `settlement`: of a force that has been said before, and of the force `f`
    /// (N).
    #[inline]
    fn most_work(&self, settlement: &Settlement<N>, f: &SVector<Real, N>) -> [Real; 2] {
        let Settlement { step, outside, .. } = settlement;
        let last = foretelling(step.as_ref(), *outside);
        let reach = &self.terms.reach;
        if !self.terms.delayed {
            return [0.0, reach.most_work(f, last, 1)];
        }
        let work = if self.is_lagging() {
            self.terms.reach.most_by_speed(f)
        } else {
            // Not less than 0: what a force takes from the robot in the next sample cannot pay for this one.
            real::max(0.0, reach.most_work(f, last, 2))
        };
        [self.reserved(step.as_ref(), *outside), work]
    }

    /// Most work (J) of a force that has been said a sample ago, in the sample that begins after the motion `step` (m).
    #[inline]
    pub(crate) fn reserved(&self, step: Option<&SVector<Real, N>>, outside: bool) -> Real {
        if !self.terms.delayed {
            0.0
        } else if self.is_lagging() {
            // The acceleration bounds the motion of whole samples only: of a part of one the speed does.
            self.terms.lag * self.terms.reach.most_by_speed(&self.commanded)
        } else {
            let last = foretelling(step, outside);
            self.terms.reach.most_work(&self.commanded, last, 1)
        }
    }

    /// Takes over the sample that ended at the position `q` (m), if it is known, and opens the one that begins: with the force
    /// `f` (N) on the robot that this tick says, and the energies that pass the nominal.
    #[inline]
    pub fn book(
        &mut self,
        ended: &Settlement<N>,
        q: Option<&SVector<Real, N>>,
        f: &SVector<Real, N>,
        flow: Flow,
    ) {
        self.q = q.copied();
        (self.step, self.outside) = (ended.step, ended.outside);
        (self.H, self.G, self.tank) = (ended.H, ended.G, ended.tank);
        self.rounding = ended.rounding;
        if self.terms.defined {
            self.acting = if self.terms.delayed {
                self.commanded
            } else {
                *f
            };
            (self.commanded, self.flow) = (*f, flow);
        }
        self.switched = None;
    }

    /// With a delay of this `part` of a sample, in (0, 1), in place of a whole one: [`switch`](Self::switch) then says when
    /// a force begins to act. It has no effect without a delay.
    pub fn lag(&mut self, part: Real) {
        self.terms.lag = part;
    }

    /// Whether a force begins to act within a sample.
    fn is_lagging(&self) -> bool {
        self.terms.delayed && self.terms.lag < 1.0
    }

    /// The force that the last tick said begins to act at the position `q` (m), within the sample; `None` where that is not
    /// known. The first call between two ticks counts.
    pub fn switch(&mut self, q: Option<&SVector<Real, N>>) {
        if !self.terms.defined || !self.is_lagging() || self.switched.is_some() {
            return;
        }
        let done = match (q, &self.q) {
            (Some(q), Some(last)) => self.acting.dot(&(q - last)),
            _ => self.terms.lag * self.terms.reach.most_by_speed(&self.acting),
        };
        self.acting = self.commanded;
        self.switched = Some(Switched {
            q: q.copied(),
            done,
        });
    }

    /// Work (J) of the forces in the sample that ends at the position `q` (m).
    #[inline]
    pub(crate) fn work(&self, q: &SVector<Real, N>) -> Real {
        match (&self.switched, &self.q) {
            (None, Some(last)) => self.acting.dot(&(q - last)),
            (Some(switched), _) => self.work_switched(switched, q),
            (None, None) => self.work_unseen(),
        }
    }

    #[cold]
    fn work_switched(&self, switched: &Switched<N>, q: &SVector<Real, N>) -> Real {
        let since = |from: SVector<Real, N>| switched.done + self.acting.dot(&(q - from));
        switched.q.map_or_else(|| self.work_unseen(), since)
    }

    /// The most that it can be where nobody saw the motion, J.
    #[cold]
    pub(crate) fn work_unseen(&self) -> Real {
        if !self.is_lagging() {
            let reach = &self.terms.reach;
            return reach.most_work(&self.acting, self.foretelling(), 1);
        }
        let lag = self.terms.lag;
        match &self.switched {
            Some(switched) => {
                switched.done + (1.0 - lag) * self.terms.reach.most_by_speed(&self.acting)
            }
            None => {
                lag * self.terms.reach.most_by_speed(&self.acting)
                    + (1.0 - lag) * self.terms.reach.most_by_speed(&self.commanded)
            }
        }
    }

    /// The terms of the work up to the position `q` (m) at their sizes, J.
    pub(crate) fn work_size(&self, q: &SVector<Real, N>) -> Real {
        let (from, done) = match &self.switched {
            Some(switched) => (switched.q, switched.done),
            None => (self.q, 0.0),
        };
        let since = |from: SVector<Real, N>| self.acting.abs().dot(&(q - from).abs());
        real::abs(done) + from.map_or(0.0, since)
    }

    /// How far the actuators moved in the sample before the last tick, m or rad; `None` where nobody knows.
    #[inline]
    pub const fn motion(&self) -> Option<&SVector<Real, N>> {
        self.step.as_ref()
    }

    /// Counts positions from a place that is further on by `by` (m).
    pub fn count_from(&mut self, by: &SVector<Real, N>) {
        self.q = self.q.map(|q| q - by);
        if let Some(switched) = &mut self.switched {
            switched.q = switched.q.map(|q| q - by);
        }
    }

    /// The last motion (m), as far as it says anything on the next one.
    pub(crate) fn foretelling(&self) -> Option<&SVector<Real, N>> {
        foretelling(self.step.as_ref(), self.outside)
    }

    /// Whether there is an energy to speak of: alpha > 0.
    pub fn is_defined(&self) -> bool {
        self.terms.defined
    }

    /// H, stored at the last tick, J.
    pub fn H(&self) -> Real {
        self.H
    }

    /// G, created up to the last tick, J; negative: dissipated.
    pub fn G(&self) -> Real {
        self.G
    }

    /// E, what the tank holds at the last tick, J.
    pub fn tank(&self) -> Real {
        self.tank
    }

    /// Whether the last motion exceeded the reach, for which passivity is promised. The first one has no predecessor to
    /// accelerate from and is held against v_max only.
    pub fn is_outside(&self) -> bool {
        self.outside
    }

    /// Whether the tank is kept and yet below zero by more than rounding: a motion beyond the reach has cost more than it
    /// held.
    pub fn is_in_debt(&self) -> bool {
        self.terms.kept && self.tank < -self.rounding
    }
}

/// The motion `step` (m), as far as it says anything on the next one: not when it left the reach.
#[inline]
fn foretelling<const N: usize>(
    step: Option<&SVector<Real, N>>,
    outside: bool,
) -> Option<&SVector<Real, N>> {
    step.filter(|_| !outside)
}
