//! The energy balance: what is stored, and the sums of what crossed the boundaries.

use super::flow::Flow;
use super::parameters::Parameters;
use super::rigid_body::RigidBody;
use super::state::State;
use crate::Sum;

/// Energy balance since the start (J).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Energy {
    /// ½ dqᵀ M dq, a held payload included.
    pub kinetic: f64,
    /// Potential energy of the links and a held payload, 0 at the height of the shoulder.
    pub potential: f64,
    /// Stored in the surfaces: Σ ½ k s².
    pub surface: f64,
    /// Work of the torques that arrive at the joints.
    pub work_tau: f64,
    /// Work of the human at the handle.
    pub work_f_h: f64,
    /// Work of the disturbance at the pad.
    pub work_f_d: f64,
    /// Brought by payloads, less what they took along.
    pub payload: f64,
    /// Heat of dry friction in the joints.
    pub loss_friction: f64,
    /// Heat of viscous friction in the joints.
    pub loss_viscous: f64,
    /// Lost at the stops.
    pub loss_stop: f64,
    /// Heat of the surfaces' dampers.
    pub loss_surface: f64,
    /// Heat of friction on the surfaces.
    pub loss_rub: f64,
    /// Lost in landings on a surface, first order in the substep; see [`Flow::loss_impact`].
    pub loss_impact: f64,
    /// Lost in gripping payloads.
    pub loss_grip: f64,
    /// The integrator's own loss, first order in the substep; see [`Flow::loss_step`].
    pub loss_step: f64,
    /// Σ work + payload − Σ loss − (E − E(0)), E = kinetic + potential + surface. No term is defined by it: it is the
    /// error of M, C, g and J being taken at the begin of a substep, first order in dt.
    pub residual: f64,
}

/// Energy that is stored (J).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Stored {
    pub(crate) kinetic: f64,
    pub(crate) potential: f64,
    pub(crate) surface: f64,
}

impl Stored {
    /// In an arm in `state`, where its rigid body is `body`.
    pub(crate) fn of(parameters: &Parameters, state: &State, body: &RigidBody) -> Self {
        let surfaces = parameters.surfaces();
        Self {
            kinetic: body.kinetic(&state.dq),
            potential: body.potential,
            surface: surfaces[0].wall().energy(state.s[0]) + surfaces[1].wall().energy(state.s[1]),
        }
    }

    fn total(&self) -> f64 {
        self.kinetic + self.potential + self.surface
    }
}

/// Sums of the flows since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Ledger {
    E_0: f64,
    work_tau: Sum,
    work_f_h: Sum,
    work_f_d: Sum,
    payload: Sum,
    loss_friction: Sum,
    loss_viscous: Sum,
    loss_stop: Sum,
    loss_surface: Sum,
    loss_rub: Sum,
    loss_impact: Sum,
    loss_grip: Sum,
    loss_step: Sum,
}

impl Ledger {
    /// Opens with what is stored at the start.
    pub(crate) fn open(stored: &Stored) -> Self {
        Self {
            E_0: stored.total(),
            ..Self::default()
        }
    }

    /// Books one substep.
    pub(crate) fn book(&mut self, flow: &Flow) {
        self.work_tau = self.work_tau.plus(flow.work_tau);
        self.work_f_h = self.work_f_h.plus(flow.work_f_h);
        self.work_f_d = self.work_f_d.plus(flow.work_f_d);
        self.payload = self.payload.plus(flow.payload);
        self.loss_friction = self.loss_friction.plus(flow.loss_friction);
        self.loss_viscous = self.loss_viscous.plus(flow.loss_viscous);
        self.loss_stop = self.loss_stop.plus(flow.loss_stop);
        self.loss_surface = self.loss_surface.plus(flow.loss_surface);
        self.loss_rub = self.loss_rub.plus(flow.loss_rub);
        self.loss_impact = self.loss_impact.plus(flow.loss_impact);
        self.loss_grip = self.loss_grip.plus(flow.loss_grip);
        self.loss_step = self.loss_step.plus(flow.loss_step);
    }

    /// The balance, with what is stored now.
    pub(crate) fn balance(&self, stored: &Stored) -> Energy {
        let energy = Energy {
            kinetic: stored.kinetic,
            potential: stored.potential,
            surface: stored.surface,
            work_tau: self.work_tau.value(),
            work_f_h: self.work_f_h.value(),
            work_f_d: self.work_f_d.value(),
            payload: self.payload.value(),
            loss_friction: self.loss_friction.value(),
            loss_viscous: self.loss_viscous.value(),
            loss_stop: self.loss_stop.value(),
            loss_surface: self.loss_surface.value(),
            loss_rub: self.loss_rub.value(),
            loss_impact: self.loss_impact.value(),
            loss_grip: self.loss_grip.value(),
            loss_step: self.loss_step.value(),
            residual: 0.0,
        };
        Energy {
            residual: energy.work() + energy.payload - energy.loss() - (stored.total() - self.E_0),
            ..energy
        }
    }
}

impl Energy {
    /// Work of torques and forces on the arm (J).
    pub fn work(&self) -> f64 {
        self.work_tau + self.work_f_h + self.work_f_d
    }

    /// All losses (J).
    pub fn loss(&self) -> f64 {
        self.loss_friction
            + self.loss_viscous
            + self.loss_stop
            + self.loss_surface
            + self.loss_rub
            + self.loss_impact
            + self.loss_grip
            + self.loss_step
    }
}
