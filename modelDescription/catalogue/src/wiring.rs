//! Which output belongs to which input: the connections that the interface documents show.

use model_description::Connection;

/// From an output to an input; `when` says the case, if it is not the usual one.
const fn wire(
    from: (&'static str, &'static str),
    to: (&'static str, &'static str),
    when: &'static str,
) -> Connection<'static> {
    Connection { from, to, when }
}

const SERVO: &str = "form = 2 of the controller and drive.mode = 2 of the testbed: position_servo";
const LEFT: &str = "a controller and an operator for the left arm";
const RIGHT: &str = "a controller and an operator for the right arm";

/// All connections.
#[rustfmt::skip] // a table
pub const CONNECTIONS: [Connection<'static>; 23] = [
    wire(("Testbed", "q"), ("TestbedController", "q"), ""),
    wire(("Testbed", "tau_h_measured"), ("TestbedController", "tau_h"), ""),
    wire(("TestbedController", "tau_a"), ("Testbed", "tau_a"), ""),
    wire(("TestbedController", "q_d"), ("Testbed", "q_d"), SERVO),
    wire(("TestbedController", "dq_d"), ("Testbed", "dq_d"), SERVO),
    wire(("Testbed", "tau_drive"), ("TestbedController", "tau_a_measured"), SERVO),
    wire(("ExoskeletonArm", "q[i]"), ("ArmController", "q[i]"), ""),
    wire(("ExoskeletonArm", "f_h_measured[i]"), ("ArmController", "f_h[i]"), ""),
    wire(("ArmController", "tau_a[i]"), ("ExoskeletonArm", "tau_a[i]"), ""),
    wire(("HumanOperator", "f_h[i]"), ("ExoskeletonArm", "f_h[i]"), ""),
    wire(("ExoskeletonArm", "p[i]"), ("HumanOperator", "p[i]"), ""),
    wire(("ExoskeletonArm", "dp[i]"), ("HumanOperator", "dp[i]"), ""),
    wire(("HumanOperator", "f_h[i]"), ("ArmController", "f_h[i]"), "beside ExoskeletonArms, whose force sensors are ideal"),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FMUS;
    use declaration::Causality;
    use model_description::entry::{Entry, Kind};

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
}
