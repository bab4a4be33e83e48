//! What the C host (`tests/host/host.c`) must know of an FMU, as lines of text.

use declaration::Causality;
use model_description::Interface;
use model_description::entry::Kind;
use std::fmt::Write as _;

/// The table of an FMU.
pub fn of(interface: &Interface) -> String {
    let mut text = format!(
        "model {}\nguid {}\nstep {}\n",
        interface.name, interface.guid, interface.experiment.step
    );
    for scalar in &interface.scalars {
        let input = scalar.causality == Causality::Input;
        let reference = scalar.reference;
        let _ = match (&scalar.kind, input) {
            (Kind::Real { unit, start, .. }, true) => {
                writeln!(
                    text,
                    "real-input {reference} {start} {}",
                    amplitude(unit.name)
                )
            }
            (Kind::Boolean { .. }, true) => writeln!(text, "boolean-input {reference}"),
            (Kind::Real { .. }, false) => writeln!(text, "real-output {reference}"),
            (Kind::Integer { .. } | Kind::Enumeration { .. }, false) => {
                writeln!(text, "integer-output {reference}")
            }
            (Kind::Boolean { .. }, false) => writeln!(text, "boolean-output {reference}"),
            (Kind::Integer { .. } | Kind::Enumeration { .. }, true) | (Kind::String { .. }, _) => {
                Ok(())
            }
        };
    }
    text
}

/// How far an input is moved around its start value: forces that overcome friction, and positions that a robot can
/// follow within a step.
fn amplitude(unit: &str) -> f64 {
    match unit {
        "N" | "N.m" => 20.0,
        "rad" | "m" => 0.002,
        _ => 0.1,
    }
}

/// The table of the test model, which has no committed description; references are 256 times the row.
pub const LAG: &str = "model lag\nguid ?\nstep 0.01\npanic 1280\nreal-input 0 0 1\nreal-output 256\nreal-output 768\ninteger-output 1024\nboolean-output 1280\n";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_of_every_fmu_is_in_its_table() {
        for fmu in crate::catalogue::FMUS {
            let interface = fmu.interface().expect("legal");
            let lines = of(&interface).lines().count();
            let numbers = interface
                .scalars
                .iter()
                .filter(|scalar| !matches!(scalar.kind, Kind::String { .. }))
                .filter(|scalar| {
                    scalar.causality != Causality::Input
                        || matches!(scalar.kind, Kind::Real { .. } | Kind::Boolean { .. })
                })
                .count();
            assert_eq!(lines, 3 + numbers, "{}", fmu.name);
        }
    }
}
