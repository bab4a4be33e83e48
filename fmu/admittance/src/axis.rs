//! One axis: slip, midpoint, clamp, reset.

use crate::midpoint::{self, Midpoint, Sample};
use crate::real::{self, floored, sat};
use crate::{Gains, Law, Motion, Real, Settings, retune, storage};

/// One axis of the law between two ticks.
///
/// M_n ddq_n + D_n dq_n = f_h − alpha y,  y = de_nr + K_P e_nr,  tau_a = K y        eq:obs_dyn, eq:dob_input
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Axis {
    gains: Gains,
    wanted: Gains,
    q_n: Real,
    v_n: Real,
    motion: Motion,
}

impl Axis {
    /// Engaged at the position `q` (m): q_n = q, v_n = 0, nothing known of the motion yet. The caller has checked the
    /// gains.
    pub fn new(gains: Gains, q: Real) -> Self {
        Self {
            gains,
            wanted: gains,
            q_n: q,
            v_n: 0.0,
            motion: Motion::default(),
        }
    }

    /// Engaged anew at the position `q` (m), with the gains last wanted.
    #[must_use]
    pub fn engaged_at(self, q: Real) -> Self {
        Self::new(self.wanted, q)
    }

    /// With other gains from the next tick on. The caller has checked them.
    #[must_use]
    pub fn tuned(self, wanted: Gains) -> Self {
        Self { wanted, ..self }
    }

    /// What the axis asks for at a tick with position `q` (m) and human force `f_h` (N): gains that are wanted take
    /// over, the spring slips, nominal and coupling are solved together.
    pub fn propose(self, q: Real, f_h: Real, settings: &Settings) -> Proposal {
        let gains = self.wanted;
        let motion = self.motion.sensed(q, settings);
        let (e, v_n) =
            retune::taken_over(settings.law, &self.gains, &gains, self.q_n - q, self.v_n);
        let sample = Sample {
            e: slipped(settings.law, &gains, e),
            v_n,
            dq: motion.dq(),
            f_h,
        };
        let wish = midpoint::coupled(&gains, settings.reaction(), settings.T, &sample);
        Proposal {
            gains,
            motion,
            q,
            sample,
            wish,
        }
    }
}

/// Under `passive_bounded`, |K K_P e| ≤ f_max: beyond it the spring slips, and q_n with it.
fn slipped(law: Law, gains: &Gains, e: Real) -> Real {
    match law {
        Law::PassiveBounded => sat(e, gains.f_max / (gains.K * gains.K_P)),
        _ => e,
    }
}

/// What one axis asks for at a tick. Nothing has happened until it is committed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proposal {
    gains: Gains,
    motion: Motion,
    q: Real,
    sample: Sample,
    wish: Midpoint,
}

/// What one axis did at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Committed {
    /// The axis until the next tick.
    pub axis: Axis,
    /// Force on the robot, N.
    pub f: Real,
    /// Energy (K/alpha) f_h v_m T that the human's port brings in the sample that begins, J. Not finite for alpha = 0.
    pub supplied: Real,
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

    /// What the law knows of the robot's motion.
    pub fn motion(&self) -> &Motion {
        &self.motion
    }

    /// K y before any limit, N.
    pub fn f_demand(&self) -> Real {
        self.gains.K * self.wish.y
    }

    /// K y within ±f_max, N.
    pub fn f(&self) -> Real {
        sat(self.f_demand(), self.gains.f_max)
    }

    /// Energy stored at this tick, J. Not finite for alpha = 0.
    pub fn stored(&self, settings: &Settings) -> Real {
        storage::stored(
            settings.law,
            &self.gains,
            settings.alpha,
            self.sample.e,
            self.sample.v_n,
        )
    }

    /// Whether f_max or the factor `s` leaves less than the demand.
    pub fn is_limited(&self, s: Real) -> bool {
        real::abs(self.f_demand()) > self.gains.f_max || s < 1.0
    }

    /// The nominal moves on, while the robot gets s·sat(K y): `s` in [0, 1] is what the caller's actuators leave.
    pub fn commit(self, s: Real, settings: &Settings) -> Committed {
        let (gains, sample) = (&self.gains, &self.sample);
        let (alpha, T) = (settings.reaction(), settings.T);
        let f = s * self.f();
        let y_s = f / gains.K;

        let limited = self.is_limited(s);
        let v_m = match settings.law {
            Law::PassiveApplied | Law::PassiveBounded if limited => {
                midpoint::driven(gains, alpha, T, sample, y_s)
            }
            _ => self.wish.v_m,
        };
        let v_next = 2.0 * v_m - sample.v_n;
        let v_n = match settings.law {
            Law::PassiveBounded if limited => {
                slower(v_next, midpoint::at_the_bound(gains, T, sample, y_s))
            }
            _ => v_next,
        };
        Committed {
            axis: Axis {
                gains: *gains,
                wanted: *gains,
                q_n: self.q_n() + T * v_m,
                v_n: floored(v_n),
                motion: self.motion,
            },
            f,
            supplied: gains.K / settings.alpha * sample.f_h * v_m * T,
        }
    }
}

/// The reset: v_b in place of v where it holds no more energy.
fn slower(v: Real, v_b: Real) -> Real {
    if v_b * v_b <= v * v { v_b } else { v }
}
