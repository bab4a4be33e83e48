//! The variables, one row each: those of the mechanics, and what the FMU has besides. A row's number decides its value
//! reference: new ones take the next.

use fmu_declaration::{Declare, Description, Experiment, Rows, Start, Stepping};
use mechanics::Energy;
use mechanics::drive::{Command, DRIVE, Drive, TORQUE};
use mechanics::testbed::{self as plant, Forces, Parameters};
use serde::{Deserialize, Serialize};

/// The testbed: its variables, and the plant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, Rows, Start)]
pub struct Testbed {
    /// What acts on the mass.
    #[part]
    pub forces: Forces,
    /// What the drive is told.
    #[part(from = 28)]
    pub command: Command,
    /// What the testbed shows.
    #[part]
    pub outputs: Outputs,

    /// What it is made of.
    #[part(from = 19)]
    pub parameters: Parameters,
    /// Where it starts.
    #[part(from = 25)]
    pub start: plant::Start,
    /// longest substep: a step is split into equal ones no longer than this
    // Below, a minute takes hours; above, an impact (50 ms) is no longer resolved.
    #[parameter(27, unit = SECOND, range = 1e-7..=1e-2, start = 8e-5)]
    pub substep: f64,
    /// what the actuator takes
    #[parameter(31, name = "drive.mode", items = DRIVE, start = TORQUE)]
    pub mode: i32,
    /// The drive.
    #[part(from = 32)]
    pub drive: Drive,

    /// State, not in the interface: the plant, built anew by each initialization.
    pub plant: plant::Testbed,
}

/// What the testbed shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, Rows)]
pub struct Outputs {
    /// position of the mass, the wall at q = wall.q
    #[output(3, unit = METRE, from = ["q_start"])]
    pub q: f64,
    /// velocity of the mass
    #[output(4, unit = METRE_PER_SECOND, from = ["dq_start"])]
    pub dq: f64,
    /// reading of the load cell: tau_h as held during the step that ended, without tau_d and the wall
    #[output(5, unit = NEWTON, from = ["tau_h"])]
    pub tau_h_measured: f64,
    /// force of the wall on the mass, mean of the last substep, never positive; 0 at the start
    #[output(6, unit = NEWTON)]
    pub tau_e: f64,
    /// force of friction on the mass, mean of the last substep, -F_c sgn(dq) - b dq in motion; 0 at rest at the start
    #[output(7, unit = NEWTON, from = ["dq_start", "F_c", "b"])]
    pub tau_f: f64,
    /// The energy balance.
    #[part(from = 8)]
    pub energy: Energy,
    /// force that the actuator applied to the mass, mean over the step that ended, positive along +q; 0 at the start
    #[output(30, unit = NEWTON)]
    pub tau_drive: f64,
}

impl Declare for Testbed {
    const DESCRIPTION: Description<Self> = Description {
        name: "Testbed",
        about: "1-DoF testbed: a mass with Coulomb and viscous friction in front of a unilateral wall",
        stepping: Stepping::Exact,
        experiment: Experiment {
            start: 0.0,
            stop: 60.0,
            tolerance: 1e-6,
            step: 0.002,
        },
        variables: Self::ROWS,
    };
}
