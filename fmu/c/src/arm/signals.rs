//! What goes into a tick of the arm's law and what comes out of it.

use super::force_sensor::Source;
use super::supervision::ArmSignals;
use crate::Real;
use crate::pointer::Cause;
use crate::refusal::{Bad, Status, truth};
use arm_law::ArmLaw;
use arm_law::arm_law as law;
use arm_law::wrench::{Fault, TareFailure, Wrench};
use nalgebra::Vector3;

/// What is sensed and asked for at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct ArmInputs {
    /// Joint angles, rad: yaw about z, shoulder pitch and elbow pitch about −y, so that positive pitch lifts.
    pub q: [f64; 3],
    /// Force of the human on the handle, N, in the frame that ft.frame says; with ft.source = 1.
    pub f_h: [Real; 3],
    /// Force that a six-axis sensor reads, N, in its frame; with ft.source = 2.
    pub ft_force: [Real; 3],
    /// Moment that it reads about its origin, N·m.
    pub ft_torque: [Real; 3],
    /// The sensor's own word: 0 = its reading is not to be used.
    pub ft_valid: i32,
    /// Whether a tare of the sensor is requested; its change to true starts one.
    pub ft_tare: i32,
    /// Whether the law is to be in the loop.
    pub engage: i32,
    /// Whether the nominal is to stay where it is.
    pub hold: i32,
    /// What supervision is told.
    pub signals: ArmSignals,
}

/// What came of a tick; every value is the one at t_k, vectors at the handle in the base frame.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct ArmOutputs {
    /// Torques on the joints, N·m, positive like q, to be held until the next tick.
    pub tau_a: [Real; 3],
    /// Torques before any limit, N·m.
    pub tau_demand: [Real; 3],
    /// Force on the robot at the handle that tau_a amounts to, N.
    pub f_a: [Real; 3],
    /// Position of the handle, m.
    pub p: [Real; 3],
    /// Velocity of the handle as the law used it, m/s.
    pub dp: [Real; 3],
    /// Nominal position, m.
    pub p_n: [Real; 3],
    /// Nominal velocity, m/s.
    pub dp_n: [Real; 3],
    /// p_n − p, m; in single precision more exact than their difference.
    pub e_nr: [Real; 3],
    /// The hand's force on the handle as the law uses it, N.
    pub ft_f_h: [Real; 3],
    /// The hand's moment about the handle, N·m.
    pub ft_moment: [Real; 3],
    /// Damping that the stiff-hand detector adds, N·s/m.
    pub stiff_hand_D: [Real; 3],
    /// Nominal angles, rad; in task space the sensed ones.
    pub q_n: [Real; 3],
    /// Nominal joint velocities, rad/s; in task space 0.
    pub dq_n: [Real; 3],
    /// q_n − q, rad; in task space 0.
    pub e_q: [Real; 3],
    /// Share of the law's torques that supervision allows, in [0, 1].
    pub authority: Real,
    /// Smallest singular value of the Jacobian, m/rad.
    pub sigma_min: Real,
    /// Energy stored, J.
    pub H: Real,
    /// Energy created since the start, J; negative: dissipated.
    pub G: Real,
    /// What the energy tank holds, J.
    pub tank: Real,
    /// Share of the torques that the energy budget left, in [0, 1].
    pub share: Real,
    /// Whether a limit leaves less than tau_demand.
    pub saturated: i32,
    /// Whether a limit of the nominal, or hold, kept it back.
    pub held: i32,
    /// Whether the joints moved faster than dq_max and ddq_max allow.
    pub outside_bounds: i32,
    /// Whether the law is in the loop.
    pub engaged: i32,
    /// Whether the nominal is slowed before a singularity.
    pub slowed: i32,
    /// Whether a stiff hand has been seen and has not been quiet since.
    pub stiff_hand_detected: i32,
    /// What is wrong with the force sensor, 0 nothing: the numbers of the FMU's ft.fault.
    pub ft_fault: i32,
    /// How far a tare has come: the numbers of the FMU's ft.tare_state.
    pub ft_tare_state: i32,
    /// Why a tare failed, 0 if it did not: the numbers of the FMU's ft.tare_failure.
    pub ft_tare_failure: i32,
    /// State of the supervision: the numbers of the FMU.
    pub state: i32,
    /// What it reports, 0 nothing: the numbers of the FMU.
    pub diagnostic: i32,
    /// The first fault since the last acknowledgement, 0 none.
    pub first_fault: i32,
    /// Whether the tank is below zero after a motion outside the bounds.
    pub debt: i32,
}

impl ArmInputs {
    /// What the law is told, with the joint angles `q` (rad) from where they are counted.
    pub(crate) fn of_law(&self, q: Vector3<Real>, source: Source) -> Result<law::Inputs, Bad> {
        let (force, torque) = match source {
            Source::Force => (self.f_h, [0.0; 3]),
            Source::Wrench => (self.ft_force, self.ft_torque),
        };
        Ok(law::Inputs {
            q,
            hand: Wrench {
                force: force.into(),
                torque: torque.into(),
            },
            ft_valid: truth("ft_valid", self.ft_valid)?,
            tare: truth("ft.tare", self.ft_tare)?,
            engage: truth("engage", self.engage)?,
            hold: truth("hold", self.hold)?,
            signals: self.signals.of_law()?,
        })
    }

    /// Why the result of a tick is not finite.
    pub(crate) fn why_not_finite(&self) -> Cause {
        Bad::sensed("q", &self.q.map(|q| q as Real)).map_or(Status::NotFinite.into(), Cause::from)
    }
}

impl ArmOutputs {
    /// What a tick of `law` said.
    pub(crate) fn of_tick(law: &ArmLaw, outputs: &law::Outputs) -> Self {
        let law::Outputs {
            pose,
            outcome,
            nominal,
            slowed,
            stiff_hand,
            ft,
            status,
        } = outputs;
        let absolute = |p: Vector3<Real>| law.origin().map_or(p, |p_0| p_0 + p).into();
        let ledger = law.ledger();
        Self {
            tau_a: outcome.tau.into(),
            tau_demand: outcome.tau_demand.into(),
            f_a: outcome.f_a.into(),
            p: absolute(pose.p),
            dp: outcome.dp.into(),
            p_n: absolute(outcome.p_n),
            dp_n: outcome.dp_n.into(),
            e_nr: outcome.e_nr.into(),
            ft_f_h: ft.hand.force.into(),
            ft_moment: ft.hand.torque.into(),
            stiff_hand_D: stiff_hand.D.into(),
            q_n: law.absolute(&nominal.q_n).into(),
            dq_n: nominal.dq_n.into(),
            e_q: nominal.e_nr.into(),
            authority: status.authority,
            sigma_min: pose.sigma_min,
            H: ledger.H(),
            G: ledger.G(),
            tank: ledger.tank(),
            share: outcome.share,
            saturated: outcome.saturated.into(),
            held: outcome.held.into(),
            outside_bounds: outcome.outside_bounds.into(),
            engaged: outcome.engaged.into(),
            slowed: i32::from(*slowed),
            stiff_hand_detected: stiff_hand.detected.into(),
            ft_fault: ft.fault.map_or(0, Fault::number),
            ft_tare_state: ft.tare.number(),
            ft_tare_failure: ft.tare.failure().map_or(0, TareFailure::number),
            state: status.state.number(),
            diagnostic: status.diagnostic.number(),
            first_fault: status.first_fault.number(),
            debt: ledger.is_in_debt().into(),
        }
    }
}
