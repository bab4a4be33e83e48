//! N axes under one ledger, on a robot that takes their forces as they are.

use crate::axes::{Axes, Request};
use crate::bounds::Bounds;
use crate::tick::{Direct, Inputs, Refused, Sampled, Tick};
use crate::{Gains, Ledger, ParameterError, Reach, Real, Settings};
use nalgebra::SVector;

/// The law for N axes: N = 1 is the testbed.
///
/// It starts out of the loop; the first tick engages it with q_n = q and v_n = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Admittance<const N: usize> {
    sampled: Sampled<Axes<N>, N>,
}

impl<const N: usize> Admittance<N> {
    /// A law out of the loop, without bounds, on a robot with the testbed's reach.
    ///
    /// # Errors
    /// The first parameter out of its range, or a law that is not offered.
    pub fn new(settings: Settings, gains: [Gains; N]) -> Result<Self, ParameterError> {
        let axes = Axes::new(settings, gains)?;
        Ok(Self {
            sampled: Sampled::new(axes, &Reach::default())?,
        })
    }

    /// The same on a robot with another reach; its ledger starts anew.
    ///
    /// # Errors
    /// The first value out of its range.
    pub fn reaching(self, reach: Reach<N>) -> Result<Self, ParameterError> {
        Ok(Self {
            sampled: self.sampled.reaching(&reach)?,
        })
    }

    /// The same with a force that changes by no more than `f_rate` (N/s) on each axis, infinite for no limit. The budget
    /// and [`rest`](Self::rest) may take a force away faster.
    ///
    /// # Errors
    /// The first value out of its range.
    pub fn rated(self, f_rate: SVector<Real, N>) -> Result<Self, ParameterError> {
        Ok(Self {
            sampled: self.sampled.rated(&f_rate)?,
        })
    }

    /// Within other bounds from the next tick on.
    ///
    /// # Errors
    /// The first bound out of its range; the bounds stay as they were.
    pub fn bound(&mut self, bounds: [Bounds; N]) -> Result<(), ParameterError> {
        self.sampled.law_mut().bound(bounds)
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
        self.bound(bounds)?;
        self.sampled.count_from(by);
        Ok(())
    }

    /// Other gains: on a straight line over the tuning time, each step taken over so that the stored energy does not rise.
    ///
    /// # Errors
    /// The first parameter out of its range; the gains stay as they were.
    pub fn tune(&mut self, gains: [Gains; N]) -> Result<(), ParameterError> {
        self.sampled.law_mut().tune(gains)
    }

    /// One tick with positions `q` (m) and human forces `f_h` (N) along the axes.
    pub fn step(&mut self, q: &SVector<Real, N>, f_h: &SVector<Real, N>) -> Tick<N> {
        self.tick(q, f_h, &Request::default())
    }

    /// One tick with positions `q` (m) and human forces `f_h` (N) along the axes, and a request beside them.
    #[inline]
    pub fn tick(
        &mut self,
        q: &SVector<Real, N>,
        f_h: &SVector<Real, N>,
        request: &Request<N>,
    ) -> Tick<N> {
        let mut done = Tick::at_rest(q);
        let accept = |tick: &Tick<N>, _| {
            done = *tick;
            true // also what is not finite, which the caller sees
        };
        self.tick_if(q, f_h, request, accept).ok();
        done
    }

    /// The same, if `accept` says yes to the tick and the energy G (J).
    ///
    /// # Errors
    /// It says no: nothing has happened.
    #[inline]
    pub fn tick_if(
        &mut self,
        q: &SVector<Real, N>,
        f_h: &SVector<Real, N>,
        request: &Request<N>,
        accept: impl FnOnce(&Tick<N>, Real) -> bool,
    ) -> Result<(), Refused> {
        let inputs = Inputs {
            place: q,
            q,
            f_h,
            authority: request.authority(),
            request,
            after: request.after,
        };
        self.sampled.tick(&inputs, &Direct, accept)
    }

    /// One tick out of the loop as [`rest`](Self::rest), if `accept` says yes to the energy G (J).
    ///
    /// # Errors
    /// It says no: nothing has happened.
    pub fn rest_if(
        &mut self,
        q: &SVector<Real, N>,
        accept: impl FnOnce(Real) -> bool,
    ) -> Result<Tick<N>, Refused> {
        Ok(Tick {
            outside_bounds: self.sampled.rest(q, accept)?,
            ..Tick::at_rest(q)
        })
    }

    /// One tick out of the loop where the positions are not known: no force. It shows the positions `last` (m).
    pub fn abandon(&mut self, last: &SVector<Real, N>) -> Tick<N> {
        Tick {
            outside_bounds: self.sampled.abandon(),
            ..Tick::at_rest(last)
        }
    }

    /// One tick out of the loop at positions `q` (m): no force, q_n = q, v_n = 0. The energy that was stored is given up;
    /// the next [`step`](Self::step) engages anew.
    pub fn rest(&mut self, q: &SVector<Real, N>) -> Tick<N> {
        let outside = self.sampled.rest(q, |_| true);
        Tick {
            outside_bounds: outside.unwrap_or(false),
            ..Tick::at_rest(q)
        }
    }

    /// A force begins to act this `part` of a sample after its tick, in (0, 1): [`acts`](Self::acts) says where. Only with a
    /// delay.
    pub fn lag(&mut self, part: Real) {
        self.sampled.lag(part);
    }

    /// The force of the last tick begins to act at the positions `q` (m); `None` where they are not known.
    pub fn acts(&mut self, q: Option<&SVector<Real, N>>) {
        self.sampled.acts(q);
    }

    /// The force that the last tick said, N.
    pub fn f(&self) -> &SVector<Real, N> {
        self.sampled.tau()
    }

    /// Sample period, s.
    pub fn T(&self) -> Real {
        self.sampled.T()
    }

    /// Energy stored and created, as of the last tick.
    pub fn ledger(&self) -> &Ledger<N> {
        self.sampled.ledger()
    }
}
