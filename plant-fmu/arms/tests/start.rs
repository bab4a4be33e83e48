//! Right after initialization: the start state, the declared dependencies, and refusals that name variable, value, range.

mod arms;

use arms::{run, started, tried};
use exoskeleton_arm::ExoskeletonArm;
use exoskeleton_arms::ExoskeletonArms;
use fmu_declaration::{Access, Causality, Declare, Variable};
use fmu_export::{Log, Model};
use std::collections::BTreeSet;

#[test]
fn shoulders_stand_at_plus_and_minus_base_y() {
    let mut arm = ExoskeletonArm::default();
    arm.initialize(0.0, &mut Log::silent()).unwrap();
    let both = started(|arms| arms.base.y = 0.25);
    for (side, y) in [(&both.outputs.left, 0.25), (&both.outputs.right, -0.25)] {
        assert_eq!(side.q, arm.outputs.q);
        assert_eq!(
            side.p,
            [arm.outputs.p[0], arm.outputs.p[1] + y, arm.outputs.p[2]]
        );
        assert_eq!(
            side.p_pad,
            [
                arm.outputs.p_pad[0],
                arm.outputs.p_pad[1] + y,
                arm.outputs.p_pad[2]
            ]
        );
    }
    assert_eq!(
        (both.outputs.gap, both.outputs.lambda, both.outputs.attached),
        (0.0, [0.0; 3], false)
    );
}

#[test]
fn a_second_initialization_starts_from_parameters_and_inputs_alone() {
    let change = |arms: &mut ExoskeletonArms| {
        arms.start.q[0] = 0.3;
        arms.parameters.arm.payload_m = 5.0;
        arms.start.attached = true;
    };
    let fresh = started(change);
    let mut used = started(|arms| {
        change(arms);
        arms.inputs.left.tau_a = [30.0; 3];
    });
    run(&mut used, 0, 50);
    used.inputs.left.tau_a = [0.0; 3];
    used.initialize(0.0, &mut Log::silent()).unwrap();
    assert_eq!(used, fresh);
}

#[test]
fn impossible_arms_are_refused_with_variable_value_and_range() {
    for (text, change) in [
        (
            "link.m[2] = -3.5 kg, expected a value from 0.001 to 10000",
            (|arms| arms.parameters.arm.masses.links[1].m = -3.5) as fn(&mut ExoskeletonArms),
        ),
        ("q_start[2] = 1.1 rad: expected -2.0 to 1.0 rad", |arms| {
            arms.start.q[1] = 1.1;
        }),
        (
            "payload.m = 0 kg, expected a mass greater than 0, since payload.attached = true",
            |arms| arms.start.attached = true,
        ),
        (
            "bond.k = 1 N/m, expected a value from 10000 to 10000000000",
            |arms| arms.parameters.bond.k = 1.0,
        ),
        ("base.y = NaN m, expected a finite value", |arms| {
            arms.base.y = f64::NAN;
        }),
    ] {
        assert_eq!(tried(change).unwrap_err(), text);
    }
}

#[test]
fn the_table_of_the_arm_is_that_of_the_single_arm() {
    type Row = (&'static str, usize, Option<(u64, u64)>, &'static str);
    fn rows<M: Declare>(but: &[&str]) -> Vec<Row> {
        let rows = M::DESCRIPTION.variables.iter();
        rows.filter(|row| row.causality == Causality::Parameter)
            .filter(|row| !but.iter().any(|but| row.name.starts_with(but)))
            .map(|row| {
                let bounds = match row.access {
                    Access::Real { range, .. } => Some((range.low.to_bits(), range.high.to_bits())),
                    _ => None,
                };
                (row.name, row.len, bounds, row.about)
            })
            .collect()
    }
    let one = rows::<ExoskeletonArm>(&["encoder.", "ft.", "payload.m"]);
    assert_eq!(
        rows::<ExoskeletonArms>(&["bond.", "base.", "payload.m"]),
        one
    );
    assert_eq!(one.len(), 44);
}

#[test]
fn each_side_has_the_ports_of_the_single_arm() {
    let single: Vec<_> = ExoskeletonArm::DESCRIPTION.variables.iter().collect();
    let both: Vec<_> = ExoskeletonArms::DESCRIPTION.variables.iter().collect();
    for side in ["left.", "right."] {
        let mut seen = 0;
        for row in both.iter().filter(|row| row.full_name().starts_with(side)) {
            let like = single
                .iter()
                .find(|one| row.full_name()[side.len()..] == one.full_name());
            let like = like.unwrap_or_else(|| panic!("{} is not of the single arm", row.name));
            assert_eq!(
                (row.len, row.causality),
                (like.len, like.causality),
                "{}",
                row.name
            );
            seen += 1;
        }
        assert_eq!(seen, 18);
    }
}

fn bits(row: &Variable<ExoskeletonArms>, arms: &ExoskeletonArms) -> Vec<u64> {
    match row.access {
        Access::Real { at, .. } => at.values(arms).map(f64::to_bits).collect(),
        Access::Boolean { at } => at.values(arms).map(u64::from).collect(),
        _ => panic!("{} is a Real or a Boolean", row.name),
    }
}

/// Other values that element `i` of a row could have.
fn changed(
    row: &Variable<ExoskeletonArms>,
    i: usize,
    arms: &ExoskeletonArms,
) -> Vec<ExoskeletonArms> {
    let with = |change: &dyn Fn(&mut ExoskeletonArms)| {
        let mut other = arms.clone();
        change(&mut other);
        other
    };
    match row.access {
        Access::Real { at, .. } => [1.0, -1.0]
            .map(|sign| {
                with(&|arms| {
                    let value = at.get(arms, i);
                    at.set(arms, i, value + sign * (0.001 + 0.01 * value.abs()));
                })
            })
            .into(),
        Access::Boolean { at } => vec![with(&|arms| at.set(arms, i, !at.get(arms, i)))],
        Access::Enumeration { of, at, .. } => (of.items.iter())
            .map(|item| with(&|arms| at.set(arms, i, item.value)))
            .collect(),
        _ => panic!("{} is a Real or a Boolean", row.name),
    }
}

#[test]
fn declared_initial_dependencies_are_the_true_ones() {
    // A start at which everything that can matter does.
    let mut moving = ExoskeletonArms::default();
    moving.start.q = [0.3, -1.0, 1.2];
    moving.start.dq = [0.5, 0.4, -0.3];
    moving.parameters.arm.masses.gravity = [0.3, 0.2, -9.8];
    moving.parameters.arm.payload_m = 7.0;
    moving.start.attached = true;
    let mut before = moving.clone();
    before.initialize(0.0, &mut Log::silent()).unwrap();
    let rows = ExoskeletonArms::DESCRIPTION.variables;
    let mut checked = 0;
    for output in rows.iter().filter(|row| row.causality == Causality::Output) {
        let mut found = BTreeSet::new();
        for row in rows
            .iter()
            .filter(|row| matches!(row.causality, Causality::Input | Causality::Parameter))
        {
            for mut other in (0..row.len).flat_map(|i| changed(row, i, &moving)) {
                if other.initialize(0.0, &mut Log::silent()).is_ok()
                    && bits(output, &other) != bits(output, &before)
                {
                    found.insert(row.full_name());
                }
            }
        }
        let declared: BTreeSet<_> = output
            .initially_from
            .iter()
            .map(|&name| name.to_owned())
            .collect();
        assert_eq!(declared, found, "{}", output.name);
        checked += usize::from(!found.is_empty());
    }
    assert_eq!(checked, 2 * 5 + 3); // q, dq, p, dp, p_pad; attached, kinetic, potential
}
