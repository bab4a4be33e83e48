//! Right after initialization: the start state, the declared dependencies, and refusals that name variable, value, range.

mod arm;

use arm::{started, started_at};
use exoskeleton_arm::{ExoskeletonArm, encoder, force_sensor};
use fmu_declaration::{Access, Causality, Declare, Variable};
use fmu_export::{Log, Model};
use mechanics::ParameterError;
use std::collections::BTreeSet;

#[test]
fn outputs_show_the_start_pose_of_the_specification() {
    let arm = started(|_| ());
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 5e-6);
    assert_eq!(arm.outputs.q, [0.0, -1.48096, 1.70138]);
    assert_eq!((arm.outputs.dq, arm.outputs.dp), ([0.0; 3], [0.0; 3]));
    // Rounded in the specification to 10 µm.
    assert!(
        near(arm.outputs.p, [0.44, 0.0, -0.24]),
        "{:?}",
        arm.outputs.p
    );
    assert!(
        (arm.outputs.p_pad[2] + 0.35710).abs() < 5e-6,
        "{:?}",
        arm.outputs.p_pad
    );
    // Gravity without payload: 6.1 and 4.5 N·m, below stiction.
    let g = arm.outputs.rigid_body.g;
    assert!(
        g[0] == 0.0 && (g[1] - 6.1).abs() < 0.05 && (g[2] - 4.5).abs() < 0.05,
        "{g:?}"
    );
    assert_eq!(
        (
            arm.outputs.f_e,
            arm.outputs.tau_applied,
            arm.outputs.tension
        ),
        ([0.0; 3], [0.0; 3], 0.0)
    );
    assert!(!arm.outputs.attached && !arm.outputs.contact);
    let energy = arm.outputs.energy;
    assert_eq!(
        (energy.kinetic, energy.work_tau, energy.residual),
        (0.0, 0.0, 0.0)
    );
}

#[test]
fn the_force_sensor_shows_its_first_sample() {
    let arm = started(|arm| {
        arm.inputs.f_h = [1.0, 2.0, 3.0];
        arm.ft.bias = [0.5, 0.0, -0.5];
    });
    assert_eq!(arm.outputs.f_h_measured, [1.5, 2.0, 2.5]);
}

#[test]
fn a_second_initialization_starts_from_parameters_and_inputs_alone() {
    let change = |arm: &mut ExoskeletonArm| {
        arm.start.q[0] = 0.3;
        arm.start.dq = [0.1, -0.2, 0.3];
        arm.ft.failure = force_sensor::STUCK;
        arm.inputs.f_h = [3.0; 3];
    };
    let fresh = started(change);
    let mut used = started(|arm| arm.inputs.f_h = [-9.0; 3]);
    arm::run(&mut used, 0, 50);
    change(&mut used);
    used.initialize(0.0, &mut Log::silent()).unwrap();
    assert_eq!(used, fresh);
}

#[test]
fn an_impossible_arm_is_refused_with_variable_value_and_range() {
    let refused = |change: fn(&mut ExoskeletonArm)| started_at(0.0, change).unwrap_err();
    for (text, change) in [
        (
            "link.m[2] = -3.5 kg, expected a value from 0.001 to 10000",
            (|arm| arm.parameters.masses.links[1].m = -3.5) as fn(&mut ExoskeletonArm),
        ),
        ("L1 = 0 m, expected a value from 0.01 to 10", |arm| {
            arm.parameters.lengths.L_1 = 0.0;
        }),
        ("q_start[2] = 1.1 rad: expected -2.0 to 1.0 rad", |arm| {
            arm.start.q[1] = 1.1;
        }),
        (
            "friction.F_s[1] = 11.0 N.m: expected 12.0 to 1000000.0 N.m",
            |arm| {
                arm.parameters.friction[0].F_s = 11.0;
            },
        ),
        ("stop.max[3] = 0.05 rad: expected 0.1 to 10.0 rad", |arm| {
            arm.parameters.stops[2].max = 0.05;
        }),
        (
            "payload.m = 0 kg, expected a mass greater than 0, since payload.attached = true",
            |arm| arm.start.attached = true,
        ),
        ("encoder.bits = 0, expected a value from 1 to 40", |arm| {
            arm.encoder.bits = 0
        }),
        (
            "encoder.kind = 4, expected an item of EncoderKind: 1 ideal, 2 motor, 3 joint",
            |arm| arm.encoder.kind = 4,
        ),
        (
            "ft.T = 0 s, expected a value from 0.000001 to 1000",
            |arm| arm.ft.T = 0.0,
        ),
        ("ft.bias[3] = NaN N, expected a finite value", |arm| {
            arm.ft.bias[2] = f64::NAN
        }),
        (
            "substep = 0 s, expected a value from 0.0000001 to 0.01",
            |arm| arm.substep = 0.0,
        ),
    ] {
        assert_eq!(refused(change), text);
    }
    let inside = refused(|arm| arm.parameters.table.z = -0.3);
    assert!(
        inside.starts_with("table.z = -0.3 m: expected -1000.0 to -0.357"),
        "{inside}"
    );
}

#[test]
fn the_physics_refuses_what_lies_beyond_the_bounds_of_any_row() {
    let sensors = ["encoder.", "ft.", "substep"];
    let rows = ExoskeletonArm::DESCRIPTION.variables.iter();
    let mut checked = 0;
    for row in rows.filter(|row| row.causality == Causality::Parameter) {
        let Access::Real {
            range: row_range,
            at,
            ..
        } = row.access
        else {
            continue;
        };
        let (min, max) = (row_range.low, row_range.high);
        if sensors.iter().any(|sensor| row.name.starts_with(sensor)) {
            continue;
        }
        for element in 0..row.len {
            for beyond in [min - 1.0, max + 1.0] {
                let mut arm = ExoskeletonArm::default();
                at.set(&mut arm, element, beyond);
                let Err(error) = arm.parameters.check(&arm.start) else {
                    panic!("{} = {beyond} is accepted", row.element_name(element));
                };
                let ParameterError::OutOfRange { bounds, value } = error else {
                    panic!("{error}");
                };
                assert_eq!(value, beyond);
                let named = format!("{} = ", row.element_name(element));
                assert!(error.to_string().starts_with(&named), "{error}");
                // Relations between parameters may narrow the range, never widen it.
                assert!(bounds.low >= min && bounds.high <= max, "{}", row.name);
                checked += 1;
            }
        }
    }
    assert_eq!(checked, 2 * 88);
}

fn bits(row: &Variable<ExoskeletonArm>, arm: &ExoskeletonArm) -> Vec<u64> {
    match row.access {
        Access::Real { at, .. } => at.values(arm).map(f64::to_bits).collect(),
        Access::Boolean { at } => at.values(arm).map(u64::from).collect(),
        _ => panic!("{} is a Real or a Boolean", row.name),
    }
}

/// Other values that element `i` of a row could have.
fn changed(row: &Variable<ExoskeletonArm>, i: usize, arm: &ExoskeletonArm) -> Vec<ExoskeletonArm> {
    let with = |change: &dyn Fn(&mut ExoskeletonArm)| {
        let mut other = arm.clone();
        change(&mut other);
        other
    };
    match row.access {
        Access::Real { at, .. } => [1.0, -1.0]
            .map(|sign| {
                with(&|arm| {
                    let value = at.get(arm, i);
                    at.set(arm, i, value + sign * (0.001 + 0.01 * value.abs()));
                })
            })
            .into(),
        Access::Integer { at, .. } => [1, 5]
            .map(|more| with(&|arm| at.set(arm, i, at.get(arm, i) + more)))
            .into(),
        Access::Enumeration { of, at, .. } => of
            .items
            .iter()
            .map(|item| with(&|arm| at.set(arm, i, item.value)))
            .collect(),
        Access::Boolean { at } => vec![with(&|arm| at.set(arm, i, !at.get(arm, i)))],
        Access::Wide { .. } | Access::String { .. } | Access::Binary { .. } => {
            panic!("no row is one")
        }
    }
}

#[test]
fn declared_initial_dependencies_are_the_true_ones() {
    // Starts at which everything that can matter does.
    let mut moving = ExoskeletonArm::default();
    moving.inputs.f_h = [3.0, -4.0, 5.0];
    moving.start.q = [0.3, -1.0, 1.2];
    moving.start.dq = [0.5, 0.4, -0.3];
    moving.parameters.masses.gravity = [0.3, 0.2, -9.8];
    moving.parameters.payload_m = 7.0;
    moving.start.attached = true;
    moving.encoder.kind = encoder::MOTOR;
    moving.ft.frame = force_sensor::SENSOR;
    moving.ft.noise = 0.1;
    moving.ft.tool_m = 2.0;
    let mut failed = moving.clone();
    failed.encoder.kind = encoder::JOINT;
    failed.ft.failure = force_sensor::OVER_RANGE;
    let rows = ExoskeletonArm::DESCRIPTION.variables;
    let given =
        |row: &&Variable<_>| matches!(row.causality, Causality::Input | Causality::Parameter);
    for output in rows.iter().filter(|row| row.causality == Causality::Output) {
        let mut found = BTreeSet::new();
        for base in [&moving, &failed] {
            let mut before = base.clone();
            before.initialize(0.0, &mut Log::silent()).unwrap();
            for row in rows.iter().filter(given) {
                for mut other in (0..row.len).flat_map(|i| changed(row, i, base)) {
                    if other.initialize(0.0, &mut Log::silent()).is_ok()
                        && bits(output, &other) != bits(output, &before)
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
fn only_the_force_sensor_may_show_nan() {
    let rows = ExoskeletonArm::DESCRIPTION.variables.iter();
    let names: Vec<_> = rows
        .filter(|row| row.may_be_nan)
        .map(|row| row.name)
        .collect();
    assert_eq!(names, ["f_h_measured[i]"]);
}

#[test]
fn the_names_that_others_rely_on_are_there() {
    let names = |causality| -> Vec<_> {
        let scalars = ExoskeletonArm::DESCRIPTION.scalars();
        scalars
            .filter(|scalar| scalar.variable.causality == causality)
            .map(|scalar| scalar.name())
            .collect()
    };
    let inputs = names(Causality::Input);
    assert_eq!(inputs.len(), 16);
    for name in [
        "tau_a[1]", "f_h[3]", "f_d[2]", "vacuum", "q_d[1]", "dq_d[3]",
    ] {
        assert!(inputs.iter().any(|n| n == name), "{name}");
    }
    for name in [
        "q[1]",
        "dq[2]",
        "p[3]",
        "dp[1]",
        "f_h_measured[3]",
        "f_e[3]",
        "tau_applied[2]",
        "tau_drive[1]",
        "attached",
        "contact",
        "energy.kinetic",
        "energy.residual",
    ] {
        assert!(names(Causality::Output).iter().any(|n| n == name), "{name}");
    }
    for name in [
        "payload.m",
        "table.z",
        "table.k",
        "table.c",
        "wall.x",
        "vacuum.F_max",
        "q_start[3]",
        "encoder.kind",
        "encoder.counts",
        "encoder.bits",
        "ft.frame",
        "ft.bias[1]",
        "ft.noise",
        "ft.seed",
        "ft.T",
        "ft.range",
        "ft.failure",
        "ft.t_failure",
        "substep",
        "link.m[3]",
        "friction.F_s[2]",
        "gear[1]",
        "drive.cutoff",
        "drive.mode",
        "drive.K[1]",
        "drive.K_P[2]",
        "drive.tau_max[3]",
        "gravity[3]",
    ] {
        assert!(
            names(Causality::Parameter).iter().any(|n| n == name),
            "{name}"
        );
    }
}
