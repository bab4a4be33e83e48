//! What a tick shows: its outputs.

use super::{ArmLaw, HandleTick};
use crate::choices::DEBT;
use crate::displacement::Origin;
use crate::joint_space::Nominal;
use crate::kinematics::Pose;
use crate::signals::ArmOutputs;
use crate::supervision::{State, Status};
use crate::wrench::{Conditioned, Fault, TareFailure};
use admittance::Real;
use nalgebra::{Matrix3, Vector3};

/// Where a tick is shown.
pub(crate) struct Shown<'a> {
    pub outputs: &'a mut ArmOutputs,
    /// where angles and positions are counted from, if not from zero
    pub origin: Option<&'a Origin>,
}

/// What a law did that has a nominal in joint coordinates, before it is shown.
pub(crate) struct Done {
    pub handle: HandleTick,
    /// in task space, where the nominal has none, the robot at rest, M_n 0
    pub nominal: Nominal,
}

impl Done {
    /// Nothing, at joint angles `q` (rad), where the handle is at `pose`.
    pub(crate) fn at_rest(pose: &Pose, q: &Vector3<Real>) -> Self {
        Self {
            handle: HandleTick::at_rest(&pose.p, false),
            nominal: Nominal::at(q, Matrix3::zeros()),
        }
    }
}

impl Shown<'_> {
    /// What happened at the handle.
    #[inline]
    pub(crate) fn handle(&mut self, tick: &HandleTick) {
        let outputs = &mut *self.outputs;
        outputs.tau_a = tick.tau.into();
        outputs.tau_demand = tick.tau_demand.into();
        outputs.f_a = tick.f_a.into();
        outputs.dp = tick.dp.into();
        outputs.p_n = self
            .origin
            .map_or(tick.p_n, |origin| origin.p() + tick.p_n)
            .into();
        outputs.dp_n = tick.dp_n.into();
        outputs.e_nr = tick.e_nr.into();
        outputs.saturated = tick.saturated.into();
        outputs.held = tick.held.into();
        outputs.share = tick.share;
        outputs.outside_bounds = tick.outside_bounds.into();
        outputs.engaged = tick.engaged.into();
    }

    /// The nominal in joint coordinates.
    pub(crate) fn nominal(&mut self, nominal: &Nominal) {
        self.no_nominal(&nominal.q_n);
        let outputs = &mut *self.outputs;
        outputs.dq_n = nominal.dq_n.into();
        outputs.e_q = nominal.e_nr.into();
        // Row by row is column by column: it is symmetric.
        for (output, M_n) in outputs.M_n.iter_mut().zip(&nominal.M_n) {
            *output = *M_n;
        }
    }

    /// A nominal without joints of its own: the robot at rest at `q` (rad), M_n 0.
    #[inline]
    pub(crate) fn no_nominal(&mut self, q: &Vector3<Real>) {
        let outputs = &mut *self.outputs;
        outputs.q_n = self.origin.map_or(*q, |origin| origin.q() + q).into();
        outputs.dq_n = [0.0; 3];
        outputs.e_q = [0.0; 3];
        outputs.M_n = [0.0; 9];
    }

    /// Both.
    pub(crate) fn done(&mut self, done: &Done) {
        self.handle(&done.handle);
        self.nominal(&done.nominal);
    }
}

impl ArmLaw {
    /// What is known after a tick that the law has shown: the handle at `pose`, what the hand does, and what supervision says;
    /// without it, that the law does what `engage` and `hold` say.
    #[inline(always)]
    pub(super) fn show(
        &self,
        pose: &Pose,
        ft: &Conditioned,
        status: &Status,
        outputs: &mut ArmOutputs,
    ) {
        outputs.p = self.origin().map_or(pose.p, |p_0| p_0 + pose.p).into();
        outputs.sigma_min = pose.sigma_min;
        let stiff_hand = self.stiff_hand.known();
        outputs.stiff_hand_detected = stiff_hand.detected.into();
        outputs.stiff_hand_D = stiff_hand.D.into();
        outputs.stiff_hand_k_h = stiff_hand.k_h.into();
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
    #[inline]
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
