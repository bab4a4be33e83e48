//! The loop that a drive closes by itself.

use crate::real::{self, sat};
use crate::{Gains, ParameterError, Real};
use nalgebra::SVector;

/// The loops of N drives, as the law has them.
///
/// tau = sat(K((dq_d − dq) + K_P (q_d − q)), f_max)        eq:dob_input, in the drive
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive<const N: usize> {
    /// Velocity gain, N·s/m.
    pub K: SVector<Real, N>,
    /// Ratio of the position gain to it, 1/s.
    pub K_P: SVector<Real, N>,
    /// Largest force, N.
    pub f_max: SVector<Real, N>,
}

impl<const N: usize> Drive<N> {
    /// That of the axes with these `gains`.
    pub fn of(gains: &[Gains; N]) -> Self {
        Self {
            K: SVector::from(gains.map(|gains| gains.K)),
            K_P: SVector::from(gains.map(|gains| gains.K_P)),
            f_max: SVector::from(gains.map(|gains| gains.f_max)),
        }
    }

    /// The mean force (N) that the `i`-th drive (from 0) must have given over a sample of `T` (s) in which it is told a motion
    /// with the velocity `dq_d` (m/s) that begins `start` (m) ahead of the robot, while the robot moves straight on by `moved`
    /// (m). Where the drive looks at its encoder half a sample earlier or later, the robot is |Δq|/2 elsewhere: what could come
    /// of that is not counted.
    ///
    /// K(w + K_P(e + T w/2)), w = dq_d − Δq/T, nearer to 0 by K K_P |Δq|/2, within ±f_max
    #[inline]
    #[allow(non_snake_case, reason = "the paper's symbol")]
    pub fn surely(&self, i: usize, start: Real, dq_d: Real, moved: Real, T: Real) -> Real {
        let (K, K_P) = (self.K[i], self.K_P[i]);
        let w = dq_d - moved / T;
        let mean = K * (w + K_P * (start + T * w / 2.0));
        let unsure = K * K_P * real::abs(moved) / 2.0;
        sat(mean - sat(mean, unsure), self.f_max[i])
    }

    /// Whether `other` gains are these, which the drives have too; `names` are those of K, K_P and f_max in the message.
    ///
    /// # Errors
    /// The first one that is not.
    pub fn is_kept(&self, other: &Self, names: [&'static str; 3]) -> Result<(), ParameterError> {
        let pairs = [
            (&self.K, &other.K),
            (&self.K_P, &other.K_P),
            (&self.f_max, &other.f_max),
        ];
        for (name, (now, wanted)) in names.into_iter().zip(pairs) {
            for (axis, (now, wanted)) in (1..).zip(now.iter().zip(wanted)) {
                if wanted != now {
                    return Err(Self::not_kept(name, (N > 1).then_some(axis), *wanted));
                }
            }
        }
        Ok(())
    }

    /// The refusal of the `value` of the gain `name` that the drive does not have; the axis counts from 1.
    pub const fn not_kept(name: &'static str, axis: Option<usize>, value: Real) -> ParameterError {
        let expected = "the value at the start, in servo form the drive has it too";
        ParameterError::of(name, axis, value, expected)
    }
}
