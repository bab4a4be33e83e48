//! Sliding-mode position control with a bounded force under a standard admittance proxy.
//!
//! After Kikuuwe and Fujimoto (2006: proxy-based sliding mode control) and Kikuuwe (2014: its use under an admittance).
//! Three bodies in a row: the admittance proxy q_n (eq:admittance_standard), a massless inner proxy p, the robot q.
//!
//! ```text
//! M_n ddq_n + D_n dq_n = f_h                      admittance proxy: no reaction
//! tau = K(db + K_P b),   b = p − q                coupling of inner proxy and robot
//! tau ∈ f_max Sgn(s),    s = (q_n − p) + H(dq_n − dp),   Sgn(0) = [−1, 1]
//! ```
//!
//! The inner proxy has no mass, so both forces on it are equal. While |tau| < f_max it slides on s = 0, that is
//! q_n − p decays as exp(−t/H) to 0, and then tau = K(de + K_P e) as in eq:adm_ctrl_1dof. When the force saturates, p
//! stays by the robot, |b| ≤ f_max/(K K_P), instead of winding up with q_n: the robot returns to q_n along s = 0, without
//! overshoot as long as f_max can brake it, (q_n − q)/H² ≤ f_max/M.
//!
//! Sampled by implicit Euler in b, with the errors predicted for the middle of the sample as in
//! [`midpoint`](crate::midpoint), de = v_m − dq and e = q_n − q + T de/2:
//!
//! ```text
//! tau ∈ f_max Sgn(e + H de − b⁺ − H(b⁺ − b)/T),   tau = K((b⁺ − b)/T + K_P b⁺)
//! ```
//!
//! b⁺ rises with tau and the argument of Sgn falls with b⁺, so there is exactly one solution, in closed form: the force
//! with which the argument is 0, within ±f_max. Nothing switches, so nothing chatters:
//!
//! ```text
//! b* = (T(e + H de) + H b)/(T + H),   tau* = K((b* − b)/T + K_P b*)
//! tau = sat(tau*, f_max),   b⁺ = (b + T tau/K)/(1 + K_P T)
//! ```
//!
//! The admittance proxy feels nothing of the robot: at a wall it runs away and the robot sticks, as under `standard`.
//! The 2014 controller shapes the surface s further, for a faster return; the proxy outside it is the same.

use crate::comparator::{ComparatorTick, Desired};
use crate::parameters::check;
use crate::real::{floored, sat};
use crate::{Gains, ParameterError, Real, Settings};
use fmu_declaration::range::NOT_NEGATIVE;

/// The controller between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SlidingMode {
    proxy: Desired,
    H: Real,
    b: Real,
}

impl SlidingMode {
    /// Out of the loop. `H` (s) is the time constant of the sliding surface; of the settings only T and dq_cutoff
    /// matter.
    ///
    /// # Errors
    /// The first parameter out of its range; `H` goes by the name `comparator.H`.
    pub fn new(settings: Settings, gains: Gains, H: Real) -> Result<Self, ParameterError> {
        let proxy = Desired::new(settings, &gains)?;
        check(None, &[("comparator.H", H, NOT_NEGATIVE)])?;
        Ok(Self { proxy, H, b: 0.0 })
    }

    /// Other gains from the next tick on.
    ///
    /// # Errors
    /// The first one out of its range; the gains stay as they were.
    pub fn tune(&mut self, gains: Gains) -> Result<(), ParameterError> {
        self.proxy.tune(&gains)
    }

    /// One tick at position `q` (m) with the human's force `f_h` (N); the first one engages with q_n = q, v_n = 0, b = 0.
    pub fn step(&mut self, q: Real, f_h: Real) -> ComparatorTick {
        let (q_n, sample) = self.proxy.sense(q, f_h);
        let Gains { K, K_P, f_max, .. } = self.proxy.rule.gains;
        let (T, H) = (self.proxy.settings.T, self.H);

        let v_m = self.proxy.rule.driven(&sample, 0.0); // no reaction
        let de = v_m - sample.dq;
        let e = sample.e + T * de / 2.0;
        let b_slide = (T * (e + H * de) + H * self.b) / (T + H);
        let f_demand = K * ((b_slide - self.b) / T + K_P * b_slide);
        let f = sat(f_demand, f_max);

        self.b = floored((self.b + T * f / K) / (1.0 + K_P * T));
        self.proxy.advance(q_n, &sample, v_m);
        ComparatorTick::of(q_n, &sample, f, f_demand)
    }

    /// One tick out of the loop at position `q` (m): no force; the next [`step`](Self::step) engages anew.
    pub fn rest(&mut self, q: Real) -> ComparatorTick {
        self.proxy.rest();
        self.b = 0.0;
        ComparatorTick::at_rest(q)
    }

    /// b = p − q, how far the inner proxy is ahead of the robot, m.
    pub fn b(&self) -> Real {
        self.b
    }
}
