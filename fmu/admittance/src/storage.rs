//! The energy that one axis of the law holds.
//!
//! H = K(½ M_n v_n²/alpha + ½ K_P e²): the nominal mass and the coupling's spring, as the robot's port sees them.
//!
//! Where the spring is [limited](Yields::Force), its force is, and its energy is Φ(e) = ∫₀ᵉ sat(K K_P s) ds: with it
//! (sat(K K_P e + K de) − sat(K K_P e))·de ≥ 0 makes the law passive, which ½ K K_P e² does not.

use crate::law::Yields;
use crate::real::{self, sat};
use crate::{Gains, Law, Real, Settings};

/// The coupling's spring on one axis, with what follows from its gains.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Spring {
    /// K K_P, N/m
    k: Real,
    half_k: Real,
    /// the force that it keeps to while it winds up, N; infinite for none
    f_limit: Real,
    /// the extension at which it slips, m; infinite for none
    e_max: Real,
}

/// The nominal mass on one axis, as the robot's port sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Mass {
    K: Real,
    half_M: Real,
    alpha: Real,
}

impl Spring {
    /// That of `gains` under `law`.
    pub fn new(law: Law, gains: &Gains) -> Self {
        let k = gains.K * gains.K_P;
        let (f_limit, e_max) = match law.row().spring {
            Yields::Never => (Real::INFINITY, Real::INFINITY),
            Yields::Force => (gains.f_max, Real::INFINITY),
            Yields::Slips => (Real::INFINITY, gains.f_max / k),
        };
        Self {
            k,
            half_k: 0.5 * k,
            f_limit,
            e_max,
        }
    }

    /// Energy at extension `e` (m), J.
    ///
    /// ½ K K_P e², and from |e| = f_max/(K K_P) on, where it is limited, f_max(|e| − f_max/(2 K K_P)).
    #[inline]
    pub fn energy(&self, e: Real) -> Real {
        let Self { k, f_limit, .. } = *self;
        let x = real::abs(e);
        if k * x > f_limit {
            f_limit * (x - f_limit / (2.0 * k))
        } else {
            self.quadratic(e)
        }
    }

    /// The same where it is not limited.
    #[inline]
    pub fn quadratic(&self, e: Real) -> Real {
        let x = real::abs(e);
        self.half_k * x * x
    }

    /// The extension |e| (m) at which it holds `energy` (J): the inverse of [`energy`](Self::energy).
    pub fn extension(&self, energy: Real) -> Real {
        let Self { k, f_limit, .. } = *self;
        let quadratic = real::sqrt(2.0 * energy / k);
        if k * quadratic > f_limit {
            energy / f_limit + f_limit / (2.0 * k)
        } else {
            quadratic
        }
    }

    /// What is left of the extension `e` (m) where it slips: |K K_P e| ≤ f_max. Others keep theirs.
    #[inline]
    pub fn slipped(&self, e: Real) -> Real {
        sat(e, self.e_max)
    }
}

impl Mass {
    /// That of `gains` under `settings`.
    pub fn new(gains: &Gains, settings: &Settings) -> Self {
        // Without alpha no energy is defined: 0, without a division by 0.
        let (K, alpha) = if settings.alpha > 0.0 {
            (gains.K, settings.alpha)
        } else {
            (0.0, 1.0)
        };
        Self {
            K,
            half_M: 0.5 * gains.M_n,
            alpha,
        }
    }

    /// Energy at velocity `v_n` (m/s), J: K ½ M_n v_n²/alpha. 0 for alpha = 0.
    #[inline]
    pub fn energy(&self, v_n: Real) -> Real {
        self.K * (self.half_M * v_n * v_n / self.alpha)
    }
}
