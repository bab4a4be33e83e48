//! The phases of an instance's life (FMI 2.0.5, section 4.2.4), and how to get there.

use crate::{Fmu, Instance, Kind, Status};

/// A phase. The standard's *step in progress*, *step canceled*, *step failed* and *fatal* need a pending step, a discarded
/// step or fmi2Fatal, none of which the FMUs ever return.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// instantiated
    Instantiated,
    /// Initialization Mode
    InitializationMode,
    /// step complete
    StepComplete,
    /// terminated
    Terminated,
    /// error
    Error,
}

impl Phase {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Instantiated,
        Self::InitializationMode,
        Self::StepComplete,
        Self::Terminated,
        Self::Error,
    ];

    /// Name as in the standard's table.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Instantiated => "instantiated",
            Self::InitializationMode => "Initialization Mode",
            Self::StepComplete => "step complete",
            Self::Terminated => "terminated",
            Self::Error => "error",
        }
    }

    /// A new instance in this phase, with an empty log; at time 0, unless a first step was good before one failed.
    ///
    /// # Panics
    /// When a call on the way does not return what it should.
    pub fn enter(self, fmu: &Fmu) -> Instance {
        let instance = fmu.instantiate();
        if self == Self::Error {
            break_at_the_next_steps(fmu, &instance);
        } else if self != Self::Instantiated {
            assert_eq!(instance.setup_experiment(0.0, None), Status::OK);
            assert_eq!(instance.enter_initialization_mode(), Status::OK);
        }
        if matches!(self, Self::StepComplete | Self::Terminated) {
            assert_eq!(instance.exit_initialization_mode(), Status::OK);
        }
        if self == Self::Terminated {
            assert_eq!(instance.terminate(), Status::OK);
        }
        instance.messages();
        instance
    }
}

/// Parameters without which no input makes a step fail: the human's hand is off at the start.
const STIFFEST: [(&str, f64); 2] = [("k_h", 1e6), ("b_h", 1e6)];

/// Initializes and steps until a step fails: the test models by their switch, the others because a result is beyond all
/// numbers.
fn break_at_the_next_steps(fmu: &Fmu, instance: &Instance) {
    if fmu.name == "HumanOperator" {
        for (name, value) in STIFFEST {
            assert_eq!(
                instance.set_real(&[fmu.reference(name)], &[value]),
                Status::OK
            );
        }
    }
    instance.initialize(0.0);
    if fmu.variables.iter().any(|one| one.name == "panic") {
        assert_eq!(
            instance.set_boolean(&[fmu.reference("panic")], &[1]),
            Status::OK
        );
    } else {
        // A controller does not believe positions such as these: its forces alone.
        let inputs = fmu.variables.iter().filter(|v| v.causality == "input");
        let inputs = inputs.filter(|v| !v.name.starts_with('q'));
        for (i, input) in inputs.filter(|v| v.kind == Kind::Real {}).enumerate() {
            let value = if i % 2 == 0 { f64::MAX } else { -f64::MAX };
            assert_eq!(instance.set_real(&[input.reference], &[value]), Status::OK);
        }
    }
    // A sampled model shows what it computed one step ago.
    let broken = (0..3).any(|k| instance.step(f64::from(k) * 0.01, 0.01) == Status::ERROR);
    assert!(broken, "{}: no step fails", fmu.name);
}
