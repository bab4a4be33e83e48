//! Edges: limits of several axes at once, which do not lie along an axis.
//!
//! An edge is a half-space of velocities that contains 0: n·v_m ≤ c, c ≥ 0. A joint limit of an arm is one, seen from the
//! axes of its handle. Where the free v_m lies beyond, the nominals run into an inelastic stop:
//!
//! ```text
//! W (v_m − free) = −Σ λ_j n_j,   λ_j ≥ 0,   λ_j > 0 only where n_j·v_m = c_j,   W = diag(K A)
//! ```
//!
//! A is what multiplies v_m in the equation of each nominal, so that R = A (v_m − free) is the stops' force. The energy that
//! it brings to the axes is Σ (K/alpha) R v_m T = −(T/alpha) Σ λ_j c_j ≤ 0. So the weight has to be K A, not A: with gains
//! that differ from axis to axis the stop of the nearest point by A alone brings energy (`tests/adversary` has it).
//!
//! Nothing rests on how well the λ are found. Whatever velocity v comes of the search, it is scaled at the end by
//!
//! ```text
//! σ = min(1, free·W v / v·W v), at least 0:   σ v·W (σ v − free) ≤ 0
//! ```
//!
//! which is 1 up to rounding where the search has come to its end.

use crate::Real;
use crate::bounds::Interval;
use crate::real::{abs, max, min};
use nalgebra::SVector;

/// Rounds of the search at most. Edges at right angles take one; each round leaves cos² of the angle between two, as W
/// measures it.
const ROUNDS: u32 = 24;

/// n·v_m ≤ c; one with n = 0 bounds nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge<const N: usize> {
    /// Direction that is bounded, of any length.
    pub n: SVector<Real, N>,
    /// How fast the nominals may move along n, ≥ 0.
    pub c: Real,
}

impl<const N: usize> Edge<N> {
    /// How far `v_m` lies beyond it: above 0 if it does. NaN counts as beyond.
    #[inline]
    fn beyond(&self, v_m: &SVector<Real, N>) -> Real {
        self.n.dot(v_m) - self.c
    }
}

/// Whether `v_m` keeps to all `edges`.
#[inline]
pub fn keeps<const N: usize>(edges: &[Edge<N>], v_m: &SVector<Real, N>) -> bool {
    edges.iter().all(|edge| edge.beyond(v_m) <= 0.0)
}

/// The nominals' velocities within `edges` and `intervals`, for those that they would have without, `free`. All entries of
/// W, the `weight`, are positive. The intervals are kept to exactly, and so is the energy. Where an interval acts beside an
/// edge the edge may be passed: it is a limit for all samples, and the next one sees how far the nominals have come.
pub fn kept<const N: usize, const E: usize>(
    edges: &[Edge<N>; E],
    intervals: &[Interval; N],
    weight: &SVector<Real, N>,
    free: &SVector<Real, N>,
) -> SVector<Real, N> {
    let mut v = *free;
    let mut lambda = [0.0; E];
    for _ in 0..ROUNDS {
        let mut is_found = true;
        for (edge, lambda) in edges.iter().zip(&mut lambda) {
            let along = edge.n.component_div(weight);
            let size = edge.n.dot(&along);
            let beyond = edge.beyond(&v);
            if size > 0.0 && (beyond > 0.0 || *lambda > 0.0) {
                let before = *lambda;
                *lambda = max(0.0, before + beyond / size);
                v -= along * (*lambda - before);
                let rounding = 8.0 * Real::EPSILON * (edge.n.abs().dot(&v.abs()) + edge.c);
                is_found &= abs((*lambda - before) * size) <= rounding;
            }
        }
        if is_found {
            break;
        }
    }
    for (v, interval) in v.iter_mut().zip(intervals) {
        *v = interval.keep(*v);
    }
    let weighted = v.component_mul(weight);
    let (given, own) = (free.dot(&weighted), v.dot(&weighted));
    if given < own {
        v *= max(0.0, min(1.0, given / own));
    }
    v
}
