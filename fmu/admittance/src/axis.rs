//! One axis: slip, midpoint, clamp, reset.

use crate::bounds::Interval;
use crate::law::{Felt, Spring};
use crate::midpoint::{self, Midpoint, Sample, slower};
use crate::motion::Sampling;
use crate::real::{floored, sat};
use crate::retune::{self, Tuning};
use crate::{Bounds, Gains, Motion, Real, Settings, storage};

/// One axis of the law between two ticks.
///
/// M_n ddq_n + D_n dq_n = f_h − alpha y,  y = de_nr + K_P e_nr,  tau_a = K y        eq:obs_dyn, eq:dob_input
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Axis {
    tuning: Tuning<Gains>,
    /// none where nothing is bounded
    bounds: Option<Bounds>,
    /// the nominal's position, while the axis is in the loop
    q_n: Option<Real>,
    v_n: Real,
    motion: Motion,
}

/// One axis at a tick, once the position is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sensed {
    /// Position, m.
    q: Real,
    /// The robot's velocity, m/s.
    dq: Real,
    /// Position error, after the slip, m.
    e: Real,
    /// The nominal's velocity, m/s.
    v_n: Real,
}

/// What is asked of one axis at a tick, beside its inputs: its part of [`axes::Request`](crate::axes::Request).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request {
    /// Whether the nominal stays where it is.
    pub hold: bool,
    /// Damping on top of D_n, N·s/m, ≥ 0.
    pub damping: Real,
    /// Speed that the nominal must not exceed, m/s, ≥ 0.
    pub speed: Real,
}

/// What one axis asks for at a tick. Nothing has happened until it is committed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Proposal {
    q: Real,
    sample: Sample,
    interval: Interval,
    wish: Driven,
    /// K y before any limit, N
    f_demand: Real,
}

/// How the nominal moves in the sample that begins.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Driven {
    /// Its velocity at the middle of the sample, m/s.
    pub v_m: Real,
    /// Whether one of the [`Bounds`], or hold, keeps it back.
    pub held: bool,
}

impl Axis {
    /// Out of the loop. The caller has checked the gains.
    pub fn new(gains: Gains) -> Self {
        Self {
            tuning: Tuning::new(gains),
            bounds: None,
            q_n: None,
            v_n: 0.0,
            motion: Motion::default(),
        }
    }

    /// On its way to other gains, which it has after `ticks` ticks; at once while it is out of the loop. The caller has
    /// checked them.
    pub fn tune(&mut self, wanted: Gains, ticks: u32) {
        self.tuning.want(wanted, ticks);
        if self.q_n.is_none() {
            self.tuning.finish();
        }
    }

    /// Within other bounds from the next tick on. The caller has checked them.
    pub fn bound(&mut self, bounds: Bounds) {
        self.bounds = (bounds != Bounds::default()).then_some(bounds);
    }

    /// Out of the loop: nothing is stored, nothing known of the motion. The next tick engages with q_n = q, v_n = 0 and the
    /// gains last wanted.
    pub fn rest(&mut self) {
        self.tuning.finish();
        (self.q_n, self.v_n, self.motion) = (None, 0.0, Motion::default());
    }

    /// The gains at this tick.
    #[inline]
    fn gains(&self) -> &Gains {
        self.tuning.now()
    }

    /// The axis at a tick with position `q` (m): gains on their way take over, the spring slips.
    #[inline]
    pub fn sense(&self, q: Real, settings: &Settings, sampling: &Sampling) -> Sensed {
        let (mut e, mut v_n) = (self.q_n.unwrap_or(q) - q, self.v_n);
        if let Some(last) = self.tuning.changed_from() {
            (e, v_n) = retune::taken_over(settings.law, last, self.gains(), e, v_n);
        }
        Sensed {
            q,
            dq: self.motion.dq(q, sampling),
            e: storage::slipped(settings.law, self.gains(), e),
            v_n,
        }
    }

    /// Energy stored at this tick, J. Not finite for alpha = 0.
    #[inline]
    pub fn stored(&self, sensed: &Sensed, settings: &Settings) -> Real {
        let Sensed { e, v_n, .. } = *sensed;
        storage::stored(settings.law, self.gains(), settings.alpha, e, v_n)
    }

    /// The spring's part of it, J.
    pub fn spring(&self, sensed: &Sensed, settings: &Settings) -> Real {
        storage::spring(settings.law, self.gains(), sensed.e)
    }

    /// The nominal mass's part of it, J. Not finite for alpha = 0.
    pub fn mass(&self, sensed: &Sensed, settings: &Settings) -> Real {
        storage::mass(self.gains(), settings.alpha, sensed.v_n)
    }

    /// What the axis asks for with the human's force `f_h` (N): nominal and coupling are solved together, within the
    /// bounds and the `request`.
    #[inline]
    pub fn propose(
        &self,
        sensed: &Sensed,
        f_h: Real,
        request: &Request,
        settings: &Settings,
    ) -> Proposal {
        let (gains, T) = (self.gains(), settings.T);
        let Sensed { q, dq, e, v_n } = *sensed;
        let sample = Sample {
            e,
            v_n,
            dq,
            f_h,
            D_n: gains.D_n + request.damping,
        };
        let interval = Interval::within(self.bounds.as_ref(), q + e, T, request.hold)
            .no_faster_than(request.speed);
        let Midpoint { v_m: free, mut y } =
            midpoint::coupled(gains, settings.reaction(), T, &sample);
        let v_m = interval.keep(free);
        let held = v_m != free;
        if held {
            y = midpoint::coupling(gains, T, &sample, v_m);
        }
        Proposal {
            q,
            sample,
            interval,
            wish: Driven { v_m, held },
            f_demand: gains.K * y,
        }
    }

    /// What the axis asks for within ±f_max, N.
    #[inline]
    pub fn f(&self, proposal: &Proposal) -> Real {
        sat(proposal.f_demand, self.gains().f_max)
    }

    /// How the nominal moves if the robot gets the force `f` (N).
    #[inline]
    pub fn driven(&self, proposal: &Proposal, f: Real, settings: &Settings) -> Driven {
        let Proposal {
            sample,
            interval,
            wish,
            f_demand,
            ..
        } = proposal;
        match settings.law.row().felt {
            Felt::Delivered if f != *f_demand => {
                let (alpha, T) = (settings.reaction(), settings.T);
                let y_s = f / self.gains().K;
                let free = midpoint::driven(self.gains(), alpha, T, sample, y_s);
                let v_m = interval.keep(free);
                Driven {
                    v_m,
                    held: v_m != free,
                }
            }
            Felt::Delivered | Felt::Coupling | Felt::Nothing => *wish,
        }
    }

    /// Energy (J) that the law is sure to take in the sample that begins, if the robot gets the force `f` (N) and the nominal
    /// is `driven` by it: what the human brings less what the nominal keeps, its damping, and the spring, which can be given
    /// up afterwards.
    ///
    /// −ΔH + (K/alpha) f_h v_m T ≥ K y v_m T + (K/alpha) D_n v_m² T + ½ K K_P e²
    #[inline]
    pub fn taken(&self, proposal: &Proposal, driven: Driven, f: Real, settings: &Settings) -> Real {
        let (gains, sample, v_m) = (self.gains(), &proposal.sample, driven.v_m);
        f * v_m * settings.T
            + gains.K / settings.alpha * sample.D_n * v_m * v_m * settings.T
            + storage::spring(settings.law, gains, sample.e)
    }

    /// Energy (K/alpha) f_h v_m T that the human's port brings in the sample that begins, J. Not finite for alpha = 0.
    #[inline]
    pub fn supplied(&self, proposal: &Proposal, driven: Driven, settings: &Settings) -> Real {
        let Settings { alpha, T, .. } = *settings;
        midpoint::supplied(self.gains(), alpha, T, &proposal.sample, driven.v_m)
    }

    /// The nominal moves on as `driven`, while the robot gets the force `f` (N), which the caller's limits left of what the
    /// axis asked for.
    #[inline]
    pub fn commit(&mut self, proposal: &Proposal, driven: Driven, f: Real, settings: &Settings) {
        let (gains, sample, T) = (self.gains(), &proposal.sample, settings.T);
        let Driven { v_m, held } = driven;
        let mut v_n = midpoint::end(sample, v_m);
        if held {
            v_n = slower(v_n, v_m);
        }
        match settings.law.row().spring {
            Spring::Slips if f != proposal.f_demand => {
                v_n = slower(v_n, midpoint::at_the_bound(gains, T, sample, f / gains.K));
            }
            Spring::Slips | Spring::Limited | Spring::Free => {}
        }
        self.q_n = Some(proposal.q_n() + T * v_m);
        self.v_n = floored(v_n);
        self.motion = Motion::at(proposal.q, sample.dq);
        self.tuning.pass();
    }
}

impl Sensed {
    /// Gives up energy: the position error and the nominal's velocity are reduced to these fractions, in [0, 1].
    pub fn reduce(&mut self, e: Real, v_n: Real) {
        self.e *= e;
        self.v_n *= v_n;
    }
}

impl Proposal {
    /// e_nr = q_n − q at this tick, after the slip, m.
    pub fn e_nr(&self) -> Real {
        self.sample.e
    }

    /// Nominal position at this tick, m.
    #[inline]
    pub fn q_n(&self) -> Real {
        self.q + self.sample.e
    }

    /// Nominal velocity at this tick, m/s.
    pub fn dq_n(&self) -> Real {
        self.sample.v_n
    }

    /// The robot's velocity as the law uses it, m/s.
    pub fn dq(&self) -> Real {
        self.sample.dq
    }

    /// K y before any limit, N.
    pub fn f_demand(&self) -> Real {
        self.f_demand
    }
}
