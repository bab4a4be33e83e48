//! The interface, one row a variable. Append, never reorder: a row's position is its value reference.

use crate::Testbed;
use declaration::Variability::{Continuous, Fixed};
use declaration::{
    Declare, Description, Enumeration, Experiment, Item, Stepping, Variable, enumeration, real,
    unit,
};
use mechanics::Range;
use mechanics::drive::Drive;
use mechanics::friction::Friction;
use mechanics::testbed::{self as plant, Parameters};
use mechanics::wall::Wall;

/// Range of `substep` (s): below, a minute takes hours; above, an impact (50 ms) is no longer resolved.
pub const SUBSTEP: Range = Range {
    variable: "substep",
    unit: "s",
    low: 1e-7,
    high: 1e-2,
};

/// The type of `drive.mode`.
pub const DRIVE: Enumeration = Enumeration {
    name: "Drive",
    about: "What the actuator takes",
    items: &[
        Item {
            value: 1,
            name: "torque",
            about: "the force tau_a",
        },
        Item {
            value: 2,
            name: "position_servo",
            about: "q_d and dq_d: the drive closes its own loop every substep, tau_a is not used",
        },
    ],
};

const fn within(row: Variable<Testbed>, range: Range) -> Variable<Testbed> {
    row.within(range.low, range.high)
}

impl Declare for Testbed {
    #[rustfmt::skip] // a table: one row a variable
    const DESCRIPTION: Description<Self> = Description {
        name: "Testbed",
        about: "1-DoF testbed: a mass with Coulomb and viscous friction in front of a unilateral wall",
        stepping: Stepping::Exact,
        experiment: Experiment { start: 0.0, stop: 60.0, tolerance: 1e-6, step: 0.002 },
        variables: &[
            real!(tau_a, unit::NEWTON).input(Continuous)
                .about("force of the actuator on the mass, positive along +q"),
            real!(tau_h, unit::NEWTON).input(Continuous)
                .about("force of the human on the mass, at the handle, positive along +q"),
            real!(tau_d, unit::NEWTON).input(Continuous)
                .about("disturbance force on the mass that no sensor sees, positive along +q"),
            real!(q, unit::METRE).output(Continuous).initially_from(&["q_start"])
                .about("position of the mass, the wall at q = wall.q"),
            real!(dq, unit::METRE_PER_SECOND).output(Continuous).initially_from(&["dq_start"])
                .about("velocity of the mass"),
            real!(tau_h_measured, unit::NEWTON).output(Continuous).initially_from(&["tau_h"])
                .about("reading of the load cell: tau_h as held during the step that ended, without tau_d and the wall"),
            real!(tau_e, unit::NEWTON).output(Continuous)
                .about("force of the wall on the mass, mean of the last substep, never positive; 0 at the start"),
            real!(tau_f, unit::NEWTON).output(Continuous).initially_from(&["dq_start", "F_c", "b"])
                .about("force of friction on the mass, mean of the last substep, -F_c sgn(dq) - b dq in motion; 0 at rest at the start"),
            real!(energy.kinetic, unit::JOULE).output(Continuous).initially_from(&["M", "dq_start"])
                .about("kinetic energy of the mass, M dq^2/2"),
            real!(energy.wall, unit::JOULE).output(Continuous)
                .about("energy stored in the wall, k s^2/2 with the deflection s of its surface"),
            real!(energy.work_tau_a, unit::JOULE).output(Continuous)
                .about("work of tau_a on the mass since the start"),
            real!(energy.work_tau_h, unit::JOULE).output(Continuous)
                .about("work of tau_h on the mass since the start"),
            real!(energy.work_tau_d, unit::JOULE).output(Continuous)
                .about("work of tau_d on the mass since the start"),
            real!(energy.loss_coulomb, unit::JOULE).output(Continuous)
                .about("heat of Coulomb friction since the start"),
            real!(energy.loss_viscous, unit::JOULE).output(Continuous)
                .about("heat of viscous friction since the start"),
            real!(energy.loss_wall, unit::JOULE).output(Continuous)
                .about("heat of the damper in the wall since the start"),
            real!(energy.loss_impact, unit::JOULE).output(Continuous)
                .about("lost in landings on the wall since the start, of first order in the substep"),
            real!(energy.loss_step, unit::JOULE).output(Continuous)
                .about("loss of the integrator (backward Euler) since the start, of first order in the substep"),
            real!(energy.residual, unit::JOULE).output(Continuous)
                .about("works - losses - (kinetic + wall - their start value): zero up to rounding, defines no term"),
            within(real!(M, unit::KILOGRAM).parameter(Fixed), Parameters::M).about("moving mass"),
            within(real!("F_c" => friction.F_c, unit::NEWTON).parameter(Fixed), Friction::F_C)
                .about("Coulomb friction, equal to stiction"),
            within(real!("b" => friction.b, unit::NEWTON_SECOND_PER_METRE).parameter(Fixed), Friction::B)
                .about("viscous friction"),
            within(real!(wall.q, unit::METRE).parameter(Fixed), Wall::Q).about("position of the wall, 1e9: no wall"),
            within(real!(wall.k, unit::NEWTON_PER_METRE).parameter(Fixed), Wall::K).about("stiffness of the wall"),
            within(real!(wall.c, unit::NEWTON_SECOND_PER_METRE).parameter(Fixed), Wall::C)
                .about("damping of the wall"),
            within(real!(q_start, unit::METRE).parameter(Fixed), plant::Testbed::Q_START)
                .about("start position, at most wall.q"),
            within(real!(dq_start, unit::METRE_PER_SECOND).parameter(Fixed), plant::Testbed::DQ_START)
                .about("start velocity"),
            within(real!(substep, unit::SECOND).parameter(Fixed), SUBSTEP)
                .about("longest substep: a step is split into equal ones no longer than this"),
            real!(q_d, unit::METRE).input(Continuous)
                .about("position command, held during the step; used by the position drive only"),
            real!(dq_d, unit::METRE_PER_SECOND).input(Continuous)
                .about("velocity command, held during the step; used by the position drive only"),
            real!(tau_drive, unit::NEWTON).output(Continuous)
                .about("force that the actuator applied to the mass, mean over the step that ended, positive along +q; 0 at the start"),
            enumeration!(drive.mode, &DRIVE).parameter(Fixed)
                .about("what the actuator takes"),
            within(real!("drive.K" => drive.servo.K, unit::NEWTON_SECOND_PER_METRE).parameter(Fixed), Drive::GAIN)
                .about("velocity gain of the position drive"),
            within(real!("drive.K_P" => drive.servo.K_P, unit::PER_SECOND).parameter(Fixed), Drive::RATIO)
                .about("ratio of the position gain to the velocity gain of the position drive"),
            within(real!("drive.tau_max" => drive.servo.tau_max, unit::NEWTON).parameter(Fixed), Drive::FORCE)
                .about("largest absolute force of the position drive"),
        ],
    };
}
