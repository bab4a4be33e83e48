//! Grip, release and loss of a payload that two cups share.

#![allow(non_snake_case, reason = "the symbols of the equations")]

use mechanics::ParameterError;
use mechanics::arm::{Inputs, Start};
use mechanics::pair::{Bond, Pair, Parameters};

const DT: f64 = 1e-4;

fn pair(attached: bool) -> Pair {
    pair_of(450.0, attached)
}

/// 20 kg, held by cups that bear `F_max` (N) each.
fn pair_of(F_max: f64, attached: bool) -> Pair {
    let mut parameters = Parameters::default();
    parameters.arm.vacuum.F_max = F_max;
    parameters.arm.payload_m = 20.0;
    parameters.arm.table.z = -0.36;
    let start = Start {
        attached,
        ..Start::default()
    };
    Pair::new(parameters, &start).expect("legal")
}

fn press(vacuum: bool) -> Inputs {
    Inputs {
        tau_a: [0.0, -30.0, -20.0],
        vacuum,
        ..Inputs::default()
    }
}

fn rest(vacuum: bool) -> Inputs {
    Inputs {
        vacuum,
        ..Inputs::default()
    }
}

#[test]
fn payload_is_gripped_when_both_cups_press_and_suck_and_not_before() {
    for inputs in [
        [press(true), press(false)],
        [press(false), press(true)],
        [press(true), rest(true)],
    ] {
        let mut pair = pair(false);
        pair.advance(&inputs, 20_000, DT);
        assert!(!pair.attached(), "{inputs:?}");
    }
    let mut pair = pair(false);
    pair.advance(&[press(true); 2], 20_000, DT);
    assert!(pair.attached() && pair.arms()[1].state().attached);
}

#[test]
fn pads_keep_the_offset_that_they_had_at_the_grip_whatever_it_was() {
    let mut pair = pair(false);
    let swing = Inputs {
        tau_a: [25.0, 0.0, 0.0],
        ..Inputs::default()
    };
    pair.advance(&[swing, rest(false)], 3_000, DT); // the left arm turns left
    pair.advance(&[press(true); 2], 20_000, DT);
    assert!(pair.attached());
    let offset = |pair: &Pair| pair.arms()[0].place().pad.p - pair.arms()[1].place().pad.p;
    let before = offset(&pair);
    assert!(before.y > 0.02, "{before}");
    let lift = Inputs {
        tau_a: [0.0, 150.0, 90.0],
        vacuum: true,
        ..Inputs::default()
    };
    pair.advance(&[lift; 2], 3_000, DT);
    assert!(pair.attached() && pair.arms()[1].place().pad.p.z > -0.34);
    // 1e8 N/m: 10 µm are 1 kN.
    assert!((offset(&pair) - before).norm() < 1e-5 && pair.gap() < 1e-5);
}

#[test]
fn arms_without_a_payload_do_not_feel_each_other() {
    let (mut both, mut one) = (pair(false), pair(false));
    both.advance(&[press(false), rest(false)], 5_000, DT);
    one.advance(&[rest(false), rest(false)], 5_000, DT);
    assert_eq!(both.arms()[1].state(), one.arms()[1].state());
    assert_ne!(both.arms()[0].state(), one.arms()[0].state());
}

#[test]
fn either_cup_that_lets_go_frees_both_pads() {
    for vacuum in [[true, false], [false, true]] {
        let mut pair = pair(true);
        pair.advance(&[rest(true); 2], 1_000, DT);
        assert!(pair.attached());
        pair.advance(&vacuum.map(rest), 1, DT);
        assert!(!pair.arms()[0].state().attached && !pair.arms()[1].state().attached);
        pair.advance(&[rest(true); 2], 1, DT);
        assert_eq!((pair.gap(), pair.lambda().norm()), (0.0, 0.0));
    }
}

#[test]
fn a_bond_that_breaks_at_one_cup_is_lost_at_both() {
    // One arm's drives lift, the other's do not: the cup of the first bears more than half of the weight, 98 N.
    let lift = Inputs {
        tau_a: [0.0, 250.0, 150.0],
        vacuum: true,
        ..Inputs::default()
    };
    for strong in [0, 1] {
        let mut inputs = [rest(true); 2];
        inputs[strong] = lift;
        let mut pair = pair_of(250.0, true);
        let mut tension = [0.0; 2];
        let mut steps = 0;
        while pair.attached() && steps < 20_000 {
            pair.advance(&inputs, 1, DT);
            tension = [0, 1].map(|i| pair.arms()[i].tension());
            steps += 1;
        }
        assert!(!pair.arms()[0].state().attached && !pair.arms()[1].state().attached);
        assert!(
            tension[strong] > 250.0 && tension[1 - strong] < 250.0,
            "{tension:?}"
        );
    }
}

#[test]
fn tensions_bear_the_weight_together_whoever_lifts() {
    let mut pair = pair(true);
    let hold = |share: f64| Inputs {
        tau_a: [0.0, 100.0 * share, 60.0 * share],
        vacuum: true,
        ..Inputs::default()
    };
    pair.advance(&[hold(1.0), hold(0.6)], 30_000, DT);
    assert!(
        pair.arms()
            .iter()
            .all(|arm| arm.state().dq.amax() == 0.0 && !arm.shown().contact)
    );
    let [left, right] = [0, 1].map(|i| pair.arms()[i].tension());
    assert!((left - right).abs() > 1.0, "{left} {right}");
    assert!((left + right - 20.0 * 9.81).abs() < 1e-9, "{left} {right}"); // roundings of 200 N
}

#[test]
fn release_takes_along_what_is_stored_in_the_bond() {
    let mut pair = pair(true);
    let lift = Inputs {
        tau_a: [20.0, 150.0, 90.0],
        vacuum: true,
        ..Inputs::default()
    };
    pair.advance(&[lift, rest(true)], 2_000, DT);
    let before = pair.energy();
    assert!(before.bond > 1e-6, "{before:?}");
    pair.advance(
        &[
            Inputs {
                vacuum: false,
                ..lift
            },
            rest(true),
        ],
        1,
        DT,
    );
    let after = pair.energy();
    assert_eq!(after.bond, 0.0);
    // One substep changes the residual by second-order terms only: far less than what was stored.
    let change = (after.arms.residual - before.arms.residual).abs();
    assert!(
        change < 0.1 * before.bond,
        "{change:e} of {:e}",
        before.bond
    );
}

#[test]
fn an_impossible_bond_is_refused_by_name() {
    for (bond, name) in [
        (Bond { k: 0.0, c: 1e5 }, "bond.k"),
        (Bond { k: 1e8, c: -1.0 }, "bond.c"),
        (
            Bond {
                k: f64::NAN,
                c: 1e5,
            },
            "bond.k",
        ),
    ] {
        let parameters = Parameters {
            bond,
            ..Parameters::default()
        };
        match Pair::new(parameters, &Start::default()) {
            Err(ParameterError::OutOfRange { bounds, .. }) => assert_eq!(bounds.name, name),
            other => panic!("{other:?}"),
        }
    }
}
