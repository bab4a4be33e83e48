//! Which variable may be set or got in which phase (FMI 2.0.5, section 4.2.4, the table's notes), by causality and
//! variability.

use crate::{Phase, Variable};

/// `x`: the standard allows it. `d`: it does not, these FMUs do: see [`DEVIATIONS`]. `.`: refused.
/// Columns: instantiated, Initialization Mode, step complete, terminated, error.
const SET: &str = "
    input               *        d x x . .
    parameter           fixed    x x . . .
    parameter           tunable  x x x . .
    calculatedParameter *        . . . . .
    output              *        . . . . .
    local               *        . . . . .
";

/// Like [`SET`].
const GET: &str = "
    input               *        d d x x x
    parameter           *        d d x x x
    calculatedParameter *        d d x x x
    output              *        d x x x x
    local               *        d d x x x
";

/// Why a `d` stands in a table: what, and the reason.
pub const DEVIATIONS: [(&str, &str); 3] = [
    (
        "set an input before Initialization Mode",
        "importers set all start values at once after fmi2Instantiate",
    ),
    (
        "get before Initialization Mode",
        "importers read start values before they initialize",
    ),
    (
        "get what is no output in Initialization Mode",
        "importers show all variables of a model that waits at its start",
    ),
];

fn mark(table: &'static str, variable: &Variable, phase: Phase) -> &'static str {
    let rows = table.lines().map(|line| line.split_whitespace());
    for mut words in rows {
        let (causality, variability) = (words.next(), words.next());
        if causality == Some(&variable.causality)
            && (variability == Some("*") || variability == Some(&variable.variability))
        {
            return words.nth(phase as usize).unwrap_or(".");
        }
    }
    panic!(
        "no row for {} {} ({})",
        variable.variability, variable.causality, variable.name
    );
}

/// Whether a variable may be set.
///
/// # Panics
/// When its causality and variability stand in no row.
pub fn settable(variable: &Variable, phase: Phase) -> bool {
    mark(SET, variable, phase) != "."
}

/// Whether a variable may be read.
///
/// # Panics
/// Like [`settable`].
pub fn readable(variable: &Variable, phase: Phase) -> bool {
    mark(GET, variable, phase) != "."
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Kind, standard};

    #[test]
    fn what_a_variable_may_is_never_more_than_what_its_function_may() {
        for (table, function) in [(SET, "fmi2SetReal"), (GET, "fmi2GetReal")] {
            for line in table.lines().filter(|line| !line.trim().is_empty()) {
                let marks: Vec<_> = line.split_whitespace().skip(2).collect();
                assert_eq!(marks.len(), Phase::ALL.len(), "{line}");
                for (phase, mark) in Phase::ALL.into_iter().zip(marks) {
                    let accepted =
                        standard::verdict(function, phase) == standard::Verdict::Accepted;
                    assert!(
                        mark == "." || accepted,
                        "{function} {phase:?} refuses all: {line}"
                    );
                    let legal = standard::legal(function, phase);
                    assert!(mark != "x" || legal, "{function} {phase:?}: {line}");
                }
            }
        }
    }

    #[test]
    fn a_tunable_parameter_is_set_during_the_run_and_a_fixed_one_is_not() {
        let parameter = |variability: &str| Variable {
            name: "p".into(),
            reference: 0,
            kind: Kind::Real {},
            causality: "parameter".into(),
            variability: variability.into(),
            bounds: None,
            start: None,
        };
        assert!(settable(&parameter("tunable"), Phase::StepComplete));
        assert!(!settable(&parameter("fixed"), Phase::StepComplete));
        assert!(readable(&parameter("fixed"), Phase::Error));
    }
}
