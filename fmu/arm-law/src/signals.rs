//! What goes into a tick of the arm's law and what comes out of it: inputs and outputs of ArmController.fmu and of the C
//! library, one row each.

use crate::choices::{
    DIAGNOSTIC, DRIVE_FAULT, ENCODER_FAULT, FAULT, STATE, TARE_FAILURE, TARE_STATE,
};
use admittance::Real;
use admittance::timing::TIMING;
use fmu_declaration::{Rows, Start};

/// What is sensed and asked for at a tick.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
#[rows(discrete)]
pub struct ArmInputs {
    /// Sensed joint angles: yaw about z, shoulder pitch and elbow pitch about -y, so that positive pitch lifts.
    #[input(0, unit = RADIAN, start = [0.0, -1.48096, 1.70138])]
    pub q: [f64; 3],
    /// Sensed force of the human on the handle, in the frame that ft.frame says, under ft.source 1. It may be NaN,
    /// which ft.fault names.
    #[input(1, unit = NEWTON, nan)]
    pub f_h: [Real; 3],
    /// Whether the controller is in the loop. It engages at the first tick at which this is true, with p_n = p and dp_n
    /// = 0; while it is false tau_a is 0.
    #[input(2, boolean, start = 1)]
    pub engage: i32,
    /// Whether the nominal stays where it is: the coupling then carries any load within f_max without drift.
    #[input(44, boolean)]
    pub hold: i32,
    /// Raw force that acts on the sensor's tool, in the sensor's frame, under ft.source 2. It may be NaN, which
    /// ft.fault names.
    #[input(66, name = "ft.force[i]", unit = NEWTON, nan)]
    pub ft_force: [Real; 3],
    /// Raw moment that acts on the sensor's tool about the sensor's origin, in the sensor's frame, under ft.source 2.
    /// It may be NaN, which ft.fault names.
    #[input(67, name = "ft.torque[i]", unit = NEWTON_METRE, nan)]
    pub ft_torque: [Real; 3],
    /// Request for a tare: its change to true starts one, with nobody touching the handle and the arm at rest.
    #[input(68, name = "ft.tare", boolean)]
    pub ft_tare: i32,
    /// Whether the controller may run at all; only with supervision.
    #[input(97, boolean)]
    pub enable: i32,
    /// Its rising edge acknowledges a fault whose cause is gone; only with supervision.
    #[input(98, boolean)]
    pub acknowledge: i32,
    /// Whether the emergency stop is pressed: no torque, at once; only with supervision.
    #[input(99, boolean)]
    pub emergency_stop: i32,
    /// A counter that must change within heartbeat_timeout, by whatever step; only with supervision.
    #[input(100)]
    pub heartbeat: i32,
    /// The sensor's own word on the force; if false the law sees no force (ft.fault) and, with supervision, stops
    /// softly.
    #[input(101, boolean, start = 1)]
    pub ft_valid: i32,
    /// The encoders' own word on q; if false there is no torque, at once: with supervision until the fault is
    /// acknowledged, without it until q is valid again, where the law engages anew.
    #[input(102, boolean, start = 1)]
    pub encoder_valid: i32,
    /// Measured torques of the drives on the joints, means over the sample that ended; the nominal feels them in the servo form,
    /// they are not used in the torque form.
    #[input(152, unit = NEWTON_METRE)]
    pub tau_a_measured: [Real; 3],
}

/// What came of a tick; every value is the one at t_k, vectors at the handle in the base frame.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
#[rows(discrete)]
pub struct ArmOutputs {
    /// Control torques on the joints, positive like q, held until the next tick (J' f_a, limited).
    #[output(3, unit = NEWTON_METRE)]
    pub tau_a: [Real; 3],
    /// Position of the handle by the controller's kinematics; base frame.
    #[output(4, unit = METRE, from = WHERE)]
    pub p: [Real; 3],
    /// Nominal position of the handle (eq:obs_dyn); base frame.
    #[output(5, unit = METRE, from = WHERE)]
    pub p_n: [Real; 3],
    /// Nominal velocity of the handle (eq:obs_dyn); base frame.
    #[output(6, unit = METRE_PER_SECOND)]
    pub dp_n: [Real; 3],
    /// Position error p_n - p, after the slip of passive_bounded; base frame.
    #[output(7, unit = METRE)]
    pub e_nr: [Real; 3],
    /// Force on the robot at the handle that tau_a amounts to (eq:dob_input, limited); base frame.
    #[output(8, unit = NEWTON)]
    pub f_a: [Real; 3],
    /// Whether f_max (under passive_bounded) or tau_max leaves less than tau_demand.
    #[output(9, boolean)]
    pub saturated: i32,
    /// Smallest singular value of the handle's Jacobian; 0 at a singularity.
    #[output(10, unit = METRE_PER_RADIAN, from = WHERE)]
    pub sigma_min: Real,
    /// Energy stored in nominal mass and coupling spring; 0 if alpha = 0, for which it is not defined.
    #[output(12, name = "energy.H", unit = JOULE)]
    pub H: Real,
    /// Energy that the sampled law has created so far, counted with the work of tau_a at the joints; negative:
    /// dissipated; 0 if alpha = 0.
    #[output(13, name = "energy.G", unit = JOULE)]
    pub G: Real,
    /// Energy tank: energy.E_0 less what was created, refilled by dissipation up to energy.E_0; 0 if alpha = 0.
    #[output(14, name = "energy.tank", unit = JOULE, from = ["energy.E_0", "alpha"], start = 10.0)]
    pub tank: Real,
    /// Velocity of the handle as the law uses it: backward difference of p, 0 at the first tick; base frame.
    #[output(15, unit = METRE_PER_SECOND)]
    pub dp: [Real; 3],
    /// Joint torques J' K y before any limit (eq:dob_input).
    #[output(16, unit = NEWTON_METRE)]
    pub tau_demand: [Real; 3],
    /// Whether the controller was in the loop at this tick.
    #[output(17, boolean)]
    pub engaged: i32,
    /// Whether the joints' motion since the last tick exceeded dq_max or ddq_max, to which the passivity argument is
    /// restricted, or is not known because q is doubted.
    #[output(18, boolean)]
    pub outside_bounds: i32,
    /// Whether sigma_min lies below singularity.sigma_slow, so that the nominal is damped more.
    #[output(19, boolean)]
    pub slowed: i32,
    /// Whether hold, dp_n_max, the position box or the workspace kept the nominal back at this tick.
    #[output(45, boolean)]
    pub held: i32,
    /// Share of the torques that the energy budget left at this tick; 1 unless something is wrong.
    #[output(46, name = "energy.share", start = 1.0)]
    pub share: Real,
    /// Whether the tank is below 0: a motion beyond dq_max and ddq_max cost more than it held; no torque until it is
    /// repaid.
    #[output(47, name = "energy.debt", boolean)]
    pub debt: i32,
    /// Whether on any axis a stiff hand has been found to swing, or makes a swing grow so fast that it is damped before, and
    /// has not been quiet since.
    #[output(63, name = "stiff_hand.detected", boolean)]
    pub stiff_hand_detected: i32,
    /// Damping on top of D_n for a stiff hand, and to probe whether a swing is meant; base frame.
    #[output(64, name = "stiff_hand.D[i]", unit = NEWTON_SECOND_PER_METRE)]
    pub stiff_hand_D: [Real; 3],
    /// Stiffness of the hand in the last swing that counted, meant or not, 0 before the first; base frame.
    #[output(65, name = "stiff_hand.k_h[i]", unit = NEWTON_PER_METRE)]
    pub stiff_hand_k_h: [Real; 3],
    /// Force of the human on the handle as the law uses it, 0 during a fault or a tare; base frame.
    #[output(69, name = "ft.f_h[i]", unit = NEWTON)]
    pub ft_f_h: [Real; 3],
    /// Moment of the human about the handle under ft.source 2, for information: the law moves a point; base frame.
    #[output(70, name = "ft.moment[i]", unit = NEWTON_METRE)]
    pub ft_moment: [Real; 3],
    /// What is wrong with the force sensor.
    #[output(71, name = "ft.fault", items = FAULT)]
    pub ft_fault: i32,
    /// How far the last tare has come.
    #[output(72, name = "ft.tare_state", items = TARE_STATE)]
    pub ft_tare_state: i32,
    /// Why the last tare failed.
    #[output(73, name = "ft.tare_failure", items = TARE_FAILURE)]
    pub ft_tare_failure: i32,
    /// Force that the sensor shows when nothing acts on it, from the last tare that was done; sensor frame.
    #[output(74, name = "ft.bias_force[i]", unit = NEWTON)]
    pub ft_bias_force: [Real; 3],
    /// Moment that the sensor shows when nothing acts on it, from the last tare that was done; sensor frame.
    #[output(75, name = "ft.bias_torque[i]", unit = NEWTON_METRE)]
    pub ft_bias_torque: [Real; 3],
    /// State of the supervision; without it off, engaged, hold or debt, as engage and hold say and the tank allows.
    #[output(103, items = STATE)]
    pub state: i32,
    /// Why the law does not simply run at this tick; always 0 without supervision.
    #[output(104, items = DIAGNOSTIC)]
    pub diagnostic: i32,
    /// The first fault, kept until it is acknowledged; 0 if there is none.
    #[output(105, items = DIAGNOSTIC)]
    pub first_fault: i32,
    /// Share of its force that the law exerts; it rises from 0 when the controller engages and falls in a soft stop.
    #[output(106)]
    pub authority: Real,
    /// Nominal mass matrix M_n(q), row by row; 0 in task space.
    #[output(133, unit = KILOGRAM_SQUARE_METRE, from = NOMINAL)]
    pub M_n: [Real; 9],
    /// Nominal joint angles (eq:obs_dyn); q in task space.
    #[output(134, unit = RADIAN, from = ["q[i]"])]
    pub q_n: [Real; 3],
    /// Nominal joint velocities (eq:obs_dyn); 0 in task space.
    #[output(135, unit = RADIAN_PER_SECOND)]
    pub dq_n: [Real; 3],
    /// Position error q_n - q of the joints, after the slip of passive_bounded; 0 in task space.
    #[output(136, unit = RADIAN)]
    pub e_q: [Real; 3],
    /// What is wrong with the joint angles of this tick. A jump, or an angle over range, is doubted for encoder.samples
    /// readings: the law goes on at its last velocity. Then there is no torque.
    #[output(137, name = "encoder.fault", items = ENCODER_FAULT, from = ["q[i]", "encoder_valid", "encoder.range[i]"])]
    pub encoder_fault: i32,
    /// Whether the tick came in time after the one before.
    #[output(141, items = TIMING)]
    pub timing: i32,
    /// Way of the nominal's handle since somebody last varied the force of the hand; 0 unless drift_distance is set, under
    /// supervision.
    #[output(195, unit = METRE)]
    pub unattended: Real,
    /// By how much the tool is heavier than ft.mass, as far as the last warning tool_weight could tell; 0 before the first.
    #[output(196, name = "ft.mass_error", unit = KILOGRAM)]
    pub ft_mass_error: Real,
    /// What is wrong with tau_a_measured, beside the torques that drives with the law's gains would have given: judged where
    /// one has been above a tenth of tau_max over .2 s; 0 in the torque form.
    #[output(150, name = "drive.fault", items = DRIVE_FAULT)]
    pub drive_fault: i32,
    /// Angles for the joints' drives in the sample that begins, held: the nominal's in the middle of that sample; 0 in the
    /// torque form.
    #[output(153, unit = RADIAN, from = ["q[i]", "form"])]
    pub q_d: [f64; 3],
    /// Velocities for the joints' drives in the sample that begins: the nominal's means in that sample; 0 in the torque form.
    #[output(154, unit = RADIAN_PER_SECOND)]
    pub dq_d: [Real; 3],
}

/// What the outputs that show the handle depend on after initialization.
const WHERE: &[&str] = &[
    "q[i]",
    "kinematics.A1",
    "kinematics.L1",
    "kinematics.handle_x",
    "kinematics.handle_z",
];

/// What M_n depends on after initialization.
const NOMINAL: &[&str] = &[
    "q[i]",
    "space",
    "kinematics.A1",
    "kinematics.L1",
    "nominal.m[i]",
    "nominal.x[i]",
    "nominal.z[i]",
    "nominal.I_xx[i]",
    "nominal.I_yy[i]",
    "nominal.I_zz[i]",
    "nominal.I_xz[i]",
    "nominal.rotor[i]",
];
