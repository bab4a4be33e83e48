//! The table of FMI 3.0.3: what the state descriptions of sections 2.3, 4.2 and 5.2 allow, as data.
//!
//! States of the standard that no instance here enters, with the functions that only they have (an empty row; such a call
//! is refused with the capability that is missing):
//! * *Configuration Mode*, *Reconfiguration Mode*: there is no structural parameter;
//! * *Event Mode*: `hasEventMode` is false; *Continuous-Time Mode*: there is no Model Exchange;
//! * *Intermediate Update Mode*: `providesIntermediateUpdate` is false, so the callback is never called;
//! * *Clock Update Mode*: the one clock is an input clock.
//!
//! After an error the standard's state is *Terminated*: an instance whose model broke is in it, and leaves it by
//! `fmi3Reset`, `fmi3SetFMUState` and `fmi3FreeInstance`.
//!
//! Deviations, each because importers do it and nothing is lost:
//! * a refused call changes nothing and leaves the instance in its state (the standard: any `fmi3Error` leads to *Terminated*);
//!   what is legal in *Terminated* is legal in every other state too, so an importer that counts on it finds it;
//! * Get is accepted after Set without a step or an activation between them, and shows what was set;

use super::{Call, Interface, Phase, table};

/// Where an instance is in its life, in the words of FMI 3.0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// After instantiation or `fmi3Reset`.
    Instantiated,
    /// After `fmi3EnterInitializationMode`.
    InitializationMode,
    /// Co-simulation, after `fmi3ExitInitializationMode`.
    StepMode,
    /// Scheduled execution, after `fmi3ExitInitializationMode`.
    ClockActivationMode,
    /// After `fmi3Terminate`, or after a caught panic or a failed step.
    Terminated,
}

impl State {
    /// Name as in the standard.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Instantiated => "Instantiated",
            Self::InitializationMode => "Initialization Mode",
            Self::StepMode => "Step Mode",
            Self::ClockActivationMode => "Clock Activation Mode",
            Self::Terminated => "Terminated",
        }
    }
}

impl Call for Function {
    type State = State;

    #[inline]
    fn name(self, _: Interface) -> &'static str {
        Self::name(self)
    }

    #[inline]
    fn legal_in(self) -> &'static [State] {
        Self::legal_in(self)
    }

    #[inline]
    fn state(phase: Phase, interface: Interface) -> State {
        match phase {
            Phase::Instantiated => State::Instantiated,
            Phase::InitializationMode => State::InitializationMode,
            Phase::StepComplete if interface == Interface::ScheduledExecution => {
                State::ClockActivationMode
            }
            Phase::StepComplete => State::StepMode,
            Phase::Terminated | Phase::Error => State::Terminated,
        }
    }

    fn state_name(state: State, _: Interface) -> &'static str {
        state.name()
    }
}

// n: Instantiated, i: Initialization Mode, s: Step Mode, c: Clock Activation Mode, t: Terminated
table! { State:
    n => Instantiated, i => InitializationMode, s => StepMode, c => ClockActivationMode, t => Terminated;

    fmi3SetDebugLogging:                n i s c t;
    fmi3FreeInstance:                   n i s c t;
    fmi3EnterInitializationMode:        n;
    fmi3ExitInitializationMode:           i;
    fmi3EnterEventMode:                     s;
    fmi3Terminate:                          s c;
    fmi3Reset:                          n i s c t;
    fmi3GetFloat32:                     n i s c t;
    fmi3GetFloat64:                     n i s c t;
    fmi3GetInt8:                        n i s c t;
    fmi3GetUInt8:                       n i s c t;
    fmi3GetInt16:                       n i s c t;
    fmi3GetUInt16:                      n i s c t;
    fmi3GetInt32:                       n i s c t;
    fmi3GetUInt32:                      n i s c t;
    fmi3GetInt64:                       n i s c t;
    fmi3GetUInt64:                      n i s c t;
    fmi3GetBoolean:                     n i s c t;
    fmi3GetString:                      n i s c t;
    fmi3GetBinary:                      n i s c t;
    fmi3GetClock:;
    fmi3SetFloat32:                     n i s c;
    fmi3SetFloat64:                     n i s c;
    fmi3SetInt8:                        n i s c;
    fmi3SetUInt8:                       n i s c;
    fmi3SetInt16:                       n i s c;
    fmi3SetUInt16:                      n i s c;
    fmi3SetInt32:                       n i s c;
    fmi3SetUInt32:                      n i s c;
    fmi3SetInt64:                       n i s c;
    fmi3SetUInt64:                      n i s c;
    fmi3SetBoolean:                     n i s c;
    fmi3SetString:                      n i s c;
    fmi3SetBinary:                      n i s c;
    fmi3SetClock:;
    fmi3GetNumberOfVariableDependencies:n i s c t;
    fmi3GetVariableDependencies:        n i s c t;
    fmi3GetFMUState:                    n i s c t;
    fmi3SetFMUState:                    n i s c t;
    fmi3FreeFMUState:                   n i s c t;
    fmi3SerializedFMUStateSize:         n i s c t;
    fmi3SerializeFMUState:              n i s c t;
    fmi3DeserializeFMUState:            n i s c t;
    fmi3GetDirectionalDerivative:         i s c t;
    fmi3GetAdjointDerivative:             i s c t;
    fmi3EnterConfigurationMode:         n   s c;
    fmi3ExitConfigurationMode:;
    fmi3GetIntervalDecimal:               i   c;
    fmi3GetIntervalFraction:              i   c;
    fmi3GetShiftDecimal:                  i;
    fmi3GetShiftFraction:                 i;
    fmi3SetIntervalDecimal:               i   c;
    fmi3SetIntervalFraction:              i   c;
    fmi3SetShiftDecimal:                  i;
    fmi3SetShiftFraction:                 i;
    fmi3EvaluateDiscreteStates:;
    fmi3UpdateDiscreteStates:;
    fmi3EnterContinuousTimeMode:;
    fmi3CompletedIntegratorStep:;
    fmi3SetTime:;
    fmi3SetContinuousStates:;
    fmi3GetContinuousStateDerivatives:;
    fmi3GetEventIndicators:;
    fmi3GetContinuousStates:;
    fmi3GetNominalsOfContinuousStates:;
    fmi3GetNumberOfEventIndicators:;
    fmi3GetNumberOfContinuousStates:;
    fmi3EnterStepMode:;
    fmi3GetOutputDerivatives:               s   t;
    fmi3DoStep:                             s;
    fmi3ActivateModelPartition:               c;
}
