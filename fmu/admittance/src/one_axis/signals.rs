//! What goes into a tick of the law of one axis and what comes out of it: inputs and outputs of TestbedController.fmu and of the
//! C library, one row each.

use crate::Real;
use crate::encoder::FAULT;
use crate::servo;
use crate::timing::TIMING;
use fmu_declaration::{Rows, Start};

/// What is sensed and asked for at a tick.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
#[rows(discrete)]
pub struct AxisInputs {
    /// Sensed position of the robot; the wall lies on the positive side.
    #[input(0, unit = METRE)]
    pub q: f64,
    /// Sensed force of the human on the robot, positive along q.
    #[input(1, unit = NEWTON)]
    pub tau_h: Real,
    /// Whether the controller is in the loop. It engages at the first tick at which this is true, with q_n = q and dq_n
    /// = 0; while it is false tau_a is 0.
    #[input(2, boolean, start = 1)]
    pub engage: i32,
    /// Whether the nominal stays where it is: the coupling then carries any load within tau_max without drift; the laws
    /// 1 to 4 only.
    #[input(37, boolean)]
    pub hold: i32,
    /// The encoder's own word on q; if false there is no force, at once, until q is valid again, where the law engages
    /// anew; the laws 1 to 4 only.
    #[input(47, boolean, start = 1)]
    pub encoder_valid: i32,
    /// Measured force of the drive on the robot, mean over the sample that ended, positive along q; the nominal feels it in
    /// the servo form, it is not used in the torque form.
    #[input(31, unit = NEWTON)]
    pub tau_a_measured: Real,
}

/// What came of a tick; every value is the one at t_k.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
#[rows(discrete)]
pub struct AxisOutputs {
    /// Control force on the robot, positive along q, held until the next tick (eq:dob_input, limited).
    #[output(3, unit = NEWTON)]
    pub tau_a: Real,
    /// K*y before any limit (eq:dob_input).
    #[output(13, unit = NEWTON)]
    pub tau_demand: Real,
    /// Nominal position (eq:obs_dyn).
    #[output(4, unit = METRE, from = ["q"])]
    pub q_n: Real,
    /// Nominal velocity (eq:obs_dyn).
    #[output(5, unit = METRE_PER_SECOND)]
    pub dq_n: Real,
    /// Position error q_n - q, after the slip of passive_bounded.
    #[output(6, unit = METRE)]
    pub e_nr: Real,
    /// Velocity of the robot as the law uses it: backward difference of q, 0 at the first tick.
    #[output(12, unit = METRE_PER_SECOND)]
    pub dq: Real,
    /// Energy stored in nominal mass and coupling spring; 0 if alpha = 0, for which it is not defined.
    #[output(9, name = "energy.H", unit = JOULE)]
    pub H: Real,
    /// Energy that the sampled law has created so far, negative: dissipated; 0 if alpha = 0.
    #[output(10, name = "energy.G", unit = JOULE)]
    pub G: Real,
    /// Energy tank: energy.E_0 less what was created, refilled by dissipation up to energy.E_0; 0 if alpha = 0 and
    /// under the laws natural and sliding_mode, for which no energy is defined.
    #[output(11, name = "energy.tank", unit = JOULE, from = ["energy.E_0", "alpha", "law"], start = 10.0)]
    pub tank: Real,
    /// Share of the force that the energy budget left at this tick; 1 unless something is wrong.
    #[output(39, name = "energy.share", start = 1.0)]
    pub share: Real,
    /// Whether tau_max leaves less than tau_demand; in the servo form, whether tau_a_measured has reached tau_max or the
    /// spring the bound at which it slips.
    #[output(7, boolean)]
    pub saturated: i32,
    /// Whether hold, dq_n_max or the position box kept the nominal back at this tick.
    #[output(38, boolean)]
    pub held: i32,
    /// Whether the motion since the last tick exceeded v_max or a_max, to which the passivity argument is restricted, or is
    /// not known because q is doubted.
    #[output(15, boolean)]
    pub outside_bounds: i32,
    /// Whether the controller was in the loop at this tick.
    #[output(14, boolean)]
    pub engaged: i32,
    /// Whether the tank is below 0: a motion beyond v_max and a_max cost more than it held; no force until it is
    /// repaid. In the servo form, where the tank follows what is measured, the drive is told to stand still until then.
    #[output(40, name = "energy.debt", boolean)]
    pub debt: i32,
    /// What is wrong with q at this tick. A jump, or a position over range, is doubted for encoder.samples readings: the
    /// law goes on at its last velocity. Then there is no force. 0 but for the laws 1 to 4.
    #[output(48, name = "encoder.fault", items = FAULT, from = ["q", "encoder_valid", "encoder.range"])]
    pub encoder_fault: i32,
    /// Whether the tick came in time after the one before.
    #[output(53, items = TIMING)]
    pub timing: i32,
    /// Position command for the sample that begins, held: the nominal's in the middle of that sample; q_n in the torque form.
    #[output(32, unit = METRE, from = ["q"])]
    pub q_d: f64,
    /// Velocity command for the sample that begins: the nominal's mean in that sample; dq_n in the torque form.
    #[output(33, unit = METRE_PER_SECOND)]
    pub dq_d: Real,
    /// What is wrong with tau_a_measured, beside the force that a drive with the law's gains would have given: judged where
    /// that has been above a tenth of tau_max over .2 s; 0 in the torque form.
    #[output(52, name = "drive.fault", items = servo::FAULT)]
    pub drive_fault: i32,
}
