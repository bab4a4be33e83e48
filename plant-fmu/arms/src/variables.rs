//! The interface, one row a variable. Append, never reorder: a row's position is its value reference.

use crate::ExoskeletonArms;
use declaration::Variability::{Continuous, Discrete, Fixed};
use declaration::{Declare, Description, Experiment, Stepping, boolean, real, unit};
use exoskeleton_arm::variables::{MOVE_HANDLE, PLACE_HANDLE, PLACE_PAD, SUBSTEP};
use exoskeleton_arm::with_arm_table;
use mechanics::Range;
use mechanics::pair::bond;

/// Range of `base.y` (m): crossed arms are no harm.
pub const BASE_Y: Range = Range {
    variable: "base.y",
    unit: "m",
    low: -10.0,
    high: 10.0,
};

/// The rows of the interface, those of the ports once for each of the `$side`s.
macro_rules! rows {
    ($($side:ident)+) => {
        with_arm_table! {
            payload: "mass of the whole payload, half of it a point at each pad; 0: none",
            ports: [
                $(
                    real!($side.tau_a[3], unit::NEWTON_METRE).input(Continuous)
                        .about("torque asked of the drive, on yaw, shoulder and elbow; positive turns left, lifts, lifts"),
                    real!($side.f_h[3], unit::NEWTON).input(Continuous)
                        .about("force of the human on this arm at the handle, base frame (x forward, y to the left, z up)"),
                    real!($side.f_d[3], unit::NEWTON).input(Continuous)
                        .about("force on this arm at the pad that no sensor sees, base frame"),
                    boolean!($side.vacuum).input(Discrete)
                        .about("whether the cup at this pad sucks; the payload is held by both cups or by none"),
                )+
                $(
                    real!($side.q[3], unit::RADIAN).output(Continuous).initially_from(&["q_start[i]"])
                        .about("joint angle, read by an ideal encoder"),
                    real!($side.dq[3], unit::RADIAN_PER_SECOND).output(Continuous).initially_from(&["dq_start[i]"])
                        .about("joint velocity"),
                    real!($side.p[3], unit::METRE).output(Continuous).initially_from(FROM_BASE_HANDLE)
                        .about("position of the handle, base frame: origin between the shoulders"),
                    real!($side.dp[3], unit::METRE_PER_SECOND).output(Continuous).initially_from(MOVE_HANDLE)
                        .about("velocity of the handle, base frame"),
                    real!($side.p_pad[3], unit::METRE).output(Continuous).initially_from(FROM_BASE_PAD)
                        .about("position of the pad, base frame: origin between the shoulders"),
                    real!($side.f_e[3], unit::NEWTON).output(Continuous)
                        .about("force of table and wall on the pad or on the half of the payload at it, base frame, mean of \
                                the last substep; 0 at the start"),
                    real!($side.tau_applied[3], unit::NEWTON_METRE).output(Continuous)
                        .about("torque that arrives at the joint after the drive's lag; 0 at the start"),
                    real!($side.tau_f[3], unit::NEWTON_METRE).output(Continuous)
                        .about("torque of dry and viscous friction on the joint, mean of the last substep; 0 at the start"),
                    boolean!($side.contact).output(Discrete)
                        .about("whether table or wall pushed in the last substep"),
                    real!($side.tension, unit::NEWTON).output(Continuous)
                        .about("upward pull of this pad on the payload, mean of the last substep; 0 without payload and at \
                                the start"),
                )+
                boolean!(attached).output(Discrete).initially_from(&["payload.attached"])
                    .about("whether the payload hangs at both pads"),
                real!(gap, unit::METRE).output(Continuous)
                    .about("distance of the pads' offset from that at the grip; 0 without payload and at the start"),
                real!(lambda[3], unit::NEWTON).output(Continuous)
                    .about("force of the payload's right half on its left one, base frame, mean of the last substep; the \
                            left one answers with its opposite; 0 without payload and at the start"),
            ],
            energy_and_more: [
                real!(energy.residual, unit::JOULE).output(Continuous)
                    .about("works + payload - losses - loss_bond - (kinetic + potential + surface + bond - their start \
                            value): of first order in the substep, defines no term"),
                real!("energy.bond" => bond_energy.stored, unit::JOULE).output(Continuous)
                    .about("energy stored in the payload between the pads"),
                real!("energy.loss_bond" => bond_energy.loss, unit::JOULE).output(Continuous)
                    .about("heat in the payload between the pads since the start"),
            ],
            sensors: [
                within(real!(bond.k, unit::NEWTON_PER_METRE), bond::K).parameter(Fixed)
                    .about("stiffness of the payload between the pads, along each axis"),
                within(real!(bond.c, unit::NEWTON_SECOND_PER_METRE), bond::C).parameter(Fixed)
                    .about("damping of the payload between the pads, along each axis"),
                within(real!(base.y, unit::METRE), BASE_Y).parameter(Fixed)
                    .about("y of the left shoulder; the right one is at its opposite"),
                within(real!(substep, unit::SECOND), SUBSTEP).parameter(Fixed)
                    .about("longest substep: a step is split into equal ones no longer than this"),
            ],
        }
    };
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
        variables: rows!(left right),
    };
}

/// What the position of a handle follows from at the start.
const FROM_BASE_HANDLE: &[&str] = &and_base(PLACE_HANDLE);
/// What the position of a pad follows from at the start.
const FROM_BASE_PAD: &[&str] = &and_base(PLACE_PAD);

/// `rows` and `base.y`.
const fn and_base(rows: &[&'static str]) -> [&'static str; 6] {
    let mut all = ["base.y"; 6];
    let mut i = 0;
    while i < 5 {
        all[i] = rows[i];
        i += 1;
    }
    all
}
