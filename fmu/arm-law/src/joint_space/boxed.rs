//! A joint that runs into a limit of its nominal: the one linear system of a sample, within an interval for each joint.
//!
//! ```text
//! A v_m = b + R,   v_m in its intervals, which contain 0,   R_i ≤ 0 at an upper end, ≥ 0 at a lower end, 0 between
//! ```
//!
//! R is the torque of an inelastic stop: R·v_m ≤ 0, so that a limit only ever dissipates, while the other joints move on as
//! their inertia says. v_m minimises ½ vᵀAv − bᵀv within the intervals; for the 1 + 2 block structure of A that is a closed
//! form.

use admittance::Real;
use admittance::bounds::Interval;
use nalgebra::{Matrix3, Vector3};

/// What a sample's nominal velocity is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// v_m, rad/s.
    pub v_m: Vector3<Real>,
    /// Which joints a limit keeps back.
    pub held: Vector3<bool>,
}

/// A⁻¹ b within `intervals`, for a symmetric positive definite A with A₁₂ = A₁₃ = 0.
///
/// Without limits pivoting is not needed: A₁₁, A₂₂ and A₃₃ − A₂₃²/A₂₂ are positive. The minimum of a convex function that
/// lies outside a rectangle has its constrained one on an edge: that of the at most four edges' minima which is least.
pub fn solved(A: &Matrix3<Real>, b: &Vector3<Real>, intervals: &[Interval; 3]) -> Solution {
    let ratio = A.m23 / A.m22;
    let x_3 = (b[2] - ratio * b[1]) / (A.m33 - ratio * A.m23);
    let free = Vector3::new(b[0] / A.m11, (b[1] - A.m23 * x_3) / A.m22, x_3);

    let mut v_m = free;
    v_m[0] = intervals[0].keep(free[0]);
    if (1..3).any(|i| intervals[i].keep(free[i]) != free[i]) {
        let mut least = Real::INFINITY;
        for (i, j) in [(1, 2), (2, 1)] {
            for end in [Real::NEG_INFINITY, Real::INFINITY].map(|far| intervals[i].keep(far)) {
                if !end.is_finite() {
                    continue; // no end
                }
                let other = intervals[j].keep((b[j] - A.m23 * end) / A[(j, j)]);
                let cost = 0.5 * (A[(i, i)] * end * end + A[(j, j)] * other * other)
                    + A.m23 * end * other
                    - (b[i] * end + b[j] * other);
                if cost < least {
                    least = cost;
                    (v_m[i], v_m[j]) = (end, other);
                }
            }
        }
    }
    Solution {
        v_m,
        held: Vector3::from([0, 1, 2].map(|i| {
            // A joint at an end is held; one that only moves otherwise because its neighbour is, is not.
            v_m[i] != free[i]
                && [Real::NEG_INFINITY, Real::INFINITY]
                    .iter()
                    .any(|far| v_m[i] == intervals[i].keep(*far))
        })),
    }
}
