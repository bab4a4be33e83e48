//! A robot for the law to act on: a mass without friction, integrated exactly under a held force.
#![allow(
    non_snake_case,
    dead_code,
    reason = "the paper's symbols; not every test uses every item"
)]

use admittance::{Admittance, Gains, Law, Settings, Tick};
use nalgebra::Vector1;

/// M ddq = tau_a + tau_h.
#[derive(Clone, Copy, Debug)]
pub struct Mass {
    pub M: f64,
    pub q: f64,
    pub dq: f64,
}

impl Mass {
    pub fn new(M: f64) -> Self {
        Self { M, q: 0.0, dq: 0.0 }
    }

    /// Exact over `T` for a held force: q⁺ = q + T dq + ½T²u/M, dq⁺ = dq + T u/M.
    pub fn hold(&mut self, u: f64, T: f64) {
        self.q += T * self.dq + 0.5 * T * T * u / self.M;
        self.dq += T * u / self.M;
    }
}

/// Gains without a force limit.
pub fn unlimited(M_n: f64, D_n: f64, K: f64, K_P: f64) -> Gains {
    Gains {
        M_n,
        D_n,
        K,
        K_P,
        f_max: f64::INFINITY,
    }
}

pub fn law(law: Law, T: f64, gains: Gains) -> Admittance<1> {
    Admittance::new(
        Settings {
            law,
            T,
            ..Settings::default()
        },
        [gains],
    )
    .expect("valid parameters")
}

/// One tick of a one-axis law.
pub fn tick(law: &mut Admittance<1>, q: f64, f_h: f64) -> Tick<1> {
    law.step(&Vector1::new(q), &Vector1::new(f_h))
}
