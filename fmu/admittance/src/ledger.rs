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
//! The ports are (f_h ; K v_n/alpha) and (dq ; −tau_a).
//!
//! Under a law that keeps its tank ([`Row::keeps_tank`](crate::law::Row::keeps_tank)) it is held ≥ 0, and with it G ≤ E_0, for every motion within the [`Reach`]:
//! 1. looking ahead, [`share`](Ledger::share) says how much of a force the tank covers whatever the robot does;
//! 2. settling, [`settle`](Ledger::settle) gives up the spring as far as it must so that what did happen is paid for. A motion beyond the reach may leave a debt, E < 0; there is no force until it is repaid.
//!
//! Under the other laws the tank is observed only.
//!
//! With alpha = 0 there is no such port and no storage: [`Ledger::is_defined`] says so, and all values are 0.

use crate::{Reach, Real, Settings, budget, real};
use nalgebra::SVector;

/// The ledger of N coordinates with one tank.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ledger<const N: usize> {
    defined: bool,
    enforced: bool,
    delayed: bool,
    T: Real,
    E_0: Real,
    reach: Reach<N>,
    H: Real,
    G: Real,
    tank: Real,
    q: Option<SVector<Real, N>>,
    last_step: Option<SVector<Real, N>>,
    outside: bool,
    commanded: SVector<Real, N>,
    acting: SVector<Real, N>,
    supplied: Real,
    /// how far rounding may have carried the tank below zero since it was last above
    rounding: Real,
}

/// What rounding may take from the tank in a sample, relative to the terms of ΔG.
const A_SAMPLE: Real = 64.0 * Real::EPSILON;

/// What is kept of the stored energy, as shares of e and of v_n in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Keep {
    /// Share of every position error.
    pub e: Real,
    /// Share of every nominal velocity.
    pub v_n: Real,
}

/// A law at a tick, once the position is known: what it stores and can give up.
pub trait Stored: Sized {
    /// Energy stored, J. Not finite for alpha = 0.
    fn stored(&self, settings: &Settings) -> Real;
    /// The springs' part of it, J.
    fn spring(&self, settings: &Settings) -> Real;
    /// The nominal masses' part of it, J; not as a difference, which would round like the whole.
    fn masses(&self, settings: &Settings) -> Real;
    /// With these shares of the position errors and of the nominal velocities kept.
    #[must_use]
    fn reduced(&self, keep: Keep) -> Self;
}

impl<const N: usize> Ledger<N> {
    /// Nothing stored, nothing created, nothing acting.
    pub fn new(settings: &Settings, reach: Reach<N>) -> Self {
        let defined = settings.alpha > 0.0;
        Self {
            defined,
            enforced: defined && settings.law.row().keeps_tank,
            delayed: settings.delayed,
            T: settings.T,
            E_0: settings.E_0,
            reach,
            H: 0.0,
            G: 0.0,
            tank: if defined { settings.E_0 } else { 0.0 },
            q: None,
            last_step: None,
            outside: false,
            commanded: SVector::zeros(),
            acting: SVector::zeros(),
            supplied: 0.0,
            rounding: 0.0,
        }
    }

    /// Settles the sample that ends now at the position `q` (m), by giving up as much of what `law` stores as must be for
    /// the tank to stay ≥ 0.
    #[must_use]
    pub fn settle<S: Stored>(self, law: S, settings: &Settings, q: &SVector<Real, N>) -> (Self, S) {
        let H = law.stored(settings);
        if !self.enforced || self.created(H, q) <= self.tank {
            return (self.settled(H, q), law);
        }
        let keep = self.shares_to_keep(law.spring(settings), law.masses(settings), q);
        let reduced = law.reduced(keep);
        (self.settled(reduced.stored(settings), q), reduced)
    }

    /// What may be kept at this tick, with the position `q` (m), of the energy that the law stores in its springs and in its
    /// nominal masses (J), for the tank to stay ≥ 0: what is given up is taken from the springs first.
    ///
    /// It is found without the springs' energy, which can be many times what is left of it: a difference of the two would
    /// leave the larger one's rounding.
    fn shares_to_keep(&self, spring: Real, masses: Real, q: &SVector<Real, N>) -> Keep {
        let affordable = self.tank - self.created(0.0, q);
        let share = |energy: Real, affordable: Real| {
            if affordable <= 0.0 {
                0.0
            } else if affordable < energy {
                real::sqrt(affordable / energy)
            } else {
                1.0
            }
        };
        Keep {
            e: share(spring, affordable - masses),
            v_n: share(masses, affordable),
        }
    }

    /// Settles the sample that ends now, with the energy `H` (J) that the law stores now and the position `q` (m).
    #[must_use]
    pub fn settled(self, H: Real, q: &SVector<Real, N>) -> Self {
        let step = self.q.map(|last| q - last);
        let moved = Self {
            q: Some(*q),
            last_step: step,
            outside: step
                .is_some_and(|step| self.reach.is_left(&step, self.last_step.as_ref(), self.T)),
            ..self
        };
        if !self.defined {
            return moved;
        }
        let created = self.created(H, q);
        // With a delay, a force has been said that acts only now: what may cover it is not poured away.
        let most = real::max(self.E_0, moved.reserved());
        let tank = real::min(self.tank - created, most);
        Self {
            H,
            G: self.G + created,
            tank,
            rounding: if tank < 0.0 {
                real::max(self.rounding, A_SAMPLE * self.size(H, q))
            } else {
                0.0
            },
            ..moved
        }
    }

    /// Settles the sample that ends now at a position that is not known, with nothing left stored: the tank pays for the most
    /// that the force can have done, and, with a delay, at the next sample again. Where that is beyond all numbers the ledger
    /// keeps what it last knew.
    #[must_use]
    pub fn unseen(self) -> Self {
        let foretelling = self.foretelling();
        let most = self.reach.most_work(&self.acting, foretelling, 1, self.T);
        let unseen = Self {
            q: None,
            last_step: None,
            outside: false,
            ..self
        };
        let created = most - self.H - self.supplied;
        if !self.defined || !(self.G + created).is_finite() {
            return unseen;
        }
        let tank = real::min(self.tank - created, real::max(self.E_0, unseen.reserved()));
        let size = real::abs(self.tank) + real::abs(most) + self.H + real::abs(self.supplied);
        Self {
            H: 0.0,
            G: self.G + created,
            tank,
            rounding: if tank < 0.0 {
                real::max(self.rounding, A_SAMPLE * size)
            } else {
                0.0
            },
            ..unseen
        }
    }

    /// The same without a motion to judge the next one by: the law engages, and what was sensed before need not have been
    /// the robot.
    #[must_use]
    pub fn without_motion(self) -> Self {
        Self {
            last_step: None,
            outside: false,
            ..self
        }
    }

    /// The same with positions counted from a place that is further on by `by` (m).
    #[must_use]
    pub fn counted_from(self, by: &SVector<Real, N>) -> Self {
        Self {
            q: self.q.map(|q| q - by),
            ..self
        }
    }

    /// Opens the sample that begins now: the force `f` (N) on the robot that this tick says, and the energy
    /// (K/alpha) f_h v_m T (J) that the human's port brings.
    #[must_use]
    pub fn opened(self, f: &SVector<Real, N>, supplied: Real) -> Self {
        if !self.defined {
            return self;
        }
        let acting = if self.delayed { self.commanded } else { *f };
        Self {
            commanded: *f,
            acting,
            supplied,
            ..self
        }
    }

    /// Share of the force `f` (N) that the tank covers, whatever the robot does within its reach. `taken(σ)` is the energy
    /// (J) that the law is sure to take in the sample that begins with the share σ.
    ///
    /// need(σ) = σ max f·Δq − taken(σ) ≤ E
    ///
    /// With a delay the force works one sample later, and the one before it works now; both are looked at.
    pub fn share(&self, f: &SVector<Real, N>, taken: impl Fn(Real) -> Real) -> Real {
        if !self.enforced {
            return 1.0;
        }
        let last = self.foretelling();
        let reserved = self.reserved();
        let work = if self.delayed {
            // Not less than 0: what a force takes from the robot in the next sample cannot pay for this one.
            real::max(0.0, self.reach.most_work(f, last, 2, self.T))
        } else {
            self.reach.most_work(f, last, 1, self.T)
        };
        budget::share(|s| reserved + s * work - taken(s), self.tank)
    }

    /// Most work (J) in the sample that begins of a force that has been said a sample ago.
    fn reserved(&self) -> Real {
        if self.delayed {
            self.reach
                .most_work(&self.commanded, self.foretelling(), 1, self.T)
        } else {
            0.0
        }
    }

    /// The last motion (m), as far as it says anything on the next one: not when it left the reach.
    fn foretelling(&self) -> Option<&SVector<Real, N>> {
        self.last_step.as_ref().filter(|_| !self.outside)
    }

    fn created(&self, H: Real, q: &SVector<Real, N>) -> Real {
        let work = match &self.q {
            Some(last) => self.acting.dot(&(q - last)),
            None => self.reach.most_work(&self.acting, None, 1, self.T),
        };
        H - self.H + work - self.supplied
    }

    /// The terms of ΔG at their sizes, J.
    fn size(&self, H: Real, q: &SVector<Real, N>) -> Real {
        let work = self
            .q
            .map_or(0.0, |last| self.acting.abs().dot(&(q - last).abs()));
        real::abs(self.tank) + H + self.H + work + real::abs(self.supplied)
    }

    /// Whether there is an energy to speak of: alpha > 0.
    pub fn is_defined(&self) -> bool {
        self.defined
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

    /// Whether the tank is enforced and below zero by more than rounding: a motion beyond the reach has cost more than it
    /// held.
    pub fn is_in_debt(&self) -> bool {
        self.enforced && self.tank < -self.rounding
    }
}
