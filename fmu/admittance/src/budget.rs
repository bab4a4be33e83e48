//! What a force may cost at most, and how much of it the tank can pay for.
//!
//! A force is held before it is known how the robot will move. Within the [`Reach`] that is stated for the robot, the
//! sample can cost no more than the work that the force does on the worst motion, less what the law is sure to take. It is
//! sure to take what the human's port brings, less what the nominal keeps; its damping; and the spring, which can be given up
//! afterwards. [`share`] finds the share of the force for which the tank covers that. `docs/passivity.md` has the argument.

use crate::parameters::{check, limit};
use crate::{ParameterError, Real, real};
use fmu_declaration::range::POSITIVE;
use nalgebra::SVector;

/// How far the robot can move within a sample: the motions for which passivity is promised, in the coordinates in which
/// the force works.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Reach<const N: usize> {
    /// Largest speed of each coordinate, m/s (rad/s).
    pub v_max: SVector<Real, N>,
    /// Largest change of the speed, m/s² (rad/s²); infinite where only the speed is bounded.
    pub a_max: SVector<Real, N>,
}

/// The reach in a sample of a certain length.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SampleReach<const N: usize> {
    reach: Reach<N>,
    T: Real,
    /// v_max T and a_max T², with the rounding that is allowed for, m
    step: SVector<Real, N>,
    change: SVector<Real, N>,
}

/// What a motion at the very bound may exceed it by, relatively: differences of positions round.
const ROUNDING: Real = 1e4 * Real::EPSILON;

impl<const N: usize> Default for Reach<N> {
    /// The testbed's: 10 m/s, 1e4 m/s².
    fn default() -> Self {
        Self {
            v_max: SVector::repeat(10.0),
            a_max: SVector::repeat(1e4),
        }
    }
}

impl<const N: usize> Reach<N> {
    /// Whether a promise can be made with them.
    ///
    /// # Errors
    /// The first value out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        let of = |axis| (N > 1).then_some(axis);
        for (axis, (v_max, a_max)) in (1..).zip(self.v_max.iter().zip(&self.a_max)) {
            check(
                of(axis),
                &[
                    ("v_max", *v_max, POSITIVE),
                    ("a_max", limit(*a_max), POSITIVE),
                ],
            )?;
        }
        Ok(())
    }

    /// Largest change of each coordinate in a sample of `T` (s), with the rounding that is allowed for, m (rad).
    #[allow(non_snake_case, reason = "the paper's symbol")]
    pub fn steps(&self, T: Real) -> SVector<Real, N> {
        self.v_max.map(|v_max| v_max * T * (1.0 + ROUNDING))
    }
}

impl<const N: usize> SampleReach<N> {
    /// The `reach` in a sample of `T` (s).
    pub fn new(reach: &Reach<N>, T: Real) -> Self {
        Self {
            reach: *reach,
            T,
            step: reach.steps(T),
            change: reach.a_max.map(|a_max| a_max * T * T * (1.0 + ROUNDING)),
        }
    }

    /// Most work (J) that the constant force `f` (N) can do in the `n`-th sample from now (1 or 2), if the last one moved
    /// the robot by `last` (m):
    ///
    /// f·Δq ≤ Σ min(|f| v_max T, f Δq_last + n |f| a_max T²)
    #[inline]
    pub fn most_work(&self, f: &SVector<Real, N>, last: Option<&SVector<Real, N>>, n: u8) -> Real {
        let Self { reach, T, .. } = self;
        let mut work = 0.0;
        for i in 0..N {
            let (f, force) = (f[i], real::abs(f[i]));
            if force > 0.0 {
                let by_speed = force * reach.v_max[i] * T;
                let by_acceleration = last.map_or(by_speed, |last| {
                    f * last[i] + Real::from(n) * force * reach.a_max[i] * T * T
                });
                work += real::at_most(by_acceleration, by_speed);
            }
        }
        work
    }

    /// The same by the largest speed alone, whatever the last motion was.
    #[cold]
    #[inline(never)]
    pub fn most_by_speed(&self, f: &SVector<Real, N>) -> Real {
        f.abs().dot(&self.reach.v_max) * self.T
    }

    /// Whether a motion by `step` (m), after one by `last`, is one for which nothing is promised. The product's rounding is
    /// allowed for.
    #[inline]
    pub fn is_left(&self, step: &SVector<Real, N>, last: Option<&SVector<Real, N>>) -> bool {
        (0..N).any(|i| {
            let change = last.map_or(0.0, |last| step[i] - last[i]);
            real::abs(step[i]) > self.step[i] || real::abs(change) > self.change[i]
        })
    }
}

/// Halvings that find the share: to the last digit of the number's mantissa.
const HALVINGS: u32 = Real::MANTISSA_DIGITS;

/// The largest share σ in [0, 1) with `need(σ)` ≤ `tank` (J), or 0 if there is none; the whole is not covered.
///
/// The need is continuous and need(0) is what no force at all would cost. It is evaluated for the share that is returned,
/// never extrapolated; the time is bounded.
pub fn share(need: impl Fn(Real) -> Real, tank: Real) -> Real {
    let (mut covered, mut not) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let between = 0.5 * (covered + not);
        if need(between) <= tank {
            covered = between;
        } else {
            not = between;
        }
    }
    covered
}
