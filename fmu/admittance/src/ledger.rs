//! What the sampled law created, and the tank that it draws on.
//!
//! Over one sample, with Δq what the robot moved and f the force that acted meanwhile, summed over the axes:
//!
//! ```text
//! ΔG = ΔH + f·Δq − (K/alpha) f_h v_m T        energy created
//! G ← G + ΔG,   E ← min(E_0, E − ΔG)          G(0) = 0, E(0) = E_0
//! ```
//!
//! A held force does f·Δq of work whatever the path, so this is exact, one sample later: at t_{k+1}, after the slip.
//! The ports are (f_h ; K v_n/alpha) and (dq ; −tau_a). The tank is observed here, not enforced: it may go negative.
//!
//! With alpha = 0 there is no such port and no storage: [`Ledger::is_defined`] says so, and all values are 0.

use crate::{Real, Settings};
use nalgebra::SVector;

/// The ledger of N axes with one tank.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ledger<const N: usize> {
    defined: bool,
    delayed: bool,
    E_0: Real,
    H: Real,
    G: Real,
    tank: Real,
    q: SVector<Real, N>,
    commanded: SVector<Real, N>,
    acting: SVector<Real, N>,
    supplied: Real,
}

impl<const N: usize> Ledger<N> {
    /// Nothing stored, nothing created, nothing acting.
    pub fn new(settings: &Settings) -> Self {
        let defined = settings.alpha > 0.0;
        Self {
            defined,
            delayed: settings.delayed,
            E_0: settings.E_0,
            H: 0.0,
            G: 0.0,
            tank: if defined { settings.E_0 } else { 0.0 },
            q: SVector::zeros(),
            commanded: SVector::zeros(),
            acting: SVector::zeros(),
            supplied: 0.0,
        }
    }

    /// Settles the sample that ends now, with the energy `H` (J) that the law stores now and the position `q` (m).
    #[must_use]
    pub fn settled(self, H: Real, q: &SVector<Real, N>) -> Self {
        if !self.defined {
            return self;
        }
        let created = H - self.H + self.acting.dot(&(q - self.q)) - self.supplied;
        Self {
            H,
            q: *q,
            G: self.G + created,
            tank: (self.tank - created).min(self.E_0),
            ..self
        }
    }

    /// Opens the sample that begins now: the force `f` (N) on the robot that this tick says, and the energy
    /// (K/alpha) f_h v_m T (J) that the human's port brings.
    #[must_use]
    pub fn opened(self, f: &SVector<Real, N>, supplied: Real) -> Self {
        if !self.defined {
            return self;
        }
        let acting = if self.delayed { self.commanded } else { *f };
        Self {
            commanded: *f,
            acting,
            supplied,
            ..self
        }
    }

    /// Whether there is an energy to speak of: alpha > 0.
    pub fn is_defined(&self) -> bool {
        self.defined
    }

    /// H, stored at the last tick, J.
    pub fn H(&self) -> Real {
        self.H
    }

    /// G, created up to the last tick, J; negative: dissipated.
    pub fn G(&self) -> Real {
        self.G
    }

    /// E, what the tank holds at the last tick, J.
    pub fn tank(&self) -> Real {
        self.tank
    }
}
