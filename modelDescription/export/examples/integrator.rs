//! The smallest model: y = ∫ u dt, with u held over each step. `lag.rs` shows every type of variable.

use fmu_declaration::{Declare, Description, Experiment, Rows, Start, Stepping};
use fmu_export::{Log, Model, Refusal, Step};
use serde::{Deserialize, Serialize};

/// Its variables, one row each.
#[derive(Clone, Serialize, Deserialize, Rows, Start)]
pub struct Integrator {
    /// speed
    #[input(0, unit = METRE_PER_SECOND)]
    u: f64,
    /// distance, 0 at the start
    #[output(1, unit = METRE)]
    y: f64,
}

#[rustfmt::skip]
impl Declare for Integrator {
    const DESCRIPTION: Description<Self> = Description {
        name: "integrator",
        about: "Integrator dy/dt = u",
        stepping: Stepping::Exact,
        experiment: Experiment { start: 0.0, stop: 1.0, tolerance: 1e-6, step: 0.01 },
        variables: Self::ROWS,
    };
}

impl Model for Integrator {
    fn initialize(&mut self, _start_time: f64, _log: &mut Log<'_>) -> Result<(), Refusal> {
        Ok(())
    }

    fn step(&mut self, step: Step, _log: &mut Log<'_>) -> Result<(), Refusal> {
        self.y += self.u * step.h;
        Ok(())
    }
}

fmu_export::export!(Integrator);
