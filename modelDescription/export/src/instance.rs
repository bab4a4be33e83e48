//! One instance of a model: life cycle, steps, FMU state. Access to variables is in [`crate::access`].

use crate::clock::{Clock, NotNext};
use crate::failure::{Failure, Outcome};
use crate::legality::{Interface, Phase};
use crate::log::{self, Category, Enabled, Log, Sink};
use crate::model::Model;
use crate::outputs::Outputs;
use crate::routes::Routes;
use crate::slots::Slots;
use crate::snapshot::Snapshot;
use crate::stop::StopTime;
use fmu_declaration::Brief;
use std::ffi::{CStr, CString};
use std::path::PathBuf;

/// One instance.
pub struct Instance<M: Model> {
    sink: Sink,
    name: CString,
    enabled: Enabled,
    resources: Option<PathBuf>,
    interface: Interface,
    stop_time: StopTime,
    /// What an FMU state holds.
    pub(crate) now: Snapshot<M>,
    /// In Initialization Mode: something was set since the model was last initialized.
    pub(crate) stale: bool,
    outputs: Outputs<M>,
    pub(crate) slots: Slots<M>,
    pub(crate) routes: Routes<M>,
    /// Strings handed to the importer, alive until its next call.
    pub(crate) strings: Vec<CString>,
    /// Binaries handed to the importer, alive until its next call.
    pub(crate) binaries: Vec<Vec<u8>>,
}

impl<M: Model> Instance<M> {
    /// A new instance with start values, whose resources are in the folder.
    pub(crate) fn new(
        sink: Sink,
        name: CString,
        enabled: Enabled,
        resources: Option<PathBuf>,
        interface: Interface,
    ) -> Self {
        let now = Snapshot {
            phase: Phase::Instantiated,
            clock: Clock::default(),
            model: M::default(),
        };
        let mut instance = Self {
            sink,
            name,
            enabled,
            resources,
            interface,
            stop_time: StopTime::default(),
            now,
            stale: false,
            outputs: Outputs::new(),
            slots: Slots::new(),
            routes: Routes::default(),
            strings: Vec::new(),
            binaries: Vec::new(),
        };
        instance.now.model.located(instance.resources.as_deref());
        instance
    }

    /// Where the instance is in its life.
    pub fn phase(&self) -> Phase {
        self.now.phase
    }

    /// What is called on it.
    pub fn interface(&self) -> Interface {
        self.interface
    }

    pub(crate) fn enter_error(&mut self) {
        self.now.phase = Phase::Error;
    }

    pub(crate) fn log(&self) -> Log<'_> {
        Log::new(&self.sink, &self.name, self.enabled)
    }

    /// The model with a log beside it.
    pub(crate) fn model_and_log(&mut self) -> (&mut M, Log<'_>) {
        (
            &mut self.now.model,
            Log::new(&self.sink, &self.name, self.enabled),
        )
    }

    /// fmi2SetDebugLogging, fmi3SetDebugLogging
    pub(crate) fn set_debug_logging<'a>(
        &mut self,
        on: bool,
        categories: impl ExactSizeIterator<Item = Option<&'a str>>,
    ) -> Outcome {
        let mut enabled = if categories.len() == 0 {
            Enabled::all(on)
        } else {
            self.enabled
        };
        for name in categories {
            let known = |c: &&Category| Some(c.name().0) == name.and_then(c_name).as_deref();
            match Category::LIST.iter().find(known) {
                Some(&category) => enabled.set(category, on),
                None if name == log::ALL.to_str().ok() => enabled = Enabled::all(on),
                None => {
                    let expected = Category::LIST
                        .map(|c| c.name().0.to_string_lossy().into_owned())
                        .join(", ");
                    let got = name.unwrap_or("(null or not UTF-8)");
                    return refused(format!(
                        "unknown log category '{got}', expected {expected} or logAll"
                    ));
                }
            }
        }
        self.enabled = enabled;
        Ok(())
    }

    /// fmi2SetupExperiment, and the arguments of fmi3EnterInitializationMode
    pub(crate) fn setup_experiment(
        &mut self,
        tolerance: Option<f64>,
        start_time: f64,
        stop: Option<f64>,
    ) -> Outcome {
        if !start_time.is_finite() {
            return refused(format!(
                "startTime = {start_time} s, expected a finite time"
            ));
        }
        if let Some(stop) = stop.filter(|&stop| stop.is_nan() || stop < start_time) {
            let (stop, start_time) = (Brief(stop), Brief(start_time));
            return refused(format!(
                "stopTime = {stop} s, expected at least startTime = {start_time} s"
            ));
        }
        if let Some(tolerance) = tolerance.filter(|t| !t.is_finite() || *t < 0.0) {
            let tolerance = Brief(tolerance);
            return refused(format!(
                "tolerance = {tolerance}, expected a finite value, at least 0"
            ));
        }
        self.now.clock = Clock::at_start(start_time);
        self.stop_time = StopTime::new(stop);
        Ok(())
    }

    /// fmi2EnterInitializationMode, fmi3EnterInitializationMode
    pub(crate) fn enter_initialization_mode(&mut self) -> Outcome {
        self.now.phase = Phase::InitializationMode;
        self.stale = true;
        Ok(())
    }

    /// fmi2ExitInitializationMode, fmi3ExitInitializationMode
    pub(crate) fn exit_initialization_mode(&mut self) -> Outcome {
        self.initialize()?;
        self.routes.make_room();
        self.now.phase = Phase::StepComplete;
        let start_time = Brief(self.now.clock.start_time());
        self.log().event(format_args!(
            "{} initialized at t = {start_time} s",
            M::DESCRIPTION.name
        ));
        Ok(())
    }

    /// Initializes the model if something was set since; a refusal keeps the model as it was.
    pub(crate) fn initialize(&mut self) -> Outcome {
        if self.stale {
            self.keeps_the_interval(&self.now.model)?;
            let mut candidate = self.now.model.clone();
            let start_time = self.now.clock.start_time();
            candidate
                .initialize(start_time, &mut self.log())
                .map_err(|refusal| refusal.0)?;
            self.outputs.check(&candidate).map_err(Failure::Refused)?;
            self.now.model = candidate;
            self.stale = false;
        }
        Ok(())
    }

    /// fmi2Terminate, fmi3Terminate
    pub(crate) fn terminate(&mut self) -> Outcome {
        self.now.phase = Phase::Terminated;
        let time = Brief(self.now.clock.time());
        self.log().event(format_args!(
            "{} terminated at t = {time} s",
            M::DESCRIPTION.name
        ));
        Ok(())
    }

    /// fmi2Reset, fmi3Reset
    pub(crate) fn reset(&mut self) -> Outcome {
        self.now = Snapshot {
            phase: Phase::Instantiated,
            clock: Clock::default(),
            model: M::default(),
        };
        self.now.model.located(self.resources.as_deref());
        self.stop_time = StopTime::default();
        self.stale = false;
        Ok(())
    }

    /// fmi2DoStep, fmi3DoStep, fmi3ActivateModelPartition: the step from `t` of `h` (s).
    pub(crate) fn step(&mut self, t: f64, h: f64) -> Outcome {
        let step = match self.now.clock.next(t, h) {
            Ok(step) => step,
            Err(why) => return Err(self.not_next(why, t, h)),
        };
        if let Some(past) = self.stop_time.objection(&step, self.interface) {
            return refused(past);
        }
        self.now.model.accepts(&step).map_err(|refusal| refusal.0)?;
        let (model, mut log) = self.model_and_log();
        model
            .step(step, &mut log)
            .map_err(|refusal| Failure::Broken(refusal.0))?;
        self.outputs
            .check(&self.now.model)
            .map_err(Failure::Broken)?;
        self.now.clock.advance(&step);
        Ok(())
    }

    /// The independent variable: the end of the last step, or the time of the last activation, to a rounding (s).
    pub(crate) fn time(&self) -> f64 {
        let clock = &self.now.clock;
        match self.interface {
            Interface::ScheduledExecution if clock.elapsed() > 0.0 => {
                clock.time() - M::DESCRIPTION.experiment.step
            }
            _ => clock.time(),
        }
    }

    /// Why a step cannot follow, in the words of the function.
    #[cold]
    fn not_next(&self, why: NotNext, t: f64, h: f64) -> Failure {
        let clock = &self.now.clock;
        Failure::Refused(match self.interface {
            Interface::Fmi2 | Interface::CoSimulation => clock.sentence(why, t, h),
            Interface::ScheduledExecution => {
                let expected = clock.time();
                format!(
                    "activationTime = {t:?} s, expected {expected:?} s: the clock is activated every {h:?} s"
                )
            }
        })
    }

    /// Refuses a sample period that is not the clock's: the scheduler would call the ticks of another law.
    fn keeps_the_interval(&self, model: &M) -> Outcome {
        let interval = M::DESCRIPTION.experiment.step;
        match (self.interface, model.sample_period()) {
            (Interface::ScheduledExecution, Some((name, period))) if period != interval => {
                refused(format!(
                    "{name} = {period:?} s, expected {interval:?} s: the clock's interval is constant in the description"
                ))
            }
            _ => Ok(()),
        }
    }

    /// fmi2SetFMUstate, fmi3SetFMUState
    pub(crate) fn restore(&mut self, snapshot: &Snapshot<M>) -> Outcome {
        if snapshot.phase != Phase::Instantiated {
            self.keeps_the_interval(&snapshot.model)?;
        }
        self.now = snapshot.clone();
        self.now.model.located(self.resources.as_deref());
        self.stale = self.now.phase == Phase::InitializationMode;
        Ok(())
    }
}

/// A refusal as a result.
pub(crate) fn refused<T>(reason: String) -> Result<T, Failure> {
    Err(Failure::Refused(reason))
}

fn c_name(name: &str) -> Option<CString> {
    CString::new(name).ok()
}

/// The name under which an instance that could not be created logs.
pub(crate) fn instance_name(name: Option<&str>) -> CString {
    name.and_then(c_name)
        .filter(|n| !n.is_empty())
        .unwrap_or_else(|| CStr::to_owned(c"(unnamed)"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::Value;
    use crate::{Refusal, Step};
    use fmu_declaration::Variability::Continuous;
    use fmu_declaration::{Declare, Description, Experiment, Stepping, real, unit};

    /// Two readings, of which one may fail as NaN.
    #[derive(Clone, Default, serde::Serialize, serde::Deserialize)]
    struct Sensor {
        sound: f64,
        failing: [f64; 2],
        seen: f64,
    }

    impl Declare for Sensor {
        const DESCRIPTION: Description<Self> = Description {
            name: "Sensor",
            about: "readings",
            stepping: Stepping::Exact,
            experiment: Experiment {
                start: 0.0,
                stop: 1.0,
                tolerance: 1e-6,
                step: 0.1,
            },
            variables: &[
                real!(sound, unit::NEWTON).output(Continuous),
                real!(failing[2], unit::NEWTON)
                    .output(Continuous)
                    .may_be_nan(),
                real!(seen, unit::NEWTON).input(Continuous).may_be_nan(),
            ],
        };
    }

    impl Model for Sensor {
        fn initialize(&mut self, _: f64, _: &mut Log<'_>) -> Result<(), Refusal> {
            Ok(())
        }

        fn step(&mut self, _: Step, _: &mut Log<'_>) -> Result<(), Refusal> {
            Ok(())
        }
    }

    #[test]
    fn nan_leaves_a_model_only_where_its_row_says_so_and_infinity_nowhere() {
        let check = |sound, failing| {
            Outputs::new().check(&Sensor {
                sound,
                failing,
                seen: f64::INFINITY,
            })
        };
        assert_eq!(check(1.0, [2.0, f64::NAN]), Ok(()));
        let refused = |name, value| Err(format!("{name} = {value} N, expected a finite value"));
        assert_eq!(check(f64::NAN, [0.0; 2]), refused("sound", f64::NAN));
        let infinite = f64::INFINITY;
        assert_eq!(
            check(0.0, [f64::NAN, infinite]),
            refused("failing[2]", infinite)
        );
    }
    #[test]
    fn what_is_not_finite_enters_a_model_only_where_its_row_says_so() {
        let [sound, _, seen] = Sensor::DESCRIPTION.variables else {
            panic!("three rows")
        };
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(value.objection(seen), None);
            let refused = format!("= {value} N, expected a finite value");
            assert_eq!(value.objection(sound), Some(refused));
        }
    }
}
