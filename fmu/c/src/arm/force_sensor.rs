//! The hand's force sensor: the parameters `ft.*`.

use crate::Real;
use crate::refusal::Bad;
use arm_law::wrench::tare::TareSettings;
use arm_law::wrench::validity::Checks;
use arm_law::wrench::{Frame, Mount, Sensor, Tool};

/// The hand's force sensor: what it is like and what is made of it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct ArmForceSensor {
    /// What is read: 1 the force f_h, 2 the wrench of a six-axis sensor.
    pub source: i32,
    /// Frame of f_h: 1 base, 2 sensor (link 3's).
    pub frame: i32,
    /// Samples without a change that are a fault; 0 = off.
    pub stuck_samples: i32,
    /// Samples of nothing but zeros that are a fault; 0 = off.
    pub dropout_samples: i32,
    /// Mounting of a six-axis sensor on link 3: roll, pitch, yaw, rad.
    pub mount: [Real; 3],
    /// The handle from the sensor's origin, sensor frame, m.
    pub handle: [Real; 3],
    /// Mass of the tool behind the sensor, kg.
    pub mass: Real,
    /// Its centre of gravity, sensor frame, m.
    pub cog: [Real; 3],
    /// Gravity, base frame, m/s².
    pub gravity: [Real; 3],
    /// Width of the deadband, N; 0 = off.
    pub deadband: Real,
    /// Corner frequency of the low pass, Hz; 0 = off.
    pub cutoff: Real,
    /// Largest force that the sensor can read, N; 0 = not checked.
    pub range_force: Real,
    /// Largest moment that it can read, N·m; 0 = not checked.
    pub range_torque: Real,
    /// Largest rate of change of a force, N/s; 0 = not checked.
    pub rate_force: Real,
    /// Largest rate of change of a moment, N·m/s; 0 = not checked.
    pub rate_torque: Real,
    /// Time without a fault after which it is trusted again, s.
    pub recovery_time: Real,
    /// Time that a tare takes, s.
    pub tare_time: Real,
    /// Largest motion of a joint during a tare, rad.
    pub tare_motion: Real,
    /// Largest spread of a force during a tare, N.
    pub tare_spread_force: Real,
    /// Largest spread of a moment during a tare, N·m.
    pub tare_spread_torque: Real,
    /// Largest force that a tare takes for a bias, N.
    pub tare_max_force: Real,
    /// Largest moment that a tare takes for a bias, N·m.
    pub tare_max_torque: Real,
}

/// What is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Source {
    /// A force.
    Force,
    /// Force and moment.
    Wrench,
}

impl Default for ArmForceSensor {
    /// A force in the base frame, as it is.
    fn default() -> Self {
        let Sensor {
            tool,
            handle,
            checks,
            tare,
            cutoff,
            deadband,
        } = Sensor::default();
        Self {
            source: 1,
            frame: 1,
            stuck_samples: 0,
            dropout_samples: 0,
            mount: Mount::default().rpy.into(),
            handle: handle.into(),
            mass: tool.mass,
            cog: tool.cog.into(),
            gravity: tool.gravity.into(),
            deadband,
            cutoff,
            range_force: checks.range_force,
            range_torque: checks.range_torque,
            rate_force: checks.rate_force,
            rate_torque: checks.rate_torque,
            recovery_time: checks.recovery_time,
            tare_time: tare.time,
            tare_motion: tare.motion,
            tare_spread_force: tare.spread_force,
            tare_spread_torque: tare.spread_torque,
            tare_max_force: tare.max_force,
            tare_max_torque: tare.max_torque,
        }
    }
}

impl ArmForceSensor {
    /// What is read.
    pub(crate) fn source(&self) -> Result<Source, Bad> {
        match self.source {
            1 => Ok(Source::Force),
            2 => Ok(Source::Wrench),
            other => Err(Bad::choice("ft.source", other, "1 (f_h), 2 (wrench)")),
        }
    }

    /// Whose axes the reading is along.
    pub(crate) fn sensed_in(&self) -> Result<Frame, Bad> {
        match (self.source()?, self.frame) {
            (Source::Force, 1) => Ok(Frame::Base),
            (Source::Force, 2) => Ok(Frame::Link3),
            (Source::Wrench, 1 | 2) => Ok(Frame::Mounted(Mount {
                rpy: self.mount.into(),
            })),
            (_, other) => Err(Bad::choice("ft.frame", other, "1 (base), 2 (sensor)")),
        }
    }

    /// What is made of it.
    pub(crate) fn sensor(&self) -> Result<Sensor, Bad> {
        Ok(Sensor {
            tool: Tool {
                mass: self.mass,
                cog: self.cog.into(),
                gravity: self.gravity.into(),
            },
            handle: self.handle.into(),
            checks: Checks {
                range_force: self.range_force,
                range_torque: self.range_torque,
                rate_force: self.rate_force,
                rate_torque: self.rate_torque,
                stuck_samples: samples("ft.stuck_samples", self.stuck_samples)?,
                dropout_samples: samples("ft.dropout_samples", self.dropout_samples)?,
                recovery_time: self.recovery_time,
            },
            tare: TareSettings {
                time: self.tare_time,
                motion: self.tare_motion,
                spread_force: self.tare_spread_force,
                spread_torque: self.tare_spread_torque,
                max_force: self.tare_max_force,
                max_torque: self.tare_max_torque,
            },
            cutoff: self.cutoff,
            deadband: self.deadband,
        })
    }
}

fn samples(name: &'static str, n: i32) -> Result<u32, Bad> {
    u32::try_from(n).map_err(|_| Bad::choice(name, n, "0 or more"))
}
