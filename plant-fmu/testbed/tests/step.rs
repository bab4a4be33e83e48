//! Communication steps: any length, exact ends, inputs held, state saved and restored.

use fmu_export::{Log, Model, Step};
use mechanics::testbed::{Forces, Start};
use mechanics::wall::Wall;
use testbed::Testbed;

fn started(mut plant: Testbed) -> Testbed {
    plant.initialize(0.0, &mut Log::silent()).unwrap();
    plant
}

fn step(plant: &mut Testbed, t: f64, h: f64) {
    plant.step(Step::at(t, h), &mut Log::silent()).unwrap();
}

/// Lands on the wall within 20 ms.
fn before_the_wall() -> Testbed {
    started(Testbed {
        start: Start { q: 0.295, dq: 0.5 },
        forces: Forces {
            tau_a: 3.0,
            tau_h: -1.0,
            tau_d: 0.5,
        },
        ..Testbed::default()
    })
}

#[test]
fn one_step_of_10_ms_equals_five_of_2_ms_bit_for_bit() {
    let (mut one, mut five) = (before_the_wall(), before_the_wall());
    for k in 0..20 {
        let t = f64::from(k) * 0.01;
        step(&mut one, t, 0.01);
        for i in 0..5 {
            step(&mut five, t + f64::from(i) * 0.002, 0.002);
        }
        assert_eq!(
            postcard::to_allocvec(&one).unwrap(),
            postcard::to_allocvec(&five).unwrap()
        );
    }
    assert!(one.outputs.energy.loss_wall > 0.0);
}

#[test]
fn a_step_ends_exactly_at_its_end_whatever_its_length() {
    // Free flight at constant velocity: q = dq_start · h, so a missing or extra substep would show.
    for h in [
        1e-9,
        7.9e-5,
        8.1e-5,
        0.002,
        0.003_000_000_000_000_1,
        0.123_456,
        3.0,
    ] {
        let mut plant = Testbed::default();
        plant.parameters.wall.q = Wall::NONE;
        plant.start.dq = 0.25;
        plant.parameters.friction.F_c = 0.0;
        plant.parameters.friction.b = 0.0;
        let mut plant = started(plant);
        step(&mut plant, 0.0, h);
        // Rounding of the step size to 1/n of h, and of the product.
        assert!(
            (plant.outputs.q / (0.25 * h) - 1.0).abs() < 1e-15,
            "{h}: {:e}",
            plant.outputs.q / (0.25 * h) - 1.0
        );
    }
}

#[test]
fn the_time_of_the_importer_does_not_matter_to_a_plant_without_clock() {
    let (mut early, mut late) = (before_the_wall(), before_the_wall());
    step(&mut early, 0.0, 0.02);
    step(&mut late, 86_400.0, 0.02);
    assert_eq!(early, late);
}

#[test]
fn the_load_cell_shows_the_humans_force_as_held_during_the_step() {
    let mut plant = before_the_wall();
    plant.forces.tau_h = 2.0;
    plant.forces.tau_d = 7.0;
    assert_eq!(plant.outputs.tau_h_measured, -1.0); // set, not yet stepped: no direct feedthrough
    step(&mut plant, 0.0, 0.002);
    assert_eq!(plant.outputs.tau_h_measured, 2.0); // and not the disturbance
}

#[test]
fn each_input_pushes_along_plus_q_and_books_its_own_work() {
    for input in 0..3 {
        let mut plant = started(Testbed::default());
        *[
            &mut plant.forces.tau_a,
            &mut plant.forces.tau_h,
            &mut plant.forces.tau_d,
        ][input] = 2.0;
        step(&mut plant, 0.0, 0.1);
        assert!(plant.outputs.q > 0.0 && plant.outputs.dq > 0.0);
        let works = [
            plant.outputs.energy.work_tau_a,
            plant.outputs.energy.work_tau_h,
            plant.outputs.energy.work_tau_d,
        ];
        for (i, work) in works.into_iter().enumerate() {
            let expected = if i == input {
                2.0 * plant.outputs.q
            } else {
                0.0
            };
            assert!((work - expected).abs() < 1e-15, "{works:?}");
        }
    }
}

#[test]
fn a_saved_state_continues_bit_for_bit() {
    let mut plant = before_the_wall();
    step(&mut plant, 0.0, 0.012); // in contact
    assert!(plant.outputs.tau_e < 0.0);
    let bytes = postcard::to_allocvec(&plant).unwrap();
    let mut restored: Testbed = postcard::from_bytes(&bytes).unwrap();
    for k in 0..100 {
        let t = 0.012 + f64::from(k) * 0.002;
        step(&mut plant, t, 0.002);
        step(&mut restored, t, 0.002);
    }
    assert_eq!(
        postcard::to_allocvec(&plant).unwrap(),
        postcard::to_allocvec(&restored).unwrap()
    );
}

#[test]
fn a_force_that_leaves_the_range_of_numbers_fails_the_step_and_is_named() {
    let mut plant = started(Testbed {
        forces: Forces {
            tau_h: 1e308,
            ..Forces::default()
        },
        ..Testbed::default()
    });
    let refusal = plant
        .step(Step::at(0.0, 1.0), &mut Log::silent())
        .unwrap_err();
    assert!(
        refusal
            .0
            .starts_with("motion left the range of numbers: q = "),
        "{refusal}"
    );
    assert!(refusal.0.contains("tau_h = 1e308 N"), "{refusal}");
}

#[test]
fn a_step_that_would_seem_to_hang_is_not_accepted() {
    let plant = started(Testbed::default());
    let step = |h| Step::at(0.0, h);
    assert_eq!(plant.accepts(&step(8000.0)), Ok(()));
    assert_eq!(
        plant.accepts(&step(1e9)).unwrap_err().0,
        "communicationStepSize = 1000000000.0 s, expected at most 8000.000000000001 s (1e8 times substep)"
    );
}
