//! Right after initialization: the start state, and refusals that name variable, value and range.

use fmu_declaration::{Access, Causality, Declare, Variable};
use fmu_export::{Log, Model};
use mechanics::Energy;
use mechanics::testbed::{Forces, Start};
use testbed::Testbed;

fn initialized(mut plant: Testbed) -> Result<Testbed, String> {
    plant
        .initialize(0.0, &mut Log::silent())
        .map_err(|refusal| refusal.0)?;
    Ok(plant)
}

#[test]
fn outputs_show_the_start_state() {
    let mut plant = initialized(Testbed {
        start: Start { q: 0.1, dq: -2.0 },
        forces: Forces {
            tau_h: 3.0,
            ..Forces::default()
        },
        ..Testbed::default()
    })
    .unwrap();
    assert_eq!(
        (
            plant.outputs.q,
            plant.outputs.dq,
            plant.outputs.tau_h_measured,
            plant.outputs.tau_e
        ),
        (0.1, -2.0, 3.0, 0.0)
    );
    assert_eq!(plant.outputs.tau_f, 0.64 + 0.19 * 2.0);
    assert_eq!(
        plant.outputs.energy,
        Energy {
            kinetic: 12.0,
            ..Energy::default()
        }
    );

    // A second initialization, after a change, starts from parameters and inputs alone.
    plant.start.q = 0.2;
    plant.start.dq = 0.0;
    let again = initialized(plant).unwrap();
    assert_eq!(
        (
            again.outputs.q,
            again.outputs.dq,
            again.outputs.tau_f,
            again.outputs.energy
        ),
        (0.2, 0.0, 0.0, Energy::default())
    );
}

#[test]
fn start_values_are_accepted_and_are_the_papers() {
    let plant = initialized(Testbed::default()).unwrap();
    assert_eq!(plant, Testbed::default());
    assert_eq!(
        (
            plant.parameters.M,
            plant.parameters.friction.F_c,
            plant.parameters.friction.b
        ),
        (6.0, 0.64, 0.19)
    );
    assert_eq!(
        (
            plant.parameters.wall.q,
            plant.parameters.wall.k,
            plant.parameters.wall.c
        ),
        (0.3, 1e5, 300.0)
    );
    assert_eq!(
        (plant.start.q, plant.start.dq, plant.substep),
        (0.0, 0.0, 8e-5)
    );
}

#[test]
fn a_refused_parameter_is_named_with_its_value_and_range() {
    let refused = |change: fn(&mut Testbed)| {
        let mut plant = Testbed::default();
        change(&mut plant);
        initialized(plant).unwrap_err()
    };
    assert_eq!(
        refused(|p| p.parameters.M = -6.0),
        "M = -6.0 kg: expected 0.001 to 1000000.0 kg"
    );
    assert_eq!(
        refused(|p| p.drive.K = -1.0),
        "drive.K = -1.0 N.s/m: expected 0.0 to 1000000.0 N.s/m"
    );
    assert_eq!(
        refused(|p| p.drive.K_P = f64::NAN),
        "drive.K_P = NaN 1/s: expected 0.0 to 1000000.0 1/s"
    );
    assert_eq!(
        refused(|p| p.drive.tau_max = -0.5),
        "drive.tau_max = -0.5 N: expected 0.0 to 1000000.0 N"
    );
    assert_eq!(
        refused(|p| p.mode = 0),
        "drive.mode = 0: expected 1 (torque), 2 (position_servo) or 3 (velocity_servo)"
    );
    assert_eq!(
        refused(|p| p.substep = 0.0),
        "substep = 0.0 s: expected 1e-7 to 0.01 s"
    );
    assert_eq!(
        refused(|p| p.start.q = 0.5),
        "q_start = 0.5 m: expected at most wall.q = 0.3 m, the mass starts outside the wall"
    );
}

fn real(row: &Variable<Testbed>, plant: &Testbed) -> f64 {
    row.value(plant, 0)
        .unwrap_or_else(|| panic!("{} is a Real", row.name))
}

#[test]
fn declared_initial_dependencies_are_the_true_ones() {
    // A start at which everything that can matter does: moving, away from the wall.
    let base = Testbed {
        start: Start { q: 0.0, dq: 0.5 },
        ..Testbed::default()
    };
    let rows = Testbed::DESCRIPTION.variables;
    for output in rows.iter().filter(|row| row.causality == Causality::Output) {
        let mut true_ones: Vec<_> = rows
            .iter()
            .filter(|row| row.causality != Causality::Output)
            .filter(|row| {
                let mut changed = base.clone();
                let at = match row.access {
                    Access::Real { at, .. } => at,
                    Access::Enumeration { at, .. } => {
                        at.set(&mut changed, 0, 2); // the position drive
                        let (before, after) = (
                            initialized(base.clone()).unwrap(),
                            initialized(changed).unwrap(),
                        );
                        return real(output, &before) != real(output, &after);
                    }
                    _ => panic!("{} is a Real or a choice", row.name),
                };
                let less = if row.name == "q_start" { 0.1 } else { 0.0 };
                let value = 0.9 * at.get(&changed, 0) - less;
                at.set(&mut changed, 0, value);
                if row.causality == Causality::Input {
                    at.set(&mut changed, 0, 1.0);
                }
                let (before, after) = (
                    initialized(base.clone()).unwrap(),
                    initialized(changed).unwrap(),
                );
                real(output, &before).to_bits() != real(output, &after).to_bits()
            })
            .map(|row| row.name)
            .collect();
        let mut declared = output.initially_from.to_vec();
        true_ones.sort_unstable();
        declared.sort_unstable();
        assert_eq!(declared, true_ones, "{}", output.name);
    }
}

#[test]
fn the_names_that_others_rely_on_are_there() {
    let names = |causality| -> Vec<_> {
        let rows = Testbed::DESCRIPTION.variables.iter();
        rows.filter(|row| row.causality == causality)
            .map(|row| row.name)
            .collect()
    };
    assert_eq!(
        names(Causality::Input),
        ["tau_a", "tau_h", "tau_d", "q_d", "dq_d"]
    );
    for name in [
        "q",
        "dq",
        "tau_h_measured",
        "tau_e",
        "energy.kinetic",
        "energy.residual",
    ] {
        assert!(names(Causality::Output).contains(&name), "{name}");
    }
    for name in ["M", "F_c", "b", "wall.q", "wall.k", "wall.c", "q_start"] {
        assert!(names(Causality::Parameter).contains(&name), "{name}");
    }
}
