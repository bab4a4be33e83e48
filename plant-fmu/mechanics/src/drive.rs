//! A position drive: an actuator that closes its own PI loop around commanded position and velocity.

use crate::Range;

/// The drive's loop, with a limit on its force.
///
/// ```text
/// τ_a = clip(K((dq_d − dq) + K_P (q_d − q)), ±τ_max)        eq:adm_ctrl_1dof, in the drive
/// ```
///
/// It is a digital drive: q and dq are sampled at the start of each of its cycles, the force is held for the cycle. The
/// cycle is the plant's substep, 25 times a controller's period for the paper's testbed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Drive {
    /// Velocity gain K (N·s/m).
    pub K: f64,
    /// Ratio of position to velocity gain K_P (1/s).
    pub K_P: f64,
    /// Largest force τ_max (N).
    pub tau_max: f64,
}

/// What the drive is told.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Command {
    /// Position q_d (m).
    pub q_d: f64,
    /// Velocity dq_d (m/s).
    pub dq_d: f64,
}

impl Default for Drive {
    /// The gains and the force limit of the paper's 1-DoF experiments.
    fn default() -> Self {
        Self {
            K: 30.0,
            K_P: 10.0,
            tau_max: 12.5,
        }
    }
}

impl Drive {
    /// Range of K (N·s/m).
    pub const GAIN: Range = Range {
        variable: "drive.K",
        unit: "N.s/m",
        low: 0.0,
        high: 1e6,
    };
    /// Range of K_P (1/s).
    pub const RATIO: Range = Range {
        variable: "drive.K_P",
        unit: "1/s",
        low: 0.0,
        high: 1e6,
    };
    /// Range of τ_max (N).
    pub const FORCE: Range = Range {
        variable: "drive.tau_max",
        unit: "N",
        low: 0.0,
        high: 1e6,
    };

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
