//! The smallest model: a first-order lag, with one variable of each type and a switch that panics.
//!
//! It is also the subject of the tests of the C interface (`tests/abi`), as a shared library.

use declaration::{
    Declare, Description, Enumeration, Experiment, Item, Stepping, Variability::*, boolean,
    enumeration, integer, real, string, unit,
};
use export::{Log, Model, Refusal, Step};
use serde::{Deserialize, Serialize};
use std::path::Path;

static METHOD: Enumeration = Enumeration {
    name: "Method",
    about: "How the lag is integrated",
    items: &[
        Item {
            value: 1,
            name: "exact",
            about: "exponential",
        },
        Item {
            value: 2,
            name: "implicit_euler",
            about: "implicit Euler",
        },
    ],
};

/// tau dy/dt = gain·u − y
#[derive(Clone, Serialize, Deserialize)]
pub struct Lag {
    u: f64,
    y: f64,
    tau: f64,
    gain: f64,
    steps: i32,
    panic: bool,
    method: i32,
    label: String,
    resource_path: String,
}

impl Default for Lag {
    fn default() -> Self {
        let (label, resource_path) = ("lag".into(), String::new());
        Self {
            u: 0.0,
            y: 0.0,
            tau: 0.5,
            gain: 1.0,
            steps: 0,
            panic: false,
            method: 1,
            label,
            resource_path,
        }
    }
}

impl Declare for Lag {
    const DESCRIPTION: Description<Self> = Description {
        name: "Lag",
        about: "First-order lag tau dy/dt = gain u - y",
        stepping: Stepping::Exact,
        experiment: Experiment {
            start: 0.0,
            stop: 2.0,
            tolerance: 1e-6,
            step: 0.01,
        },
        variables: &[
            real!(u, unit::NONE).input(Continuous).about("input"),
            real!(y, unit::NONE)
                .output(Continuous)
                .initially_from(&["u", "gain"])
                .about("output, at rest at the start"),
            real!(tau, unit::SECOND)
                .parameter(Fixed)
                .within(1e-6, 1e6)
                .about("time constant"),
            real!(gain, unit::NONE)
                .parameter(Tunable)
                .within(-1e3, 1e3)
                .about("gain"),
            integer!(steps)
                .output(Discrete)
                .about("number of steps since the start"),
            boolean!(panic)
                .input(Discrete)
                .about("the next step panics"),
            enumeration!(method, &METHOD)
                .typed()
                .parameter(Fixed)
                .about("integration method"),
            string!(label).parameter(Fixed).about("any text"),
            string!(resource_path)
                .output(Discrete)
                .about("where the importer unpacked the resources"),
        ],
    };
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

export::fmi2!(Lag);
