//! What a gear loses of the torque that it carries.

use fmu_declaration::Rows;

/// Dry friction of a joint that grows with the torque τ its gear carries, beside that of [`Stribeck`](super::stribeck::Stribeck).
/// A strain-wave gear loses a share of what goes in, and another one when the load drives the motor:
///
/// ```text
/// the motor drives (τ dq > 0):       the load gets (1 − loss) τ            friction  loss |τ|
/// the load drives back (τ dq < 0):   the motor gets (1 − loss_back) of it   friction  loss_back/(1 − loss_back) |τ|
/// ```
///
/// At rest both limits hold, each for its direction. τ is the torque that arrives from the drive, the rotor's share in an
/// acceleration included. The start values are a gear without such a loss.
#[derive(Clone, Copy, Debug, Default, PartialEq, Rows)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GearLoss {
    // Above, next to nothing arrives: a gear that is broken.
    /// share of the drive's torque that the gear loses while the drive moves the load
    #[parameter(50, name = "gear.loss[i]", range = 0.0..=0.95)]
    pub drive: f64,
    /// share of the load's torque that the gear loses while the load moves the drive
    #[parameter(51, name = "gear.loss_back[i]", range = 0.0..=0.95)]
    pub back: f64,
}

impl GearLoss {
    /// Friction against the positive and against the negative direction, under the torque `tau`, with what is `dry` beside it:
    /// all in N·m, or all in N·m·s.
    #[inline]
    pub fn against(&self, tau: f64, dry: f64) -> [f64; 2] {
        if self.drive == 0.0 && self.back == 0.0 {
            return [dry; 2];
        }
        let (ahead, back) = (self.drive * tau, self.back / (1.0 - self.back) * tau);
        if tau >= 0.0 {
            [dry + ahead, dry + back]
        } else {
            [dry - back, dry - ahead]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn friction_is_a_share_of_what_goes_in_on_the_side_where_it_goes_in() {
        let gear = GearLoss {
            drive: 0.2,
            back: 0.5,
        };
        // 10 N·m from the drive lift 8 N·m; 20 N·m from the load drive 10 N·m back.
        assert_eq!(gear.against(10.0, 0.0), [2.0, 10.0]);
        assert_eq!(gear.against(-10.0, 0.0), [10.0, 2.0]);
        assert_eq!(gear.against(-10.0, 3.0), [13.0, 5.0]);
        assert_eq!(gear.against(0.0, 3.0), [3.0, 3.0]);
        assert_eq!(GearLoss::default().against(-300.0, 3.0), [3.0, 3.0]);
    }
}
