//! The stiffness of the payload between the pads, and the energy in it.

use nalgebra::Vector3;

use crate::{ParameterError, Range, Sum};

/// Stiffness of the bond (N/m). Below, the gap is no longer small; above, roundings of a pad's position (1e-16 m) show in λ.
pub const K: Range = Range {
    variable: "bond.k",
    unit: "N/m",
    low: 1e4,
    high: 1e10,
};
/// Damping of the bond (N·s/m).
pub const C: Range = Range {
    variable: "bond.c",
    unit: "N.s/m",
    low: 0.0,
    high: 1e8,
};

/// What keeps the pads at their offset: λ = −k g − c dg/dt, on the left pad; −λ on the right one.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Bond {
    /// Stiffness k (N/m), along each axis.
    pub k: f64,
    /// Damping c (N·s/m), along each axis.
    pub c: f64,
}

impl Default for Bond {
    /// 1 µm at 100 N; relaxes within 1 ms.
    fn default() -> Self {
        Self { k: 1e8, c: 1e5 }
    }
}

impl Bond {
    /// # Errors
    /// Names the first value that is out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        K.check(self.k)?;
        C.check(self.c)
    }

    /// κ = k dt + c: by how much λ shrinks per relative velocity at the end of a substep `dt` (s); in N·s/m.
    pub fn impedance(&self, dt: f64) -> f64 {
        self.k * dt + self.c
    }

    /// ½ k g² (J).
    pub fn energy(&self, g: &Vector3<f64>) -> f64 {
        0.5 * self.k * g.norm_squared()
    }
}

/// Sums of what the bond took, since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Ledger {
    pub(crate) loss: Sum,
    pub(crate) loss_step: Sum,
    pub(crate) left: Sum,
}

impl Ledger {
    /// Books a substep of `dt` (s) in which the gap went from `before` to `after`: heat c Δg²/dt, and the integrator's own
    /// loss ½ k Δg².
    pub(crate) fn book(
        &mut self,
        bond: &Bond,
        before: &Vector3<f64>,
        after: &Vector3<f64>,
        dt: f64,
    ) {
        let moved = after - before;
        self.loss = self.loss.plus(bond.c * moved.norm_squared() / dt);
        self.loss_step = self.loss_step.plus(bond.energy(&moved));
    }

    /// The payload leaves with what is stored in it at the gap `g`.
    pub(crate) fn release(&mut self, bond: &Bond, g: &Vector3<f64>) {
        self.left = self.left.plus(bond.energy(g));
    }
}
