//! The phases of an instance's life (FMI 2.0.5, section 4.2.4), and how to get there.

use crate::{Fmu, Instance, Status};

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
    /// error; only the test model has a switch that leads here.
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

    /// The phases into which an instance of this FMU can be driven on purpose.
    pub fn reachable(fmu: &Fmu) -> &'static [Self] {
        &Self::ALL[..if fmu.name == "Lag" { 5 } else { 4 }]
    }

    /// A new instance in this phase, at time 0, with an empty log.
    ///
    /// # Panics
    /// When a call on the way does not return what it should.
    pub fn enter(self, fmu: &Fmu) -> Instance {
        let instance = fmu.instantiate();
        if self != Self::Instantiated {
            assert_eq!(instance.setup_experiment(0.0, None), Status::OK);
            assert_eq!(instance.enter_initialization_mode(), Status::OK);
        }
        if !matches!(self, Self::Instantiated | Self::InitializationMode) {
            assert_eq!(instance.exit_initialization_mode(), Status::OK);
        }
        match self {
            Self::Terminated => assert_eq!(instance.terminate(), Status::OK),
            Self::Error => {
                let panic = fmu.reference("panic");
                assert_eq!(instance.set_boolean(&[panic], &[1]), Status::OK);
                assert_eq!(instance.step(0.0, 0.01), Status::ERROR);
            }
            _ => {}
        }
        instance.messages();
        instance
    }
}
