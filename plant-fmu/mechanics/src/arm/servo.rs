//! Position or velocity drives at the joints, in place of torques: [`crate::drive`], one for each joint.

use fmu_declaration::Rows;
use nalgebra::Vector3;

use super::parameters::Parameters;
use crate::drive::{self, Drive, Told};

/// The loop that the drive of one joint closes.
#[derive(Clone, Copy, Debug, PartialEq, Rows)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Servo {
    /// velocity gain of the joint's drive; without effect under drive.mode = 1
    #[parameter(55, name = "drive.K[i]", unit = NEWTON_METRE_SECOND_PER_RADIAN, range = 0.0..=1e6)]
    pub K: f64,
    /// ratio of the position gain to the velocity gain of the joint's drive; without effect under drive.mode = 1
    #[parameter(56, name = "drive.K_P[i]", unit = PER_SECOND, range = 0.0..=1e6)]
    pub K_P: f64,
    /// largest absolute torque that the joint's drive asks for; without effect under drive.mode = 1
    #[parameter(57, name = "drive.tau_max[i]", unit = NEWTON_METRE, range = 0.0..=1e6)]
    pub tau_max: f64,
}

/// What the drives are told.
#[derive(Clone, Copy, Debug, Default, PartialEq, Rows)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Command {
    /// command of the joint's angle, held during the step; used under drive.mode = 2 and 3 only
    #[input(0, unit = RADIAN)]
    pub q_d: [f64; 3],
    /// command of the joint's velocity, held during the step; used under drive.mode = 2 and 3 only
    #[input(1, unit = RADIAN_PER_SECOND)]
    pub dq_d: [f64; 3],
}

/// The drives of all joints, and what they are told for a communication step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drives([Told; 3]);

impl Parameters {
    /// The drives with their `command` in a step that begins at joint angles `q` (rad); `None`: they take torques.
    pub(crate) fn drives(&self, command: &Command, q: &Vector3<f64>) -> Option<Drives> {
        let told = |i: usize| {
            let Servo { K, K_P, tau_max } = self.servo[i];
            let command = drive::Command {
                q_d: command.q_d[i],
                dq_d: command.dq_d[i],
            };
            Drive { K, K_P, tau_max }.told(self.drive_mode, &command, q[i])
        };
        Some(Drives([told(0)?, told(1)?, told(2)?]))
    }
}

impl Drives {
    /// Torques (N·m) that they ask for in a cycle that begins at joint angles `q` (rad) and velocities `dq` (rad/s).
    pub fn torque(&self, q: &Vector3<f64>, dq: &Vector3<f64>) -> [f64; 3] {
        [0, 1, 2].map(|i| self.0[i].force(q[i], dq[i]))
    }
}
