//! The interface, one row a variable. Append, never reorder: a row's position is its value reference.

use crate::ExoskeletonArm;
use crate::{encoder, force_sensor};
use declaration::Variability::{Continuous, Discrete, Fixed};
use declaration::{
    Declare, Description, Enumeration, Experiment, Item, Stepping, Variable, boolean, enumeration,
    integer, real, unit,
};
use mechanics::Range;
use mechanics::arm::ranges as range;

/// Range of `substep` (s): below, a minute takes hours; above, contacts (a few milliseconds) are no longer resolved.
pub const SUBSTEP: Range = Range {
    variable: "substep",
    unit: "s",
    low: 1e-7,
    high: 1e-2,
};

const fn within(row: Variable<ExoskeletonArm>, range: Range) -> Variable<ExoskeletonArm> {
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
        variables: &[
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
            real!(energy.kinetic, unit::JOULE).output(Continuous).initially_from(KINETIC)
                .about("kinetic energy of arm, rotors and a held payload"),
            real!(energy.potential, unit::JOULE).output(Continuous).initially_from(POTENTIAL)
                .about("potential energy of the links and a held payload, 0 at the shoulder"),
            real!(energy.surface, unit::JOULE).output(Continuous)
                .about("energy stored in table and wall"),
            real!(energy.work_tau, unit::JOULE).output(Continuous)
                .about("work of tau_applied on the arm since the start"),
            real!(energy.work_f_h, unit::JOULE).output(Continuous)
                .about("work of f_h on the arm since the start"),
            real!(energy.work_f_d, unit::JOULE).output(Continuous)
                .about("work of f_d on the arm since the start"),
            real!(energy.payload, unit::JOULE).output(Continuous)
                .about("energy that payloads brought when they were gripped, less what they took along when they left"),
            real!(energy.loss_friction, unit::JOULE).output(Continuous)
                .about("heat of dry friction in the joints since the start"),
            real!(energy.loss_viscous, unit::JOULE).output(Continuous)
                .about("heat of viscous friction in the joints since the start"),
            real!(energy.loss_stop, unit::JOULE).output(Continuous)
                .about("lost at the joints' stops since the start"),
            real!(energy.loss_surface, unit::JOULE).output(Continuous)
                .about("heat of the dampers in table and wall since the start"),
            real!(energy.loss_rub, unit::JOULE).output(Continuous)
                .about("heat of friction on table and wall since the start"),
            real!(energy.loss_impact, unit::JOULE).output(Continuous)
                .about("lost in landings on table and wall since the start, of first order in the substep"),
            real!(energy.loss_grip, unit::JOULE).output(Continuous)
                .about("lost in gripping payloads since the start: momentum is kept, energy is not"),
            real!(energy.loss_step, unit::JOULE).output(Continuous)
                .about("loss of the integrator (backward Euler) since the start, of first order in the substep"),
            real!(energy.residual, unit::JOULE).output(Continuous)
                .about("works + payload - losses - (kinetic + potential + surface - their start value): of first order in \
                        the substep, defines no term"),
            real!("rigid_body.M[i]" => rigid_body.M[9], unit::KILOGRAM_SQUARE_METRE).local(Continuous)
                .about("mass matrix in the present pose, row by row, with rotors and a held payload"),
            real!("rigid_body.C_dq[i]" => rigid_body.C_dq[3], unit::NEWTON_METRE).local(Continuous)
                .about("Coriolis and centrifugal torque, left side of M ddq + C dq + g = tau"),
            real!("rigid_body.g[i]" => rigid_body.g[3], unit::NEWTON_METRE).local(Continuous)
                .about("torque that holds the arm and a held payload against gravity"),

            within(real!("A1" => parameters.A_1, unit::METRE), range::A_1).parameter(Fixed)
                .about("from the yaw axis forward to the shoulder's pitch axis"),
            within(real!("L1" => parameters.L_1, unit::METRE), range::L_1).parameter(Fixed)
                .about("from the shoulder's pitch axis to the elbow's"),
            within(real!("handle.x" => parameters.handle.x, unit::METRE), range::HANDLE_X).parameter(Fixed)
                .about("handle, along link 3 from the elbow's axis"),
            within(real!("handle.z" => parameters.handle.z, unit::METRE), range::HANDLE_Z).parameter(Fixed)
                .about("handle, across link 3, up when the link is level"),
            within(real!("pad.x" => parameters.pad.x, unit::METRE), range::PAD_X).parameter(Fixed)
                .about("pad, along link 3 from the elbow's axis"),
            within(real!("pad.z" => parameters.pad.z, unit::METRE), range::PAD_Z).parameter(Fixed)
                .about("pad, across link 3, up when the link is level"),
            within(real!("link.m[i]" => parameters.link.m[3], unit::KILOGRAM), range::LINK_M[0]).parameter(Fixed)
                .about("mass of the link"),
            within(real!("link.x[i]" => parameters.link.x[3], unit::METRE), range::LINK_X[0]).parameter(Fixed)
                .about("centre of mass along the link from its joint"),
            within(real!("link.z[i]" => parameters.link.z[3], unit::METRE), range::LINK_Z[0]).parameter(Fixed)
                .about("centre of mass across the link, up when the link is level"),
            within(real!("link.I_xx[i]" => parameters.link.I_xx[3], unit::KILOGRAM_SQUARE_METRE), range::LINK_I_XX[0])
                .parameter(Fixed).about("moment of inertia about the centre of mass, axis along the link"),
            within(real!("link.I_yy[i]" => parameters.link.I_yy[3], unit::KILOGRAM_SQUARE_METRE), range::LINK_I_YY[0])
                .parameter(Fixed).about("moment of inertia about the centre of mass, axis of the pitch"),
            within(real!("link.I_zz[i]" => parameters.link.I_zz[3], unit::KILOGRAM_SQUARE_METRE), range::LINK_I_ZZ[0])
                .parameter(Fixed).about("moment of inertia about the centre of mass, axis across the link"),
            within(real!("link.I_xz[i]" => parameters.link.I_xz[3], unit::KILOGRAM_SQUARE_METRE), range::LINK_I_XZ[0])
                .parameter(Fixed).about("element xz of the inertia matrix about the centre of mass"),
            within(real!("rotor.I[i]" => parameters.rotor_I[3], unit::KILOGRAM_SQUARE_METRE), range::ROTOR[0])
                .parameter(Fixed).about("inertia of rotor and gear about the rotor axis; at the joint it counts times gear^2"),
            within(real!("gear[i]" => parameters.gear[3], unit::NONE), range::GEAR[0]).parameter(Fixed)
                .about("gear ratio"),
            within(real!("gravity[i]" => parameters.gravity[3], unit::METRE_PER_SECOND_SQUARED), range::GRAVITY[0])
                .parameter(Fixed).about("acceleration of gravity, base frame"),
            within(real!("friction.F_c[i]" => parameters.friction.F_c[3], unit::NEWTON_METRE), range::F_C[0])
                .parameter(Fixed).about("Coulomb friction of the joint"),
            within(real!("friction.F_s[i]" => parameters.friction.F_s[3], unit::NEWTON_METRE), range::F_S[0])
                .parameter(Fixed).about("stiction of the joint, at least friction.F_c"),
            within(real!("friction.v_s[i]" => parameters.friction.v_s[3], unit::RADIAN_PER_SECOND), range::V_S[0])
                .parameter(Fixed).about("Stribeck velocity: F_c + (F_s - F_c) exp(-(dq/v_s)^2)"),
            within(real!("friction.b[i]" => parameters.friction.b[3], unit::NEWTON_METRE_SECOND_PER_RADIAN), range::B[0])
                .parameter(Fixed).about("viscous friction of the joint"),
            within(real!("stop.min[i]" => parameters.stop_min[3], unit::RADIAN), range::STOP_MIN[0]).parameter(Fixed)
                .about("lower stop of the joint, hard and inelastic"),
            within(real!("stop.max[i]" => parameters.stop_max[3], unit::RADIAN), range::STOP_MAX[0]).parameter(Fixed)
                .about("upper stop of the joint, at least stop.min"),
            within(real!("drive.cutoff" => parameters.drive_cutoff, unit::HERTZ), range::DRIVE_CUTOFF).parameter(Fixed)
                .about("corner frequency of the torque's first-order lag; 0: no lag"),
            within(real!("payload.m" => parameters.payload_m, unit::KILOGRAM), range::PAYLOAD_M).parameter(Fixed)
                .about("mass of the payload, a point at the pad; 0: none"),
            boolean!("payload.attached" => parameters.payload_attached).parameter(Fixed)
                .about("whether the payload hangs at the pad from the start on"),
            within(real!("vacuum.F_max" => parameters.vacuum.F_max, unit::NEWTON), range::F_MAX).parameter(Fixed)
                .about("pull on the payload beyond which the bond breaks"),
            within(real!("vacuum.F_attach" => parameters.vacuum.F_attach, unit::NEWTON), range::F_ATTACH).parameter(Fixed)
                .about("force of the table on the pad beyond which the cup grips the payload"),
            within(real!("table.z" => parameters.table.position, unit::METRE), range::TABLE.position).parameter(Fixed)
                .about("height of the table, at most that of the pad at the start; -10: none in reach"),
            within(real!("table.k" => parameters.table.k, unit::NEWTON_PER_METRE), range::TABLE.k).parameter(Fixed)
                .about("stiffness of the table"),
            within(real!("table.c" => parameters.table.c, unit::NEWTON_SECOND_PER_METRE), range::TABLE.c)
                .parameter(Fixed).about("damping of the table"),
            within(real!("table.mu" => parameters.table.mu, unit::NONE), range::TABLE.mu).parameter(Fixed)
                .about("coefficient of friction on the table, for each tangential axis by itself"),
            within(real!("wall.x" => parameters.wall.position, unit::METRE), range::WALL.position).parameter(Fixed)
                .about("distance of the wall ahead, at least that of the pad at the start; 10: none in reach"),
            within(real!("wall.k" => parameters.wall.k, unit::NEWTON_PER_METRE), range::WALL.k).parameter(Fixed)
                .about("stiffness of the wall"),
            within(real!("wall.c" => parameters.wall.c, unit::NEWTON_SECOND_PER_METRE), range::WALL.c)
                .parameter(Fixed).about("damping of the wall"),
            within(real!("wall.mu" => parameters.wall.mu, unit::NONE), range::WALL.mu).parameter(Fixed)
                .about("coefficient of friction on the wall, for each tangential axis by itself"),
            within(real!("q_start[i]" => parameters.q_start[3], unit::RADIAN), range::Q_START[0]).parameter(Fixed)
                .about("start angle of the joint, between its stops"),
            within(real!("dq_start[i]" => parameters.dq_start[3], unit::RADIAN_PER_SECOND), range::DQ_START[0])
                .parameter(Fixed).about("start velocity of the joint"),

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
    };
}

const PLACE_HANDLE: &[&str] = &["q_start[i]", "A1", "L1", "handle.x", "handle.z"];
const MOVE_HANDLE: &[&str] = &[
    "q_start[i]",
    "dq_start[i]",
    "A1",
    "L1",
    "handle.x",
    "handle.z",
];
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
];
const KINETIC: &[&str] = &[
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
const POTENTIAL: &[&str] = &[
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
