//! The smallest model: y = ∫ u dt, with u held over each step. `feedthrough` shows every type of variable.

use fmu_export::{Log, Model, Refusal, Step, interface};

/// Integrator dy/dt = u
#[interface(step = 0.01)]
pub struct Integrator {
    /// speed
    #[input(unit = METRE_PER_SECOND)]
    u: f64,
    /// distance, 0 at the start
    #[output(unit = METRE)]
    y: f64,
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
