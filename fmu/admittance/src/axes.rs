//! N axes, without a ledger: what several scalars do at one tick.

mod within;

use crate::axis::{Axis, AxisProposal, AxisRequest, AxisSensed, Driven};
use crate::bounds::Bounds;
use crate::motion::Sampling;
use crate::servo::{Drivable, Drive};
use crate::settling::Keep;
use crate::tick::{Coordinates, Tick};
use crate::{Gains, ParameterError, Real, Settings, real};
use nalgebra::SVector;

/// N axes of the law between two ticks. They start out of the loop; the first tick engages them with q_n = q and v_n = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Axes<const N: usize> {
    settings: Settings,
    sampling: Sampling,
    tuning_ticks: u32,
    axes: SVector<Axis, N>,
    engaged: bool,
}

/// What is asked of the law at a tick, beside its inputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request<const N: usize> {
    /// Part of the force that the robot is to get, in [0, 1]: for fading in and out. A NaN counts as 0.
    pub authority: Real,
    /// Whether the nominal stays where it is: the coupling then supports any load without drift.
    pub hold: bool,
    /// Damping on top of D_n, N·s/m, ≥ 0.
    pub damping: SVector<Real, N>,
    /// Speed that the nominal must not exceed, beside its bounds, m/s, ≥ 0; infinite for no limit.
    pub speed: SVector<Real, N>,
    /// Sample periods that have passed since the position before this one was read; 1: the tick is in time.
    pub after: Real,
}

impl<const N: usize> Default for Request<N> {
    /// The law alone.
    fn default() -> Self {
        Self {
            authority: 1.0,
            hold: false,
            damping: SVector::zeros(),
            speed: SVector::repeat(Real::INFINITY),
            after: 1.0,
        }
    }
}

impl<const N: usize> Request<N> {
    /// The authority within [0, 1].
    pub fn authority(&self) -> Real {
        if self.authority > 0.0 {
            real::min(self.authority, 1.0)
        } else {
            0.0
        }
    }

    /// The part of it that is about axis `i`, from 0.
    fn of(&self, i: usize) -> AxisRequest {
        AxisRequest {
            hold: self.hold,
            damping: self.damping[i],
            speed: self.speed[i],
        }
    }
}

impl<const N: usize> Axes<N> {
    /// Out of the loop, without bounds.
    ///
    /// # Errors
    /// The first parameter out of its range, or a law that is not offered.
    pub fn new(settings: Settings, gains: [Gains; N]) -> Result<Self, ParameterError> {
        settings.check()?;
        check(&gains)?;
        Ok(Self {
            settings,
            sampling: Sampling::new(&settings),
            tuning_ticks: settings.tuning_ticks(),
            axes: SVector::from(gains).map(|gains| Axis::new(&settings, gains)),
            engaged: false,
        })
    }

    /// Within other bounds from the next tick on.
    ///
    /// # Errors
    /// The first bound out of its range; the bounds stay as they were.
    pub fn bound(&mut self, bounds: [Bounds; N]) -> Result<(), ParameterError> {
        for (axis, bounds) in (1..).zip(&bounds) {
            bounds.check(named::<N>(axis))?;
        }
        for (axis, bounds) in self.axes.iter_mut().zip(bounds) {
            axis.bound(bounds);
        }
        Ok(())
    }

    /// Other gains: on a straight line over the tuning time, each step taken over so that the stored energy does not rise.
    ///
    /// # Errors
    /// The first parameter out of its range; the gains stay as they were.
    pub fn tune(&mut self, gains: [Gains; N]) -> Result<(), ParameterError> {
        check(&gains)?;
        for (axis, gains) in self.axes.iter_mut().zip(gains) {
            axis.tune(gains, self.tuning_ticks, &self.settings);
            if !self.engaged {
                axis.settle_gains(&self.settings);
            }
        }
        Ok(())
    }
}

impl<const N: usize> Coordinates<N> for Axes<N> {
    type Place = SVector<Real, N>;
    type Request = Request<N>;
    type Sensed = [AxisSensed; N];
    type Proposal = [AxisProposal; N];
    type Driven = [Driven; N];

    fn settings(&self) -> &Settings {
        &self.settings
    }

    fn is_engaged(&self) -> bool {
        self.engaged
    }

    #[inline]
    fn sense(&self, q: &SVector<Real, N>, after: Real) -> [AxisSensed; N] {
        if self.engaged {
            each(|i| self.axes[i].sense(q[i], after, &self.settings, &self.sampling))
        } else {
            each(|i| self.axes[i].engage(q[i]))
        }
    }

    #[inline]
    fn stored(&self, sensed: &[AxisSensed; N]) -> Real {
        sum::<N>(|i| self.axes[i].stored(&sensed[i]))
    }

    fn springs(&self, sensed: &[AxisSensed; N]) -> Real {
        sum::<N>(|i| self.axes[i].spring(&sensed[i]))
    }

    fn masses(&self, sensed: &[AxisSensed; N]) -> Real {
        sum::<N>(|i| self.axes[i].mass(&sensed[i]))
    }

    fn reduce(&self, sensed: &mut [AxisSensed; N], keep: Keep) {
        for axis in sensed {
            axis.reduce(keep.e, keep.v_n);
        }
    }

    #[inline]
    fn propose(
        &self,
        sensed: &[AxisSensed; N],
        f_h: &SVector<Real, N>,
        request: &Request<N>,
    ) -> [AxisProposal; N] {
        let T = self.settings.T;
        each(|i| self.axes[i].propose(&sensed[i], f_h[i], &request.of(i), T))
    }

    #[inline]
    fn f(&self, proposal: &[AxisProposal; N]) -> SVector<Real, N> {
        SVector::from_fn(|i, _| self.axes[i].f(&proposal[i]))
    }

    #[inline]
    fn driven(&self, proposal: &[AxisProposal; N], f: &SVector<Real, N>) -> [Driven; N] {
        if self.settings.law.row().feels_what_is_delivered() {
            each(|i| self.axes[i].driven(&proposal[i], f[i]))
        } else {
            each(|i| proposal[i].wish())
        }
    }

    #[inline]
    fn taken(
        &self,
        proposal: &[AxisProposal; N],
        driven: &[Driven; N],
        f: &SVector<Real, N>,
    ) -> Real {
        sum::<N>(|i| self.axes[i].taken(&proposal[i], driven[i], f[i]))
    }

    #[inline]
    fn supplied(&self, proposal: &[AxisProposal; N], driven: &[Driven; N]) -> Real {
        sum::<N>(|i| self.axes[i].supplied(&proposal[i], driven[i]))
    }

    #[inline]
    fn exchanged(&self, proposal: &[AxisProposal; N], driven: &[Driven; N]) -> Real {
        sum::<N>(|i| self.axes[i].exchanged(&proposal[i], driven[i]))
    }

    #[inline]
    fn show(&self, proposal: &[AxisProposal; N], driven: &[Driven; N], tick: &mut Tick<N>) {
        tick.held = false;
        for i in 0..N {
            tick.f_demand[i] = proposal[i].f_demand();
            tick.q_n[i] = proposal[i].q_n();
            tick.dq_n[i] = proposal[i].dq_n();
            tick.e_nr[i] = proposal[i].e_nr();
            tick.dq[i] = proposal[i].dq();
            tick.held |= driven[i].held;
        }
    }

    #[inline]
    fn commit(&mut self, proposal: &[AxisProposal; N], driven: &[Driven; N], f: &SVector<Real, N>) {
        let slips = self.settings.law.row().slips();
        for i in 0..N {
            self.axes[i].commit(&proposal[i], driven[i], f[i], slips, &self.settings);
        }
        self.engaged = true;
    }

    fn rest(&mut self) {
        for axis in &mut self.axes {
            axis.settle_gains(&self.settings);
        }
        self.engaged = false;
    }
}

impl<const N: usize> Drivable<N> for Axes<N> {
    fn drive(&self) -> Drive<N> {
        let of = |gain: fn(&Gains) -> Real| SVector::from_fn(|i, _| gain(self.axes[i].gains()));
        Drive {
            K: of(|gains| gains.K),
            K_P: of(|gains| gains.K_P),
            f_max: of(|gains| gains.f_max),
        }
    }

    fn v_m(&self, driven: &[Driven; N]) -> SVector<Real, N> {
        SVector::from_fn(|i, _| driven[i].v_m)
    }

    fn follow(
        &mut self,
        proposal: &[AxisProposal; N],
        driven: &[Driven; N],
        v_b: &[Option<Real>; N],
    ) {
        for i in 0..N {
            self.axes[i].follow(&proposal[i], driven[i], v_b[i], &self.settings);
        }
        self.engaged = true;
    }
}

/// One of something for each axis, from 0.
#[inline]
fn each<T, const N: usize>(of: impl FnMut(usize) -> T) -> [T; N] {
    core::array::from_fn(of)
}

/// The sum of something over N axes, from 0.
#[inline]
fn sum<const N: usize>(mut of: impl FnMut(usize) -> Real) -> Real {
    let mut sum = -0.0; // as the sum of an iterator begins
    for i in 0..N {
        sum += of(i);
    }
    sum
}

/// The axis as messages name it: not at all if there is one only.
fn named<const N: usize>(axis: usize) -> Option<usize> {
    (N > 1).then_some(axis)
}

fn check<const N: usize>(gains: &[Gains; N]) -> Result<(), ParameterError> {
    gains
        .iter()
        .zip(1..)
        .try_for_each(|(gains, axis)| gains.check(named::<N>(axis)))
}
