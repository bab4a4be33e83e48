//! Refusals that name variable, value and what was expected; declared dependencies and names.

use fmu_declaration::{Access, Causality, Declare, Variable};
use fmu_export::{Log, Model};
use human_operator::HumanOperator;
use human_operator::rows::Inputs;
use human_operator::target::{Point, SINE, TABLE};
use std::collections::BTreeSet;

fn initialized(mut human: HumanOperator) -> Result<HumanOperator, String> {
    human
        .initialize(0.0, &mut Log::silent())
        .map_err(|refusal| refusal.0)?;
    Ok(human)
}

#[test]
fn start_values_are_accepted_and_give_no_force() {
    let human = initialized(HumanOperator::default()).unwrap();
    assert_eq!(human, HumanOperator::default());
}

#[test]
fn a_refused_parameter_is_named_with_its_value_and_what_was_expected() {
    let refused = |change: fn(&mut HumanOperator)| {
        let mut human = HumanOperator::default();
        change(&mut human);
        initialized(human).unwrap_err()
    };
    for (text, change) in [
        (
            "k_h = -1 N/m, expected a value from 0 to 1000000",
            (|h| h.k_h = -1.0) as fn(&mut HumanOperator),
        ),
        ("b_h = NaN N.s/m, expected a finite value", |h| {
            h.b_h = f64::NAN
        }),
        ("delay = 1.5 s, expected a value from 0 to 1", |h| {
            h.delay = 1.5
        }),
        ("segment[16].axis = 4, expected a value from 1 to 3", |h| {
            h.segments[15].axis = 4
        }),
        (
            "segment[2].kind = 3, expected an item of SegmentKind: 1 sine, 2 constant",
            |h| h.segments[1].kind = 3,
        ),
        (
            "segment[3].ramp = -0.5 s, expected a value from 0 to 1000000000",
            |h| h.segments[2].ramp = -0.5,
        ),
        (
            "segment[1].t_off = 2 s, expected at least segment[1].t_on = 5 s",
            |h| (h.segments[0].t_on, h.segments[0].t_off) = (5.0, 2.0),
        ),
        (
            "target.kind = 5, expected an item of TargetKind: 1 still, 2 sine, 3 minimum_jerk, 4 table",
            |h| h.target.kind = 5,
        ),
        (
            "target.t_off = 6 s, expected at least target.t_on + target.ramp = 7 s",
            |h| {
                h.target.kind = 2;
                (h.target.t_on, h.target.t_off, h.target.ramp) = (5.0, 6.0, 2.0);
            },
        ),
        (
            "target.points = 0, expected at least 1 for target.kind minimum_jerk or table",
            |h| h.target.kind = 3,
        ),
        ("target.points = 17, expected a value from 0 to 16", |h| {
            h.target.used = 17
        }),
        (
            "target.point[2].t = 1 s, expected more than target.point[1].t = 1 s",
            |h| {
                (h.target.kind, h.target.used) = (4, 3);
                for (i, t) in [1.0, 1.0, 2.0].into_iter().enumerate() {
                    h.target.points[i].t = t;
                }
            },
        ),
        (
            "k_h_factor[2] = -1, expected a value from 0 to 1000000",
            |h| h.k_h_factor[1] = -1.0,
        ),
    ] {
        assert_eq!(refused(change), text);
    }
}

#[test]
fn a_second_initialization_starts_from_parameters_and_inputs_alone() {
    let mut human = HumanOperator {
        inputs: Inputs {
            p: [0.4, 0.0, 0.0],
            ..Inputs::default()
        },
        k_h: 100.0,
        delay: 0.2,
        ..HumanOperator::default()
    };
    human = initialized(human).unwrap();
    human.inputs.p[0] = 0.5;
    human.k_h = 200.0;
    let again = initialized(human.clone()).unwrap();
    let fresh = initialized(HumanOperator {
        hand: HumanOperator::default().hand,
        ..human
    });
    assert_eq!(again, fresh.unwrap());
    assert_eq!(again.outputs.f_h, [0.0; 3]);
}

fn outputs(row: &Variable<HumanOperator>, human: &HumanOperator) -> Vec<u64> {
    let Access::Real { at, .. } = row.access else {
        panic!("{} is a Real", row.name)
    };
    at.values(human).map(f64::to_bits).collect()
}

/// Changes element `i` of a row; `false` when there is no such element.
fn change(row: &Variable<HumanOperator>, i: usize, human: &mut HumanOperator) -> bool {
    if i >= row.len {
        return false;
    }
    match row.access {
        Access::Real { at, .. } => at.set(human, i, at.get(human, i) + 0.01),
        Access::Integer { at, .. } | Access::Enumeration { at, .. } => {
            at.set(human, i, 3 - at.get(human, i))
        }
        Access::Boolean { at } => at.set(human, i, !at.get(human, i)),
        Access::Wide { .. } | Access::String { .. } | Access::Binary { .. } => {
            panic!("no row is one")
        }
    }
    true
}

#[test]
fn declared_initial_dependencies_are_the_true_ones() {
    // Starts at which everything that can matter does: half-way in both ramps, the hand on, the hand just off.
    let mut base = HumanOperator {
        inputs: Inputs {
            p: [0.1, 0.2, 0.3],
            dp: [0.1, 0.2, 0.3],
        },
        k_h: 10.0,
        b_h: 1.0,
        delay: 0.1,
        ..HumanOperator::default()
    };
    for i in 0..3 {
        base.segments[i].amplitude = 2.0;
        base.segments[i].t_on = -0.2;
        base.segments[i].t_off = -0.1;
        base.segments[i].ramp = 0.5;
        base.segments[i].phase = 0.3;
    }
    let elsewhere = HumanOperator {
        intended_from_start: false,
        ..base.clone()
    };
    let letting_go = HumanOperator {
        let_go: 0.03,
        ..base.clone()
    };
    let mut to_and_fro = base.clone();
    to_and_fro.target.kind = SINE;
    to_and_fro.target.amplitude = [0.1; 3];
    to_and_fro.target.phase = [0.3; 3];
    (to_and_fro.target.t_on, to_and_fro.target.t_off) = (-0.2, -0.1);
    to_and_fro.target.ramp = 0.05;
    let mut opening = to_and_fro.clone();
    (opening.target.t_on, opening.target.t_off) = (0.0, 1.0);
    let mut closing = to_and_fro.clone();
    (closing.target.t_on, closing.target.t_off) = (-1.0, 0.0);
    // On the way from the second point to the third one, and to the second one, which is the last.
    let mut on_the_way = base.clone();
    on_the_way.target.kind = TABLE;
    on_the_way.target.used = 3;
    for (i, t) in [-0.5, 0.0, 0.1].into_iter().enumerate() {
        let x = 0.1 * t;
        on_the_way.target.points[i] = Point { t, x, y: x, z: x };
    }
    let mut stopping = on_the_way.clone();
    stopping.target.used = 2;
    let rows = HumanOperator::DESCRIPTION.variables;
    for output in rows.iter().filter(|row| row.causality == Causality::Output) {
        let mut found = BTreeSet::new();
        for row in rows.iter().filter(|row| row.causality != Causality::Output) {
            for base in [
                &base,
                &elsewhere,
                &letting_go,
                &opening,
                &closing,
                &on_the_way,
                &stopping,
            ] {
                for i in 0..3 {
                    let mut changed = base.clone();
                    let there = change(row, i, &mut changed);
                    // A start away from 0, so that the frequency matters.
                    let mut before = base.clone();
                    before.initialize(0.03, &mut Log::silent()).unwrap();
                    if there
                        && changed.initialize(0.03, &mut Log::silent()).is_ok()
                        && outputs(output, &before) != outputs(output, &changed)
                    {
                        found.insert(row.name);
                    }
                }
            }
        }
        let declared: BTreeSet<_> = output.initially_from.iter().copied().collect();
        assert_eq!(declared, found, "{}", output.name);
    }
}

#[test]
fn the_names_that_others_rely_on_are_there() {
    let names: Vec<_> = HumanOperator::DESCRIPTION
        .scalars()
        .map(|s| s.name())
        .collect();
    for name in [
        "p[1]",
        "dp[3]",
        "f_h[2]",
        "k_h",
        "b_h",
        "delay",
        "segment[16].axis",
        "segment[16].kind",
        "segment[1].t_on",
        "segment[1].t_off",
        "segment[1].ramp",
        "segment[1].amplitude",
        "segment[1].frequency",
        "segment[1].phase",
        "p_intended[3]",
        "intended_from_start",
        "target.kind",
        "target.amplitude[3]",
        "target.point[16].z",
        "k_h_factor[1]",
        "p_target[3]",
    ] {
        assert!(names.iter().any(|n| n == name), "{name}");
    }
}
