//! The variables, one row each: those of the arm's law.

use arm_law::{ArmInputs, ArmLaw, ArmOutputs, ArmParameters};
use fmu_declaration::{Declare, Description, Experiment, Rows, Start, Stepping};
use fmu_export::Sampler;
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
    /// Number of the tick that the outputs belong to, due at startTime + tick*sample_period; -1 before the first one; it
    /// stays at 2147483647.
    #[output(11, start = -1)]
    pub tick: i32,
    /// Sample period that the law has: the whole number of communication steps that is nearest to T, as the first step has
    /// them. T where a step divides it; the step itself where it is longer than T.
    #[output(142, unit = SECOND, from = ["T"], start = 0.001)]
    pub sample_period: f64,
    /// Gains in task space that are accepted but probably not meant: 0 none, 1 K*T/M_min above 0.25, 2 a Lambda_n below
    /// M_min/10, 3 both.
    #[output(43, from = ["M_min", "Lambda_n[i]", "K[i]", "T"])]
    pub gain_warning: i32,
    /// The law's parameters.
    #[part]
    pub parameters: ArmParameters,

    pub(crate) sampler: Option<Sampler>,
    /// whether the log has been told of a tick that did not come in time
    pub(crate) told: bool,
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
