//! What the law makes of the sensed positions.

use crate::real::{self, consts::TAU, floored};
use crate::{Real, Settings};

/// How positions are sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sampling {
    /// sample period, s
    T: Real,
    /// 1 − exp(−2π f_c T) of the exact sampled first-order low pass, if there is one
    weight: Option<Real>,
}

/// The robot's velocity on one axis, from positions alone.
///
/// dq = (q_k − q_{k−1})/T, 0 at the first tick; with a low pass of corner frequency f_c,
/// dq ← dq + (1 − exp(−2π f_c T))·((q_k − q_{k−1})/T − dq).
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
            weight: (dq_cutoff > 0.0).then(|| -real::exp_m1(-TAU * dq_cutoff * T)),
        }
    }

    /// The velocity at the position `q` (m), one sample after the position `last` with the velocity `dq` (m/s).
    #[inline]
    pub fn dq(&self, last: Real, dq: Real, q: Real) -> Real {
        let difference = (q - last) / self.T;
        match self.weight {
            Some(weight) => floored(dq + weight * (difference - dq)),
            None => difference,
        }
    }
}

impl Motion {
    /// The velocity that the law uses when `q` (m) is sensed at a tick, m/s.
    #[inline]
    pub fn dq(&self, q: Real, sampling: &Sampling) -> Real {
        self.q.map_or(0.0, |last| sampling.dq(last, self.dq, q))
    }

    /// The motion after a tick at `q` (m) with the velocity `dq` (m/s).
    pub const fn at(q: Real, dq: Real) -> Self {
        Self { q: Some(q), dq }
    }
}
