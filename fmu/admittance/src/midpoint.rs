//! The implicit midpoint rule for (e, v_n): the law's arithmetic, without limits and without memory.
//!
//! With v_m = (v_n + v_n⁺)/2 and w = v_m − dq, the robot's velocity dq held over the sample:
//!
//! ```text
//! M_n (v_n⁺ − v_n)/T = f_h − D_n v_m − alpha y        eq:obs_dyn
//! e⁺ = e + T w
//! y  = w + K_P (e + T w/2)                            eq:dob_input, tau = K y
//! ```

use crate::storage::{Mass, Spring};
use crate::{Gains, Real, Settings};

/// The rule for one axis, with what follows from its gains: computed when they change, not at every tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rule {
    /// The gains.
    pub gains: Gains,
    /// The coupling's spring.
    pub spring: Spring,
    /// The nominal mass as an energy.
    pub mass: Mass,
    T: Real,
    /// the damper through which the nominal feels y, N·s/m
    alpha: Real,
    /// 2 M_n and 2 M_n/T
    M_2: Real,
    M_2T: Real,
    /// K_P T
    KPT: Real,
    /// 1 + K_P T/2, and alpha times that
    lead: Real,
    c: Real,
    /// K/alpha of the human's port
    port: Real,
    /// K T (1 + K_P T/2)
    exchange: Real,
}

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
    /// Damping on top of D_n, N·s/m.
    pub damping: Real,
}

impl Rule {
    /// That of `gains` under `settings`.
    pub fn new(settings: &Settings, gains: &Gains) -> Self {
        let Settings { law, T, .. } = *settings;
        let Gains { M_n, K, K_P, .. } = *gains;
        let lead = 1.0 + K_P * T / 2.0;
        Self {
            gains: *gains,
            spring: Spring::new(law, gains),
            mass: Mass::new(gains, settings),
            T,
            alpha: settings.reaction(),
            M_2: 2.0 * M_n,
            M_2T: 2.0 * M_n / T,
            KPT: K_P * T,
            lead,
            c: settings.reaction() * lead,
            port: settings.over_alpha(K),
            exchange: K * T * lead,
        }
    }

    /// D_n and what comes on top of it in this sample, N·s/m.
    #[inline]
    fn D_n(&self, sample: &Sample) -> Real {
        self.gains.D_n + sample.damping
    }

    /// Nominal and coupling solved together: the nominal feels alpha·y. With alpha = 0 it feels nothing. Returns v_m (m/s); y is
    /// its [`coupling`](Self::coupling).
    ///
    /// c = alpha(1 + K_P T/2)
    /// v_m = (2 M_n v_n/T + f_h + alpha(dq + K_P T dq/2 − K_P e)) / (2 M_n/T + D_n + c)
    #[inline]
    pub fn coupled(&self, sample: &Sample) -> Real {
        let Self {
            T, alpha, M_2, KPT, ..
        } = *self;
        let Sample {
            e, v_n, dq, f_h, ..
        } = *sample;
        (M_2 * v_n / T + f_h + alpha * (dq + KPT * dq / 2.0 - self.gains.K_P * e))
            / (self.M_2T + self.D_n(sample) + self.c)
    }

    /// What multiplies v_m in the nominal's equation, N·s/m: that of [`coupled`](Self::coupled), or of
    /// [`driven`](Self::driven).
    #[inline]
    pub fn inertia(&self, sample: &Sample, is_coupled: bool) -> Real {
        let driven = self.M_2T + self.D_n(sample);
        if is_coupled { driven + self.c } else { driven }
    }

    /// The coupling's answer to a nominal that moves with `v_m` (m/s) over the sample: y at its middle (m/s).
    ///
    /// y = w + K_P(e + T w/2), w = v_m − dq
    #[inline]
    pub fn coupling(&self, sample: &Sample, v_m: Real) -> Real {
        let w = v_m - sample.dq;
        w + self.gains.K_P * (sample.e + self.T * w / 2.0)
    }

    /// The nominal under a given reaction alpha·y_s, y_s being what the limits left of y (m/s). Returns v_m (m/s).
    ///
    /// v_m = (2 M_n v_n/T + f_h − alpha y_s) / (2 M_n/T + D_n)
    #[inline]
    pub fn driven(&self, sample: &Sample, y_s: Real) -> Real {
        let Self { T, alpha, M_2, .. } = *self;
        let Sample { v_n, f_h, .. } = *sample;
        (M_2 * v_n / T + f_h - alpha * y_s) / (self.M_2T + self.D_n(sample))
    }

    /// The nominal velocity at which the coupling asks for exactly y_s (m/s): while it slips, the nominal need not run ahead
    /// of the robot any faster than that.
    ///
    /// v_b = (y_s − K_P e)/(1 + K_P T/2) + dq
    #[inline]
    pub fn at_the_bound(&self, sample: &Sample, y_s: Real) -> Real {
        let Sample { e, dq, .. } = *sample;
        (y_s - self.gains.K_P * e) / self.lead + dq
    }

    /// Energy (K/alpha) f_h v_m T that the human's port brings in a sample, J. 0 for alpha = 0.
    #[inline]
    pub fn supplied(&self, f_h: Real, v_m: Real) -> Real {
        self.port * f_h * v_m * self.T
    }

    /// The terms of the energy that passes the coupling in a sample, at their sizes, J: y is a difference of them, and their
    /// rounding is the nominal's.
    ///
    /// K T (1 + K_P T/2)(v_m² + dq²)
    #[inline]
    pub fn exchanged(&self, dq: Real, v_m: Real) -> Real {
        self.exchange * (v_m * v_m + dq * dq)
    }

    /// Energy (J) that the law is sure to take in a sample over which the robot gets the force `f` (N), while the nominal
    /// feels it and moves with `v_m` (m/s), but for the energy of the spring, which can be given up afterwards: what the human
    /// brings less what the nominal keeps, and its damping.
    ///
    /// −ΔH + (K/alpha) f_h v_m T ≥ K y v_m T + (K/alpha) D_n v_m² T + ½ K K_P e²
    #[inline]
    pub fn taken(&self, sample: &Sample, f: Real, v_m: Real) -> Real {
        f * v_m * self.T + self.port * self.D_n(sample) * v_m * v_m * self.T
    }
}

/// Nominal velocity at the end of a sample that begins with `v_n` and over which its mean is `v_m` (m/s): v_n⁺ = 2 v_m − v_n.
#[inline]
pub fn end(v_n: Real, v_m: Real) -> Real {
    2.0 * v_m - v_n
}

/// `other` in place of the velocity `v` where it holds no more energy.
#[inline]
pub fn slower(v: Real, other: Real) -> Real {
    if other * other <= v * v { other } else { v }
}
