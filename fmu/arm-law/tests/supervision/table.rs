//! The transition table against a second reading of it, and what must be true of it as a whole.

use arm_law::supervision::table::{FAULTS, RULES, Rule, decisive, next};
use arm_law::supervision::{Condition, Conditions, Diagnostic, State};
use std::collections::{HashMap, HashSet};

/// Every state under every combination of conditions: 7 × 2¹⁵.
fn everything() -> impl Iterator<Item = (State, Conditions)> {
    let combinations = 0..1 << Condition::ALL.len();
    combinations.flat_map(|bits| State::ALL.map(|state| (state, Conditions::from_bits(bits))))
}

/// What follows, told state by state as in the documentation's prose.
fn second_reading(state: State, conditions: Conditions) -> State {
    use Condition::*;
    let has = |condition| conditions.contain(condition);
    let steady = has(ForceSteady) || has(ToolWeight);
    let sensing = !has(EncoderInvalid) && !has(HeartbeatLost) && !has(FtInvalid) && !steady;
    let wanted = has(Enabled) && has(EngageOn);
    match state {
        State::Off => match (has(NotFinite), has(Enabled)) {
            (true, _) => State::Fault,
            (false, true) => State::Init,
            (false, false) => State::Off,
        },
        State::Init | State::Ready if has(NotFinite) || has(EmergencyStop) => State::Fault,
        State::Init | State::Ready if !has(Enabled) => State::Off,
        State::Init if has(Prepared) && sensing => State::Ready,
        State::Init => State::Init,
        State::Ready if !sensing => State::Init,
        State::Ready if has(EngageRises) => State::Engaged,
        State::Ready => State::Ready,
        State::Engaged | State::Hold | State::SoftStop
            if has(NotFinite) || has(EmergencyStop) || has(EncoderInvalid) =>
        {
            State::Fault
        }
        State::Engaged | State::Hold if !sensing || !wanted => State::SoftStop,
        State::Engaged | State::Hold if has(Quiet) => State::Hold,
        State::Engaged | State::Hold => State::Engaged,
        State::SoftStop if !has(Stopped) => State::SoftStop,
        State::SoftStop if has(Latched) => State::Fault,
        State::SoftStop => State::Off,
        State::Fault => {
            let good = sensing && !has(NotFinite) && !has(EmergencyStop);
            if has(AcknowledgeRises) && good {
                State::Off
            } else {
                State::Fault
            }
        }
    }
}

#[test]
fn every_state_under_every_combination_of_conditions_goes_where_the_second_reading_says() {
    for (state, conditions) in everything() {
        let expected = second_reading(state, conditions);
        assert_eq!(
            next(state, conditions),
            expected,
            "from {state:?} under {conditions:?}"
        );
    }
}

#[test]
fn every_row_decides_somewhere_from_each_of_its_states() {
    let mut decided: HashSet<(usize, State)> = HashSet::new();
    for (state, conditions) in everything() {
        if let Some(rule) = decisive(state, conditions) {
            let row = RULES.iter().position(|other| other == rule);
            decided.insert((row.unwrap(), state));
        }
    }
    for (row, rule) in RULES.iter().enumerate() {
        for from in rule.from {
            assert!(
                decided.contains(&(row, *from)),
                "row {row} ({}) never decides in {from:?}",
                rule.why
            );
        }
    }
}

#[test]
fn no_row_stays_where_it_is_or_asks_for_a_contradiction() {
    for Rule {
        from,
        when,
        unless,
        to,
        why,
    } in RULES
    {
        assert!(!from.contains(to), "{why}");
        assert!(!when.iter().any(|c| unless.contains(c)), "{why}");
    }
}

/// States that can be reached from `start` along rows that decide under some combination.
fn reachable(start: State) -> HashSet<State> {
    let mut edges: HashMap<State, HashSet<State>> = HashMap::new();
    for (state, conditions) in everything() {
        edges
            .entry(state)
            .or_default()
            .insert(next(state, conditions));
    }
    let mut found = HashSet::from([start]);
    let mut open = vec![start];
    while let Some(state) = open.pop() {
        for to in &edges[&state] {
            if found.insert(*to) {
                open.push(*to);
            }
        }
    }
    found
}

#[test]
fn every_state_can_be_reached_from_every_other_so_none_is_without_a_way_out() {
    for start in State::ALL {
        assert_eq!(reachable(start).len(), State::ALL.len(), "from {start:?}");
    }
}

#[test]
fn nothing_but_a_rising_edge_in_ready_starts_torque() {
    for (state, conditions) in everything() {
        let to = next(state, conditions);
        if to.acts() && !state.acts() {
            assert_eq!((state, to), (State::Ready, State::Engaged));
            assert!(conditions.contain(Condition::EngageRises));
            assert!(conditions.contain(Condition::Enabled));
            assert!(
                !conditions.contain_any(FAULTS),
                "{conditions:?} engages through a fault"
            );
        }
    }
}

#[test]
fn no_torque_under_emergency_stop_without_a_position_or_without_a_result() {
    use Condition::{EmergencyStop, EncoderInvalid, NotFinite};
    for (state, conditions) in everything() {
        if conditions.contain_any(&[EmergencyStop, EncoderInvalid, NotFinite]) {
            assert!(
                !next(state, conditions).acts(),
                "{state:?} acts under {conditions:?}"
            );
        }
    }
}

#[test]
fn following_somebody_takes_all_that_it_needs() {
    for (state, conditions) in everything() {
        if matches!(next(state, conditions), State::Engaged | State::Hold) {
            assert!(!conditions.contain_any(FAULTS));
            assert!(conditions.contain(Condition::Enabled));
            if state != State::Ready {
                assert!(conditions.contain(Condition::EngageOn));
            }
        }
    }
}

#[test]
fn a_fault_is_left_by_an_acknowledgement_after_its_cause_alone() {
    for (state, conditions) in everything() {
        if state == State::Fault && next(state, conditions) != State::Fault {
            assert_eq!(next(state, conditions), State::Off);
            assert!(conditions.contain(Condition::AcknowledgeRises));
            assert!(!conditions.contain_any(FAULTS));
        }
    }
}

#[test]
fn a_soft_stop_is_never_taken_back() {
    for (state, conditions) in everything() {
        if state == State::SoftStop {
            let to = next(state, conditions);
            assert!(
                [State::SoftStop, State::Off, State::Fault].contains(&to),
                "to {to:?}"
            );
        }
    }
}

#[test]
fn numbers_and_names_are_those_of_the_order_and_stand_once() {
    let mut names = HashSet::new();
    for (number, state) in (0..).zip(State::ALL) {
        assert_eq!(state.number(), number);
        assert!(names.insert(state.name()));
    }
    names.clear();
    for (number, diagnostic) in (0..).zip(Diagnostic::ALL) {
        assert_eq!(diagnostic.number(), number);
        assert!(names.insert(diagnostic.name()));
    }
    for (bit, condition) in Condition::ALL.into_iter().enumerate() {
        let set = Conditions::from_bits(1 << bit);
        assert!(set.contain(condition) && set == Conditions::default().with(condition, true));
        assert!(names.insert(condition.name()));
    }
}

#[test]
fn every_fault_has_its_diagnostic_in_the_same_order() {
    let diagnostics: Vec<_> = FAULTS.iter().map(|c| Diagnostic::of(*c)).collect();
    assert!(diagnostics.is_sorted() && !diagnostics.contains(&Diagnostic::None));
    let others = Condition::ALL.iter().filter(|c| !FAULTS.contains(c));
    assert!(
        others
            .into_iter()
            .all(|c| Diagnostic::of(*c) == Diagnostic::None)
    );
}
