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

/// Where an instance is in its life.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Phase {
    /// After `fmi2Instantiate` or `fmi2Reset`.
    Instantiated,
    /// After `fmi2EnterInitializationMode`.
    InitializationMode,
    /// After `fmi2ExitInitializationMode` and after each successful step (the standard's *step complete*).
    StepComplete,
    /// After `fmi2Terminate`.
    Terminated,
    /// After a caught panic or a failed step.
    Error,
}

impl Phase {
    /// Name as in the standard.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Instantiated => "instantiated",
            Self::InitializationMode => "Initialization Mode",
            Self::StepComplete => "step complete",
            Self::Terminated => "terminated",
            Self::Error => "error",
        }
    }
}

macro_rules! table {
    ($($function:ident: $($letter:ident)*;)*) => {
        /// A function of the interface that is called on an instance.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(non_camel_case_types, reason = "the C names of the standard")]
        pub enum Function {
            $(#[doc = concat!("`", stringify!($function), "`")] $function,)*
        }

        impl Function {
            /// All of them.
            pub const LIST: &[Self] = &[$(Self::$function),*];

            /// Its C name.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$function => stringify!($function)),* }
            }

            /// The phases in which it is legal.
            pub const fn legal_in(self) -> &'static [Phase] {
                match self { $(Self::$function => &[$(table!(@ $letter)),*]),* }
            }
        }
    };
    (@ n) => { Phase::Instantiated };
    (@ i) => { Phase::InitializationMode };
    (@ s) => { Phase::StepComplete };
    (@ t) => { Phase::Terminated };
    (@ e) => { Phase::Error };
}

// n: instantiated, i: Initialization Mode, s: step complete, t: terminated, e: error
table! {
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

impl Function {
    /// Whether the function may be called in `phase`.
    pub fn is_legal_in(self, phase: Phase) -> bool {
        self.legal_in().contains(&phase)
    }
}
