//! The interface.

use crate::ArmController;
use admittance::law::OFFERED_LAW;
use admittance::{Law, encoder};
use arm_law::choices::{
    DEBT, DIAGNOSTIC, ENCODER_FAULT, FAULT, FRAME, SOURCE, SPACE, STATE, TARE_FAILURE, TARE_STATE,
    TORQUE_LIMITING,
};
use arm_law::supervision::{Diagnostic, State};
use arm_law::wrench::{Fault, TareFailure, TareState};
use fmu_declaration::{Access, Causality, Declare, Variability};
use std::collections::HashSet;

#[test]
fn start_values_lie_within_their_bounds_and_names_are_unique() {
    let start = ArmController::default();
    let mut names = HashSet::new();
    for scalar in ArmController::DESCRIPTION.scalars() {
        let (name, i) = (scalar.name(), scalar.element);
        assert!(names.insert(name.to_lowercase()), "{name} twice");
        assert!(
            !scalar.variable.about.is_empty(),
            "{name} without description"
        );
        match scalar.variable.access {
            Access::Real { range, at, .. } => {
                let value = at.get(&start, i);
                assert!(range.contains(value), "{name} = {value}");
            }
            Access::Integer { min, max, at } => {
                let value = at.get(&start, i);
                assert!(min <= value && value <= max, "{name} = {value}");
            }
            Access::Enumeration { of, at, .. } => {
                let value = at.get(&start, i);
                assert!(
                    of.items.iter().any(|item| item.value == value),
                    "{name} = {value}"
                );
            }
            Access::Wide { .. } | Access::Binary { .. } => panic!("no row is one"),
            Access::Boolean { .. } | Access::String { .. } => {}
        }
    }
}

/// docs/specification.md, section 8: what others rely on.
#[test]
fn the_names_that_others_rely_on_are_there() {
    let names = |wanted: fn(Causality) -> bool| -> HashSet<String> {
        ArmController::DESCRIPTION
            .scalars()
            .filter(|scalar| wanted(scalar.variable.causality))
            .map(|scalar| scalar.name())
            .collect()
    };
    let vectors = |names: &[&str]| -> Vec<String> {
        let element = |name: &&str| (1..=3).map(|i| format!("{name}[{i}]")).collect::<Vec<_>>();
        names.iter().flat_map(element).collect()
    };
    let scalars = |names: &[&str]| names.iter().map(ToString::to_string).collect::<Vec<_>>();

    let inputs: HashSet<_> = [vectors(&["q", "f_h"]), scalars(&["engage"])]
        .concat()
        .into_iter()
        .collect();
    let offered = names(|c| c == Causality::Input);
    assert!(inputs.is_subset(&offered), "{offered:?}");
    let outputs = names(|c| c == Causality::Output);
    let parameters = names(|c| c == Causality::Parameter);
    let expected_outputs = [
        vectors(&["tau_a", "p", "p_n", "dp_n", "e_nr", "f_a"]),
        scalars(&[
            "saturated",
            "sigma_min",
            "tick",
            "energy.H",
            "energy.G",
            "energy.tank",
        ]),
    ];
    let expected_parameters = [
        vectors(&["Lambda_n", "D_n", "K", "K_P", "f_max", "tau_max"]),
        scalars(&["law", "alpha", "T", "delay", "energy.E_0", "ft.frame"]),
    ];
    for name in expected_outputs.concat() {
        assert!(outputs.contains(&name), "{name}");
    }
    for name in expected_parameters.concat() {
        assert!(parameters.contains(&name), "{name}");
    }
}

#[test]
fn gains_and_f_max_are_tunable_and_the_rest_is_fixed() {
    for variable in ArmController::DESCRIPTION.variables {
        if variable.causality == Causality::Parameter {
            let task = ["Lambda_n[i]", "D_n[i]", "K[i]", "K_P[i]", "f_max[i]"];
            let joint = ["joint.D_n[i]", "joint.K", "joint.K_P[i]"];
            let gain = task.contains(&variable.name) || joint.contains(&variable.name);
            let expected = if gain {
                Variability::Tunable
            } else {
                Variability::Fixed
            };
            assert_eq!(variable.variability, expected, "{}", variable.name);
        }
    }
}

#[test]
fn enumerations_have_the_numbers_and_names_that_the_model_knows() {
    let items = |of: fmu_declaration::Enumeration| -> Vec<_> {
        of.items
            .iter()
            .map(|item| (item.value, item.name))
            .collect()
    };
    let offered = Law::ALL.iter().filter(|law| law.row().offered);
    let offered: Vec<_> = offered.map(|law| (law.number(), law.name())).collect();
    assert_eq!(items(OFFERED_LAW), offered);
    assert_eq!(offered.len(), Law::ALL.len() - 2); // without the two comparators, which have one axis
    let mut states = State::ALL.map(|s| (s.number(), s.name())).to_vec();
    states.push((DEBT, "debt")); // shown, no state of the table
    assert_eq!(items(STATE), states);
    let mut faults = vec![(0, "none")];
    faults.extend(encoder::Fault::ALL.map(|f| (f.number(), f.name())));
    assert_eq!(items(ENCODER_FAULT), faults);
    assert_eq!(
        items(DIAGNOSTIC),
        Diagnostic::ALL.map(|d| (d.number(), d.name()))
    );
    assert_eq!(items(TORQUE_LIMITING), [(1, "scale"), (2, "clip")]);
    assert_eq!(items(FRAME), [(1, "base"), (2, "sensor")]);
    assert_eq!(items(SPACE), [(1, "task"), (2, "joint")]);
    assert_eq!(items(SOURCE), [(1, "f_h"), (2, "wrench")]);
    let faults = Fault::ALL.map(|fault| (fault.number(), fault.name()));
    assert_eq!(items(FAULT)[1..], faults);
    assert_eq!(items(FAULT)[0], (0, "none"));
    let unsteady = TareFailure::Unsteady;
    let state = TareState::Failed(unsteady);
    assert!(items(TARE_STATE).contains(&(state.number(), "failed")));
    assert!(items(TARE_FAILURE).contains(&(unsteady.number(), "unsteady")));
}
