//! The variables, one row each: those of the mechanics, and what the FMU has besides. A row's number decides its value
//! reference: new ones take the next.

use fmu_declaration::{Declare, Description, Experiment, Rows, Start, Stepping};
use mechanics::arm;
use mechanics::pair::{Balance, Pair, Parameters};
use serde::{Deserialize, Serialize};

/// Both arms: their variables, and the plant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, Rows, Start)]
pub struct ExoskeletonArms {
    /// What acts on the arms.
    #[part]
    pub inputs: Inputs,
    /// What the drives of the left arm are told.
    #[part(prefix = "left.", from = 107)]
    pub left_command: arm::Command,
    /// What those of the right one are told.
    #[part(prefix = "right.", from = 109)]
    pub right_command: arm::Command,
    /// What the arms show.
    #[part]
    pub outputs: Outputs,

    /// What the arms and the bond are made of.
    #[part(from = 49, about = [("payload.m", "mass of the whole payload, half of it a point at each pad; 0: none")])]
    pub parameters: Parameters,
    /// Where each arm starts.
    #[part(from = 49)]
    pub start: arm::Start,
    /// Where the shoulders are.
    #[part]
    pub base: Base,
    /// longest substep: a step is split into equal ones no longer than this
    // Below, a minute takes hours; above, contacts (a few milliseconds) are no longer resolved.
    #[parameter(89, unit = SECOND, range = 1e-7..=1e-2, start = 1e-4)]
    pub substep: f64,

    /// State, not in the interface: the plant, built anew by each initialization.
    pub plant: Pair,
}

/// What acts on the arms.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, Rows)]
pub struct Inputs {
    /// On the left one.
    #[part(prefix = "left.", about = ON_THIS_ARM)]
    pub left: arm::Inputs,
    /// On the right one.
    #[part(prefix = "right.", from = 4, about = ON_THIS_ARM)]
    pub right: arm::Inputs,
}

/// What of an arm's inputs is another thing where there are two.
const ON_THIS_ARM: &[(&str, &str)] = &[
    (
        "f_h[i]",
        "force of the human on this arm at the handle, base frame (x forward, y to the left, z up)",
    ),
    (
        "f_d[i]",
        "force on this arm at the pad that no sensor sees, base frame",
    ),
    (
        "vacuum",
        "whether the cup at this pad sucks; the payload is held by both cups or by none, and one that hangs from the start on \
         until this has been true",
    ),
];

/// What the arms show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, Rows)]
pub struct Outputs {
    /// The left one.
    #[part(prefix = "left.", from = 8)]
    pub left: Side,
    /// The right one.
    #[part(prefix = "right.", from = 18)]
    pub right: Side,
    /// distance of the pads' offset from that at the grip; 0 without payload and at the start
    #[output(29, unit = METRE)]
    pub gap: f64,
    /// force of the payload's right half on its left one, base frame, mean of the last substep; the left one answers
    /// with its opposite; 0 without payload and at the start
    #[output(30, unit = NEWTON)]
    pub lambda: [f64; 3],
    /// The energy balance of both arms and the bond.
    #[part(from = 31)]
    pub energy: Balance,
    /// moment of both pads' wrists together on the payload, which therefore does not turn: (p_L - p_R) x lambda; base frame,
    /// mean of the last substep; 0 without payload and at the start
    #[output(102, unit = NEWTON_METRE)]
    pub wrist: [f64; 3],
    /// whether the payload hangs at both pads
    #[output(28, from = ["payload.attached"])]
    pub attached: bool,
}

/// What one arm shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, Rows)]
pub struct Side {
    /// joint angle, read by an ideal encoder
    #[output(0, unit = RADIAN, from = ["q_start[i]"])]
    pub q: [f64; 3],
    /// joint velocity
    #[output(1, unit = RADIAN_PER_SECOND, from = ["dq_start[i]"])]
    pub dq: [f64; 3],
    /// position of the handle, base frame: origin between the shoulders
    #[output(2, unit = METRE, from = ["q_start[i]", "A1", "L1", "handle.x", "handle.z", "base.y"])]
    pub p: [f64; 3],
    /// velocity of the handle, base frame
    #[output(3, unit = METRE_PER_SECOND, from = ["q_start[i]", "dq_start[i]", "A1", "L1", "handle.x", "handle.z"])]
    pub dp: [f64; 3],
    /// position of the pad, base frame: origin between the shoulders
    #[output(4, unit = METRE, from = ["q_start[i]", "A1", "L1", "pad.x", "pad.z", "base.y"])]
    pub p_pad: [f64; 3],
    /// force of table and wall on the pad or on the half of the payload at it, base frame, mean of the last substep; 0 at
    /// the start
    #[output(5, unit = NEWTON)]
    pub f_e: [f64; 3],
    /// torque that arrives at the joint after the drive's lag; 0 at the start
    #[output(6, unit = NEWTON_METRE)]
    pub tau_applied: [f64; 3],
    /// torque of dry and viscous friction on the joint, mean of the last substep; 0 at the start
    #[output(7, unit = NEWTON_METRE)]
    pub tau_f: [f64; 3],
    /// upward pull of this pad on the payload, mean of the last substep; 0 without payload and at the start
    #[output(9, unit = NEWTON)]
    pub tension: f64,
    /// level force of this pad on the payload, its size, mean of the last substep; 0 without payload and at the start
    #[output(93, unit = NEWTON)]
    pub shear: f64,
    /// torque of the drive on the joint after its lag, mean over the step that ended, whatever the drive takes; 0 at the start
    #[output(104, unit = NEWTON_METRE)]
    pub tau_drive: [f64; 3],
    /// whether table or wall pushed in the last substep
    #[output(8)]
    pub contact: bool,
}

/// Where the shoulders are; crossed arms are no harm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Rows, Start)]
pub struct Base {
    /// y of the left shoulder; the right one is at its opposite
    #[parameter(88, name = "base.y", unit = METRE, range = -10.0..=10.0, start = 0.2)]
    pub y: f64,
}

impl Declare for ExoskeletonArms {
    const DESCRIPTION: Description<Self> = Description {
        name: "ExoskeletonArms",
        about: "Two powered upper limbs, left and right, that share one payload rigidly; each as ExoskeletonArm",
        stepping: Stepping::Exact,
        experiment: Experiment {
            start: 0.0,
            stop: 36.0,
            tolerance: 1e-6,
            step: 0.001,
        },
        variables: Self::ROWS,
    };
}
