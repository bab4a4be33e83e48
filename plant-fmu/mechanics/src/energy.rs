//! Where the energy is, where it came from, where it went.

use crate::Sum;
use fmu_declaration::Rows;

/// Energy that crossed the plant's boundaries in one substep (J).
///
/// Each term is computed by its own formula from what happened in the substep; Δx stands for x⁺ − x, Δq = dt dq⁺. Losses
/// are never negative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flow {
    /// Work of the actuator on the mass: τ_a Δq.
    pub work_tau_a: f64,
    /// Work of the human on the mass: τ_h Δq.
    pub work_tau_h: f64,
    /// Work of the disturbance on the mass: τ_d Δq.
    pub work_tau_d: f64,
    /// Heat of Coulomb friction: F_c |Δq|.
    pub loss_coulomb: f64,
    /// Heat of viscous friction: b dq⁺ Δq.
    pub loss_viscous: f64,
    /// Heat of the wall's damper: c Δs²/dt, also while the surface relaxes by itself.
    pub loss_wall: f64,
    /// Lost in landing: λ (s − pen). The contact force of the landing substep acts over the whole of Δq, the gap
    /// included that the mass had yet to cross. First order in dt, zero while contact lasts.
    pub loss_impact: f64,
    /// The integrator's own loss (backward Euler): ½ M Δdq² + ½ k Δs². First order in dt.
    pub loss_step: f64,
}

/// Energy balance since the start (J); each sum adds up one term of [`Flow`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Rows)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Energy {
    /// kinetic energy of the mass, M dq^2/2
    #[output(0, name = "energy.kinetic", unit = JOULE, from = ["M", "dq_start"])]
    pub kinetic: f64,
    /// energy stored in the wall, k s^2/2 with the deflection s of its surface
    #[output(1, name = "energy.wall", unit = JOULE)]
    pub wall: f64,
    /// work of tau_a on the mass since the start
    #[output(2, name = "energy.work_tau_a", unit = JOULE)]
    pub work_tau_a: f64,
    /// work of tau_h on the mass since the start
    #[output(3, name = "energy.work_tau_h", unit = JOULE)]
    pub work_tau_h: f64,
    /// work of tau_d on the mass since the start
    #[output(4, name = "energy.work_tau_d", unit = JOULE)]
    pub work_tau_d: f64,
    /// heat of Coulomb friction since the start
    #[output(5, name = "energy.loss_coulomb", unit = JOULE)]
    pub loss_coulomb: f64,
    /// heat of viscous friction since the start
    #[output(6, name = "energy.loss_viscous", unit = JOULE)]
    pub loss_viscous: f64,
    /// heat of the damper in the wall since the start
    #[output(7, name = "energy.loss_wall", unit = JOULE)]
    pub loss_wall: f64,
    /// lost in landings on the wall since the start, of first order in the substep
    #[output(8, name = "energy.loss_impact", unit = JOULE)]
    pub loss_impact: f64,
    /// loss of the integrator (backward Euler) since the start, of first order in the substep
    #[output(9, name = "energy.loss_step", unit = JOULE)]
    pub loss_step: f64,
    /// works - losses - (kinetic + wall - their start value): zero up to rounding, defines no term
    #[output(10, name = "energy.residual", unit = JOULE)]
    pub residual: f64,
}

/// Sums of the flows since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Ledger {
    E_0: f64,
    work_tau_a: Sum,
    work_tau_h: Sum,
    work_tau_d: Sum,
    loss_coulomb: Sum,
    loss_viscous: Sum,
    loss_wall: Sum,
    loss_impact: Sum,
    loss_step: Sum,
}

impl Ledger {
    /// Opens with the stored energy `E_0` = E(0) (J).
    pub(crate) fn open(E_0: f64) -> Self {
        Self {
            E_0,
            ..Self::default()
        }
    }

    /// Books one substep.
    #[inline(always)]
    pub(crate) fn book(&mut self, flow: &Flow) {
        self.work_tau_a = self.work_tau_a.plus(flow.work_tau_a);
        self.work_tau_h = self.work_tau_h.plus(flow.work_tau_h);
        self.work_tau_d = self.work_tau_d.plus(flow.work_tau_d);
        self.loss_coulomb = self.loss_coulomb.plus(flow.loss_coulomb);
        self.loss_viscous = self.loss_viscous.plus(flow.loss_viscous);
        self.loss_wall = self.loss_wall.plus(flow.loss_wall);
        self.loss_impact = self.loss_impact.plus(flow.loss_impact);
        self.loss_step = self.loss_step.plus(flow.loss_step);
    }

    /// The balance, with what is stored now (J).
    pub(crate) fn balance(&self, kinetic: f64, wall: f64) -> Energy {
        let energy = Energy {
            kinetic,
            wall,
            work_tau_a: self.work_tau_a.value(),
            work_tau_h: self.work_tau_h.value(),
            work_tau_d: self.work_tau_d.value(),
            loss_coulomb: self.loss_coulomb.value(),
            loss_viscous: self.loss_viscous.value(),
            loss_wall: self.loss_wall.value(),
            loss_impact: self.loss_impact.value(),
            loss_step: self.loss_step.value(),
            residual: 0.0,
        };
        Energy {
            residual: energy.work() - energy.loss() - (kinetic + wall - self.E_0),
            ..energy
        }
    }
}

impl Energy {
    /// Work of all external forces on the mass (J).
    pub fn work(&self) -> f64 {
        self.work_tau_a + self.work_tau_h + self.work_tau_d
    }

    /// All losses (J).
    pub fn loss(&self) -> f64 {
        self.loss_coulomb + self.loss_viscous + self.loss_wall + self.loss_impact + self.loss_step
    }
}
