//! The stiffness of the payload between the pads, and the energy in it.

use fmu_declaration::{Rows, Start};
use nalgebra::Vector3;

use crate::Sum;

/// What keeps the pads at their offset: λ = −k g − c dg/dt, on the left pad; −λ on the right one. The start values: 1 µm at
/// 100 N; relaxes within 1 ms.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Bond {
    // Below, the gap is no longer small; above, roundings of a pad's position (1e-16 m) show in λ.
    /// stiffness of the payload between the pads, along each axis
    #[parameter(0, name = "bond.k", unit = NEWTON_PER_METRE, range = 1e4..=1e10, start = 1e8)]
    pub k: f64,
    /// damping of the payload between the pads, along each axis
    #[parameter(1, name = "bond.c", unit = NEWTON_SECOND_PER_METRE, range = 0.0..=1e8, start = 1e5)]
    pub c: f64,
}

impl Bond {
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
