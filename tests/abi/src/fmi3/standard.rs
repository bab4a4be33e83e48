//! Which call FMI 3.0.3 allows in which state (sections 2.3, 3.2, 4.2 and 5.2), and where these FMUs differ from it on
//! purpose.

/// Columns of [`TABLE`]. An instance is only ever in one of those that [`State`] names: see [`UNREACHABLE`].
const COLUMNS: [&str; 11] = [
    "Instantiated",
    "Configuration Mode",
    "Initialization Mode",
    "Event Mode",
    "Continuous-Time Mode",
    "Step Mode",
    "Intermediate Update Mode",
    "Reconfiguration Mode",
    "Clock Activation Mode",
    "Clock Update Mode",
    "Terminated",
];

/// States of the standard into which no instance of these FMUs gets, and why.
pub const UNREACHABLE: [(&str, &str); 6] = [
    ("Configuration Mode", "there is no structural parameter"),
    ("Event Mode", "hasEventMode is false"),
    ("Continuous-Time Mode", "there is no Model Exchange"),
    (
        "Intermediate Update Mode",
        "providesIntermediateUpdate is false",
    ),
    ("Reconfiguration Mode", "there is no structural parameter"),
    ("Clock Update Mode", "the clock is an input"),
];

/// `x`: legal. `m`: legal for Model Exchange only. `.`: not legal.
const TABLE: &str = "
                                        inst  conf  init  event cont  step  inter recon act   upd   term
    fmi3SetDebugLogging                 x     x     x     x     x     x     x     x     x     x     x
    fmi3FreeInstance                    x     x     x     x     x     x     .     x     x     .     x
    fmi3EnterInitializationMode         x     .     .     .     .     .     .     .     .     .     .
    fmi3ExitInitializationMode          .     .     x     .     .     .     .     .     .     .     .
    fmi3EnterEventMode                  .     .     .     .     x     x     .     .     .     .     .
    fmi3Terminate                       .     .     .     x     x     x     .     x     x     .     .
    fmi3Reset                           x     x     x     x     x     x     .     x     x     .     x
    fmi3GetFloat32                      x     .     x     x     x     x     x     .     x     .     x
    fmi3GetFloat64                      x     .     x     x     x     x     x     .     x     .     x
    fmi3GetInt8                         x     .     x     x     x     x     x     .     x     .     x
    fmi3GetUInt8                        x     .     x     x     x     x     x     .     x     .     x
    fmi3GetInt16                        x     .     x     x     x     x     x     .     x     .     x
    fmi3GetUInt16                       x     .     x     x     x     x     x     .     x     .     x
    fmi3GetInt32                        x     .     x     x     x     x     x     .     x     .     x
    fmi3GetUInt32                       x     .     x     x     x     x     x     .     x     .     x
    fmi3GetInt64                        x     .     x     x     x     x     x     .     x     .     x
    fmi3GetUInt64                       x     .     x     x     x     x     x     .     x     .     x
    fmi3GetBoolean                      x     .     x     x     x     x     x     .     x     .     x
    fmi3GetString                       x     .     x     x     x     x     x     .     x     .     x
    fmi3GetBinary                       x     .     x     x     x     x     x     .     x     .     x
    fmi3GetClock                        .     .     .     x     .     .     .     .     .     x     .
    fmi3SetFloat32                      x     x     x     x     x     x     x     x     x     .     .
    fmi3SetFloat64                      x     x     x     x     x     x     x     x     x     .     .
    fmi3SetInt8                         x     x     x     x     x     x     x     x     x     .     .
    fmi3SetUInt8                        x     x     x     x     x     x     x     x     x     .     .
    fmi3SetInt16                        x     x     x     x     x     x     x     x     x     .     .
    fmi3SetUInt16                       x     x     x     x     x     x     x     x     x     .     .
    fmi3SetInt32                        x     x     x     x     x     x     x     x     x     .     .
    fmi3SetUInt32                       x     x     x     x     x     x     x     x     x     .     .
    fmi3SetInt64                        x     x     x     x     x     x     x     x     x     .     .
    fmi3SetUInt64                       x     x     x     x     x     x     x     x     x     .     .
    fmi3SetBoolean                      x     x     x     x     x     x     x     x     x     .     .
    fmi3SetString                       x     x     x     x     x     x     x     x     x     .     .
    fmi3SetBinary                       x     x     x     x     x     x     x     x     x     .     .
    fmi3SetClock                        .     .     .     x     .     .     .     .     .     .     .
    fmi3GetNumberOfVariableDependencies x     .     x     x     x     x     x     .     x     x     x
    fmi3GetVariableDependencies         x     .     x     x     x     x     x     .     x     x     x
    fmi3GetFMUState                     x     x     x     x     x     x     .     x     x     .     x
    fmi3SetFMUState                     x     x     x     x     x     x     .     x     x     .     x
    fmi3FreeFMUState                    x     x     x     x     x     x     .     x     x     .     x
    fmi3SerializedFMUStateSize          x     x     x     x     x     x     .     x     x     .     x
    fmi3SerializeFMUState               x     x     x     x     x     x     .     x     x     .     x
    fmi3DeserializeFMUState             x     x     x     x     x     x     .     x     x     .     x
    fmi3GetDirectionalDerivative        .     .     x     x     x     x     .     .     x     .     x
    fmi3GetAdjointDerivative            .     .     x     x     x     x     .     .     x     .     x
    fmi3EnterConfigurationMode          x     .     .     x     .     x     .     .     x     .     .
    fmi3ExitConfigurationMode           .     x     .     .     .     .     .     x     .     .     .
    fmi3GetIntervalDecimal              .     .     x     x     .     .     .     .     x     x     .
    fmi3GetIntervalFraction             .     .     x     x     .     .     .     .     x     x     .
    fmi3GetShiftDecimal                 .     .     x     .     .     .     .     .     .     .     .
    fmi3GetShiftFraction                .     .     x     .     .     .     .     .     .     .     .
    fmi3SetIntervalDecimal              .     .     x     x     .     .     .     .     x     .     .
    fmi3SetIntervalFraction             .     .     x     x     .     .     .     .     x     .     .
    fmi3SetShiftDecimal                 .     .     x     .     .     .     .     .     .     .     .
    fmi3SetShiftFraction                .     .     x     .     .     .     .     .     .     .     .
    fmi3EvaluateDiscreteStates          .     .     .     x     .     .     .     .     .     .     .
    fmi3UpdateDiscreteStates            .     .     .     x     .     .     .     .     .     .     .
    fmi3EnterContinuousTimeMode         .     .     .     x     .     .     .     .     .     .     .
    fmi3CompletedIntegratorStep         .     .     .     .     x     .     .     .     .     .     .
    fmi3SetTime                         .     .     .     .     x     .     .     .     .     .     .
    fmi3SetContinuousStates             .     .     .     .     x     .     .     .     .     .     .
    fmi3GetContinuousStateDerivatives   m     .     m     m     m     .     .     .     .     .     m
    fmi3GetEventIndicators              m     .     m     m     m     .     .     .     .     .     m
    fmi3GetContinuousStates             m     .     m     m     m     .     .     .     .     .     m
    fmi3GetNominalsOfContinuousStates   m     .     m     m     m     .     .     .     .     .     m
    fmi3GetNumberOfEventIndicators      m     .     m     m     m     .     .     .     .     .     m
    fmi3GetNumberOfContinuousStates     m     .     m     m     m     .     .     .     .     .     m
    fmi3EnterStepMode                   .     .     .     x     .     .     .     .     .     .     .
    fmi3GetOutputDerivatives            .     .     .     .     .     x     x     .     .     .     x
    fmi3DoStep                          .     .     .     .     .     x     .     .     .     .     .
    fmi3ActivateModelPartition          .     .     .     .     .     .     .     .     x     .     .
";

/// A state in which an instance can be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// Instantiated
    Instantiated,
    /// Initialization Mode
    InitializationMode,
    /// Step Mode
    StepMode,
    /// Clock Activation Mode
    ClockActivationMode,
    /// Terminated, by fmi3Terminate
    Terminated,
    /// Terminated, by a step that failed
    Failed,
}

impl State {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::Instantiated,
        Self::InitializationMode,
        Self::StepMode,
        Self::ClockActivationMode,
        Self::Terminated,
        Self::Failed,
    ];

    /// Name as in the standard.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Instantiated => "Instantiated",
            Self::InitializationMode => "Initialization Mode",
            Self::StepMode => "Step Mode",
            Self::ClockActivationMode => "Clock Activation Mode",
            Self::Terminated | Self::Failed => "Terminated",
        }
    }
}

/// Accepted although the standard's text says no: what, and why.
pub const DEVIATIONS_FROM_THE_TEXT: [(&str, &str); 2] = [
    (
        "a call after one that was refused",
        "nothing has changed; what is legal in *Terminated*, where the standard is then, is legal in each state",
    ),
    (
        "fmi3Get… after fmi3Set… without a step between them",
        "importers show all variables; what was set is read",
    ),
];

/// Functions that are refused where they are legal, too, with a part of the reason that is given.
pub const UNSUPPORTED: [(&str, &str); 29] = [
    ("fmi3EnterEventMode", "hasEventMode"),
    ("fmi3EnterStepMode", "hasEventMode"),
    ("fmi3EvaluateDiscreteStates", "hasEventMode"),
    ("fmi3UpdateDiscreteStates", "hasEventMode"),
    ("fmi3SetClock", "hasEventMode"),
    ("fmi3GetClock", "no clock is an output"),
    (
        "fmi3GetNumberOfVariableDependencies",
        "providesPerElementDependencies",
    ),
    (
        "fmi3GetVariableDependencies",
        "providesPerElementDependencies",
    ),
    (
        "fmi3GetDirectionalDerivative",
        "providesDirectionalDerivatives",
    ),
    ("fmi3GetAdjointDerivative", "providesAdjointDerivatives"),
    ("fmi3EnterConfigurationMode", "structural parameter"),
    ("fmi3ExitConfigurationMode", "structural parameter"),
    ("fmi3GetIntervalFraction", "supportsFraction"),
    ("fmi3GetShiftFraction", "supportsFraction"),
    ("fmi3SetIntervalFraction", "supportsFraction"),
    ("fmi3SetShiftFraction", "supportsFraction"),
    ("fmi3SetIntervalDecimal", "intervalVariability"),
    ("fmi3SetShiftDecimal", "intervalVariability"),
    ("fmi3GetOutputDerivatives", "maxOutputDerivativeOrder"),
    ("fmi3EnterContinuousTimeMode", "ModelExchange"),
    ("fmi3CompletedIntegratorStep", "ModelExchange"),
    ("fmi3SetTime", "ModelExchange"),
    ("fmi3SetContinuousStates", "ModelExchange"),
    ("fmi3GetContinuousStateDerivatives", "ModelExchange"),
    ("fmi3GetEventIndicators", "ModelExchange"),
    ("fmi3GetContinuousStates", "ModelExchange"),
    ("fmi3GetNominalsOfContinuousStates", "ModelExchange"),
    ("fmi3GetNumberOfEventIndicators", "ModelExchange"),
    ("fmi3GetNumberOfContinuousStates", "ModelExchange"),
];

/// What a call with good arguments comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// fmi3OK.
    Accepted,
    /// Refused, with this in the reason.
    Refused(&'static str),
}

/// Rows of the table: function and marks by column.
pub fn rows() -> Vec<(&'static str, Vec<&'static str>)> {
    let rows = TABLE.lines().filter(|line| line.contains("fmi3"));
    rows.map(|line| {
        let mut words = line.split_whitespace();
        (words.next().unwrap_or_default(), words.collect())
    })
    .collect()
}

/// What the standard says.
///
/// # Panics
/// When the function has no row.
pub fn legal(function: &str, state: State) -> bool {
    let column = COLUMNS.iter().position(|&name| name == state.name());
    let rows = rows();
    let (_, marks) = rows
        .iter()
        .find(|(name, _)| *name == function)
        .unwrap_or_else(|| panic!("the table has no {function}"));
    column.is_some_and(|column| marks[column] == "x")
}

/// What these FMUs do.
pub fn verdict(function: &str, state: State) -> Verdict {
    let lacking = UNSUPPORTED.iter().find(|(name, _)| *name == function);
    let somewhere = State::ALL.into_iter().any(|state| legal(function, state));
    match (legal(function, state) || !somewhere, lacking) {
        (true, None) => Verdict::Accepted,
        (true, Some((_, reason))) => Verdict::Refused(reason),
        (false, _) => Verdict::Refused(state.name()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fmi3::Library;

    #[test]
    fn the_table_has_all_functions_that_are_called_on_an_instance_in_all_eleven_states() {
        let mut names: Vec<_> = rows().iter().map(|(name, _)| *name).collect();
        let mut expected: Vec<_> = Library::FUNCTIONS.into();
        expected.retain(|name| *name != "fmi3GetVersion" && !name.contains("Instantiate"));
        names.sort_unstable();
        expected.sort_unstable();
        assert_eq!(names, expected);
        for (name, marks) in rows() {
            assert_eq!(marks.len(), COLUMNS.len(), "{name}");
            assert!(
                marks.iter().all(|mark| ["x", "m", "."].contains(mark)),
                "{name}"
            );
        }
    }

    #[test]
    fn every_state_of_the_standard_can_be_entered_or_has_a_reason_why_not() {
        let mut all: Vec<_> = State::ALL.map(State::name).into();
        all.extend(UNREACHABLE.map(|(name, _)| name));
        all.sort_unstable();
        all.dedup();
        let mut columns = COLUMNS;
        columns.sort_unstable();
        assert_eq!(all, columns);
    }

    #[test]
    fn what_is_legal_in_terminated_is_legal_in_every_state() {
        let rows = rows();
        for (name, _) in rows
            .iter()
            .filter(|(name, _)| legal(name, State::Terminated))
        {
            for state in State::ALL {
                let only_then = [
                    "fmi3GetDirectionalDerivative",
                    "fmi3GetAdjointDerivative",
                    "fmi3GetOutputDerivatives",
                ];
                assert!(
                    legal(name, state) || only_then.contains(name),
                    "{name}, {state:?}"
                );
            }
        }
    }
}
