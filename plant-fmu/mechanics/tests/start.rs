//! Start state, refused parameters, and what splitting a run does: nothing.

#![allow(
    non_snake_case,
    reason = "the paper's symbols with its capitals: M, F_c"
)]

use mechanics::friction::Friction;
use mechanics::testbed::{Forces, Parameters, Testbed};
use mechanics::wall::Wall;
use mechanics::{Energy, ParameterError};

#[test]
fn the_default_is_the_papers_testbed_at_rest_and_passes_its_own_checks() {
    let built = Testbed::new(Parameters::default(), 0.0, 0.0).unwrap();
    assert_eq!(built, Testbed::default());
    assert_eq!(
        (built.q(), built.dq(), built.tau_e(), built.tau_f()),
        (0.0, 0.0, 0.0, 0.0)
    );
    assert_eq!(built.energy(), Energy::default());
}

#[test]
fn the_start_state_shows_before_the_first_substep() {
    let plant = Testbed::new(Parameters::default(), 0.1, -2.0).unwrap();
    assert_eq!((plant.q(), plant.dq(), plant.tau_e()), (0.1, -2.0, 0.0));
    assert_eq!(plant.tau_f(), 0.64 + 0.19 * 2.0); // F_c + b |dq|, against the motion
    assert_eq!(
        plant.energy(),
        Energy {
            kinetic: 12.0,
            ..Energy::default()
        }
    ); // ½ · 6 · 2²
}

#[test]
fn one_run_equals_its_parts_bit_for_bit() {
    let start = Testbed::new(Parameters::default(), 0.295, 0.5).unwrap(); // lands within the run
    let forces = Forces {
        tau_a: 3.0,
        tau_h: -1.0,
        tau_d: 0.5,
    };
    let (mut whole, mut parts) = (start, start);
    whole.advance(&forces, 1_250, 8e-5);
    for _ in 0..50 {
        parts.advance(&forces, 25, 8e-5);
    }
    assert!(whole.energy().wall > 0.0);
    assert_eq!(whole, parts); // no NaN and no −0 in it, so equal means equal bits
    assert_eq!(whole.energy(), parts.energy());
}

#[test]
fn a_substep_of_any_length_stays_finite() {
    for dt in [f64::MIN_POSITIVE / 16.0, 1e-300, 1e-15, 1.0, 1e6] {
        let mut plant = Testbed::new(Parameters::default(), 0.3, 0.1).unwrap();
        plant.advance(
            &Forces {
                tau_h: 5.0,
                ..Forces::default()
            },
            10,
            dt,
        );
        let energy = plant.energy();
        let all = [
            plant.q(),
            plant.dq(),
            plant.tau_f(),
            plant.tau_e(),
            energy.work(),
            energy.loss(),
            energy.residual,
        ];
        assert!(all.iter().all(|x| x.is_finite()), "dt = {dt:e}: {all:?}");
    }
}

#[test]
fn the_error_names_variable_value_and_range() {
    let good = Parameters::default();
    let with = |change: fn(&mut Parameters)| {
        let mut parameters = good;
        change(&mut parameters);
        Testbed::new(parameters, 0.0, 0.0).unwrap_err().to_string()
    };
    assert_eq!(
        with(|p| p.M = 0.0),
        "M = 0.0 kg: expected 0.001 to 1000000.0 kg"
    );
    assert_eq!(
        with(|p| p.M = f64::NAN),
        "M = NaN kg: expected 0.001 to 1000000.0 kg"
    );
    assert_eq!(
        with(|p| p.friction.F_c = -0.1),
        "F_c = -0.1 N: expected 0.0 to 1000000.0 N"
    );
    assert_eq!(
        with(|p| p.friction.b = f64::INFINITY),
        "b = inf N.s/m: expected 0.0 to 1000000.0 N.s/m"
    );
    assert_eq!(
        with(|p| p.wall.q = 2e9),
        "wall.q = 2000000000.0 m: expected -1000000000.0 to 1000000000.0 m"
    );
    assert_eq!(
        with(|p| p.wall.k = 0.0),
        "wall.k = 0.0 N/m: expected 1.0 to 1000000000.0 N/m"
    );
    assert_eq!(
        with(|p| p.wall.c = -1.0),
        "wall.c = -1.0 N.s/m: expected 0.0 to 1000000000.0 N.s/m"
    );
    let start = |q, dq| Testbed::new(good, q, dq).unwrap_err();
    assert_eq!(
        start(-2e6, 0.0).to_string(),
        "q_start = -2000000.0 m: expected -1000000.0 to 1000000.0 m"
    );
    assert_eq!(
        start(0.0, 1e4).to_string(),
        "dq_start = 10000.0 m/s: expected -1000.0 to 1000.0 m/s"
    );
    assert_eq!(
        start(0.31, 0.0),
        ParameterError::StartBeyondWall {
            q_start: 0.31,
            wall_q: 0.3
        }
    );
    assert_eq!(
        start(0.31, 0.0).to_string(),
        "q_start = 0.31 m: expected at most wall.q = 0.3 m, the mass starts outside the wall"
    );
}

#[test]
fn a_start_that_touches_the_wall_is_allowed() {
    let plant = Testbed::new(Parameters::default(), 0.3, 0.0).unwrap();
    assert_eq!((plant.tau_e(), plant.state().s), (0.0, 0.0));
}

#[test]
fn the_extremes_of_every_range_are_accepted() {
    for (M, F_c, b, k, c) in [(1e-3, 0.0, 0.0, 1.0, 0.0), (1e6, 1e6, 1e6, 1e9, 1e9)] {
        for q in [-1e9, Wall::NONE] {
            let parameters = Parameters {
                M,
                friction: Friction { F_c, b },
                wall: Wall { q, k, c },
            };
            let q_start = q.clamp(-1e6, 1e6).min(q);
            match Testbed::new(parameters, q_start, 0.0) {
                Ok(mut plant) => {
                    plant.advance(
                        &Forces {
                            tau_h: 1.0,
                            ..Forces::default()
                        },
                        100,
                        8e-5,
                    );
                    assert!(plant.q().is_finite() && plant.dq().is_finite());
                }
                // A wall at −1e9 m leaves no room in which to start.
                Err(error) => assert!(
                    matches!(error, ParameterError::OutOfRange { value: -1e9, .. }),
                    "{error}"
                ),
            }
        }
    }
}
