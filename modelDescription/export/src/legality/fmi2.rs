//! Which function may be called in which phase: the table of FMI 2.0.5, section 4.2.4, as data.
//!
//! The standard's states that do not occur here: *step in progress* and *step canceled* (steps are synchronous),
//! *step failed* (`fmi2Discard` is never returned), *fatal* (`fmi2Fatal` is never returned).
//!
//! Deviations, each because importers do it and nothing is lost:
//! * Get is accepted right after instantiation and reads the start values (the standard: from Initialization Mode on);
//! * Set of inputs is accepted before Initialization Mode (the standard: only variables with `initial="exact"`);
//! * `fmi2EnterInitializationMode` is accepted without `fmi2SetupExperiment` (start time 0, no stop time);
//! * `fmi2GetRealStatus(fmi2LastSuccessfulTime)` and `fmi2GetBooleanStatus(fmi2Terminated)` are answered in the error phase
//!   too (the standard: not there), where the last successful time is what one wants to know; the other status functions
//!   and `fmi2CancelStep` (the standard: while a step is pending only) are refused anyway, with what is not supported.

use super::{Call, Interface, Phase, table};

impl Call for Function {
    type State = Phase;

    #[inline]
    fn name(self, _: Interface) -> &'static str {
        Self::name(self)
    }

    #[inline]
    fn legal_in(self) -> &'static [Phase] {
        Self::legal_in(self)
    }

    #[inline]
    fn state(phase: Phase, _: Interface) -> Phase {
        phase
    }

    fn state_name(state: Phase, _: Interface) -> &'static str {
        state.name()
    }
}

// n: instantiated, i: Initialization Mode, s: step complete, t: terminated, e: error
table! { Phase:
    n => Instantiated, i => InitializationMode, s => StepComplete, t => Terminated, e => Error;

    fmi2SetDebugLogging:           n i s t e;
    fmi2FreeInstance:              n i s t e;
    fmi2SetupExperiment:           n;
    fmi2EnterInitializationMode:   n;
    fmi2ExitInitializationMode:      i;
    fmi2Terminate:                     s;
    fmi2Reset:                     n i s t e;
    fmi2GetReal:                   n i s t e;
    fmi2GetInteger:                n i s t e;
    fmi2GetBoolean:                n i s t e;
    fmi2GetString:                 n i s t e;
    fmi2SetReal:                   n i s;
    fmi2SetInteger:                n i s;
    fmi2SetBoolean:                n i s;
    fmi2SetString:                 n i s;
    fmi2GetFMUstate:               n i s t e;
    fmi2SetFMUstate:               n i s t e;
    fmi2FreeFMUstate:              n i s t e;
    fmi2SerializedFMUstateSize:    n i s t e;
    fmi2SerializeFMUstate:         n i s t e;
    fmi2DeSerializeFMUstate:       n i s t e;
    fmi2GetDirectionalDerivative:    i s t e;
    fmi2SetRealInputDerivatives:   n i s;
    fmi2GetRealOutputDerivatives:      s t e;
    fmi2DoStep:                        s;
    fmi2CancelStep:                    s;
    fmi2GetStatus:                     s t e;
    fmi2GetRealStatus:                 s t e;
    fmi2GetIntegerStatus:              s t e;
    fmi2GetBooleanStatus:              s t e;
    fmi2GetStringStatus:               s t e;
}
