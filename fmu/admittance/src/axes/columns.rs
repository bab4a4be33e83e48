//! What several axes sense, ask for and do at a tick, quantity by quantity: the same quantity of all axes lies side by side,
//! and a processor computes two of them at once.

use crate::Real;
use crate::bounds::Interval;
use crate::midpoint::Sample;
use nalgebra::SVector;

/// N axes at a tick, once the position is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxesSensed<const N: usize> {
    /// Positions, m.
    pub(super) q: SVector<Real, N>,
    /// The robot's velocities, m/s.
    pub(super) dq: SVector<Real, N>,
    /// Position errors, after the slip, m.
    pub(super) e: SVector<Real, N>,
    /// The nominals' velocities, m/s.
    pub(super) v_n: SVector<Real, N>,
}

/// What N axes ask for at a tick. Nothing has happened until it is committed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxesProposal<const N: usize> {
    pub(super) sensed: AxesSensed<N>,
    /// Forces of the human, N.
    pub(super) f_h: SVector<Real, N>,
    /// Damping on top of D_n, N·s/m.
    pub(super) damping: SVector<Real, N>,
    /// Velocities that each may have.
    pub(super) interval: [Interval; N],
    /// How the nominals move if all of K y acts on them.
    pub(super) wish: AxesDriven<N>,
    /// K y before any limit, N.
    pub(super) f_demand: SVector<Real, N>,
}

/// How N nominals move in the sample that begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxesDriven<const N: usize> {
    /// Their velocities at the middle of the sample, m/s.
    pub(super) v_m: SVector<Real, N>,
    /// Whether one of the [`Bounds`](crate::Bounds), or hold, keeps each back.
    pub(super) held: [bool; N],
}

impl<const N: usize> AxesSensed<N> {
    /// What axis `i`, from 0, starts from with the human's force `f_h` (N) and `damping` (N·s/m) on top of D_n.
    #[inline(always)]
    pub(super) fn sample(&self, i: usize, f_h: Real, damping: Real) -> Sample {
        Sample {
            e: self.e[i],
            v_n: self.v_n[i],
            dq: self.dq[i],
            f_h,
            damping,
        }
    }
}

impl<const N: usize> AxesProposal<N> {
    /// What axis `i`, from 0, starts from.
    #[inline(always)]
    pub(super) fn sample(&self, i: usize) -> Sample {
        self.sensed.sample(i, self.f_h[i], self.damping[i])
    }

    /// Nominal positions at this tick, m.
    #[inline]
    pub(super) fn q_n(&self) -> SVector<Real, N> {
        self.sensed.q + self.sensed.e
    }

    /// Position errors e_nr = q_n − q at this tick, after the slip, m.
    #[inline]
    pub fn e_nr(&self) -> &SVector<Real, N> {
        &self.sensed.e
    }
}

impl<const N: usize> AxesDriven<N> {
    /// Within `interval`, if any of them does not allow all: `free` are the velocities (m/s) without it.
    #[inline]
    pub(super) fn within(interval: &[Interval; N], free: &SVector<Real, N>) -> Self {
        let v_m = SVector::from_fn(|i, _| interval[i].keep(free[i]));
        Self {
            v_m,
            held: core::array::from_fn(|i| v_m[i] != free[i]),
        }
    }

    /// Whether any of them is held back.
    #[inline]
    pub(super) fn is_held(&self) -> bool {
        self.held.iter().any(|held| *held)
    }
}
