//! What an arm's law is built from, and the start values.

use super::force_sensor::ArmForceSensor;
use super::joint::{ArmJoint, ArmJointGains, ArmNominal};
use super::supervision::ArmSupervision;
use crate::Real;
use crate::gains::{ArmGains, bounds, limited_under, or_none};
use crate::refusal::{Bad, truth};
use admittance::hand::StiffHand;
use admittance::{Law, ParameterError, Reach, Settings};
use arm_law::arm_law::{Parameters, Space};
use arm_law::joint_space::JointParameters;
use arm_law::limits::{Limits, TorqueLimiting};
use nalgebra::Vector3;

/// The lengths that place the handle, m.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct ArmKinematics {
    /// From the yaw axis forward to the shoulder's pitch axis.
    pub A1: Real,
    /// From the shoulder's pitch axis to the elbow's.
    pub L1: Real,
    /// Handle in link 3's frame: from the elbow's axis along the link.
    pub handle_x: Real,
    /// Handle in link 3's frame: across the link, upwards when it is level.
    pub handle_z: Real,
}

/// Slowing before a singularity.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct ArmSingularity {
    /// sigma_min below which the nominal is damped more, m/rad; 0 = off.
    pub sigma_slow: Real,
    /// What scales the damping, N·s/m.
    pub D: Real,
}

/// Damping for a hand too stiff for the gains.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct ArmStiffHand {
    /// Whether anybody watches.
    pub active: i32,
    /// Damping that comes on top of D_n, N·s/m.
    pub D_max: Real,
    /// Lower edge of the band, Hz.
    pub f_low: Real,
    /// Upper edge of the band, Hz.
    pub f_high: Real,
    /// Amplitude of f_h in the band from which on a swing counts, N.
    pub f_min: Real,
    /// Factor by which a half swing has to be stronger than the one a period before, > 1.
    pub growth: Real,
    /// Time in which D goes from 0 to D_max, s.
    pub attack: Real,
    /// Time without a swing after which the damping is given back, s.
    pub quiet: Real,
    /// Time in which D goes from D_max to 0, s.
    pub release: Real,
}

/// Parameters of the arm's law. Vectors are along x, y, z of the base frame, or by joint.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct ArmParameters {
    /// 1 standard, 2 passive, 3 passive_applied, 4 passive_bounded.
    pub law: i32,
    /// 0 or 1: samples after which the torques reach the robot.
    pub delay: i32,
    /// Torques beyond tau_max: 1 scale all by one factor, 2 clip each; clip under `standard` and `passive` only.
    pub torque_limiting: i32,
    /// Whether the nominal keeps to p_n_min … p_n_max.
    pub p_n_box: i32,
    /// The gains to begin with.
    pub gains: ArmGains,
    /// Damper of the reaction on the nominal, N·s/m, ≥ 0; 1 is the paper.
    pub alpha: Real,
    /// Sample period, s.
    pub T: Real,
    /// Largest torque of each joint, N·m, > 0.
    pub tau_max: [Real; 3],
    /// Largest rate of change of each joint's torque, N·m/s; 0 = no limit.
    pub tau_rate_max: [Real; 3],
    /// Largest speed of each joint for which passivity is promised, rad/s.
    pub dq_max: [Real; 3],
    /// Largest acceleration of each joint for which passivity is promised, rad/s².
    pub ddq_max: [Real; 3],
    /// Corner frequency of a low pass on the velocity, Hz; 0 = off.
    pub dp_cutoff: Real,
    /// Energy with which the tank starts and above which it does not fill, J.
    pub E_0: Real,
    /// Time that changed gains take to come into force, s.
    pub tuning_time: Real,
    /// Largest speed of the nominal along each axis, m/s; 0 = no limit.
    pub dp_n_max: [Real; 3],
    /// Least position of the nominal, base frame, m.
    pub p_n_min: [Real; 3],
    /// Largest position of the nominal, base frame, m.
    pub p_n_max: [Real; 3],
    /// Where the handle is.
    pub kinematics: ArmKinematics,
    /// Slowing before a singularity.
    pub singularity: ArmSingularity,
    /// Damping for a hand too stiff for the gains.
    pub stiff_hand: ArmStiffHand,
    /// The hand's force sensor.
    pub ft: ArmForceSensor,
    /// When the law may act.
    pub supervision: ArmSupervision,
    /// The nominal: 1 task (a mass at the handle), 2 joint (a light arm).
    pub space: i32,
    /// Gains of the joint-space form to begin with.
    pub joint_gains: ArmJointGains,
    /// Its limits.
    pub joint: ArmJoint,
    /// Its nominal arm.
    pub nominal: ArmNominal,
}

impl Default for ArmParameters {
    /// The start values of ArmController.fmu.
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
        let kinematics = arm_law::kinematics::Kinematics::default();
        let stiff_hand = StiffHand::default();
        let singularity = arm_law::singularity::Singularity::default();
        Self {
            law: law.number(),
            delay: delayed.into(),
            torque_limiting: TorqueLimiting::Scale as i32,
            p_n_box: 0,
            gains: ArmGains::default(),
            alpha,
            T: 0.001,
            tau_max: [153.0, 259.0, 153.0],
            tau_rate_max: [0.0; 3],
            dq_max: [6.0; 3],
            ddq_max: [3e3; 3],
            dp_cutoff: dq_cutoff,
            E_0,
            tuning_time,
            dp_n_max: [0.0; 3],
            p_n_min: [-1.0; 3],
            p_n_max: [1.0; 3],
            kinematics: ArmKinematics {
                A1: kinematics.A1,
                L1: kinematics.L1,
                handle_x: kinematics.handle_x,
                handle_z: kinematics.handle_z,
            },
            singularity: ArmSingularity {
                sigma_slow: singularity.sigma_slow,
                D: singularity.D,
            },
            stiff_hand: ArmStiffHand {
                active: stiff_hand.active.into(),
                D_max: stiff_hand.D_max,
                f_low: stiff_hand.f_low,
                f_high: stiff_hand.f_high,
                f_min: stiff_hand.f_min,
                growth: stiff_hand.growth,
                attack: stiff_hand.attack,
                quiet: stiff_hand.quiet,
                release: stiff_hand.release,
            },
            ft: ArmForceSensor::default(),
            supervision: ArmSupervision::default(),
            space: 1,
            joint_gains: ArmJointGains::default(),
            joint: ArmJoint::default(),
            nominal: ArmNominal::default(),
        }
    }
}

/// A name of the law under its name in this interface.
fn renamed(name: &'static str) -> &'static str {
    match name {
        "v_max" => "dq_max",
        "a_max" => "ddq_max",
        "speed_max" => "dp_n_max",
        "q_min" => "p_n_min",
        "q_max" => "p_n_max",
        "M_n" => "Lambda_n",
        "E_0" => "energy.E_0",
        "dq_cutoff" => "dp_cutoff",
        other => other,
    }
}

/// A parameter error of the law under the names of this interface.
pub(crate) fn bad(error: ParameterError) -> Bad {
    Bad::from_law(error, renamed)
}

impl ArmParameters {
    fn settings(&self) -> Result<Settings, Bad> {
        Ok(Settings {
            law: Law::try_from(self.law).map_err(bad)?,
            alpha: self.alpha,
            T: self.T,
            delayed: truth("delay", self.delay)?,
            dq_cutoff: self.dp_cutoff,
            E_0: self.E_0,
            tuning_time: self.tuning_time,
        })
    }

    fn limiting(&self) -> Result<TorqueLimiting, Bad> {
        TorqueLimiting::from_number(self.torque_limiting).ok_or(Bad::choice(
            "torque_limiting",
            self.torque_limiting,
            "1 (scale), 2 (clip)",
        ))
    }

    /// The law's parameters.
    pub(crate) fn of_law(&self) -> Result<Parameters, Bad> {
        let settings = self.settings()?;
        if !settings.law.row().offered {
            return Err(Bad::choice("law", self.law, Law::OFFERED));
        }
        let is_boxed = truth("p_n_box", self.p_n_box)?;
        let within = |speed, (low, high)| bounds(speed, is_boxed.then_some((low, high)));
        let edges =
            Vector3::from(self.p_n_min).zip_map(&self.p_n_max.into(), |low, high| (low, high));
        Ok(Parameters {
            settings,
            gains: self
                .gains
                .of_law()
                .map(|gains| limited_under(settings.law, gains)),
            bounds: Vector3::from(self.dp_n_max).zip_map(&edges, within).into(),
            reach: Reach {
                v_max: self.dq_max.into(),
                a_max: self.ddq_max.into(),
            },
            kinematics: arm_law::kinematics::Kinematics {
                A1: self.kinematics.A1,
                L1: self.kinematics.L1,
                handle_x: self.kinematics.handle_x,
                handle_z: self.kinematics.handle_z,
            },
            limits: Limits {
                tau_max: self.tau_max.into(),
                tau_rate: self.tau_rate_max.map(or_none).into(),
                limiting: self.limiting()?,
            },
            singularity: arm_law::singularity::Singularity {
                sigma_slow: self.singularity.sigma_slow,
                D: self.singularity.D,
            },
            stiff_hand: StiffHand {
                active: truth("stiff_hand.active", self.stiff_hand.active)?,
                D_max: self.stiff_hand.D_max,
                f_low: self.stiff_hand.f_low,
                f_high: self.stiff_hand.f_high,
                f_min: self.stiff_hand.f_min,
                growth: self.stiff_hand.growth,
                attack: self.stiff_hand.attack,
                quiet: self.stiff_hand.quiet,
                release: self.stiff_hand.release,
            },
            frame: self.ft.sensed_in()?,
            sensor: self.ft.sensor()?,
            supervision: self.supervision.of_law()?,
            space: match self.space {
                1 => Space::Task,
                2 => Space::Joint,
                other => return Err(Bad::choice("space", other, "1 (task), 2 (joint)")),
            },
            joint: JointParameters {
                arm: self.nominal.of_law(),
                gains: self.joint_gains.of_law(&self.tau_max),
                bounds: self.joint.of_law()?,
            },
        })
    }
}
