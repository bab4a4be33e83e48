//! The variables, one row each: those of the arm's law.

use admittance::encoder::Age;
use arm_law::{ArmInputs, ArmLaw, ArmOutputs, ArmParameters};
use declaration::{Declare, Description, Experiment, Rows, Start, Stepping};
use export::Ticks;
use serde::{Deserialize, Serialize};

/// The controller: its variables, and its state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, Rows, Start)]
#[rows(discrete)]
pub struct ArmController {
    /// What is sensed and asked for.
    #[part]
    pub inputs: ArmInputs,
    /// What came of the last tick.
    #[part]
    pub outputs: ArmOutputs,
    /// Number of the tick that the outputs belong to, at startTime + tick*T; -1 before the first one; it stays
    /// at 2147483647.
    #[output(11, start = -1)]
    pub tick: i32,
    /// Gains in task space that are accepted but probably not meant: 0 none, 1 K*T/M_min above 0.25, 2 a Lambda_n below
    /// M_min/10, 3 both.
    #[output(43, from = ["M_min", "Lambda_n[i]", "K[i]", "T"])]
    pub gain_warning: i32,
    /// The law's parameters.
    #[part]
    pub parameters: ArmParameters,

    pub(crate) ticks: Ticks,
    pub(crate) age: Age,
    pub(crate) arm_law: Option<ArmLaw>,
}

impl Declare for ArmController {
    const DESCRIPTION: Description<Self> = Description {
        name: "ArmController",
        about: "Passivity-based admittance control at the handle of the exoskeleton arm",
        stepping: Stepping::Sampled,
        experiment: Experiment {
            start: 0.0,
            stop: 60.0,
            tolerance: 1e-6,
            step: 0.001,
        },
        variables: Self::ROWS,
    };
}
