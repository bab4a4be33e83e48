//! One axis: slip, midpoint, clamp, reset.

mod within;

use crate::bounds::Interval;
use crate::midpoint::{self, Midpoint, Rule, Sample, slower};
use crate::motion::Sampling;
use crate::real::{floored, sat};
use crate::retune::{self, Tuning};
use crate::{Bounds, Gains, Real, Settings, timing};

/// One axis of the law between two ticks.
///
/// M_n ddq_n + D_n dq_n = f_h − alpha y,  y = de_nr + K_P e_nr,  tau_a = K y        eq:obs_dyn, eq:dob_input
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Axis {
    tuning: Tuning<Gains>,
    /// that of the gains at this tick
    rule: Rule,
    /// none where nothing is bounded
    bounds: Option<Bounds>,
    /// the last tick in the loop
    last: Last,
}

/// What is remembered of a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Last {
    q: Real,
    dq: Real,
    /// where the nominal goes from there, m and m/s
    q_n: Real,
    v_n: Real,
}

/// One axis at a tick, once the position is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisSensed {
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
pub struct AxisRequest {
    /// Whether the nominal stays where it is.
    pub hold: bool,
    /// Damping on top of D_n, N·s/m, ≥ 0.
    pub damping: Real,
    /// Speed that the nominal must not exceed, m/s, ≥ 0.
    pub speed: Real,
}

/// What one axis asks for at a tick. Nothing has happened until it is committed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisProposal {
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
    pub fn new(settings: &Settings, gains: Gains) -> Self {
        Self {
            tuning: Tuning::new(gains),
            rule: Rule::new(settings, &gains),
            bounds: None,
            last: Last::default(),
        }
    }

    /// On its way to other gains, which it has after `ticks` ticks. The caller has checked them.
    pub fn tune(&mut self, wanted: Gains, ticks: u32, settings: &Settings) {
        self.tuning.want(wanted, ticks);
        self.rule = Rule::new(settings, self.tuning.now());
    }

    /// At the gains last wanted, at once: the axis is out of the loop.
    pub fn settle_gains(&mut self, settings: &Settings) {
        self.tuning.finish();
        self.rule = Rule::new(settings, self.tuning.now());
    }

    /// Within other bounds from the next tick on. The caller has checked them.
    pub fn bound(&mut self, bounds: Bounds) {
        self.bounds = (bounds != Bounds::default()).then_some(bounds);
    }

    /// The axis engages at the position `q` (m): q_n = q, v_n = 0, nothing is known of the motion.
    #[expect(clippy::eq_op, reason = "q_n - q: 0, and no number where q is none")]
    pub fn engage(&self, q: Real) -> AxisSensed {
        AxisSensed {
            q,
            dq: 0.0,
            e: self.rule.spring.slipped(q - q),
            v_n: 0.0,
        }
    }

    /// The axis in the loop at a tick with position `q` (m), which was read `after` sample periods after the last one: gains
    /// on their way take over, the spring slips.
    #[inline]
    pub fn sense(
        &self,
        q: Real,
        after: Real,
        settings: &Settings,
        sampling: &Sampling,
    ) -> AxisSensed {
        let last = &self.last;
        let q_n = if after == 1.0 {
            last.q_n
        } else {
            let way = timing::more(after) * settings.T * last.v_n;
            Bounds::kept(self.bounds.as_ref(), last.q_n, way)
        };
        let (mut e, mut v_n) = (q_n - q, last.v_n);
        if let Some(gains) = self.tuning.changed_from() {
            (e, v_n) = retune::taken_over(settings.law, gains, self.tuning.now(), e, v_n);
        }
        AxisSensed {
            q,
            dq: sampling.dq(last.q, last.dq, q, after),
            e: self.rule.spring.slipped(e),
            v_n,
        }
    }

    /// Its gains at this tick.
    #[inline]
    pub fn gains(&self) -> &Gains {
        &self.rule.gains
    }

    /// Energy stored at this tick, J. 0 for alpha = 0.
    #[inline]
    pub fn stored(&self, sensed: &AxisSensed) -> Real {
        self.rule.stored(sensed.e, sensed.v_n)
    }

    /// The spring's part of it, J.
    pub fn spring(&self, sensed: &AxisSensed) -> Real {
        self.rule.spring.energy(sensed.e)
    }

    /// The nominal mass's part of it, J. 0 for alpha = 0.
    pub fn mass(&self, sensed: &AxisSensed) -> Real {
        self.rule.mass.energy(sensed.v_n)
    }

    /// What the axis asks for with the human's force `f_h` (N): nominal and coupling are solved together, within the
    /// bounds and the `request`.
    #[inline]
    pub fn propose(
        &self,
        sensed: &AxisSensed,
        f_h: Real,
        request: &AxisRequest,
        T: Real,
    ) -> AxisProposal {
        let rule = &self.rule;
        let AxisSensed { q, dq, e, v_n } = *sensed;
        let sample = Sample {
            e,
            v_n,
            dq,
            f_h,
            damping: request.damping,
        };
        let interval = Interval::within(self.bounds.as_ref(), q + e, T, request.hold)
            .no_faster_than(request.speed);
        let Midpoint { v_m: free, mut y } = rule.coupled(&sample);
        let wish = Driven::within(&interval, free);
        if wish.held {
            y = rule.coupling(&sample, wish.v_m);
        }
        AxisProposal {
            q,
            sample,
            interval,
            wish,
            f_demand: rule.gains.K * y,
        }
    }

    /// What the axis asks for within ±f_max, N.
    #[inline]
    pub fn f(&self, proposal: &AxisProposal) -> Real {
        sat(proposal.f_demand, self.rule.gains.f_max)
    }

    /// How a nominal moves that feels the force `f` (N), which the robot gets.
    #[inline]
    pub fn driven(&self, proposal: &AxisProposal, f: Real) -> Driven {
        if f == proposal.f_demand {
            return proposal.wish;
        }
        let y_s = f / self.rule.gains.K;
        Driven::within(&proposal.interval, self.rule.driven(&proposal.sample, y_s))
    }

    /// Energy (J) that the law is sure to take in the sample that begins: [`Rule::taken`].
    #[inline]
    pub fn taken(&self, proposal: &AxisProposal, driven: Driven, f: Real) -> Real {
        self.rule.taken(&proposal.sample, f, driven.v_m)
    }

    /// Energy (K/alpha) f_h v_m T that the human's port brings in the sample that begins, J. 0 for alpha = 0.
    #[inline]
    pub fn supplied(&self, proposal: &AxisProposal, driven: Driven) -> Real {
        self.rule.supplied(&proposal.sample, driven.v_m)
    }

    /// The terms of the energy that passes the coupling in the sample that begins, at their sizes, J.
    #[inline]
    pub fn exchanged(&self, proposal: &AxisProposal, driven: Driven) -> Real {
        self.rule.exchanged(&proposal.sample, driven.v_m)
    }

    /// The nominal moves on as `driven`, while the robot gets the force `f` (N), which the caller's limits left of what the
    /// axis asked for. Where its spring `slips` it is set back.
    #[inline]
    pub fn commit(
        &mut self,
        proposal: &AxisProposal,
        driven: Driven,
        f: Real,
        slips: bool,
        settings: &Settings,
    ) {
        let (rule, sample) = (&self.rule, &proposal.sample);
        let limited = slips && f != proposal.f_demand;
        let v_b = limited.then(|| rule.at_the_bound(sample, f / rule.gains.K));
        self.follow(proposal, driven, v_b, settings);
    }

    /// The same where the nominal is set back to `v_b` (m/s), if there is one of no more energy.
    #[inline]
    pub fn follow(
        &mut self,
        proposal: &AxisProposal,
        driven: Driven,
        v_b: Option<Real>,
        settings: &Settings,
    ) {
        let sample = &proposal.sample;
        let Driven { v_m, held } = driven;
        let mut v_n = midpoint::end(sample, v_m);
        if held {
            v_n = slower(v_n, v_m);
        }
        if let Some(v_b) = v_b {
            v_n = slower(v_n, v_b);
        }
        self.last = Last {
            q: proposal.q,
            dq: sample.dq,
            q_n: proposal.q_n() + settings.T * v_m,
            v_n: floored(v_n),
        };
        if self.tuning.pass() {
            self.rule = Rule::new(settings, self.tuning.now());
        }
    }
}

impl Driven {
    /// With the velocity `free` (m/s) as far as it lies within `interval`.
    #[inline]
    fn within(interval: &Interval, free: Real) -> Self {
        let v_m = interval.keep(free);
        Self {
            v_m,
            held: v_m != free,
        }
    }
}

impl AxisSensed {
    /// Gives up energy: the position error and the nominal's velocity are reduced to these fractions, in [0, 1].
    pub fn reduce(&mut self, e: Real, v_n: Real) {
        self.e *= e;
        self.v_n *= v_n;
    }
}

impl AxisProposal {
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

    /// How the nominal moves if the whole of K y acts on it.
    pub fn wish(&self) -> Driven {
        self.wish
    }

    /// K y before any limit, N.
    pub fn f_demand(&self) -> Real {
        self.f_demand
    }
}
