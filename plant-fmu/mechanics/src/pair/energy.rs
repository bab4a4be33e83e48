//! The energy balance of both arms and of what ties them together.

use crate::arm::Energy;
use fmu_declaration::Rows;

/// Energy balance since the start (J).
#[derive(Clone, Copy, Debug, Default, PartialEq, Rows)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Balance {
    /// Sums over both arms; `loss_step` and `payload` include the bond's share. The residual is that of the whole:
    ///
    /// ```text
    /// Σ work + payload − Σ loss − loss_bond − (E − E(0)),   E = Σ (kinetic + potential + surface) + bond
    /// ```
    #[part(about = [(
        "energy.residual",
        "works + payload - losses - loss_bond - (kinetic + potential + surface + bond - their start value): of first \
         order in the substep, defines no term",
    )])]
    pub arms: Energy,
    /// energy stored in the payload between the pads
    #[output(16, name = "energy.bond", unit = JOULE)]
    pub bond: f64,
    /// heat in the payload between the pads since the start
    #[output(17, name = "energy.loss_bond", unit = JOULE)]
    pub loss_bond: f64,
}

/// Both arms together, field by field.
pub(crate) fn sum(left: &Energy, right: &Energy) -> Energy {
    Energy {
        kinetic: left.kinetic + right.kinetic,
        potential: left.potential + right.potential,
        surface: left.surface + right.surface,
        work_tau: left.work_tau + right.work_tau,
        work_f_h: left.work_f_h + right.work_f_h,
        work_f_d: left.work_f_d + right.work_f_d,
        payload: left.payload + right.payload,
        loss_friction: left.loss_friction + right.loss_friction,
        loss_viscous: left.loss_viscous + right.loss_viscous,
        loss_stop: left.loss_stop + right.loss_stop,
        loss_surface: left.loss_surface + right.loss_surface,
        loss_rub: left.loss_rub + right.loss_rub,
        loss_impact: left.loss_impact + right.loss_impact,
        loss_grip: left.loss_grip + right.loss_grip,
        loss_step: left.loss_step + right.loss_step,
        residual: left.residual + right.residual,
    }
}
