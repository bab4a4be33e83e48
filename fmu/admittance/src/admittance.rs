//! N axes under one ledger.

use crate::{Axis, Gains, Ledger, ParameterError, Real, Settings, axis};
use nalgebra::SVector;

/// The law for N axes: N = 1 is the testbed, N = 3 a task space with diagonal gains.
///
/// It starts out of the loop; the first tick engages it with q_n = q and v_n = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Admittance<const N: usize> {
    settings: Settings,
    axes: SVector<Axis, N>,
    ledger: Ledger<N>,
    engaged: bool,
}

/// What the axes ask for at a tick. Nothing has happened until it is committed; it may be dropped.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Proposal<const N: usize> {
    axes: SVector<axis::Proposal, N>,
    ledger: Ledger<N>,
}

/// What happened at a tick; every value is the one at t_k.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick<const N: usize> {
    /// Force on the robot, N: s·sat(K y), held until the next tick.
    pub f: SVector<Real, N>,
    /// K y before any limit, N.
    pub f_demand: SVector<Real, N>,
    /// Nominal position q + e_nr, m.
    pub q_n: SVector<Real, N>,
    /// Nominal velocity, m/s.
    pub dq_n: SVector<Real, N>,
    /// q_n − q after the slip, m.
    pub e_nr: SVector<Real, N>,
    /// The robot's velocity as the law used it, m/s.
    pub dq: SVector<Real, N>,
    /// Whether any axis got less than it asked for.
    pub saturated: bool,
    /// Whether the motion since the last tick exceeded v_max or a_max, to which the passivity argument is restricted.
    pub outside_bounds: bool,
    /// Whether the law is in the loop.
    pub engaged: bool,
    /// Energy (K/alpha) f_h v_m T that the human's port brings in the sample that begins, J: for a caller who keeps a
    /// [`Ledger`] of its own, where the force works on other coordinates than q. Not finite for alpha = 0.
    pub supplied: Real,
}

impl<const N: usize> Admittance<N> {
    /// A law out of the loop.
    ///
    /// # Errors
    /// The first parameter out of its range, or a law that is not offered.
    pub fn new(settings: Settings, gains: [Gains; N]) -> Result<Self, ParameterError> {
        settings.check()?;
        check(&gains)?;
        let axes = SVector::from(gains).map(|gains| Axis::new(gains, 0.0));
        Ok(Self {
            settings,
            axes,
            ledger: Ledger::new(&settings),
            engaged: false,
        })
    }

    /// Other gains from the next tick on, taken over so that the stored energy does not rise.
    ///
    /// # Errors
    /// The first parameter out of its range; the gains stay as they were.
    pub fn tune(&mut self, gains: [Gains; N]) -> Result<(), ParameterError> {
        check(&gains)?;
        self.axes.zip_apply(&SVector::from(gains), |axis, gains| {
            *axis = axis.tuned(gains)
        });
        Ok(())
    }

    /// What the axes ask for at a tick with positions `q` (m) and human forces `f_h` (N) along the axes.
    pub fn propose(&self, q: &SVector<Real, N>, f_h: &SVector<Real, N>) -> Proposal<N> {
        let axes = self.axes.zip_zip_map(q, f_h, |axis, q, f_h| {
            let axis = if self.engaged {
                axis
            } else {
                axis.engaged_at(q)
            };
            axis.propose(q, f_h, &self.settings)
        });
        let H = axes.iter().map(|axis| axis.stored(&self.settings)).sum();
        Proposal {
            axes,
            ledger: self.ledger.settled(H, q),
        }
    }

    /// The nominal moves on. `s` in [0, 1] is the share of [`Proposal::f`] that the actuators deliver, one factor for all
    /// axes so that the force keeps its direction. A NaN counts as 0.
    ///
    /// Under `passive_applied` and `passive_bounded` the nominal feels what is delivered, under `passive` the whole y,
    /// under `standard` nothing.
    ///
    /// With s = 1 the energy statements of the laws hold as they are. A factor below 1 is a limit that the spring does not
    /// know of: while it lasts, the robot may stretch the spring for less work than the spring stores, under every law.
    /// The [`Ledger`] counts it; `passive_bounded` keeps it within ½ f_max²/(K K_P) for each stretch.
    pub fn commit(&mut self, proposal: Proposal<N>, s: Real) -> Tick<N> {
        let s = if s > 0.0 { s.min(1.0) } else { 0.0 };
        let Proposal { axes, ledger } = proposal;
        let done = axes.map(|axis| axis.commit(s, &self.settings));
        let f = done.map(|axis| axis.f);
        let supplied = done.iter().map(|axis| axis.supplied).sum();
        self.axes = done.map(|axis| axis.axis);
        self.ledger = ledger.opened(&f, supplied);
        self.engaged = true;
        Tick {
            f,
            f_demand: axes.map(|axis| axis.f_demand()),
            q_n: axes.map(|axis| axis.q_n()),
            dq_n: axes.map(|axis| axis.dq_n()),
            e_nr: axes.map(|axis| axis.e_nr()),
            dq: axes.map(|axis| axis.motion().dq()),
            saturated: axes.iter().any(|axis| axis.is_limited(s)),
            outside_bounds: axes.iter().any(|axis| axis.motion().outside_bounds()),
            engaged: true,
            supplied,
        }
    }

    /// One tick without any limit but f_max: [`propose`](Self::propose), then [`commit`](Self::commit) with s = 1.
    pub fn step(&mut self, q: &SVector<Real, N>, f_h: &SVector<Real, N>) -> Tick<N> {
        let proposal = self.propose(q, f_h);
        self.commit(proposal, 1.0)
    }

    /// One tick out of the loop at positions `q` (m): no force, q_n = q, v_n = 0. The energy that was stored is given up;
    /// the next [`step`](Self::step) engages anew.
    pub fn rest(&mut self, q: &SVector<Real, N>) -> Tick<N> {
        let zeros = SVector::zeros();
        self.axes.zip_apply(q, |axis, q| *axis = axis.engaged_at(q));
        self.ledger = self.ledger.settled(0.0, q).opened(&zeros, 0.0);
        self.engaged = false;
        Tick {
            f: zeros,
            f_demand: zeros,
            q_n: *q,
            dq_n: zeros,
            e_nr: zeros,
            dq: zeros,
            saturated: false,
            outside_bounds: false,
            engaged: false,
            supplied: 0.0,
        }
    }

    /// Energy stored and created, as of the last tick.
    pub fn ledger(&self) -> &Ledger<N> {
        &self.ledger
    }
}

impl<const N: usize> Proposal<N> {
    /// The force that the axes ask for within ±f_max, N: what the caller maps to its actuators.
    pub fn f(&self) -> SVector<Real, N> {
        self.axes.map(|axis| axis.f())
    }
}

fn check<const N: usize>(gains: &[Gains; N]) -> Result<(), ParameterError> {
    let several = N > 1;
    gains
        .iter()
        .zip(1..)
        .try_for_each(|(gains, axis)| gains.check(several.then_some(axis)))
}
