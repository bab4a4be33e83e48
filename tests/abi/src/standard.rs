//! The table of FMI 2.0.5, section 4.2.4, for co-simulation, and where these FMUs differ from it on purpose.

use crate::Phase;
use std::sync::OnceLock;

/// Columns of [`TABLE`]. An instance is only ever in one of those that [`Phase`] names: see [`UNREACHABLE`].
const COLUMNS: [&str; 10] = [
    "start and end",
    "instantiated",
    "Initialization Mode",
    "step complete",
    "step in progress",
    "step failed",
    "step canceled",
    "terminated",
    "error",
    "fatal",
];

/// States of the standard into which no instance of these FMUs gets, and why.
pub const UNREACHABLE: [(&str, &str); 5] = [
    ("start and end", "there is no instance yet, or no more"),
    ("step in progress", "fmi2Pending is never returned"),
    ("step failed", "fmi2Discard is never returned"),
    ("step canceled", "there is no step in progress to cancel"),
    ("fatal", "fmi2Fatal is never returned"),
];

/// `x`: legal. `v`: legal for some variables, which ones is in [`crate::rights`]. `.`: not legal.
const TABLE: &str = "
                                 start inst init done prog fail canc term error fatal
    fmi2GetTypesPlatform           x    x    x    x    x    x    x    x    x     .
    fmi2GetVersion                 x    x    x    x    x    x    x    x    x     .
    fmi2SetDebugLogging            .    x    x    x    x    x    x    x    x     .
    fmi2Instantiate                x    .    .    .    .    .    .    .    .     .
    fmi2FreeInstance               .    x    x    x    .    x    x    x    x     .
    fmi2SetupExperiment            .    x    .    .    .    .    .    .    .     .
    fmi2EnterInitializationMode    .    x    .    .    .    .    .    .    .     .
    fmi2ExitInitializationMode     .    .    x    .    .    .    .    .    .     .
    fmi2Terminate                  .    .    .    x    .    x    .    .    .     .
    fmi2Reset                      .    x    x    x    .    x    x    x    x     .
    fmi2GetReal                    .    .    v    x    .    x    x    x    x     .
    fmi2GetInteger                 .    .    v    x    .    x    x    x    x     .
    fmi2GetBoolean                 .    .    v    x    .    x    x    x    x     .
    fmi2GetString                  .    .    v    x    .    x    x    x    x     .
    fmi2SetReal                    .    v    v    v    .    .    .    .    .     .
    fmi2SetInteger                 .    v    v    v    .    .    .    .    .     .
    fmi2SetBoolean                 .    v    v    v    .    .    .    .    .     .
    fmi2SetString                  .    v    v    v    .    .    .    .    .     .
    fmi2GetFMUstate                .    x    x    x    .    x    x    x    x     .
    fmi2SetFMUstate                .    x    x    x    .    x    x    x    x     .
    fmi2FreeFMUstate               .    x    x    x    .    x    x    x    x     .
    fmi2SerializedFMUstateSize     .    x    x    x    .    x    x    x    x     .
    fmi2SerializeFMUstate          .    x    x    x    .    x    x    x    x     .
    fmi2DeSerializeFMUstate        .    x    x    x    .    x    x    x    x     .
    fmi2GetDirectionalDerivative   .    .    x    x    .    x    x    x    x     .
    fmi2SetRealInputDerivatives    .    x    x    x    .    .    .    .    .     .
    fmi2GetRealOutputDerivatives   .    .    .    x    .    x    x    x    x     .
    fmi2DoStep                     .    .    .    x    .    .    .    .    .     .
    fmi2CancelStep                 .    .    .    .    x    .    .    .    .     .
    fmi2GetStatus                  .    .    .    x    x    x    .    x    .     .
    fmi2GetRealStatus              .    .    .    x    x    x    .    x    .     .
    fmi2GetIntegerStatus           .    .    .    x    x    x    .    x    .     .
    fmi2GetBooleanStatus           .    .    .    x    x    x    .    x    .     .
    fmi2GetStringStatus            .    .    .    x    x    x    .    x    .     .
";

/// Treated as legal although the table says no: functions, phase, and why.
pub const DEVIATIONS: [(&[&str], Phase, &str); 2] = [
    (
        &[
            "fmi2GetReal",
            "fmi2GetInteger",
            "fmi2GetBoolean",
            "fmi2GetString",
        ],
        Phase::Instantiated,
        "importers read start values before they initialize",
    ),
    (
        &[
            "fmi2GetStatus",
            "fmi2GetRealStatus",
            "fmi2GetIntegerStatus",
            "fmi2GetBooleanStatus",
            "fmi2GetStringStatus",
        ],
        Phase::Error,
        "the time of the last good step is wanted most after a bad one",
    ),
];

/// Functions of capabilities that the description does not claim, with that capability. They are refused where they are
/// legal, too.
pub const UNSUPPORTED: [(&str, &str); 7] = [
    (
        "fmi2GetDirectionalDerivative",
        "providesDirectionalDerivative",
    ),
    ("fmi2SetRealInputDerivatives", "canInterpolateInputs"),
    ("fmi2GetRealOutputDerivatives", "maxOutputDerivativeOrder"),
    ("fmi2CancelStep", "canRunAsynchronuously"),
    ("fmi2GetStatus", "canRunAsynchronuously"),
    ("fmi2GetIntegerStatus", "no integer status"),
    ("fmi2GetStringStatus", "canRunAsynchronuously"),
];

/// What a call with good arguments comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// fmi2OK.
    Accepted,
    /// Refused for the phase, or for this capability.
    Refused(Option<&'static str>),
}

/// Rows of the table: function and marks by column. Read once: random sequences ask at every call.
pub fn rows() -> &'static [(&'static str, Vec<&'static str>)] {
    static ROWS: OnceLock<Vec<(&str, Vec<&str>)>> = OnceLock::new();
    ROWS.get_or_init(|| {
        let rows = TABLE.lines().filter(|line| line.contains("fmi2"));
        rows.map(|line| {
            let mut words = line.split_whitespace();
            (words.next().unwrap_or_default(), words.collect())
        })
        .collect()
    })
}

/// What the standard's table says.
///
/// # Panics
/// When the function has no row.
pub fn legal(function: &str, phase: Phase) -> bool {
    let column = COLUMNS.iter().position(|&name| name == phase.name());
    let (_, marks) = rows()
        .iter()
        .find(|(name, _)| *name == function)
        .unwrap_or_else(|| panic!("the table has no {function}"));
    column.is_some_and(|column| marks[column] != ".")
}

/// What these FMUs do.
pub fn verdict(function: &str, phase: Phase) -> Verdict {
    let deviates = DEVIATIONS
        .iter()
        .any(|(functions, at, _)| *at == phase && functions.contains(&function));
    let lacking = UNSUPPORTED.iter().find(|(name, _)| *name == function);
    match (legal(function, phase) || deviates, lacking) {
        (true, None) => Verdict::Accepted,
        (true, Some((_, capability))) => Verdict::Refused(Some(capability)),
        // While a step is in progress nothing else can be called: to an importer that is the phase before its end.
        (false, Some((name, capability)))
            if *name == "fmi2CancelStep" && phase == Phase::StepComplete =>
        {
            Verdict::Refused(Some(capability))
        }
        (false, _) => Verdict::Refused(None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Library;

    #[test]
    fn the_table_has_all_34_functions_in_all_ten_states() {
        let mut names: Vec<_> = rows().iter().map(|(name, _)| *name).collect();
        let mut expected = Library::FUNCTIONS;
        names.sort_unstable();
        expected.sort_unstable();
        assert_eq!(names, expected);
        for (name, marks) in rows() {
            assert_eq!(marks.len(), COLUMNS.len(), "{name}");
            assert!(
                marks.iter().all(|mark| ["x", "v", "."].contains(mark)),
                "{name}"
            );
        }
    }

    #[test]
    fn every_state_of_the_table_is_a_phase_or_has_a_reason_why_not() {
        let mut all: Vec<_> = Phase::ALL.map(Phase::name).into();
        all.extend(UNREACHABLE.map(|(name, _)| name));
        all.sort_unstable();
        let mut columns = COLUMNS;
        columns.sort_unstable();
        assert_eq!(all, columns);
    }

    #[test]
    fn a_deviation_is_one() {
        for (functions, phase, reason) in DEVIATIONS {
            assert!(!reason.is_empty());
            for function in functions {
                assert!(
                    !legal(function, phase),
                    "{function} is legal in {phase:?} anyway"
                );
            }
        }
    }
}
