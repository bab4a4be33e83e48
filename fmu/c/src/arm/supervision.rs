//! Supervision: its parameters, and what it is told at a tick.

use crate::Real;
use crate::refusal::{Bad, truth};
use arm_law::arm_law::Signals;
use arm_law::supervision::Parameters;

/// Times and thresholds of the supervision.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct ArmSupervision {
    /// Whether there is any; without it `engage` and `hold` alone decide.
    pub supervision: i32,
    /// For how long sensors and heartbeat must have been good before the controller is ready, s.
    pub init_time: Real,
    /// Duration over which the authority rises from 0 to 1, s.
    pub engage_time: Real,
    /// Duration over which it falls to 0, s.
    pub soft_stop_time: Real,
    /// Time within which the heartbeat must change, s; 0 = it is not watched.
    pub heartbeat_timeout: Real,
    /// Magnitude of f_h below which the hand is at rest, N; 0 = the controller never holds by itself.
    pub hold_enter: Real,
    /// Magnitude of f_h above which it no longer is, N.
    pub hold_leave: Real,
    /// For how long f_h must have been below hold_enter, s.
    pub hold_time: Real,
    /// Duration over which a moving nominal is brought to rest, s.
    pub hold_brake: Real,
    /// For how long limits may act before they are reported, s; 0 = they are not.
    pub saturation_time: Real,
}

/// What supervision is told at a tick; without it nobody listens.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct ArmSignals {
    /// Whether the controller may run at all.
    pub enable: i32,
    /// Its rising edge acknowledges a fault.
    pub acknowledge: i32,
    /// Whether the emergency stop is pressed.
    pub emergency_stop: i32,
    /// A counter that changes as long as its sender lives.
    pub heartbeat: i32,
    /// Whether the joint angles can be trusted.
    pub encoder_valid: i32,
}

impl Default for ArmSupervision {
    /// None.
    fn default() -> Self {
        let Parameters {
            init_time,
            engage_time,
            soft_stop_time,
            heartbeat_timeout,
            hold_enter,
            hold_leave,
            hold_time,
            hold_brake,
            saturation_time,
        } = Parameters::default();
        Self {
            supervision: 0,
            init_time,
            engage_time,
            soft_stop_time,
            heartbeat_timeout,
            hold_enter,
            hold_leave,
            hold_time,
            hold_brake,
            saturation_time,
        }
    }
}

impl ArmSupervision {
    /// The law's parameters.
    pub(crate) fn of_law(&self) -> Result<Option<Parameters>, Bad> {
        Ok(
            truth("supervision", self.supervision)?.then_some(Parameters {
                init_time: self.init_time,
                engage_time: self.engage_time,
                soft_stop_time: self.soft_stop_time,
                heartbeat_timeout: self.heartbeat_timeout,
                hold_enter: self.hold_enter,
                hold_leave: self.hold_leave,
                hold_time: self.hold_time,
                hold_brake: self.hold_brake,
                saturation_time: self.saturation_time,
            }),
        )
    }
}

impl Default for ArmSignals {
    /// Not enabled, with good sensors: the FMU's start values.
    fn default() -> Self {
        Self {
            enable: 0,
            acknowledge: 0,
            emergency_stop: 0,
            heartbeat: 0,
            encoder_valid: 1,
        }
    }
}

impl ArmSignals {
    /// What the law is told.
    pub(crate) fn of_law(&self) -> Result<Signals, Bad> {
        Ok(Signals {
            enable: truth("enable", self.enable)?,
            acknowledge: truth("acknowledge", self.acknowledge)?,
            emergency_stop: truth("emergency_stop", self.emergency_stop)?,
            heartbeat: self.heartbeat,
            encoder_valid: truth("encoder_valid", self.encoder_valid)?,
        })
    }
}
