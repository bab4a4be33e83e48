//! What a tick shows: its outputs.

use super::{ArmLaw, HandleTick};
use crate::choices::DEBT;
use crate::joint_space::Nominal;
use crate::kinematics::{Pose, ZERO};
use crate::signals::ArmOutputs;
use crate::stiff_hand::StiffHandSeen;
use crate::supervision::{Demand, State, Status};
use crate::wrench::{Conditioned, Fault, TareFailure};
use admittance::{Real, encoder};
use nalgebra::Vector3;

/// What came of a tick, before it is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ran {
    /// where the handle is
    pub(super) pose: Pose,
    /// what the law did
    pub(super) outcome: HandleTick,
    /// the nominal in joint coordinates; in task space, where it has none, the robot at rest, M_n 0
    pub(super) nominal: Nominal,
    /// whether the nominal is slowed before a singularity
    pub(super) slowed: bool,
    /// what is known of a stiff hand, after this tick
    pub(super) stiff_hand: StiffHandSeen,
    /// what the law knows of the hand: about the handle, in the base frame
    pub(super) ft: Conditioned,
    /// sample periods since the joint angles before these were read
    pub(super) after: Real,
    /// what is wrong with the joint angles
    pub(super) encoder: Option<encoder::Fault>,
    /// what supervision says; without it, that the law does what `engage` and `hold` say
    pub(super) status: Status,
}

impl Ran {
    /// Nothing yet, with joint angles read `after` sample periods after those before, with which something may be wrong.
    #[inline]
    pub(super) fn nothing(after: Real, encoder: Option<encoder::Fault>) -> Self {
        let zeros = Vector3::zeros();
        Self {
            pose: Pose::NOWHERE,
            outcome: HandleTick::at_rest(&zeros, false),
            nominal: Nominal::at(&zeros, ZERO),
            slowed: false,
            stiff_hand: StiffHandSeen::default(),
            ft: Conditioned::default(),
            after,
            encoder,
            status: Status::of(Demand::Rest),
        }
    }
}

impl ArmLaw {
    /// What came of a tick.
    pub(super) fn show(&self, ran: &Ran, outputs: &mut ArmOutputs) {
        let Ran {
            pose,
            outcome,
            nominal,
            slowed,
            stiff_hand,
            ft,
            encoder,
            status,
            after: _,
        } = ran;
        let absolute = |p: &Vector3<Real>| self.origin().map_or(*p, |p_0| p_0 + p).into();
        outputs.tau_a = outcome.tau.into();
        outputs.tau_demand = outcome.tau_demand.into();
        outputs.f_a = outcome.f_a.into();
        outputs.p = absolute(&pose.p);
        outputs.dp = outcome.dp.into();
        outputs.p_n = absolute(&outcome.p_n);
        outputs.dp_n = outcome.dp_n.into();
        outputs.e_nr = outcome.e_nr.into();
        outputs.sigma_min = pose.sigma_min;
        outputs.saturated = outcome.saturated.into();
        outputs.held = outcome.held.into();
        outputs.outside_bounds = outcome.outside_bounds.into();
        outputs.engaged = outcome.engaged.into();
        outputs.slowed = i32::from(*slowed);
        outputs.q_n = self.absolute(&nominal.q_n).into();
        outputs.dq_n = nominal.dq_n.into();
        outputs.e_q = nominal.e_nr.into();
        // Row by row is column by column: it is symmetric.
        for (output, M_n) in outputs.M_n.iter_mut().zip(&nominal.M_n) {
            *output = *M_n;
        }
        outputs.stiff_hand_detected = stiff_hand.detected.into();
        outputs.stiff_hand_D = stiff_hand.D.into();
        outputs.stiff_hand_k_h = stiff_hand.k_h.into();
        outputs.encoder_fault = encoder.map_or(0, encoder::Fault::number);
        outputs.diagnostic = status.diagnostic.number();
        outputs.first_fault = status.first_fault.number();
        outputs.authority = status.authority;
        let ledger = self.ledger();
        outputs.H = ledger.H();
        outputs.G = ledger.G();
        outputs.tank = ledger.tank();
        let is_in_debt = ledger.is_in_debt();
        outputs.debt = is_in_debt.into();
        outputs.state = match status.state {
            State::Engaged | State::Hold if is_in_debt => DEBT,
            state => state.number(),
        };
        outputs.share = outcome.share;
        self.show_hand(ft, outputs);
    }

    /// What the watch on drift knows; without one the outputs stay as they are.
    pub(super) fn show_drift(&self, outputs: &mut ArmOutputs) {
        let supervisor = self.supervisor.as_ref();
        if let Some(drift) = supervisor.and_then(|supervisor| supervisor.drift()) {
            outputs.unattended = drift.moved();
            outputs.ft_mass_error = drift.mass_error();
        }
    }

    /// What is known of the hand.
    pub(super) fn show_hand(&self, ft: &Conditioned, outputs: &mut ArmOutputs) {
        outputs.ft_f_h = ft.hand.force.into();
        outputs.ft_moment = ft.hand.torque.into();
        outputs.ft_fault = ft.fault.map_or(0, Fault::number);
        outputs.ft_tare_state = ft.tare.number();
        outputs.ft_tare_failure = ft.tare.failure().map_or(0, TareFailure::number);
        let bias = self.conditioner.bias();
        outputs.ft_bias_force = bias.force.into();
        outputs.ft_bias_torque = bias.torque.into();
    }
}
