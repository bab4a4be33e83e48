//! N axes, without a ledger: what several scalars do at one tick.

mod columns;
mod request;
mod seldom;
mod within;

pub use columns::{AxesDriven, AxesProposal, AxesSensed};
pub use request::Request;

use crate::axis::Axis;
use crate::bounds::{Bounds, Interval};
use crate::law::Yields;
use crate::midpoint::{self, slower};
use crate::motion::Sampling;
use crate::real::{floored, sat};
use crate::servo::{Drivable, Drive};
use crate::settling::Keep;
use crate::tick::{Coordinates, Tick};
use crate::{Gains, ParameterError, Real, Settings};
use nalgebra::SVector;

/// N axes of the law between two ticks. They start out of the loop; the first tick engages them with q_n = q and v_n = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Axes<const N: usize> {
    settings: Settings,
    sampling: Sampling,
    tuning_ticks: u32,
    axes: SVector<Axis, N>,
    /// whether any of them has bounds
    bounded: bool,
    /// whether their springs keep to a force
    limited: bool,
    engaged: bool,
    /// the last tick in the loop
    last: Last<N>,
}

/// What is remembered of a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Last<const N: usize> {
    q: SVector<Real, N>,
    dq: SVector<Real, N>,
    /// where the nominals go from there, m and m/s
    q_n: SVector<Real, N>,
    v_n: SVector<Real, N>,
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
            bounded: false,
            limited: settings.law.row().spring == Yields::Force,
            engaged: false,
            last: Last {
                q: SVector::zeros(),
                dq: SVector::zeros(),
                q_n: SVector::zeros(),
                v_n: SVector::zeros(),
            },
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
        self.bounded = self.axes.iter().any(|axis| axis.bounds.is_some());
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

    /// Energy of the spring of axis `i`, from 0, at the extension `e` (m), J.
    #[inline]
    fn spring(&self, i: usize, e: Real) -> Real {
        let spring = &self.axes[i].rule.spring;
        if self.limited {
            spring.energy(e)
        } else {
            spring.quadratic(e)
        }
    }

    /// Whether gains are on their way.
    #[inline]
    fn is_tuning(&self) -> bool {
        self.axes.iter().any(|axis| axis.changed_from().is_some())
    }

    /// The nominals move on as `driven`; where one is set back to `v_b` (m/s), it is so if that has no more energy.
    #[inline(always)]
    fn move_on(
        &mut self,
        proposal: &AxesProposal<N>,
        driven: &AxesDriven<N>,
        v_b: Option<&[Option<Real>; N]>,
    ) {
        let Self { settings, axes, .. } = self;
        let mut v_n = SVector::<Real, N>::from_fn(|i, _| {
            midpoint::end(proposal.sensed.v_n[i], driven.v_m[i])
        });
        if driven.is_held() {
            for i in 0..N {
                if driven.held[i] {
                    v_n[i] = slower(v_n[i], driven.v_m[i]);
                }
            }
        }
        if let Some(v_b) = v_b {
            for i in 0..N {
                v_n[i] = v_b[i].map_or(v_n[i], |v_b| slower(v_n[i], v_b));
            }
        }
        self.last = Last {
            q: proposal.sensed.q,
            dq: proposal.sensed.dq,
            q_n: proposal.q_n() + driven.v_m * settings.T,
            v_n: v_n.map(floored),
        };
        for axis in axes.iter_mut() {
            axis.pass(settings);
        }
        self.engaged = true;
    }
}

/// What each tick calls once is inlined whatever its size: where a rarer way calls it, too, a compiler would call it, and what
/// goes in and out would go through memory.
impl<const N: usize> Coordinates<N> for Axes<N> {
    type Place = SVector<Real, N>;
    type Request = Request<N>;
    type Sensed = AxesSensed<N>;
    type Proposal = AxesProposal<N>;
    type Driven = AxesDriven<N>;

    fn settings(&self) -> &Settings {
        &self.settings
    }

    fn is_engaged(&self) -> bool {
        self.engaged
    }

    #[inline]
    #[expect(clippy::eq_op, reason = "q_n - q: 0, and no number where q is none")]
    fn sense(&self, q: &SVector<Real, N>, after: Real) -> AxesSensed<N> {
        let last = &self.last;
        let mut sensed = if !self.engaged {
            // q_n = q, v_n = 0, nothing is known of the motion.
            AxesSensed {
                q: *q,
                dq: SVector::zeros(),
                e: q - q,
                v_n: SVector::zeros(),
            }
        } else if after == 1.0 && !self.sampling.is_filtered() && !self.is_tuning() {
            AxesSensed {
                q: *q,
                dq: (q - last.q) / self.settings.T,
                e: last.q_n - q,
                v_n: last.v_n,
            }
        } else {
            self.sense_otherwise(q, after)
        };
        for i in 0..N {
            sensed.e[i] = self.axes[i].rule.spring.slipped(sensed.e[i]);
        }
        sensed
    }

    #[inline(always)]
    fn stored(&self, sensed: &AxesSensed<N>) -> Real {
        sum::<N>(|i| {
            let rule = &self.axes[i].rule;
            rule.mass.energy(sensed.v_n[i]) + self.spring(i, sensed.e[i])
        })
    }

    fn springs(&self, sensed: &AxesSensed<N>) -> Real {
        sum::<N>(|i| self.spring(i, sensed.e[i]))
    }

    fn masses(&self, sensed: &AxesSensed<N>) -> Real {
        sum::<N>(|i| self.axes[i].rule.mass.energy(sensed.v_n[i]))
    }

    fn reduce(&self, sensed: &mut AxesSensed<N>, keep: Keep) {
        sensed.e *= keep.e;
        sensed.v_n *= keep.v_n;
    }

    #[inline(always)]
    fn propose(
        &self,
        sensed: &AxesSensed<N>,
        f_h: &SVector<Real, N>,
        request: &Request<N>,
    ) -> AxesProposal<N> {
        let damping = &request.damping;
        let sample = |i: usize| sensed.sample(i, f_h[i], damping[i]);
        let free = SVector::from_fn(|i, _| self.axes[i].rule.coupled(&sample(i)));
        let is_free = !self.bounded && request.leaves_free();
        let (interval, wish) = if is_free {
            let held = [false; N];
            ([Interval::ALL; N], AxesDriven { v_m: free, held })
        } else {
            let interval = self.intervals(*sensed, *request);
            (interval, AxesDriven::within(&interval, &free))
        };
        AxesProposal {
            sensed: *sensed,
            f_h: *f_h,
            damping: *damping,
            interval,
            wish,
            f_demand: SVector::from_fn(|i, _| {
                let rule = &self.axes[i].rule;
                rule.gains.K * rule.coupling(&sample(i), wish.v_m[i])
            }),
        }
    }

    #[inline]
    fn f(&self, proposal: &AxesProposal<N>) -> SVector<Real, N> {
        SVector::from_fn(|i, _| sat(proposal.f_demand[i], self.axes[i].gains().f_max))
    }

    #[inline(always)]
    fn driven(&self, proposal: &AxesProposal<N>, f: &SVector<Real, N>) -> AxesDriven<N> {
        let feels = self.settings.law.row().feels_what_is_delivered();
        if !feels || *f == proposal.f_demand {
            return proposal.wish;
        }
        self.driven_by(*proposal, *f)
    }

    #[inline(always)]
    fn taken(
        &self,
        proposal: &AxesProposal<N>,
        driven: &AxesDriven<N>,
        f: &SVector<Real, N>,
    ) -> Real {
        sum::<N>(|i| {
            let (rule, sample) = (&self.axes[i].rule, proposal.sample(i));
            rule.taken(&sample, f[i], driven.v_m[i]) + self.spring(i, sample.e)
        })
    }

    #[inline]
    fn supplied(&self, proposal: &AxesProposal<N>, driven: &AxesDriven<N>) -> Real {
        sum::<N>(|i| self.axes[i].rule.supplied(proposal.f_h[i], driven.v_m[i]))
    }

    #[inline]
    fn exchanged(&self, proposal: &AxesProposal<N>, driven: &AxesDriven<N>) -> Real {
        let dq = &proposal.sensed.dq;
        sum::<N>(|i| self.axes[i].rule.exchanged(dq[i], driven.v_m[i]))
    }

    #[inline]
    fn show(&self, proposal: &AxesProposal<N>, driven: &AxesDriven<N>, tick: &mut Tick<N>) {
        let AxesSensed { dq, e, v_n, .. } = &proposal.sensed;
        tick.f_demand = proposal.f_demand;
        tick.q_n = proposal.q_n();
        (tick.dq_n, tick.e_nr, tick.dq) = (*v_n, *e, *dq);
        tick.held = driven.is_held();
    }

    #[inline]
    fn commit(&mut self, proposal: &AxesProposal<N>, driven: &AxesDriven<N>, f: &SVector<Real, N>) {
        if !self.settings.law.row().slips() || *f == proposal.f_demand {
            return self.move_on(proposal, driven, None);
        }
        let v_b = self.at_the_bounds(*proposal, *f);
        self.move_on(proposal, driven, Some(&v_b));
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

    fn v_m(&self, driven: &AxesDriven<N>) -> SVector<Real, N> {
        driven.v_m
    }

    fn follow(
        &mut self,
        proposal: &AxesProposal<N>,
        driven: &AxesDriven<N>,
        v_b: &[Option<Real>; N],
    ) {
        self.move_on(proposal, driven, Some(v_b));
    }
}

/// The sum of something over N axes, from 0.
#[inline(always)]
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
