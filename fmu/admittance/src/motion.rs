//! What the law makes of the sensed positions.

use crate::real::{self, consts::TAU, floored};
use crate::{Real, Settings};

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

impl Motion {
    /// The motion after `q` (m) has been sensed at a tick.
    #[must_use]
    pub fn sensed(self, q: Real, settings: &Settings) -> Self {
        let Some(last) = self.q else {
            return Self {
                q: Some(q),
                ..Self::default()
            };
        };
        let difference = (q - last) / settings.T;
        Self {
            q: Some(q),
            dq: if settings.dq_cutoff > 0.0 {
                floored(self.dq + weight(settings) * (difference - self.dq))
            } else {
                difference
            },
        }
    }

    /// The velocity that the law uses, m/s.
    pub fn dq(&self) -> Real {
        self.dq
    }
}

/// 1 − exp(−2π f_c T): the exact sampled first-order low pass.
fn weight(settings: &Settings) -> Real {
    -real::exp_m1(-TAU * settings.dq_cutoff * settings.T)
}
