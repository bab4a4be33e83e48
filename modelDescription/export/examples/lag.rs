//! A first-order lag, with variables of all types of FMI 2.0 and a switch that panics.
//!
//! It is also the subject of the tests of the C interface (`tests/abi`), as a shared library.

use fmu_export::{Log, Model, Refusal, Step, choices, interface};
use std::path::Path;

choices! { METHOD "Method" "How the lag is integrated":
    1 "exact" "exponential";
    2 "implicit_euler" "implicit Euler";
}

/// First-order lag tau dy/dt = gain u - y
#[interface(step = 0.01, stop = 2.0)]
pub struct Lag {
    /// input
    #[input(0)]
    u: f64,
    /// output, at rest at the start
    #[output(1, from = ["u", "gain"])]
    y: f64,
    /// time constant
    #[parameter(2, unit = SECOND, range = 1e-6..=1e6, start = 0.5)]
    tau: f64,
    /// gain
    #[parameter(3, range = -1e3..=1e3, tunable, start = 1.0)]
    gain: f64,
    /// number of steps since the start
    #[output(4)]
    steps: i32,
    /// the next step panics
    #[input(5)]
    panic: bool,
    /// integration method
    #[parameter(6, items = METHOD, typed, start = 1)]
    method: i32,
    /// any text
    #[parameter(7, start = "lag".into())]
    label: String,
    /// where the importer unpacked the resources
    #[output(8)]
    resource_path: String,
}

impl Model for Lag {
    fn initialize(&mut self, _start_time: f64, _log: &mut Log<'_>) -> Result<(), Refusal> {
        self.y = self.gain * self.u;
        self.steps = 0;
        Ok(())
    }

    fn tune(&mut self, _log: &mut Log<'_>) -> Result<(), Refusal> {
        if self.gain == 13.0 {
            return Err(Refusal::new(
                "gain = 13, expected any other gain (a relation that only the model can check)",
            ));
        }
        Ok(())
    }

    fn located(&mut self, resources: Option<&Path>) {
        self.resource_path = resources
            .map(|path| path.display().to_string())
            .unwrap_or_default();
    }

    fn step(&mut self, step: Step, log: &mut Log<'_>) -> Result<(), Refusal> {
        assert!(!self.panic, "provoked with 100% certainty");
        let share = match self.method {
            1 => -libm::expm1(-step.h / self.tau),
            _ => step.h / (self.tau + step.h),
        };
        self.y += share * (self.gain * self.u - self.y);
        self.steps += 1;
        if self.steps == 1 {
            log.event(format_args!("first step to t = {} s", step.t + step.h));
        }
        Ok(())
    }
}

fmu_export::export!(Lag);
