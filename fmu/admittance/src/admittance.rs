//! N axes under one ledger, on a robot that takes their forces as they are.

use crate::axes::{Axes, Committed, Request};
use crate::bounds::Bounds;
use crate::budget::{Reach, share_of_the_way};
use crate::parameters::{check, limit};
use crate::{Gains, Ledger, ParameterError, Real, Settings};
use declaration::range::POSITIVE;
use nalgebra::SVector;

/// The law for N axes: N = 1 is the testbed.
///
/// It starts out of the loop; the first tick engages it with q_n = q and v_n = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Admittance<const N: usize> {
    axes: Axes<N>,
    ledger: Ledger<N>,
    f_rate: SVector<Real, N>,
    f: SVector<Real, N>,
}

/// What happened at a tick; every value is the one at t_k.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick<const N: usize> {
    /// Force on the robot, N, held until the next tick.
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
    /// Whether one of the [`Bounds`], or hold, kept a nominal back.
    pub held: bool,
    /// Share of the force that the energy budget left, in [0, 1]: 1 unless something is wrong.
    pub share: Real,
    /// Whether the motion since the last tick exceeded the [`Reach`], to which the passivity argument is restricted.
    pub outside_bounds: bool,
    /// Whether the law is in the loop.
    pub engaged: bool,
}

impl<const N: usize> Admittance<N> {
    /// A law out of the loop, without bounds, on a robot with the testbed's reach.
    ///
    /// # Errors
    /// The first parameter out of its range, or a law that is not offered.
    pub fn new(settings: Settings, gains: [Gains; N]) -> Result<Self, ParameterError> {
        Ok(Self {
            axes: Axes::new(settings, gains)?,
            ledger: Ledger::new(&settings, Reach::default()),
            f_rate: SVector::repeat(Real::INFINITY),
            f: SVector::zeros(),
        })
    }

    /// The same on a robot with another reach; its ledger starts anew.
    ///
    /// # Errors
    /// The first value out of its range.
    pub fn reaching(self, reach: Reach<N>) -> Result<Self, ParameterError> {
        reach.check()?;
        let ledger = Ledger::new(self.axes.settings(), reach);
        Ok(Self { ledger, ..self })
    }

    /// The same with a force that changes by no more than `f_rate` (N/s) on each axis, infinite for no limit. The budget
    /// and [`rest`](Self::rest) may take a force away faster.
    ///
    /// # Errors
    /// The first value out of its range.
    pub fn rated(self, f_rate: SVector<Real, N>) -> Result<Self, ParameterError> {
        for (axis, f_rate) in (1..).zip(&f_rate) {
            check(
                (N > 1).then_some(axis),
                &[("f_rate", limit(*f_rate), POSITIVE)],
            )?;
        }
        Ok(Self { f_rate, ..self })
    }

    /// Within other bounds from the next tick on.
    ///
    /// # Errors
    /// The first bound out of its range; the bounds stay as they were.
    pub fn bound(&mut self, bounds: [Bounds; N]) -> Result<(), ParameterError> {
        self.axes.bound(bounds)
    }

    /// Counts positions from a place that is further on by `by` (m), and keeps to `bounds`, which are counted from there.
    /// While the law is out of the loop.
    ///
    /// # Errors
    /// The first bound out of its range; nothing has changed.
    pub fn count_from(
        &mut self,
        by: &SVector<Real, N>,
        bounds: [Bounds; N],
    ) -> Result<(), ParameterError> {
        self.axes.bound(bounds)?;
        self.ledger = self.ledger.counted_from(by);
        Ok(())
    }

    /// Other gains: on a straight line over the tuning time, each step taken over so that the stored energy does not rise.
    ///
    /// # Errors
    /// The first parameter out of its range; the gains stay as they were.
    pub fn tune(&mut self, gains: [Gains; N]) -> Result<(), ParameterError> {
        self.axes.tune(gains)
    }

    /// One tick with positions `q` (m) and human forces `f_h` (N) along the axes.
    pub fn step(&mut self, q: &SVector<Real, N>, f_h: &SVector<Real, N>) -> Tick<N> {
        self.tick(q, f_h, &Request::default())
    }

    /// One tick with positions `q` (m) and human forces `f_h` (N) along the axes, and a request beside them.
    pub fn tick(
        &mut self,
        q: &SVector<Real, N>,
        f_h: &SVector<Real, N>,
        request: &Request<N>,
    ) -> Tick<N> {
        let settings = *self.axes.settings();
        let (ledger, sensed) = self.ledger.settle(self.axes.sense(q), &settings, q);
        let ledger = if self.axes.is_engaged() {
            ledger
        } else {
            ledger.without_motion()
        };
        let proposal = sensed.propose(f_h, request, &settings);

        let asked = proposal.f() * request.share();
        let most = self.f_rate * settings.T;
        let way = share_of_the_way(&self.f, &asked, &most);
        let allowed = if way < 1.0 {
            self.f + (asked - self.f) * way
        } else {
            asked
        };
        let share = ledger.share(&allowed, |s| proposal.taken(&(allowed * s), &settings));
        let f = if share < 1.0 {
            allowed * share
        } else {
            allowed
        };

        let done = self.axes.commit(proposal, &f);
        self.ledger = ledger.opened(&f, done.supplied);
        self.f = f;
        let Committed {
            f_demand,
            q_n,
            dq_n,
            e_nr,
            dq,
            held,
            ..
        } = done;
        Tick {
            f,
            f_demand,
            q_n,
            dq_n,
            e_nr,
            dq,
            saturated: f != f_demand,
            held,
            share,
            outside_bounds: self.ledger.is_outside(),
            engaged: true,
        }
    }

    /// One tick out of the loop at positions `q` (m): no force, q_n = q, v_n = 0. The energy that was stored is given up;
    /// the next [`step`](Self::step) engages anew.
    pub fn rest(&mut self, q: &SVector<Real, N>) -> Tick<N> {
        let zeros = SVector::zeros();
        self.axes.rest(q);
        self.ledger = self.ledger.settled(0.0, q).opened(&zeros, 0.0);
        self.f = zeros;
        Tick {
            f: zeros,
            f_demand: zeros,
            q_n: *q,
            dq_n: zeros,
            e_nr: zeros,
            dq: zeros,
            saturated: false,
            held: false,
            share: 1.0,
            outside_bounds: self.ledger.is_outside(),
            engaged: false,
        }
    }

    /// Energy stored and created, as of the last tick.
    pub fn ledger(&self) -> &Ledger<N> {
        &self.ledger
    }
}
