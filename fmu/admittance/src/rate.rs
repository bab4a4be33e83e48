//! How fast a force may change.

use crate::parameters::{check, limit};
use crate::{ParameterError, Real, real};
use fmu_declaration::range::POSITIVE;
use nalgebra::SVector;

/// A limit on the change of N forces in a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rate<const N: usize> {
    /// largest change of each in a sample, N; none where nothing is limited
    most: Option<SVector<Real, N>>,
}

impl<const N: usize> Rate<N> {
    /// No limit.
    pub const fn none() -> Self {
        Self { most: None }
    }

    /// A `rate` (N/s) for each force, infinite for no limit, in samples of `T` (s).
    ///
    /// # Errors
    /// The first rate out of its range; it goes by the name `f_rate`.
    pub fn new(rate: &SVector<Real, N>, T: Real) -> Result<Self, ParameterError> {
        for (axis, rate) in (1..).zip(rate) {
            check(
                (N > 1).then_some(axis),
                &[("f_rate", limit(*rate), POSITIVE)],
            )?;
        }
        let limits = rate.iter().any(|rate| *rate < Real::INFINITY);
        Ok(Self {
            most: limits.then(|| rate * T),
        })
    }

    /// Part λ in [0, 1] of the way from the forces `last` to the forces `asked` (N) on which none changes faster.
    #[inline]
    pub fn way(&self, last: &SVector<Real, N>, asked: &SVector<Real, N>) -> Real {
        match &self.most {
            None => 1.0,
            Some(most) => (asked - last)
                .zip_map(most, |way, most| part(most, real::abs(way)))
                .fold(1.0, real::min),
        }
    }
}

/// Part of `whole` that `most` is, at most 1.
#[inline]
pub fn part(most: Real, whole: Real) -> Real {
    let exceeds = whole > most;
    let part = real::quotient_if(exceeds, most, whole);
    if exceeds { part } else { 1.0 }
}
