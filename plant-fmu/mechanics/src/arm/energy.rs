//! The energy balance: what is stored, and the sums of what crossed the boundaries.

use fmu_declaration::Rows;

use super::flow::Flow;
use super::parameters::Parameters;
use super::rigid_body::RigidBody;
use super::state::State;
use crate::Sum;

/// Energy balance since the start (J); each sum adds up one term of [`Flow`]. The residual is the error of M, C, g and J
/// being taken at the begin of a substep.
#[derive(Clone, Copy, Debug, Default, PartialEq, Rows)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Energy {
    /// kinetic energy of arm, rotors and a held payload
    #[output(0, name = "energy.kinetic", unit = JOULE, from = KINETIC)]
    pub kinetic: f64,
    /// potential energy of the links and a held payload, 0 at the shoulder
    #[output(1, name = "energy.potential", unit = JOULE, from = POTENTIAL)]
    pub potential: f64,
    /// energy stored in table and wall
    #[output(2, name = "energy.surface", unit = JOULE)]
    pub surface: f64,
    /// work of tau_applied on the arm since the start
    #[output(3, name = "energy.work_tau", unit = JOULE)]
    pub work_tau: f64,
    /// work of f_h on the arm since the start
    #[output(4, name = "energy.work_f_h", unit = JOULE)]
    pub work_f_h: f64,
    /// work of f_d on the arm since the start
    #[output(5, name = "energy.work_f_d", unit = JOULE)]
    pub work_f_d: f64,
    /// energy that payloads brought when they were gripped, less what they took along when they left
    #[output(6, name = "energy.payload", unit = JOULE)]
    pub payload: f64,
    /// heat of dry friction in the joints since the start
    #[output(7, name = "energy.loss_friction", unit = JOULE)]
    pub loss_friction: f64,
    /// heat of viscous friction in the joints since the start
    #[output(8, name = "energy.loss_viscous", unit = JOULE)]
    pub loss_viscous: f64,
    /// lost at the joints' stops since the start
    #[output(9, name = "energy.loss_stop", unit = JOULE)]
    pub loss_stop: f64,
    /// heat of the dampers in table and wall since the start
    #[output(10, name = "energy.loss_surface", unit = JOULE)]
    pub loss_surface: f64,
    /// heat of friction on table and wall since the start
    #[output(11, name = "energy.loss_rub", unit = JOULE)]
    pub loss_rub: f64,
    /// lost in landings on table and wall since the start, of first order in the substep
    #[output(12, name = "energy.loss_impact", unit = JOULE)]
    pub loss_impact: f64,
    /// lost in gripping payloads since the start: momentum is kept, energy is not
    #[output(13, name = "energy.loss_grip", unit = JOULE)]
    pub loss_grip: f64,
    /// loss of the integrator (backward Euler) since the start, of first order in the substep
    #[output(14, name = "energy.loss_step", unit = JOULE)]
    pub loss_step: f64,
    /// works + payload - losses - (kinetic + potential + surface - their start value): of first order in the
    /// substep, defines no term
    #[output(15, name = "energy.residual", unit = JOULE)]
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

    /// Books what came and went with a payload.
    pub(crate) fn exchange(&mut self, flow: &Flow) {
        self.payload = self.payload.plus(flow.payload);
        self.loss_grip = self.loss_grip.plus(flow.loss_grip);
    }

    /// Books one substep, but for the exchange of a payload.
    pub(crate) fn book(&mut self, flow: &Flow) {
        self.work_tau = self.work_tau.plus(flow.work_tau);
        self.work_f_h = self.work_f_h.plus(flow.work_f_h);
        self.work_f_d = self.work_f_d.plus(flow.work_f_d);
        self.loss_friction = self.loss_friction.plus(flow.loss_friction);
        self.loss_viscous = self.loss_viscous.plus(flow.loss_viscous);
        self.loss_stop = self.loss_stop.plus(flow.loss_stop);
        self.loss_surface = self.loss_surface.plus(flow.loss_surface);
        self.loss_rub = self.loss_rub.plus(flow.loss_rub);
        self.loss_impact = self.loss_impact.plus(flow.loss_impact);
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

/// What the kinetic energy follows from at the start.
const KINETIC: &[&str] = &[
    "q_start[i]",
    "dq_start[i]",
    "A1",
    "L1",
    "pad.x",
    "pad.z",
    "link.m[i]",
    "link.x[i]",
    "link.z[i]",
    "link.I_xx[i]",
    "link.I_yy[i]",
    "link.I_zz[i]",
    "link.I_xz[i]",
    "rotor.I[i]",
    "gear[i]",
    "payload.m",
    "payload.attached",
];
/// What the potential energy follows from at the start.
const POTENTIAL: &[&str] = &[
    "q_start[i]",
    "A1",
    "L1",
    "pad.x",
    "pad.z",
    "link.m[i]",
    "link.x[i]",
    "link.z[i]",
    "gravity[i]",
    "payload.m",
    "payload.attached",
];
