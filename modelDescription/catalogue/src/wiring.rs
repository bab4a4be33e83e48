//! Which output belongs to which input: the connections that the interface documents show.
//!
//! The controllers get the human's force itself. A plant's sensor is ideal at the start values: its reading is the same force,
//! one step later. It takes the force's place where the sensor is the subject.

use fmu_archive::{Connection, System};

/// From an output to an input; `when` says the case, if it is not the usual one.
const fn wire(
    from: (&'static str, &'static str),
    to: (&'static str, &'static str),
    when: &'static str,
) -> Connection<'static> {
    Connection { from, to, when }
}

pub(crate) const SERVO: &str = "form = 2 of the controller and drive.mode = 2 or 3 of the testbed: position_servo, velocity_servo";
pub(crate) const JOINT_SERVO: &str = "form = 2 and space = 2 of the controller, drive.mode = 2 or 3 of the arm: position_servo, velocity_servo";
pub(crate) const SENSOR: &str = "where the sensor is the subject, in place of the human's force itself: what it reads comes a step later";
const LEFT: &str = "a controller and an operator for the left arm";
const RIGHT: &str = "a controller and an operator for the right arm";

/// All connections.
#[rustfmt::skip] // a table
pub const CONNECTIONS: [Connection<'static>; 36] = [
    wire(("Testbed", "q"), ("TestbedController", "q"), ""),
    wire(("HumanOperator", "f_h[1]"), ("TestbedController", "tau_h"), ""),
    wire(("HumanOperator", "f_h[1]"), ("Testbed", "tau_h"), ""),
    wire(("Testbed", "tau_h_measured"), ("TestbedController", "tau_h"), SENSOR),
    wire(("Testbed", "q"), ("HumanOperator", "p[1]"), ""),
    wire(("Testbed", "dq"), ("HumanOperator", "dp[1]"), ""),
    wire(("TestbedController", "tau_a"), ("Testbed", "tau_a"), ""),
    wire(("TestbedController", "q_d"), ("Testbed", "q_d"), SERVO),
    wire(("TestbedController", "dq_d"), ("Testbed", "dq_d"), SERVO),
    wire(("Testbed", "tau_drive"), ("TestbedController", "tau_a_measured"), SERVO),
    wire(("ExoskeletonArm", "q[i]"), ("ArmController", "q[i]"), ""),
    wire(("HumanOperator", "f_h[i]"), ("ArmController", "f_h[i]"), ""),
    wire(("ExoskeletonArm", "f_h_measured[i]"), ("ArmController", "f_h[i]"), SENSOR),
    wire(("ArmController", "tau_a[i]"), ("ExoskeletonArm", "tau_a[i]"), ""),
    wire(("HumanOperator", "f_h[i]"), ("ExoskeletonArm", "f_h[i]"), ""),
    wire(("ExoskeletonArm", "p[i]"), ("HumanOperator", "p[i]"), ""),
    wire(("ExoskeletonArm", "dp[i]"), ("HumanOperator", "dp[i]"), ""),
    wire(("ArmController", "q_d[i]"), ("ExoskeletonArm", "q_d[i]"), JOINT_SERVO),
    wire(("ArmController", "dq_d[i]"), ("ExoskeletonArm", "dq_d[i]"), JOINT_SERVO),
    wire(("ExoskeletonArm", "tau_drive[i]"), ("ArmController", "tau_a_measured[i]"), JOINT_SERVO),
    wire(("ArmController", "q_d[i]"), ("ExoskeletonArms", "left.q_d[i]"), JOINT_SERVO),
    wire(("ArmController", "dq_d[i]"), ("ExoskeletonArms", "left.dq_d[i]"), JOINT_SERVO),
    wire(("ExoskeletonArms", "left.tau_drive[i]"), ("ArmController", "tau_a_measured[i]"), JOINT_SERVO),
    wire(("ArmController", "q_d[i]"), ("ExoskeletonArms", "right.q_d[i]"), JOINT_SERVO),
    wire(("ArmController", "dq_d[i]"), ("ExoskeletonArms", "right.dq_d[i]"), JOINT_SERVO),
    wire(("ExoskeletonArms", "right.tau_drive[i]"), ("ArmController", "tau_a_measured[i]"), JOINT_SERVO),
    wire(("ExoskeletonArms", "left.q[i]"), ("ArmController", "q[i]"), LEFT),
    wire(("ArmController", "tau_a[i]"), ("ExoskeletonArms", "left.tau_a[i]"), LEFT),
    wire(("HumanOperator", "f_h[i]"), ("ExoskeletonArms", "left.f_h[i]"), LEFT),
    wire(("ExoskeletonArms", "left.p[i]"), ("HumanOperator", "p[i]"), LEFT),
    wire(("ExoskeletonArms", "left.dp[i]"), ("HumanOperator", "dp[i]"), LEFT),
    wire(("ExoskeletonArms", "right.q[i]"), ("ArmController", "q[i]"), RIGHT),
    wire(("ArmController", "tau_a[i]"), ("ExoskeletonArms", "right.tau_a[i]"), RIGHT),
    wire(("HumanOperator", "f_h[i]"), ("ExoskeletonArms", "right.f_h[i]"), RIGHT),
    wire(("ExoskeletonArms", "right.p[i]"), ("HumanOperator", "p[i]"), RIGHT),
    wire(("ExoskeletonArms", "right.dp[i]"), ("HumanOperator", "dp[i]"), RIGHT),
];

/// Those from and to one FMU.
pub fn of(fmu: &str) -> Vec<Connection<'static>> {
    let mut own = CONNECTIONS.to_vec();
    own.retain(|connection| connection.from.0 == fmu || connection.to.0 == fmu);
    own
}

const TESTBED: System<'static> = System {
    parts: &[
        ("controller", "TestbedController"),
        ("plant", "Testbed"),
        ("operator", "HumanOperator"),
    ],
    wires: &[
        (("plant", "q"), ("controller", "q")),
        (("operator", "f_h[1]"), ("controller", "tau_h")),
        (("controller", "tau_a"), ("plant", "tau_a")),
        (("operator", "f_h[1]"), ("plant", "tau_h")),
        (("plant", "q"), ("operator", "p[1]")),
        (("plant", "dq"), ("operator", "dp[1]")),
    ],
    start: &[
        ("controller", "delay", "1"),
        ("operator", "segment[1].amplitude", "4.0"),
    ],
};

const ARM: System<'static> = System {
    parts: &[
        ("controller", "ArmController"),
        ("plant", "ExoskeletonArm"),
        ("operator", "HumanOperator"),
    ],
    wires: &[
        (("plant", "q[i]"), ("controller", "q[i]")),
        (("operator", "f_h[i]"), ("controller", "f_h[i]")),
        (("controller", "tau_a[i]"), ("plant", "tau_a[i]")),
        (("operator", "f_h[i]"), ("plant", "f_h[i]")),
        (("plant", "p[i]"), ("operator", "p[i]")),
        (("plant", "dp[i]"), ("operator", "dp[i]")),
    ],
    start: &[
        ("controller", "delay", "1"),
        ("operator", "segment[1].amplitude", "6.0"),
    ],
};

/// A controller and an operator for each arm.
const ARMS: System<'static> = System {
    parts: &[
        ("left_controller", "ArmController"),
        ("right_controller", "ArmController"),
        ("plant", "ExoskeletonArms"),
        ("left_operator", "HumanOperator"),
        ("right_operator", "HumanOperator"),
    ],
    wires: &[
        (("plant", "left.q[i]"), ("left_controller", "q[i]")),
        (("plant", "right.q[i]"), ("right_controller", "q[i]")),
        (("left_operator", "f_h[i]"), ("left_controller", "f_h[i]")),
        (("right_operator", "f_h[i]"), ("right_controller", "f_h[i]")),
        (("left_controller", "tau_a[i]"), ("plant", "left.tau_a[i]")),
        (
            ("right_controller", "tau_a[i]"),
            ("plant", "right.tau_a[i]"),
        ),
        (("left_operator", "f_h[i]"), ("plant", "left.f_h[i]")),
        (("right_operator", "f_h[i]"), ("plant", "right.f_h[i]")),
        (("plant", "left.p[i]"), ("left_operator", "p[i]")),
        (("plant", "right.p[i]"), ("right_operator", "p[i]")),
        (("plant", "left.dp[i]"), ("left_operator", "dp[i]")),
        (("plant", "right.dp[i]"), ("right_operator", "dp[i]")),
    ],
    start: &[
        ("left_controller", "delay", "1"),
        ("right_controller", "delay", "1"),
        ("left_operator", "segment[1].amplitude", "6.0"),
        ("right_operator", "segment[1].amplitude", "6.0"),
    ],
};

/// The system that the quick start of an FMU builds; without parts where there is none. What is exchanged at once comes one
/// tick late, as the controllers are told.
pub fn system(fmu: &str) -> System<'static> {
    match fmu {
        "TestbedController" | "Testbed" => TESTBED,
        "ArmController" | "ExoskeletonArm" | "HumanOperator" => ARM,
        "ExoskeletonArms" => ARMS,
        _ => System::default(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FMUS;
    use fmu_archive::entry::{Entry, Kind};
    use fmu_declaration::Causality;

    /// The scalars that one end of a connection names.
    fn end((fmu, variable): (&str, &str)) -> Vec<Entry> {
        let fmu = FMUS
            .iter()
            .find(|one| one.name == fmu)
            .expect("a known FMU");
        let names: Vec<_> = match variable.strip_suffix("[i]") {
            Some(vector) => (1..=3).map(|i| format!("{vector}[{i}]")).collect(),
            None => vec![variable.to_owned()],
        };
        let scalars = fmu.interface().expect("legal").scalars;
        names
            .iter()
            .map(|name| scalars.iter().find(|entry| entry.name == *name))
            .map(|entry| {
                entry
                    .unwrap_or_else(|| panic!("{}.{variable}", fmu.name))
                    .clone()
            })
            .collect()
    }

    #[test]
    fn each_connection_goes_from_an_output_to_an_input_of_the_same_unit() {
        for connection in CONNECTIONS {
            let (from, to) = (end(connection.from), end(connection.to));
            assert_eq!(from.len(), to.len());
            for (from, to) in from.iter().zip(&to) {
                assert_eq!(from.causality, Causality::Output, "{connection:?}");
                assert_eq!(to.causality, Causality::Input, "{connection:?}");
                match (&from.kind, &to.kind) {
                    (Kind::Real { unit, .. }, Kind::Real { unit: other, .. }) => {
                        assert_eq!(unit, other, "{connection:?}");
                    }
                    _ => panic!("{connection:?}: expected Reals"),
                }
            }
        }
    }

    #[test]
    fn an_input_has_one_usual_source() {
        let mut usual: Vec<_> = CONNECTIONS
            .iter()
            .filter(|connection| connection.when.is_empty())
            .map(|connection| connection.to)
            .collect();
        let all = usual.len();
        usual.sort_unstable();
        usual.dedup();
        assert_eq!(usual.len(), all);
    }

    #[test]
    fn each_fmu_has_connections() {
        for fmu in FMUS {
            assert!(!of(fmu.name).is_empty(), "{}", fmu.name);
        }
    }

    /// The FMU of a part.
    fn fmu_of(system: System<'static>, part: &str) -> &'static str {
        let found = system.parts.iter().find(|(name, _)| *name == part);
        found.unwrap_or_else(|| panic!("no part {part}")).1
    }

    #[test]
    fn the_system_of_each_fmu_has_it_as_a_part_and_makes_each_of_its_connections() {
        for fmu in FMUS {
            let system = system(fmu.name);
            assert!(system.parts.iter().any(|(_, of)| *of == fmu.name));
            let wires: Vec<_> = system
                .wires
                .iter()
                .map(|(from, to)| {
                    (
                        (fmu_of(system, from.0), from.1),
                        (fmu_of(system, to.0), to.1),
                    )
                })
                .collect();
            let known = |one: &Connection<'_>| {
                [one.from.0, one.to.0]
                    .iter()
                    .all(|end| system.parts.iter().any(|(_, of)| of == end))
            };
            let usual = CONNECTIONS.iter().filter(|one| {
                known(one) && (one.when.is_empty() || [LEFT, RIGHT].contains(&one.when))
            });
            let mut made = 0;
            for one in usual {
                let count = wires
                    .iter()
                    .filter(|wire| **wire == (one.from, one.to))
                    .count();
                assert!(count > 0, "{}: {one:?}", fmu.name);
                made += 1;
            }
            assert!(made >= 3, "{}", fmu.name);
            for (from, to) in wires {
                assert!(
                    CONNECTIONS
                        .iter()
                        .any(|one| (one.from, one.to) == (from, to)),
                    "{from:?} → {to:?} is in no table"
                );
            }
        }
    }

    #[test]
    fn an_input_of_a_system_has_one_source_and_every_part_gives_and_takes() {
        for system in [TESTBED, ARM, ARMS] {
            let mut inputs: Vec<_> = system.wires.iter().map(|(_, to)| *to).collect();
            inputs.sort_unstable();
            let all = inputs.len();
            inputs.dedup();
            assert_eq!(inputs.len(), all);
            for (part, _) in system.parts {
                assert!(
                    system.wires.iter().any(|(from, _)| from.0 == *part),
                    "{part}"
                );
                assert!(system.wires.iter().any(|(_, to)| to.0 == *part), "{part}");
            }
        }
    }

    #[test]
    fn a_system_starts_with_values_that_its_variables_take() {
        for system in [TESTBED, ARM, ARMS] {
            for (part, variable, value) in system.start {
                let [entry] = &*end((fmu_of(system, part), variable)) else {
                    panic!("{variable}");
                };
                let value: f64 = value.parse().expect("a number");
                let fits = match entry.kind {
                    Kind::Real { min, max, .. } => {
                        min.is_none_or(|min| min <= value) && max.is_none_or(|max| value <= max)
                    }
                    Kind::Integer { min, max, .. } => {
                        value.fract() == 0.0
                            && min.is_none_or(|min| min as f64 <= value)
                            && max.is_none_or(|max| value <= max as f64)
                    }
                    _ => false,
                };
                assert!(
                    fits && !entry.is_calculated(),
                    "{part}.{variable} = {value}"
                );
            }
        }
    }
}
