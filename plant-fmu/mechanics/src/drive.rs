//! A position drive: an actuator that closes its own PI loop around commanded position and velocity.

use fmu_declaration::{Rows, Start};

/// The drive's loop, with a limit on its force.
///
/// ```text
/// τ_a = clip(K((dq_d − dq) + K_P (q_d − q)), ±τ_max)        eq:adm_ctrl_1dof, in the drive
/// ```
///
/// It is a digital drive: q and dq are sampled at the start of each of its cycles, the force is held for the cycle. The
/// cycle is the plant's substep, 25 times a controller's period for the paper's testbed. The start values are the gains and
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

impl Drive {
    /// Force (N) on the driven part in a cycle that begins at position `q` (m) and velocity `dq` (m/s).
    pub fn force(&self, command: &Command, q: f64, dq: f64) -> f64 {
        let demand = self.K * ((command.dq_d - dq) + self.K_P * (command.q_d - q));
        demand.max(-self.tau_max).min(self.tau_max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_force_is_the_pi_loop_within_its_limit() {
        let drive = Drive {
            K: 2.0,
            K_P: 4.0,
            tau_max: 3.0,
        };
        let command = Command {
            q_d: 0.5,
            dq_d: 1.0,
        };
        assert_eq!(drive.force(&command, 0.25, 1.5), 1.0); // 2((1 − 1.5) + 4·0.25)
        assert_eq!(drive.force(&command, -9.0, 0.0), 3.0);
        assert_eq!(drive.force(&command, 9.0, 0.0), -3.0);
    }
}
