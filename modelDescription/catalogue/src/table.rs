//! What the C host (`tests/host/host.c`) must know of an FMU, as lines of text.

use fmu_archive::Interface;
use fmu_archive::entry::Kind;
use fmu_declaration::Causality;
use std::fmt::Write as _;

/// Parameters that are set, so that something happens: the arm meets a table with a payload and measures with noise, both
/// arms hold one, the hand pushes and is stiff (its damper not so that it cancels the spring): FMU, variable, value.
pub const SETTINGS: [(&str, &str, f64); 11] = [
    ("ExoskeletonArm", "ft.noise", 0.2),
    ("ExoskeletonArm", "table.z", -0.3771),
    ("ExoskeletonArm", "payload.m", 17.5),
    ("ExoskeletonArm", "payload.attached", 1.0),
    ("ExoskeletonArms", "table.z", -0.3771),
    ("ExoskeletonArms", "payload.m", 35.0),
    ("ExoskeletonArms", "payload.attached", 1.0),
    ("HumanOperator", "segment[1].amplitude", 6.0),
    ("HumanOperator", "k_h", 50.0),
    ("HumanOperator", "b_h", 1.5),
    ("HumanOperator", "delay", 0.01),
];

/// The table of an FMU.
pub fn of(interface: &Interface) -> String {
    let mut text = format!(
        "model {}\nguid {}\nstep {}\n",
        interface.name, interface.guid, interface.experiment.step
    );
    for scalar in &interface.scalars {
        let setting = SETTINGS
            .iter()
            .find(|(fmu, name, _)| *fmu == interface.name && *name == scalar.name);
        if let Some((_, _, value)) = setting {
            let kind = match scalar.kind {
                Kind::Boolean { .. } => "boolean-setting",
                _ => "real-setting",
            };
            let _ = writeln!(text, "{kind} {} {value}", scalar.reference);
        }
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
            (Kind::Integer { .. } | Kind::Enumeration { .. }, true)
            | (Kind::String { .. } | Kind::Binary { .. }, _) => Ok(()),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_of_every_fmu_is_in_its_table() {
        for fmu in crate::FMUS {
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
            let settings = SETTINGS
                .iter()
                .filter(|(name, _, _)| *name == fmu.name)
                .count();
            assert_eq!(lines, 3 + settings + numbers, "{}", fmu.name);
        }
    }
}
