//! What a model must offer to be exported.

use crate::{Clock, Log, Step};
use fmu_declaration::Declare;
use serde::{Serialize, de::DeserializeOwned};
use std::path::Path;

/// A model: its variables are fields, declared by [`Declare`], and its whole state (parameters, inputs, outputs,
/// internal states) is one value that can be copied and serialized.
///
/// The life cycle, as the C interface drives it:
/// 1. [`Default::default`]: instantiated, start values.
/// 2. The importer sets parameters and inputs; each value is checked against its row before it is written.
/// 3. [`initialize`](Model::initialize), possibly several times, while the importer sets and reads in Initialization Mode.
/// 4. [`step`](Model::step), once for every `fmi2DoStep`; inputs and tunable parameters may be set in between, and
///    [`tune`](Model::tune) runs after each change of tunable parameters.
///
/// No method may write to the standard streams. A panic becomes `fmi2Error`.
pub trait Model: Declare + Clone + Serialize + DeserializeOwned {
    /// Computes states and outputs at the start time from parameters and inputs alone, so that it may be called again
    /// after a change.
    ///
    /// # Errors
    /// A [`Refusal`] that names the parameter, its value and what was expected; the instance stays in Initialization
    /// Mode with all values kept.
    fn initialize(&mut self, start_time: f64, log: &mut Log<'_>) -> Result<(), Refusal>;

    /// Says where the FMU's unpacked `resources` folder is, if the importer told: after instantiation, after a reset and
    /// after a state was set (which may come from another machine).
    fn located(&mut self, resources: Option<&Path>) {
        let _ = resources;
    }

    /// Takes over changed tunable parameters during the run.
    ///
    /// # Errors
    /// A [`Refusal`]; the C interface then restores the model as it was before the Set.
    fn tune(&mut self, log: &mut Log<'_>) -> Result<(), Refusal> {
        let _ = log;
        Ok(())
    }

    /// Whether the model can make `step` at all, asked before anything changes. See [`Step::at_most`].
    ///
    /// # Errors
    /// A [`Refusal`]; the instance stays as it was.
    fn accepts(&self, step: &Step) -> Result<(), Refusal> {
        let _ = step;
        Ok(())
    }

    /// Whether the state can be that of a run whose time is `clock`'s: asked of an initialized state that came as bytes. A model says no
    /// to what would make a step hang or panic: a counter that is not that of the time, a place beyond a list's end.
    ///
    /// # Errors
    /// A [`Refusal`] that names the value and what was expected; the bytes are then no state.
    fn fits(&self, clock: &Clock) -> Result<(), Refusal> {
        let _ = clock;
        Ok(())
    }

    /// The parameter that is the sample period, and its value (s): of a sampled model that has one. In scheduled execution the
    /// description's clock has its start value as constant interval, so any other value is refused there, by this name.
    fn sample_period(&self) -> Option<(&'static str, f64)> {
        None
    }

    /// Advances over `step`. Must not allocate.
    ///
    /// # Errors
    /// A [`Refusal`] that says what failed; the instance is then in the error state of the standard.
    fn step(&mut self, step: Step, log: &mut Log<'_>) -> Result<(), Refusal>;
}

/// Why a model refuses: a full sentence part that names the variable, the value and what was expected.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal(pub String);

impl Refusal {
    /// From anything that can be displayed, for instance a law's parameter error.
    pub fn new(reason: impl core::fmt::Display) -> Self {
        Self(reason.to_string())
    }
}

impl core::fmt::Display for Refusal {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.0)
    }
}
