//! The interface, one row a variable. Append, never reorder: a row's position is its value reference.

use crate::{ExoskeletonArm, encoder, force_sensor, with_arm_table};
use declaration::Variability::{Continuous, Discrete, Fixed};
use declaration::{
    Declare, Description, Enumeration, Experiment, Item, Stepping, Variable, boolean, enumeration,
    integer, real, unit,
};
use mechanics::Range;
pub use mechanics::arm::ranges as range;

/// Range of `substep` (s): below, a minute takes hours; above, contacts (a few milliseconds) are no longer resolved.
pub const SUBSTEP: Range = Range {
    variable: "substep",
    unit: "s",
    low: 1e-7,
    high: 1e-2,
};

/// `row` with the bounds of `range`.
pub const fn within<M>(row: Variable<M>, range: Range) -> Variable<M> {
    row.within(range.low, range.high)
}

const fn item(value: i32, name: &'static str, about: &'static str) -> Item {
    Item { value, name, about }
}

/// The type of `encoder.kind`.
pub const ENCODER: Enumeration = Enumeration {
    name: "EncoderKind",
    about: "Where the encoders sit",
    items: &[
        item(encoder::IDEAL, "ideal", "reads the true angle"),
        item(
            encoder::MOTOR,
            "motor",
            "on the motor's shaft: encoder.counts times the gear ratio per revolution of the joint",
        ),
        item(
            encoder::JOINT,
            "joint",
            "on the joint: 2 to the power of encoder.bits per revolution",
        ),
    ],
};

/// The type of `ft.frame`.
pub const FRAME: Enumeration = Enumeration {
    name: "Frame",
    about: "Frame in which the force sensor's components are given",
    items: &[
        item(
            force_sensor::BASE,
            "base",
            "base frame: x forward, y to the left, z up",
        ),
        item(
            force_sensor::SENSOR,
            "sensor",
            "link 3's frame: x along the link, z up when the link is level; it turns with the link",
        ),
    ],
};

/// The type of `ft.failure`.
pub const FAILURE: Enumeration = Enumeration {
    name: "ForceSensorFailure",
    about: "How the force sensor fails",
    items: &[
        item(force_sensor::NONE, "none", "it does not"),
        item(
            force_sensor::STUCK,
            "stuck",
            "shows its last sound reading for ever",
        ),
        item(force_sensor::NAN, "nan", "shows NaN on all axes"),
        item(
            force_sensor::OVER_RANGE,
            "over_range",
            "shows the end of its range on all axes, on the side of the force",
        ),
        item(force_sensor::DROPOUT, "dropout", "shows 0 on all axes"),
    ],
};

impl Declare for ExoskeletonArm {
    #[rustfmt::skip] // a table: one row a variable
    const DESCRIPTION: Description<Self> = Description {
        name: "ExoskeletonArm",
        about: "Powered upper limb: geared 3-DoF arm with friction that sticks, payload, table, wall, and its sensors",
        stepping: Stepping::Exact,
        experiment: Experiment { start: 0.0, stop: 60.0, tolerance: 1e-6, step: 0.001 },
        variables: with_arm_table! {
        payload: "mass of the payload, a point at the pad; 0: none",
        ports: [
            real!(tau_a[3], unit::NEWTON_METRE).input(Continuous)
                .about("torque asked of the drive, on yaw, shoulder and elbow; positive turns left, lifts, lifts"),
            real!(f_h[3], unit::NEWTON).input(Continuous)
                .about("force of the human on the arm at the handle, base frame (x forward, y to the left, z up)"),
            real!(f_d[3], unit::NEWTON).input(Continuous)
                .about("force on the arm at the pad that no sensor sees, base frame"),
            boolean!(vacuum).input(Discrete)
                .about("whether the cup at the pad sucks: it grips what the pad presses on, and lets go when this is false"),

            real!(q[3], unit::RADIAN).output(Continuous)
                .initially_from(&["q_start[i]", "gear[i]", "encoder.kind", "encoder.counts", "encoder.bits"])
                .about("joint angle as the encoder reads it"),
            real!(dq[3], unit::RADIAN_PER_SECOND).output(Continuous).initially_from(&["dq_start[i]"])
                .about("true joint velocity"),
            real!(p[3], unit::METRE).output(Continuous).initially_from(PLACE_HANDLE)
                .about("position of the handle, base frame"),
            real!(dp[3], unit::METRE_PER_SECOND).output(Continuous).initially_from(MOVE_HANDLE)
                .about("velocity of the handle, base frame"),
            real!(f_h_measured[3], unit::NEWTON).output(Continuous).initially_from(READING).may_be_nan()
                .about("reading of the force sensor in the handle: f_h as held when it last sampled, in the frame ft.frame; \
                        NaN after a failure of that kind"),
            real!(f_e[3], unit::NEWTON).output(Continuous)
                .about("force of table and wall on the pad or on the payload it holds, base frame, mean of the last substep; \
                        0 at the start"),
            real!(tau_applied[3], unit::NEWTON_METRE).output(Continuous)
                .about("torque that arrives at the joint after the drive's lag; 0 at the start"),
            real!(tau_f[3], unit::NEWTON_METRE).output(Continuous)
                .about("torque of dry and viscous friction on the joint, mean of the last substep; 0 at the start"),
            real!(q_joint[3], unit::RADIAN).output(Continuous).initially_from(&["q_start[i]"])
                .about("true joint angle"),
            real!(p_pad[3], unit::METRE).output(Continuous).initially_from(PLACE_PAD)
                .about("position of the pad, base frame"),
            boolean!(attached).output(Discrete).initially_from(&["payload.attached"])
                .about("whether a payload hangs at the pad"),
            boolean!(contact).output(Discrete)
                .about("whether table or wall pushed in the last substep"),
            real!(tension, unit::NEWTON).output(Continuous)
                .about("upward pull of the pad on the payload, mean of the last substep; 0 without payload and at the start"),
        ],
        energy_and_more: [
            real!(energy.residual, unit::JOULE).output(Continuous)
                .about("works + payload - losses - (kinetic + potential + surface - their start value): of first order in \
                        the substep, defines no term"),
            real!("rigid_body.M[i]" => rigid_body.M[9], unit::KILOGRAM_SQUARE_METRE).local(Continuous)
                .about("mass matrix in the present pose, row by row, with rotors and a held payload"),
            real!("rigid_body.C_dq[i]" => rigid_body.C_dq[3], unit::NEWTON_METRE).local(Continuous)
                .about("Coriolis and centrifugal torque, left side of M ddq + C dq + g = tau"),
            real!("rigid_body.g[i]" => rigid_body.g[3], unit::NEWTON_METRE).local(Continuous)
                .about("torque that holds the arm and a held payload against gravity"),
        ],
        sensors: [
            enumeration!(encoder.kind, &ENCODER).parameter(Fixed).about("where the encoders sit"),
            integer!(encoder.counts).parameter(Fixed).within_integers(1, 1_000_000_000)
                .about("counts per revolution of the motor, on the motor's side"),
            integer!(encoder.bits).parameter(Fixed).within_integers(1, 40)
                .about("bits per revolution of the joint, on the joint's side"),
            enumeration!(ft.frame, &FRAME).parameter(Fixed)
                .about("frame of f_h_measured, ft.bias and the noise"),
            real!("ft.bias[i]" => ft.bias[3], unit::NEWTON).parameter(Fixed).within(-1e6, 1e6)
                .about("constant error of the force sensor, in the frame ft.frame"),
            real!(ft.noise, unit::NEWTON).parameter(Fixed).within(0.0, 1e6)
                .about("standard deviation of the force sensor's white noise, on each axis and sample"),
            integer!(ft.seed).parameter(Fixed)
                .about("which noise: the same seed gives the same noise, whatever the steps"),
            real!(ft.T, unit::SECOND).parameter(Fixed).within(1e-6, 1e3)
                .about("sample period of the force sensor; sample k is taken at startTime + k ft.T"),
            real!(ft.range, unit::NEWTON).parameter(Fixed).within(1e-3, 1e9)
                .about("largest reading of the force sensor, on each axis"),
            enumeration!(ft.failure, &FAILURE).parameter(Fixed).about("how the force sensor fails"),
            real!(ft.t_failure, unit::SECOND).parameter(Fixed).within(-1e9, 1e9)
                .about("when the force sensor fails: from the first sample on that is not earlier"),
            within(real!(substep, unit::SECOND), SUBSTEP).parameter(Fixed)
                .about("longest substep: a step is split into equal ones no longer than this"),
        ],
        },
    };
}

/// What the position of the handle follows from at the start.
pub const PLACE_HANDLE: &[&str] = &["q_start[i]", "A1", "L1", "handle.x", "handle.z"];
/// What the velocity of the handle follows from at the start.
pub const MOVE_HANDLE: &[&str] = &[
    "q_start[i]",
    "dq_start[i]",
    "A1",
    "L1",
    "handle.x",
    "handle.z",
];
/// What the position of the pad follows from at the start.
pub const PLACE_PAD: &[&str] = &["q_start[i]", "A1", "L1", "pad.x", "pad.z"];
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
];
/// What the kinetic energy follows from at the start.
pub const KINETIC: &[&str] = &[
    "q_start[i]",
    "dq_start[i]",
    "A1",
    "L1",
    "pad.x",
    "pad.z",
    "link.m[i]",
    "link.x[i]",
    "link.z[i]",
    "link.I_xx[i]",
    "link.I_yy[i]",
    "link.I_zz[i]",
    "link.I_xz[i]",
    "rotor.I[i]",
    "gear[i]",
    "payload.m",
    "payload.attached",
];
/// What the potential energy follows from at the start.
pub const POTENTIAL: &[&str] = &[
    "q_start[i]",
    "A1",
    "L1",
    "pad.x",
    "pad.z",
    "link.m[i]",
    "link.x[i]",
    "link.z[i]",
    "gravity[i]",
    "payload.m",
    "payload.attached",
];
