//! The variables, one row each: those of the law of one axis, and what the testbed has besides.

use crate::controller::Controller;
use admittance::one_axis::{AxisInputs, AxisOutputs, AxisParameters};
use fmu_declaration::{Declare, Description, Experiment, Rows, Start, Stepping};
use fmu_export::Sampler;
use serde::{Deserialize, Serialize};

/// The controller: its variables, and its state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, Rows, Start)]
#[rows(discrete)]
pub struct TestbedController {
    /// What is sensed and asked for.
    #[part]
    pub inputs: AxisInputs,

    /// What came of the last tick.
    #[part]
    pub outputs: AxisOutputs,
    /// Number of the tick that the outputs belong to, due at startTime + tick*sample_period; -1 before the first one; it
    /// stays at 2147483647.
    #[output(8, start = -1)]
    pub tick: i32,
    /// Sample period that the law has: the whole number of communication steps that is nearest to T, as the first step has
    /// them. T where a step divides it; the step itself where it is longer than T.
    #[output(54, unit = SECOND, from = ["T"], start = 0.002)]
    pub sample_period: f64,
    /// Gains that are accepted but probably not meant: 0 none, 1 K*T/M_min above 0.25, 2 M_n below M_min/10, 3 both.
    #[output(30, from = ["M_min", "M_n", "K", "T"])]
    pub gain_warning: i32,

    /// The law's parameters.
    #[part]
    pub parameters: AxisParameters,
    /// What the comparators need besides the law's parameters.
    #[part]
    pub comparator: Comparator,

    pub(crate) sampler: Option<Sampler>,
    /// whether the log has been told of a tick that did not come in time
    pub(crate) told: bool,
    pub(crate) controller: Option<Controller>,
}

/// The variables `comparator.*`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Rows, Start)]
pub struct Comparator {
    /// Mass of the robot, for the law natural only.
    #[parameter(35, name = "comparator.M", unit = KILOGRAM, range = POSITIVE, start = 6.0)]
    pub M: f64,
    /// Time constant of the sliding surface, for the law sliding_mode only.
    #[parameter(36, name = "comparator.H", unit = SECOND, range = NOT_NEGATIVE, start = 0.7)]
    pub H: f64,
}

impl Declare for TestbedController {
    const DESCRIPTION: Description<Self> = Description {
        name: "TestbedController",
        about: "Passivity-based admittance control of the one-axis testbed",
        stepping: Stepping::Sampled,
        experiment: Experiment {
            start: 0.0,
            stop: 60.0,
            tolerance: 1e-6,
            step: 0.002,
        },
        variables: Self::ROWS,
    };
}
