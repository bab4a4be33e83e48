//! The terminals of FMI 3.0: the [connections](wiring::CONNECTIONS) of two FMUs that are made by one line. Nothing is said here
//! that the connections do not say, so no FMU has a terminal that does not fit another's.
//!
//! | terminal | between | members |
//! |---|---|---|
//! | `robot` | controller and plant | positions, torques |
//! | `drive` | controller and plant as `position_servo` wires them | command, force |
//! | `sensor` | controller and plant | the force that the plant measures |
//! | `hand` | human, controller and plant | force, position, velocity |
//!
//! `ExoskeletonArms` has one of each arm, `left_robot`, `right_robot`. A connection of one element of a vector is in no terminal,
//! whose members are whole variables: so the testbed, of one axis, has no `hand`.

use crate::wiring::{self, JOINT_SERVO, SENSOR, SERVO};
use fmu_archive::arrays;
use fmu_archive::{Connection, Matching, Member, Terminal};

/// What is connected by one line.
#[derive(Debug)]
struct Bus {
    name: &'static str,
    about: &'static str,
    matching: Matching,
    icon: &'static [u8],
}

macro_rules! bus {
    ($name:literal, $matching:ident, $about:literal) => {
        Bus {
            name: $name,
            about: $about,
            matching: Matching::$matching,
            icon: include_bytes!(concat!("../../icons/terminals/", $name, ".png")),
        }
    };
}

const ROBOT: Bus = bus!("robot", Plug, "controller and robot: positions, torques");
const DRIVE: Bus = bus!(
    "drive",
    Plug,
    "controller and the robot's position servo: command, force"
);
const FORCE_SENSOR: Bus = bus!(
    "sensor",
    Plug,
    "the force that the robot's sensor reads, in place of the hand's itself"
);
// The controller takes only the force.
const HAND: Bus = bus!(
    "hand",
    Bus,
    "the human's hand: its force, position and velocity of the handle"
);

fn bus(connection: &Connection<'_>) -> &'static Bus {
    let human = [connection.from.0, connection.to.0].contains(&"HumanOperator");
    match connection.when {
        SERVO | JOINT_SERVO => &DRIVE,
        SENSOR => &FORCE_SENSOR,
        _ if human => &HAND,
        _ => &ROBOT,
    }
}

/// `left.q[i]` as the arm's side with its underscore, and the variable's name in it.
fn side(variable: &str) -> (&'static str, &str) {
    match variable.split_once('.') {
        Some(("left", rest)) => ("left_", rest),
        Some(("right", rest)) => ("right_", rest),
        _ => ("", variable),
    }
}

/// Whether it names a whole variable, no element of one.
fn is_whole(variable: &str) -> bool {
    !variable.replace("[i]", "").contains('[')
}

/// Those of an FMU.
pub fn of(fmu: &str) -> Vec<Terminal> {
    let mut terminals: Vec<Terminal> = Vec::new();
    for connection in wiring::of(fmu) {
        let (from, to) = (connection.from, connection.to);
        if !(is_whole(from.1) && is_whole(to.1)) {
            continue;
        }
        let variable = if from.0 == fmu { from.1 } else { to.1 };
        let bus = bus(&connection);
        let name = format!("{}{}", side(variable).0, bus.name);
        let member = Member {
            name: arrays::name(side(to.1).1),
            variable: arrays::name(variable),
        };
        match terminals.iter_mut().find(|known| known.name == name) {
            Some(known) if known.members.contains(&member) => {}
            Some(known) => known.members.push(member),
            None => terminals.push(Terminal {
                name,
                about: bus.about.to_owned(),
                matching: bus.matching,
                members: vec![member],
                icon: (bus.name, bus.icon),
            }),
        }
    }
    terminals
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FMUS, Fmu};
    use fmu_archive::arrays::Array;
    use fmu_archive::entry::Kind;
    use fmu_declaration::Causality;
    use std::collections::BTreeSet;

    /// What an importer does with two terminals: their members by name, as the rules of both allow.
    fn connected(one: &Terminal, other: &Terminal) -> Option<Vec<(String, String)>> {
        let mut pairs = Vec::new();
        for (here, there) in [(one, other), (other, one)] {
            for member in &here.members {
                let found = there.members.iter().find(|same| same.name == member.name);
                match found {
                    Some(same) => pairs.push((member.variable.clone(), same.variable.clone())),
                    None if here.matching == Matching::Bus => {}
                    None => return None,
                }
            }
        }
        pairs.truncate(pairs.len() / 2);
        Some(pairs)
    }

    fn named(fmu: &str, terminal: &str) -> Terminal {
        let mut all = of(fmu);
        all.retain(|one| one.name == terminal);
        assert_eq!(all.len(), 1, "{fmu}.{terminal}");
        all.remove(0)
    }

    /// Direction, shape and unit of a variable.
    fn of_variable(fmu: &str, variable: &str) -> (Causality, Option<usize>, &'static str) {
        let interface = Fmu::named(fmu)
            .expect("is listed")
            .interface()
            .expect("legal");
        let arrays = arrays::of(&interface);
        let found = arrays.iter().find(|one| one.name == variable);
        let array: &Array<'_> = found.unwrap_or_else(|| panic!("{fmu}.{variable}"));
        let Kind::Real { unit, .. } = array.first().kind else {
            panic!("{fmu}.{variable}: expected a Real");
        };
        let length = array.is_vector().then_some(array.elements.len());
        (array.first().causality, length, unit.name)
    }

    #[test]
    fn a_line_between_controller_and_plant_closes_the_loop() {
        let pair = |one: (&str, &str), other: (&str, &str)| {
            connected(&named(one.0, one.1), &named(other.0, other.1)).expect("they fit")
        };
        let text = |pairs: &[(&str, &str)]| -> Vec<(String, String)> {
            let owned = pairs.iter().map(|(a, b)| (a.to_string(), b.to_string()));
            owned.collect()
        };
        assert_eq!(
            pair(("ArmController", "robot"), ("ExoskeletonArm", "robot")),
            text(&[("q", "q"), ("tau_a", "tau_a")])
        );
        assert_eq!(
            pair(
                ("ArmController", "robot"),
                ("ExoskeletonArms", "right_robot")
            ),
            text(&[("q", "right.q"), ("tau_a", "right.tau_a")])
        );
        assert_eq!(
            pair(("ArmController", "drive"), ("ExoskeletonArm", "drive")),
            text(&[
                ("q_d", "q_d"),
                ("dq_d", "dq_d"),
                ("tau_a_measured", "tau_drive")
            ])
        );
        assert_eq!(
            pair(("TestbedController", "drive"), ("Testbed", "drive")),
            text(&[
                ("q_d", "q_d"),
                ("dq_d", "dq_d"),
                ("tau_a_measured", "tau_drive")
            ])
        );
        assert_eq!(
            pair(("ExoskeletonArm", "hand"), ("HumanOperator", "hand")),
            text(&[("f_h", "f_h"), ("p", "p"), ("dp", "dp")])
        );
        assert_eq!(
            pair(("ArmController", "hand"), ("HumanOperator", "hand")),
            text(&[("f_h", "f_h")])
        );
        // The testbed's force is a number, the arm's a vector.
        let (one, three) = (named("Testbed", "sensor"), named("ArmController", "sensor"));
        assert_eq!(connected(&one, &three), None);
    }

    #[test]
    fn terminals_connect_whole_variables_from_output_to_input_of_one_shape_and_unit_and_nothing_else()
     {
        let mut made = BTreeSet::new();
        for one in FMUS {
            let wired = wiring::of(one.name);
            let is_wired = |other: &str| {
                other != one.name
                    && wired
                        .iter()
                        .any(|wire| [wire.from.0, wire.to.0].contains(&other))
            };
            for other in FMUS.iter().filter(|other| is_wired(other.name)) {
                for here in of(one.name) {
                    for there in of(other.name) {
                        if here.icon.0 != there.icon.0 {
                            continue;
                        }
                        for (a, b) in connected(&here, &there).unwrap_or_default() {
                            let (from, to) =
                                (of_variable(one.name, &a), of_variable(other.name, &b));
                            if from.0 == to.0 {
                                // Both take the human's force.
                                assert_eq!((from.0, a.ends_with("f_h")), (Causality::Input, true));
                                continue;
                            }
                            assert_eq!(
                                (from.1, from.2),
                                (to.1, to.2),
                                "{}.{a} {}.{b}",
                                one.name,
                                other.name
                            );
                            if from.0 == Causality::Output {
                                made.insert([one.name.to_owned(), a, other.name.to_owned(), b]);
                            }
                        }
                    }
                }
            }
        }
        let whole = wiring::CONNECTIONS
            .iter()
            .filter(|one| is_whole(one.from.1) && is_whole(one.to.1));
        let wanted: BTreeSet<_> = whole
            .map(|one| {
                let (from, to) = (one.from, one.to);
                [
                    from.0.to_owned(),
                    arrays::name(from.1),
                    to.0.to_owned(),
                    arrays::name(to.1),
                ]
            })
            .collect();
        assert_eq!(made, wanted);
    }

    #[test]
    fn a_terminal_has_each_member_once_and_each_fmu_has_a_terminal() {
        for fmu in FMUS {
            let terminals = of(fmu.name);
            assert!(!terminals.is_empty(), "{}", fmu.name);
            for terminal in terminals {
                let names: BTreeSet<_> = terminal.members.iter().map(|one| &one.name).collect();
                assert_eq!(names.len(), terminal.members.len(), "{terminal:?}");
            }
        }
    }
}
