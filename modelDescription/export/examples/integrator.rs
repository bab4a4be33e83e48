//! The smallest model: y = ∫ u dt, with u held over each step. `lag.rs` shows every type of variable.

use declaration::{Declare, Description, Experiment, Stepping, Variability::*, real, unit};
use export::{Log, Model, Refusal, Step};
use serde::{Deserialize, Serialize};

/// Its variables, at their start values by default.
#[derive(Clone, Default, Serialize, Deserialize)]
pub struct Integrator {
    u: f64,
    y: f64,
}

#[rustfmt::skip] // a table
impl Declare for Integrator {
    const DESCRIPTION: Description<Self> = Description {
        name: "integrator",
        about: "Integrator dy/dt = u",
        stepping: Stepping::Exact,
        experiment: Experiment { start: 0.0, stop: 1.0, tolerance: 1e-6, step: 0.01 },
        variables: &[
            real!(u, unit::METRE_PER_SECOND).input(Continuous).about("speed"),
            real!(y, unit::METRE).output(Continuous).about("distance, 0 at the start"),
        ],
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

export::fmi2!(Integrator);
