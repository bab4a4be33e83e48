//! A position or velocity drive: an actuator that closes a loop of its own around what it is told.

use fmu_declaration::{Rows, Start, choices};

choices! { DRIVE "Drive" "What the actuator takes":
    TORQUE = 1 "torque" "tau_a";
    POSITION_SERVO = 2 "position_servo" "q_d and dq_d: the drive closes its own loop every substep, tau_a is not used";
    VELOCITY_SERVO = 3 "velocity_servo" "the velocity dq_d + drive.K_P (q_d - q), with q at the begin of the step: the drive closes its velocity \
        loop every substep, whoever commands it the position loop once a step, tau_a is not used";
}

/// The drive's loop, with a limit on its force.
///
/// ```text
/// τ_a = clip(K((dq_d − dq) + K_P (q_d − q)), ±τ_max)        eq:adm_ctrl_1dof, in the drive
/// ```
///
/// It is a digital drive: q and dq are sampled at the start of each of its cycles, the force is held for the cycle. The
/// cycle is the plant's substep, 25 times a controller's period for the paper's testbed. A velocity drive knows no position:
/// q is that at the begin of the communication step. The start values are the gains and
/// the force limit of the paper's 1-DoF experiments.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Drive {
    /// velocity gain of the position drive
    #[parameter(0, name = "drive.K", unit = NEWTON_SECOND_PER_METRE, range = 0.0..=1e6, start = 30.0)]
    pub K: f64,
    /// ratio of the position gain to the velocity gain of the position drive
    #[parameter(1, name = "drive.K_P", unit = PER_SECOND, range = 0.0..=1e6, start = 10.0)]
    pub K_P: f64,
    /// largest absolute force of the position drive
    #[parameter(2, name = "drive.tau_max", unit = NEWTON, range = 0.0..=1e6, start = 12.5)]
    pub tau_max: f64,
}

/// What the drive is told.
#[derive(Clone, Copy, Debug, Default, PartialEq, Rows)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Command {
    /// position command, held during the step; used by the position drive only
    #[input(0, unit = METRE)]
    pub q_d: f64,
    /// velocity command, held during the step; used by the position drive only
    #[input(1, unit = METRE_PER_SECOND)]
    pub dq_d: f64,
}

/// A drive and what it is told for a communication step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Told {
    drive: Drive,
    command: Command,
}

impl Drive {
    /// With its `command` in a step that begins at position `q` (m); `None`: in this `mode` it takes a force.
    pub fn told(&self, mode: i32, command: &Command, q: f64) -> Option<Told> {
        let (drive, command) = (*self, *command);
        match mode {
            POSITION_SERVO => Some(Told { drive, command }),
            VELOCITY_SERVO => Some(Told {
                drive: Self { K_P: 0.0, ..drive },
                command: Command {
                    q_d: q,
                    dq_d: command.dq_d + drive.K_P * (command.q_d - q),
                },
            }),
            _ => None,
        }
    }
}

impl Told {
    /// Force (N) on the driven part in a cycle that begins at position `q` (m) and velocity `dq` (m/s).
    pub fn force(&self, q: f64, dq: f64) -> f64 {
        let Self { drive, command } = self;
        let demand = drive.K * ((command.dq_d - dq) + drive.K_P * (command.q_d - q));
        demand.max(-drive.tau_max).min(drive.tau_max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DRIVE: Drive = Drive {
        K: 2.0,
        K_P: 4.0,
        tau_max: 3.0,
    };
    const COMMAND: Command = Command {
        q_d: 0.5,
        dq_d: 1.0,
    };

    #[test]
    fn the_force_is_the_pi_loop_within_its_limit() {
        let told = DRIVE
            .told(POSITION_SERVO, &COMMAND, 7.0)
            .expect("it is told");
        assert_eq!(told.force(0.25, 1.5), 1.0); // 2((1 − 1.5) + 4·0.25)
        assert_eq!(told.force(-9.0, 0.0), 3.0);
        assert_eq!(told.force(9.0, 0.0), -3.0);
    }

    #[test]
    fn a_velocity_drive_is_told_one_velocity_for_the_step() {
        let told = DRIVE
            .told(VELOCITY_SERVO, &COMMAND, 0.25)
            .expect("it is told");
        assert_eq!(told.force(0.25, 1.5), 1.0); // 2(2 − 1.5), 2 = 1 + 4·0.25
        assert_eq!(told.force(-9.0, 1.5), 1.0);
        assert_eq!(told.force(0.25, 0.0), 3.0);
    }

    #[test]
    fn under_torque_it_is_told_nothing() {
        assert_eq!(DRIVE.told(TORQUE, &COMMAND, 0.0), None);
    }
}
