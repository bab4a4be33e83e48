//! The implicit midpoint rule for (e, v_n) of three coupled joints, without memory.
//!
//! M_n is that of the pose q_k over the whole sample; what the next pose makes of v_n comes with the next tick
//! ([`transport`](crate::nominal::transport)). With v_m = (v_n + v_n⁺)/2 and w = v_m − dq:
//!
//! ```text
//! M_n (v_n⁺ − v_n)/T = tau_h − D_n v_m − alpha y        eq:obs_dyn
//! e⁺ = e + T w
//! y  = w + K_P (e + T w/2)                              eq:dob_input, tau = K y
//! ```
//!
//! The matrices to be solved with are symmetric and positive definite, and block diagonal like M_n.

use super::JointGains;
use super::boxed::{Solution, solved};
use admittance::Real;
use admittance::bounds::Interval;
use nalgebra::{Matrix3, Vector3};

/// What one sample of the law starts from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// M_n(q_k), kg·m².
    pub M_n: Matrix3<Real>,
    /// Nominal damping, N·m·s/rad, symmetric and not negative, block diagonal like M_n.
    pub D_n: Matrix3<Real>,
    /// Position error q_n − q, rad.
    pub e: Vector3<Real>,
    /// Nominal velocity, rad/s.
    pub v_n: Vector3<Real>,
    /// The robot's velocity, rad/s.
    pub dq: Vector3<Real>,
    /// Torque of the human on the joints, Jᵀ f_h, N·m.
    pub tau_h: Vector3<Real>,
}

/// Nominal and coupling solved together, within `intervals`: the nominal feels alpha·y. With alpha = 0 it feels nothing.
///
/// A = 2 M_n/T + D_n + alpha(1 + K_P T/2)
/// A v_m = 2 M_n v_n/T + tau_h + alpha(dq + K_P T dq/2 − K_P e)
pub fn coupled(
    gains: &JointGains,
    alpha: Real,
    T: Real,
    sample: &Sample,
    intervals: &[Interval; 3],
) -> Solution {
    let K_P = &gains.K_P;
    let Sample {
        M_n,
        D_n,
        e,
        v_n,
        dq,
        tau_h,
    } = sample;
    let c = K_P.map(|K_P| alpha * (1.0 + K_P * T / 2.0));
    let A = M_n * (2.0 / T) + D_n + Matrix3::from_diagonal(&c);
    let pull = (dq + K_P.component_mul(dq) * (T / 2.0) - K_P.component_mul(e)) * alpha;
    solved(&A, &(M_n * v_n * (2.0 / T) + tau_h + pull), intervals)
}

/// The coupling's answer to a nominal that moves with `v_m` (rad/s) over the sample: y at its middle (rad/s).
///
/// y = w + K_P (e + T w/2),  w = v_m − dq
pub fn coupling(
    gains: &JointGains,
    T: Real,
    sample: &Sample,
    v_m: &Vector3<Real>,
) -> Vector3<Real> {
    let w = v_m - sample.dq;
    w + gains.K_P.component_mul(&(sample.e + w * (T / 2.0)))
}

/// The nominal under a given reaction alpha·y_s, y_s being what the limits left of y (rad/s), within `intervals`.
///
/// (2 M_n/T + D_n) v_m = 2 M_n v_n/T + tau_h − alpha y_s
pub fn driven(
    alpha: Real,
    T: Real,
    sample: &Sample,
    y_s: &Vector3<Real>,
    intervals: &[Interval; 3],
) -> Solution {
    let Sample {
        M_n,
        D_n,
        v_n,
        tau_h,
        ..
    } = sample;
    let A = M_n * (2.0 / T) + D_n;
    solved(
        &A,
        &(M_n * v_n * (2.0 / T) + tau_h - y_s * alpha),
        intervals,
    )
}

/// The nominal velocity at which each joint's coupling asks for exactly y_s (rad/s): while it slips, the nominal need not
/// run ahead of the robot any faster than that.
///
/// v_b = (y_s − K_P e)/(1 + K_P T/2) + dq
pub fn at_the_bound(
    gains: &JointGains,
    T: Real,
    sample: &Sample,
    y_s: &Vector3<Real>,
) -> Vector3<Real> {
    let K_P = &gains.K_P;
    (y_s - K_P.component_mul(&sample.e)).zip_map(K_P, |x, K_P| x / (1.0 + K_P * T / 2.0))
        + sample.dq
}
