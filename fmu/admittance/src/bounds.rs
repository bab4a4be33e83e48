//! Limits inside the law: the nominal keeps to them, and the robot with it.
//!
//! Each is an interval for the nominal's velocity v_m over the sample that contains 0: at its ends the nominal runs into
//! an inelastic stop. Where the stop acts, its force R does the work R v_m T ≤ 0, so that limits only ever dissipate,
//! whatever switches them on and off. What is clipped behind a law knows nothing of the kind.
//!
//! | limit | interval of v_m |
//! |---|---|
//! | speed | ±v |
//! | position box | (q_min − q_n)/T … (q_max − q_n)/T, as far as it leads inwards |
//! | hold | 0 |
//! | request | ±v, for one tick: to brake before a hold |

use crate::parameters::{check, limit};
use crate::{ParameterError, Real, real};
use fmu_declaration::range::{FINITE, POSITIVE};

/// What is expected of a largest position.
const GREATER: &str = "a value greater than the least one";

/// Limits of one axis, infinite where there are none.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Bounds {
    /// Largest speed of the nominal, m/s, > 0.
    pub speed: Real,
    /// Least position of the nominal, m. A nominal beyond it may only move inwards.
    pub q_min: Real,
    /// Largest position of the nominal, m, > q_min.
    pub q_max: Real,
}

impl Default for Bounds {
    /// None.
    fn default() -> Self {
        Self {
            speed: Real::INFINITY,
            q_min: Real::NEG_INFINITY,
            q_max: Real::INFINITY,
        }
    }
}

impl Bounds {
    /// Whether they can be kept; `axis` (from 1) is for the message.
    ///
    /// # Errors
    /// The first value out of its range.
    pub fn check(&self, axis: Option<usize>) -> Result<(), ParameterError> {
        check(
            axis,
            &[
                ("speed_max", limit(self.speed), POSITIVE),
                ("q_min", -limit(-self.q_min), FINITE),
                ("q_max", limit(self.q_max), FINITE),
            ],
        )?;
        if self.q_min < self.q_max {
            Ok(())
        } else {
            Err(ParameterError::of("q_max", axis, self.q_max, GREATER))
        }
    }

    /// Where a nominal at `q_n` (m) is that goes on by `way` (m), as far as the box of these bounds, if there are any, lets it.
    #[cold]
    pub fn kept(of: Option<&Self>, q_n: Real, way: Real) -> Real {
        let wanted = q_n + way;
        of.map_or(wanted, |Self { q_min, q_max, .. }| {
            let (low, high) = (real::min(*q_min, q_n), real::max(*q_max, q_n));
            real::max(low, real::min(wanted, high))
        })
    }

    /// The interval for v_m (m/s) of a nominal at `q_n` (m), with sample period `T` (s).
    pub fn interval(&self, q_n: Real, T: Real, hold: bool) -> Interval {
        if hold {
            return Interval {
                low: 0.0,
                high: 0.0,
            };
        }
        Interval {
            low: real::min(0.0, real::max((self.q_min - q_n) / T, -self.speed)),
            high: real::max(0.0, real::min((self.q_max - q_n) / T, self.speed)),
        }
    }
}

/// A limit of an interface, where 0 stands for none.
pub fn or_none(limit: Real) -> Real {
    if limit == 0.0 { Real::INFINITY } else { limit }
}

/// Limits of `N` axes from the parameters of an interface: a speed of 0 is none, and the box counts only if `is_boxed`.
///
/// # Errors
/// The first largest position, by the name `name`, that does not exceed the least one.
pub fn boxed<const N: usize>(
    name: &'static str,
    is_boxed: bool,
    q_min: &[Real; N],
    q_max: &[Real; N],
    speed: &[Real; N],
) -> Result<[Bounds; N], ParameterError> {
    let mut bounds = speed.map(|speed| Bounds {
        speed: or_none(speed),
        ..Bounds::default()
    });
    if is_boxed {
        for (i, bounds) in bounds.iter_mut().enumerate() {
            (bounds.q_min, bounds.q_max) = (q_min[i], q_max[i]);
            if q_min[i] >= q_max[i] {
                let axis = (N > 1).then_some(i + 1);
                return Err(ParameterError::of(name, axis, q_max[i], GREATER));
            }
        }
    }
    Ok(bounds)
}

/// Velocities that the nominal may have over a sample, m/s. They contain 0; by default they are 0 alone.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Interval {
    low: Real,
    high: Real,
}

impl Interval {
    /// All velocities.
    pub const ALL: Self = Self {
        low: Real::NEG_INFINITY,
        high: Real::INFINITY,
    };

    /// That of a nominal at `q_n` (m) within `bounds`, or without any; 0 alone where it is to `hold`.
    #[inline]
    pub fn within(bounds: Option<&Bounds>, q_n: Real, T: Real, hold: bool) -> Self {
        match bounds {
            None if !hold => Self::ALL,
            _ => bounds.copied().unwrap_or_default().interval(q_n, T, hold),
        }
    }

    /// The part of it within ±`speed` (m/s, ≥ 0).
    #[must_use]
    #[inline]
    pub fn no_faster_than(self, speed: Real) -> Self {
        if speed == Real::INFINITY {
            return self;
        }
        Self {
            low: real::max(self.low, -speed),
            high: real::min(self.high, speed),
        }
    }

    /// The part of it in which a nominal at `q_n` (m) comes near `q_min` and `q_max` (m) no faster than the distance that
    /// is left over `time` (s). Beyond them it may only move inwards.
    #[must_use]
    #[inline]
    pub fn approaching(self, q_n: Real, [q_min, q_max]: [Real; 2], time: Real) -> Self {
        Self {
            low: real::max(self.low, real::min(0.0, (q_min - q_n) / time)),
            high: real::min(self.high, real::max(0.0, (q_max - q_n) / time)),
        }
    }

    /// `v_m` (m/s) within; NaN stays NaN.
    #[inline]
    pub fn keep(&self, v_m: Real) -> Real {
        if v_m > self.high {
            self.high
        } else if v_m < self.low {
            self.low
        } else {
            v_m
        }
    }
}
