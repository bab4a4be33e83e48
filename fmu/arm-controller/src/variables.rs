//! The variables and their start values.

use crate::force_sensor::ForceSensor;
use crate::joint::{Joint, Nominal};
use admittance::Settings;
use admittance::hand::StiffHand;
use arm_law::ArmLaw;
use arm_law::arm_law::Signals;
use arm_law::kinematics::Kinematics;
use arm_law::limits::TorqueLimiting;
use arm_law::singularity::Singularity;
use arm_law::supervision;
use export::Ticks;
use serde::{Deserialize, Serialize};

/// The controller. What each variable is, with unit, sign and frame, stands in its row ([`rows`](crate::rows)).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "a variable is described once, in its row")]
pub struct ArmController {
    pub q: [f64; 3],
    pub f_h: [f64; 3],
    pub engage: bool,

    pub tau_a: [f64; 3],
    pub p: [f64; 3],
    pub p_n: [f64; 3],
    pub dp_n: [f64; 3],
    pub e_nr: [f64; 3],
    pub f_a: [f64; 3],
    pub saturated: bool,
    pub sigma_min: f64,
    pub tick: i32,
    pub energy: Energy,
    pub dp: [f64; 3],
    pub tau_demand: [f64; 3],
    pub engaged: bool,
    pub outside_bounds: bool,
    pub slowed: bool,

    pub law: i32,
    pub Lambda_n: [f64; 3],
    pub D_n: [f64; 3],
    pub K: [f64; 3],
    pub K_P: [f64; 3],
    pub alpha: f64,
    pub f_max: [f64; 3],
    pub tau_max: [f64; 3],
    pub torque_limiting: i32,
    pub T: f64,
    pub delay: i32,
    pub dq_max: [f64; 3],
    pub ddq_max: [f64; 3],
    pub dp_cutoff: f64,
    pub kinematics: Kinematics,
    pub ft: ForceSensor,
    pub singularity: Singularity,

    pub M_min: f64,
    pub gain_warning: i32,
    pub hold: bool,
    pub held: bool,
    pub tuning_time: f64,
    pub dp_n_max: [f64; 3],
    pub p_n_box: bool,
    pub p_n_min: [f64; 3],
    pub p_n_max: [f64; 3],
    pub tau_rate_max: [f64; 3],

    pub stiff_hand: StiffHand,
    pub stiff_hand_seen: StiffHandSeen,
    pub enable: bool,
    pub acknowledge: bool,
    pub emergency_stop: bool,
    pub heartbeat: i32,
    pub ft_valid: bool,
    pub encoder_valid: bool,
    pub state: i32,
    pub diagnostic: i32,
    pub first_fault: i32,
    pub authority: f64,
    pub supervision: bool,
    pub init_time: f64,
    pub engage_time: f64,
    pub soft_stop_time: f64,
    pub heartbeat_timeout: f64,
    pub hold_enter: f64,
    pub hold_leave: f64,
    pub hold_time: f64,
    pub hold_brake: f64,
    pub saturation_time: f64,

    pub space: i32,
    pub joint: Joint,
    pub nominal: Nominal,
    pub M_n: [f64; 9],
    pub q_n: [f64; 3],
    pub dq_n: [f64; 3],
    pub e_q: [f64; 3],

    pub(crate) ticks: Ticks,
    pub(crate) arm_law: Option<ArmLaw>,
}

/// The variables `energy.*`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "a variable is described once, in its row")]
pub struct Energy {
    pub H: f64,
    pub G: f64,
    pub tank: f64,
    pub E_0: f64,
    pub share: f64,
    pub debt: bool,
}

/// The outputs `stiff_hand.*`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "a variable is described once, in its row")]
pub struct StiffHandSeen {
    pub detected: bool,
    pub D: [f64; 3],
    pub k_h: [f64; 3],
}

/// `space`: the nominal is a mass at the handle.
pub(crate) const TASK: i32 = 1;
/// `space`: the nominal is an arm.
pub(crate) const JOINT: i32 = 2;

impl Default for ArmController {
    fn default() -> Self {
        let Settings {
            law,
            alpha,
            delayed,
            dq_cutoff,
            E_0,
            tuning_time,
            ..
        } = Settings::default();
        let Signals {
            enable,
            acknowledge,
            emergency_stop,
            heartbeat,
            encoder_valid,
        } = Signals::default();
        let supervision::Parameters {
            init_time,
            engage_time,
            soft_stop_time,
            heartbeat_timeout,
            hold_enter,
            hold_leave,
            hold_time,
            hold_brake,
            saturation_time,
        } = supervision::Parameters::default();
        Self {
            q: [0.0, -1.48096, 1.70138],
            f_h: [0.0; 3],
            engage: true,
            tau_a: [0.0; 3],
            p: [0.0; 3],
            p_n: [0.0; 3],
            dp_n: [0.0; 3],
            e_nr: [0.0; 3],
            f_a: [0.0; 3],
            saturated: false,
            sigma_min: 0.0,
            tick: -1,
            energy: Energy {
                H: 0.0,
                G: 0.0,
                tank: E_0,
                E_0,
                share: 1.0,
                debt: false,
            },
            dp: [0.0; 3],
            tau_demand: [0.0; 3],
            engaged: false,
            outside_bounds: false,
            slowed: false,
            law: law.number(),
            Lambda_n: [5.0; 3],
            D_n: [20.0; 3],
            K: [1000.0; 3],
            K_P: [20.0; 3],
            alpha,
            f_max: [400.0; 3],
            tau_max: [153.0, 259.0, 153.0],
            torque_limiting: TorqueLimiting::Scale as i32,
            T: 0.001,
            delay: i32::from(delayed),
            dq_max: [6.0; 3],
            ddq_max: [3e3; 3],
            dp_cutoff: dq_cutoff,
            kinematics: Kinematics::default(),
            ft: ForceSensor::default(),
            singularity: Singularity::default(),
            M_min: 14.0,
            gain_warning: 0,
            hold: false,
            held: false,
            tuning_time,
            dp_n_max: [0.0; 3],
            p_n_box: false,
            p_n_min: [-1.0; 3],
            p_n_max: [1.0; 3],
            tau_rate_max: [0.0; 3],
            stiff_hand: StiffHand::default(),
            stiff_hand_seen: StiffHandSeen::default(),
            enable,
            acknowledge,
            emergency_stop,
            heartbeat,
            ft_valid: true,
            encoder_valid,
            state: 0,
            diagnostic: 0,
            first_fault: 0,
            authority: 0.0,
            supervision: false,
            init_time,
            engage_time,
            soft_stop_time,
            heartbeat_timeout,
            hold_enter,
            hold_leave,
            hold_time,
            hold_brake,
            saturation_time,
            space: TASK,
            joint: Joint::default(),
            nominal: Nominal::default(),
            M_n: [0.0; 9],
            q_n: [0.0; 3],
            dq_n: [0.0; 3],
            e_q: [0.0; 3],
            ticks: Ticks::default(),
            arm_law: None,
        }
    }
}
