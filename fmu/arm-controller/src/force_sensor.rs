//! The variables `ft.*`: the hand's force sensor, as [`arm_law::wrench`] conditions it.

use arm_law::wrench::tare::TareSettings;
use arm_law::wrench::validity::Checks;
use arm_law::wrench::{
    Conditioned, Fault, Frame, Mount, Sensor, TareFailure, TareState, Tool, Wrench,
};
use export::Refusal;
use serde::{Deserialize, Serialize};

/// The variables `ft.*`. What each is stands in its row ([`rows`](crate::rows)).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "a variable is described once, in its row")]
pub struct ForceSensor {
    pub frame: i32,

    pub force: [f64; 3],
    pub torque: [f64; 3],
    pub tare: bool,

    pub f_h: [f64; 3],
    pub moment: [f64; 3],
    pub fault: i32,
    pub tare_state: i32,
    pub tare_failure: i32,
    pub bias_force: [f64; 3],
    pub bias_torque: [f64; 3],

    pub source: i32,
    pub mount: [f64; 3],
    pub handle: [f64; 3],
    pub mass: f64,
    pub cog: [f64; 3],
    pub gravity: [f64; 3],
    pub deadband: f64,
    pub cutoff: f64,
    pub range_force: f64,
    pub range_torque: f64,
    pub rate_force: f64,
    pub rate_torque: f64,
    pub stuck_samples: i32,
    pub dropout_samples: i32,
    pub recovery_time: f64,
    pub tare_time: f64,
    pub tare_motion: f64,
    pub tare_spread_force: f64,
    pub tare_spread_torque: f64,
    pub tare_max_force: f64,
    pub tare_max_torque: f64,
}

/// `ft.source`: the force f_h, in the frame ft.frame.
const F_H: i32 = 1;
/// `ft.source`: the wrench ft.force, ft.torque in the sensor's frame, which ft.mount turns.
const WRENCH: i32 = 2;

impl Default for ForceSensor {
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
            frame: 1,
            force: [0.0; 3],
            torque: [0.0; 3],
            tare: false,
            f_h: [0.0; 3],
            moment: [0.0; 3],
            fault: 0,
            tare_state: 0,
            tare_failure: 0,
            bias_force: [0.0; 3],
            bias_torque: [0.0; 3],
            source: F_H,
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
            stuck_samples: 0,
            dropout_samples: 0,
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

impl ForceSensor {
    /// Whose axes the reading is along.
    ///
    /// # Errors
    /// A choice that there is not.
    pub(crate) fn sensed_in(&self) -> Result<Frame, Refusal> {
        match (self.source, self.frame) {
            (F_H, 1) => Ok(Frame::Base),
            (F_H, 2) => Ok(Frame::Link3),
            (WRENCH, 1 | 2) => Ok(Frame::Mounted(Mount {
                rpy: self.mount.into(),
            })),
            (F_H | WRENCH, frame) => Err(Refusal(format!(
                "ft.frame = {frame}: expected 1 (base), 2 (sensor)"
            ))),
            (source, _) => Err(Refusal(format!(
                "ft.source = {source}: expected 1 (f_h), 2 (wrench)"
            ))),
        }
    }

    /// What is made of it.
    ///
    /// # Errors
    /// A number of samples below 0.
    pub(crate) fn sensor(&self) -> Result<Sensor, Refusal> {
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

    /// What the sensor reads, given the input `f_h` (N).
    pub(crate) fn reading(&self, f_h: [f64; 3]) -> Wrench {
        let (force, torque) = if self.source == WRENCH {
            (self.force, self.torque)
        } else {
            (f_h, [0.0; 3])
        };
        Wrench {
            force: force.into(),
            torque: torque.into(),
        }
    }

    /// What the law made of it, and the bias.
    pub(crate) fn show(&mut self, ft: &Conditioned, bias: &Wrench) {
        self.f_h = ft.hand.force.into();
        self.moment = ft.hand.torque.into();
        self.fault = ft.fault.map_or(0, Fault::number);
        self.tare_state = ft.tare.number();
        self.tare_failure = ft.tare.failure().map_or(0, TareFailure::number);
        self.bias_force = bias.force.into();
        self.bias_torque = bias.torque.into();
    }

    /// What is shown before the first tick: nothing was sensed.
    pub(crate) fn clear(&mut self) {
        let nothing = Conditioned {
            hand: Wrench::ZERO,
            fault: None,
            tare: TareState::Off,
        };
        self.show(&nothing, &Wrench::ZERO);
    }
}

fn samples(name: &str, n: i32) -> Result<u32, Refusal> {
    u32::try_from(n).map_err(|_| Refusal(format!("{name} = {n}: expected 0 or more")))
}
