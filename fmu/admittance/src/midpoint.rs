//! The implicit midpoint rule for (e, v_n): the law's arithmetic, without limits and without memory.
//!
//! With v_m = (v_n + v_n⁺)/2 and w = v_m − dq, the robot's velocity dq held over the sample:
//!
//! ```text
//! M_n (v_n⁺ − v_n)/T = f_h − D_n v_m − alpha y        eq:obs_dyn
//! e⁺ = e + T w
//! y  = w + K_P (e + T w/2)                            eq:dob_input, tau = K y
//! ```

use crate::{Gains, Real};

/// What one sample of the law starts from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// Position error q_n − q, m.
    pub e: Real,
    /// Nominal velocity, m/s.
    pub v_n: Real,
    /// The robot's velocity, m/s.
    pub dq: Real,
    /// Force of the human on the handle, N.
    pub f_h: Real,
    /// Damping of the nominal in this sample, N·s/m: D_n of the gains and what comes on top.
    pub D_n: Real,
}

/// What one sample of the law arrives at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Midpoint {
    /// Nominal velocity at the middle of the sample, m/s.
    pub v_m: Real,
    /// PI output at the middle of the sample, m/s.
    pub y: Real,
}

/// Nominal and coupling solved together: the nominal feels alpha·y. With alpha = 0 it feels nothing.
///
/// c = alpha(1 + K_P T/2)
/// v_m = (2 M_n v_n/T + f_h + alpha(dq + K_P T dq/2 − K_P e)) / (2 M_n/T + D_n + c)
/// y = (v_m − dq) + K_P(e + T(v_m − dq)/2)
pub fn coupled(gains: &Gains, alpha: Real, T: Real, sample: &Sample) -> Midpoint {
    let Gains { M_n, K_P, .. } = *gains;
    let Sample {
        e,
        v_n,
        dq,
        f_h,
        D_n,
    } = *sample;
    let c = alpha * (1.0 + K_P * T / 2.0);
    let v_m = (2.0 * M_n * v_n / T + f_h + alpha * (dq + K_P * T * dq / 2.0 - K_P * e))
        / (2.0 * M_n / T + D_n + c);
    let y = coupling(gains, T, sample, v_m);
    Midpoint { v_m, y }
}

/// The coupling's answer to a nominal that moves with `v_m` (m/s) over the sample: y at its middle (m/s).
///
/// y = w + K_P(e + T w/2), w = v_m − dq
pub fn coupling(gains: &Gains, T: Real, sample: &Sample, v_m: Real) -> Real {
    let w = v_m - sample.dq;
    w + gains.K_P * (sample.e + T * w / 2.0)
}

/// The nominal under a given reaction alpha·y_s, y_s being what the limits left of y (m/s). Returns v_m (m/s).
///
/// v_m = (2 M_n v_n/T + f_h − alpha y_s) / (2 M_n/T + D_n)
pub fn driven(gains: &Gains, alpha: Real, T: Real, sample: &Sample, y_s: Real) -> Real {
    let M_n = gains.M_n;
    let Sample { v_n, f_h, D_n, .. } = *sample;
    (2.0 * M_n * v_n / T + f_h - alpha * y_s) / (2.0 * M_n / T + D_n)
}

/// The nominal velocity at which the coupling asks for exactly y_s (m/s): while it slips, the nominal need not run ahead
/// of the robot any faster than that.
///
/// v_b = (y_s − K_P e)/(1 + K_P T/2) + dq
pub fn at_the_bound(gains: &Gains, T: Real, sample: &Sample, y_s: Real) -> Real {
    let Sample { e, dq, .. } = *sample;
    (y_s - gains.K_P * e) / (1.0 + gains.K_P * T / 2.0) + dq
}

/// Nominal velocity at the end of a sample over which its mean is `v_m` (m/s): v_n⁺ = 2 v_m − v_n.
pub fn end(sample: &Sample, v_m: Real) -> Real {
    2.0 * v_m - sample.v_n
}

/// `other` in place of the velocity `v` where it holds no more energy.
pub fn slower(v: Real, other: Real) -> Real {
    if other * other <= v * v { other } else { v }
}

/// Energy (K/alpha) f_h v_m T that the human's port brings in a sample, J. Not finite for alpha = 0.
pub fn supplied(gains: &Gains, alpha: Real, T: Real, sample: &Sample, v_m: Real) -> Real {
    gains.K / alpha * sample.f_h * v_m * T
}
