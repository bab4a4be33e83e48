//! The variables, one row each: those of the mechanics, and what the FMU has besides. A row's number decides its value
//! reference: new ones take the next.

use crate::encoder::Encoder;
use crate::force_sensor::{ForceSensor, Reading};
use fmu_declaration::{Declare, Description, Experiment, Rows, Start, Stepping};
use mechanics::arm::{self, Arm, Command, Energy, Inputs, Parameters};
use serde::{Deserialize, Serialize};

/// The arm: its variables, the plant and what the force sensor shows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, Rows, Start)]
pub struct ExoskeletonArm {
    /// What acts on the arm.
    #[part]
    pub inputs: Inputs,
    /// What the drives are told.
    #[part(from = 94)]
    pub command: Command,
    /// What the arm shows.
    #[part]
    pub outputs: Outputs,

    /// What the arm is made of.
    #[part(from = 36)]
    pub parameters: Parameters,
    /// Where it starts.
    #[part(from = 36)]
    pub start: arm::Start,
    /// The encoders.
    #[part]
    pub encoder: Encoder,
    /// The force sensor.
    #[part]
    pub ft: ForceSensor,
    /// longest substep: a step is split into equal ones no longer than this
    // Below, a minute takes hours; above, contacts (a few milliseconds) are no longer resolved.
    #[parameter(84, unit = SECOND, range = 1e-7..=1e-2, start = 1e-4)]
    pub substep: f64,

    /// State, not in the interface: the plant, built anew by each initialization.
    pub plant: Arm,
    /// State, not in the interface: what the force sensor shows.
    pub reading: Reading,
}

/// What the arm shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, Rows)]
pub struct Outputs {
    /// joint angle as the encoder reads it
    #[output(4, unit = RADIAN, from = ["q_start[i]", "gear[i]", "encoder.kind", "encoder.counts", "encoder.bits"])]
    pub q: [f64; 3],
    /// true joint velocity
    #[output(5, unit = RADIAN_PER_SECOND, from = ["dq_start[i]"])]
    pub dq: [f64; 3],
    /// position of the handle, base frame
    #[output(6, unit = METRE, from = PLACE_HANDLE)]
    pub p: [f64; 3],
    /// velocity of the handle, base frame
    #[output(7, unit = METRE_PER_SECOND, from = MOVE_HANDLE)]
    pub dp: [f64; 3],
    /// force of table and wall on the pad or on the payload it holds, base frame, mean of the last substep; 0 at the
    /// start
    #[output(9, unit = NEWTON)]
    pub f_e: [f64; 3],
    /// torque that arrives at the joint after the drive's lag; 0 at the start
    #[output(10, unit = NEWTON_METRE)]
    pub tau_applied: [f64; 3],
    /// torque of dry and viscous friction on the joint, mean of the last substep; 0 at the start
    #[output(11, unit = NEWTON_METRE)]
    pub tau_f: [f64; 3],
    /// true joint angle
    #[output(12, unit = RADIAN, from = ["q_start[i]"])]
    pub q_joint: [f64; 3],
    /// position of the pad, base frame
    #[output(13, unit = METRE, from = PLACE_PAD)]
    pub p_pad: [f64; 3],
    /// upward pull of the pad on the payload, mean of the last substep; 0 without payload and at the start
    #[output(16, unit = NEWTON)]
    pub tension: f64,
    /// level force of the pad on the payload, its size, mean of the last substep; 0 without payload and at the start
    #[output(88, unit = NEWTON)]
    pub shear: f64,
    /// torque of the drive on the joint after its lag, mean over the step that ended, whatever the drive takes; 0 at the start
    #[output(96, unit = NEWTON_METRE)]
    pub tau_drive: [f64; 3],
    /// The energy balance.
    #[part(from = 17)]
    pub energy: Energy,
    /// The rigid body in this pose.
    #[part]
    pub rigid_body: RigidBody,
    /// reading of the force sensor in the handle: f_h as held when it last sampled, in the frame ft.frame; NaN after a
    /// failure of that kind
    #[output(8, unit = NEWTON, from = READING, nan)]
    pub f_h_measured: [f64; 3],
    /// whether a payload hangs at the pad
    #[output(14, from = ["payload.attached"])]
    pub attached: bool,
    /// whether table or wall pushed in the last substep
    #[output(15)]
    pub contact: bool,
}

/// M ddq + C dq + g = τ in the present pose, with the payload if it is attached: for those who check or compensate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, Rows)]
pub struct RigidBody {
    /// mass matrix in the present pose, row by row, with rotors and a held payload
    #[local(33, name = "rigid_body.M[i]", unit = KILOGRAM_SQUARE_METRE, continuous)]
    pub M: [f64; 9],
    /// Coriolis and centrifugal torque, left side of M ddq + C dq + g = tau
    #[local(34, name = "rigid_body.C_dq[i]", unit = NEWTON_METRE, continuous)]
    pub C_dq: [f64; 3],
    /// torque that holds the arm and a held payload against gravity
    #[local(35, name = "rigid_body.g[i]", unit = NEWTON_METRE, continuous)]
    pub g: [f64; 3],
}

impl Declare for ExoskeletonArm {
    const DESCRIPTION: Description<Self> = Description {
        name: "ExoskeletonArm",
        about: "Powered upper limb: geared 3-DoF arm with friction that sticks, payload, table, wall, and its sensors",
        stepping: Stepping::Exact,
        experiment: Experiment {
            start: 0.0,
            stop: 60.0,
            tolerance: 1e-6,
            step: 0.001,
        },
        variables: Self::ROWS,
    };
}

/// What the position of the handle follows from at the start.
const PLACE_HANDLE: &[&str] = &["q_start[i]", "A1", "L1", "handle.x", "handle.z"];
/// What the velocity of the handle follows from at the start.
const MOVE_HANDLE: &[&str] = &[
    "q_start[i]",
    "dq_start[i]",
    "A1",
    "L1",
    "handle.x",
    "handle.z",
];
/// What the position of the pad follows from at the start.
const PLACE_PAD: &[&str] = &["q_start[i]", "A1", "L1", "pad.x", "pad.z"];
const READING: &[&str] = &[
    "f_h[i]",
    "q_start[i]",
    "ft.frame",
    "ft.bias[i]",
    "ft.noise",
    "ft.seed",
    "ft.range",
    "ft.failure",
    "ft.t_failure",
    "ft.tool_m",
    "gravity[i]",
];
