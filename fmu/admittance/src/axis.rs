//! One axis: slip, midpoint, clamp, reset.

use crate::bounds::Interval;
use crate::law::{Felt, Spring};
use crate::midpoint::{self, Midpoint, Sample, slower};
use crate::real::{floored, sat};
use crate::{Bounds, Gains, Motion, Real, Settings, retune, storage};

/// One axis of the law between two ticks.
///
/// M_n ddq_n + D_n dq_n = f_h − alpha y,  y = de_nr + K_P e_nr,  tau_a = K y        eq:obs_dyn, eq:dob_input
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Axis {
    gains: Gains,
    wanted: Gains,
    /// ticks until the gains are those wanted
    remaining: u32,
    bounds: Bounds,
    q_n: Real,
    v_n: Real,
    motion: Motion,
}

/// One axis at a tick, once the position is known: what it stores, before it acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensed {
    axis: Axis,
    q: Real,
    e: Real,
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proposal {
    axis: Axis,
    /// the gains with the damping on top
    damped: Gains,
    interval: Interval,
    q: Real,
    sample: Sample,
    wish: Midpoint,
    /// whether a limit changed the wish
    held: bool,
}

/// What one axis did at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Committed {
    /// The axis until the next tick.
    pub axis: Axis,
    /// Energy (K/alpha) f_h v_m T that the human's port brings in the sample that begins, J. Not finite for alpha = 0.
    pub supplied: Real,
    /// Whether one of the [`Bounds`], or hold, kept the nominal back.
    pub held: bool,
}

impl Axis {
    /// Engaged at the position `q` (m): q_n = q, v_n = 0, nothing known of the motion yet. The caller has checked gains and
    /// bounds.
    pub fn new(gains: Gains, bounds: Bounds, q: Real) -> Self {
        Self {
            gains,
            wanted: gains,
            remaining: 0,
            bounds,
            q_n: q,
            v_n: 0.0,
            motion: Motion::default(),
        }
    }

    /// Engaged anew at the position `q` (m), with the gains last wanted.
    #[must_use]
    pub fn engaged_at(self, q: Real) -> Self {
        Self::new(self.wanted, self.bounds, q)
    }

    /// On its way to other gains, which it has after `ticks` ticks, or at the next one; wanting the same again, as an importer
    /// does that sets all it has at every step, starts nothing anew. The caller has checked them.
    #[must_use]
    pub fn tuned(self, wanted: Gains, ticks: u32) -> Self {
        if wanted == self.wanted {
            return self;
        }
        Self {
            wanted,
            remaining: ticks.max(1),
            ..self
        }
    }

    /// Within other bounds from the next tick on. The caller has checked them.
    #[must_use]
    pub fn within(self, bounds: Bounds) -> Self {
        Self { bounds, ..self }
    }

    /// The axis at a tick with position `q` (m): gains on their way take over, the spring slips.
    pub fn sensed(self, q: Real, settings: &Settings) -> Sensed {
        let gains = self.gains.toward(&self.wanted, self.remaining);
        let (e, v_n) =
            retune::taken_over(settings.law, &self.gains, &gains, self.q_n - q, self.v_n);
        Sensed {
            axis: Self {
                gains,
                remaining: self.remaining.saturating_sub(1),
                v_n,
                motion: self.motion.sensed(q, settings),
                ..self
            },
            q,
            e: storage::slipped(settings.law, &gains, e),
        }
    }
}

impl Sensed {
    /// Energy stored at this tick, J. Not finite for alpha = 0.
    pub fn stored(&self, settings: &Settings) -> Real {
        let Self { axis, e, .. } = self;
        storage::stored(settings.law, &axis.gains, settings.alpha, *e, axis.v_n)
    }

    /// The spring's part of it, J.
    pub fn spring(&self, settings: &Settings) -> Real {
        storage::spring(settings.law, &self.axis.gains, self.e)
    }

    /// The nominal mass's part of it, J. Not finite for alpha = 0.
    pub fn mass(&self, settings: &Settings) -> Real {
        storage::mass(&self.axis.gains, settings.alpha, self.axis.v_n)
    }

    /// With the position error and the nominal's velocity reduced to these shares, in [0, 1]: energy given up.
    #[must_use]
    pub fn reduced(self, e: Real, v_n: Real) -> Self {
        Self {
            axis: Axis {
                v_n: self.axis.v_n * v_n,
                ..self.axis
            },
            e: self.e * e,
            ..self
        }
    }

    /// What the axis asks for with the human's force `f_h` (N): nominal and coupling are solved together, within the
    /// bounds and the `request`.
    pub fn propose(self, f_h: Real, request: &Request, settings: &Settings) -> Proposal {
        let Self { axis, q, e } = self;
        let damped = Gains {
            D_n: axis.gains.D_n + request.damping,
            ..axis.gains
        };
        let sample = Sample {
            e,
            v_n: axis.v_n,
            dq: axis.motion.dq(),
            f_h,
        };
        let interval = axis
            .bounds
            .interval(q + e, settings.T, request.hold)
            .no_faster_than(request.speed);
        let free = midpoint::coupled(&damped, settings.reaction(), settings.T, &sample);
        let v_m = interval.keep(free.v_m);
        let held = v_m != free.v_m;
        let wish = if held {
            let y = midpoint::coupling(&damped, settings.T, &sample, v_m);
            Midpoint { v_m, y }
        } else {
            free
        };
        Proposal {
            axis,
            damped,
            interval,
            q,
            sample,
            wish,
            held,
        }
    }
}

impl Proposal {
    /// e_nr = q_n − q at this tick, after the slip, m.
    pub fn e_nr(&self) -> Real {
        self.sample.e
    }

    /// Nominal position at this tick, m.
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
        self.damped.K * self.wish.y
    }

    /// K y within ±f_max, N.
    pub fn f(&self) -> Real {
        sat(self.f_demand(), self.damped.f_max)
    }

    /// v_m (m/s) if the robot gets the force `f` (N), and whether the bounds kept it back.
    fn v_m(&self, f: Real, settings: &Settings) -> (Real, bool) {
        match settings.law.row().felt {
            Felt::Delivered if f != self.f_demand() => {
                let (alpha, T) = (settings.reaction(), settings.T);
                let y_s = f / self.damped.K;
                let free = midpoint::driven(&self.damped, alpha, T, &self.sample, y_s);
                let v_m = self.interval.keep(free);
                (v_m, v_m != free)
            }
            Felt::Delivered | Felt::Coupling | Felt::Nothing => (self.wish.v_m, self.held),
        }
    }

    /// Energy (J) that the law is sure to take in the sample that begins, if the robot gets the force `f` (N) under
    /// `passive_bounded`: what the human brings less what the nominal keeps, its damping, and the spring, which can be
    /// given up afterwards.
    ///
    /// −ΔH + (K/alpha) f_h v_m T ≥ K y v_m T + (K/alpha) D_n v_m² T + ½ K K_P e²
    pub fn taken(&self, f: Real, settings: &Settings) -> Real {
        let Gains { D_n, K, .. } = self.damped;
        let (v_m, _) = self.v_m(f, settings);
        f * v_m * settings.T
            + K / settings.alpha * D_n * v_m * v_m * settings.T
            + storage::spring(settings.law, &self.damped, self.sample.e)
    }

    /// The nominal moves on, while the robot gets the force `f` (N), which the caller's limits left of [`f`](Self::f).
    pub fn commit(self, f: Real, settings: &Settings) -> Committed {
        let Self { damped, sample, .. } = &self;
        let T = settings.T;
        let (v_m, held) = self.v_m(f, settings);
        let mut v_n = midpoint::end(sample, v_m);
        if held {
            v_n = slower(v_n, v_m);
        }
        match settings.law.row().spring {
            Spring::Slips if f != self.f_demand() => {
                v_n = slower(v_n, midpoint::at_the_bound(damped, T, sample, f / damped.K));
            }
            Spring::Slips | Spring::Limited | Spring::Free => {}
        }
        Committed {
            axis: Axis {
                q_n: self.q_n() + T * v_m,
                v_n: floored(v_n),
                ..self.axis
            },
            supplied: midpoint::supplied(damped, settings.alpha, T, sample, v_m),
            held,
        }
    }
}
