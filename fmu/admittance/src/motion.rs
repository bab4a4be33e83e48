//! What the law makes of the sensed positions.

use crate::real::{self, consts::TAU, floored};
use crate::{Real, Settings};

/// How positions are sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sampling {
    /// sample period, s
    T: Real,
    /// the exact sampled first-order low pass, if there is one
    low_pass: Option<LowPass>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct LowPass {
    /// 2π f_c T
    way: Real,
    /// 1 − exp(−2π f_c T)
    weight: Real,
}

/// The robot's velocity on one axis, from positions alone.
///
/// dq = (q_k − q_{k−1})/T, 0 at the first tick; with a low pass of corner frequency f_c,
/// dq ← dq + (1 − exp(−2π f_c T))·((q_k − q_{k−1})/T − dq). A tick that does not come in time divides by the time that has
/// passed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Motion {
    q: Option<Real>,
    dq: Real,
}

impl Sampling {
    /// That of `settings`: their sample period and low pass.
    pub fn new(settings: &Settings) -> Self {
        let Settings { T, dq_cutoff, .. } = *settings;
        Self {
            T,
            low_pass: (dq_cutoff > 0.0).then(|| LowPass {
                way: TAU * dq_cutoff * T,
                weight: -real::exp_m1(-TAU * dq_cutoff * T),
            }),
        }
    }

    /// Whether velocities pass a filter.
    #[inline]
    pub(crate) fn is_filtered(&self) -> bool {
        self.low_pass.is_some()
    }

    /// The velocity at the position `q` (m), which was read `after` sample periods after the position `last` with the
    /// velocity `dq` (m/s).
    #[inline]
    pub fn dq(&self, last: Real, dq: Real, q: Real, after: Real) -> Real {
        if after != 1.0 {
            return self.dq_off_time(last, dq, q, after);
        }
        let difference = (q - last) / self.T;
        match self.low_pass {
            Some(LowPass { weight, .. }) => floored(dq + weight * (difference - dq)),
            None => difference,
        }
    }

    /// The same where the tick did not come a period after the last one. The difference is that over the time which has
    /// really passed; where this is less than a period it counts for its part of one, so that the encoder's step and the
    /// clock's are not divided by almost nothing.
    #[cold]
    fn dq_off_time(&self, last: Real, dq: Real, q: Real, after: Real) -> Real {
        let difference = if after < 1.0 {
            dq + ((q - last) / self.T - dq * after)
        } else {
            (q - last) / (after * self.T)
        };
        match self.low_pass {
            Some(LowPass { way, .. }) => {
                floored(dq - real::exp_m1(-way * after) * (difference - dq))
            }
            None => difference,
        }
    }
}

impl Motion {
    /// The velocity that the law uses when `q` (m) is sensed at a tick, `after` sample periods after the last one, m/s.
    #[inline]
    pub fn dq(&self, q: Real, after: Real, sampling: &Sampling) -> Real {
        self.q
            .map_or(0.0, |last| sampling.dq(last, self.dq, q, after))
    }

    /// The motion after a tick at `q` (m) with the velocity `dq` (m/s).
    pub const fn at(q: Real, dq: Real) -> Self {
        Self { q: Some(q), dq }
    }
}
