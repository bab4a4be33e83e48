//! Lists that are known, beside the long way.

use super::*;
use crate::ffi::fmi3::Logger;
use crate::kind::{fmi2, fmi3};
use crate::legality::Interface;
use crate::log::{Enabled, Sink};
use crate::{Log, Model, Refusal, Step};
use fmu_declaration::Variability::{Continuous, Fixed, Tunable};
use fmu_declaration::{Declare, Description, Experiment, Stepping, real, unit};
use std::convert::Infallible;

#[derive(Clone, Default, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
struct Mixed {
    u: [f64; 4],
    gain: f64,
    y: [f64; 3],
    tuned: u32,
}

impl Declare for Mixed {
    const DESCRIPTION: Description<Self> = Description {
        name: "Mixed",
        about: "inputs, parameters, outputs",
        stepping: Stepping::Exact,
        experiment: Experiment {
            start: 0.0,
            stop: 1.0,
            tolerance: 1e-6,
            step: 0.1,
        },
        variables: &[
            real!(u[4], unit::NEWTON).input(Continuous).numbered(0),
            real!(gain, unit::NEWTON).parameter(Tunable).numbered(1),
            real!(y[3], unit::NEWTON).output(Continuous).numbered(2),
            real!(y[3], unit::NEWTON).parameter(Fixed).numbered(3),
        ],
    };
}

impl Model for Mixed {
    fn initialize(&mut self, _: f64, _: &mut Log<'_>) -> Result<(), Refusal> {
        Ok(())
    }

    fn tune(&mut self, _: &mut Log<'_>) -> Result<(), Refusal> {
        self.tuned += 1;
        Ok(())
    }

    fn step(&mut self, step: Step, _: &mut Log<'_>) -> Result<(), Refusal> {
        self.y = [self.u[0] * step.h, self.u[1] + 1.0, self.u[3]];
        Ok(())
    }
}

fn running(interface: Interface) -> Instance<Mixed> {
    let sink = Sink::Fmi3(Logger {
        log_message: None,
        environment: std::ptr::null_mut(),
    });
    let name = c"mixed".to_owned();
    let mut instance = Instance::new(sink, name, Enabled::all(false), None, interface);
    assert!(instance.enter_initialization_mode().is_ok());
    assert!(instance.exit_initialization_mode().is_ok());
    instance
}

fn set(instance: &mut Instance<Mixed>, references: &[u32], values: &[f64]) -> bool {
    let take = |value| Ok::<_, Infallible>(value);
    instance
        .set_all::<fmi2::Real, f64, _>(references, values, take)
        .is_ok()
}

fn get(instance: &mut Instance<Mixed>, references: &[u32]) -> Vec<f64> {
    let mut values = vec![f64::NAN; references.len()];
    let done = instance.get_all::<fmi2::Real, f64>(references, &mut values, |value| value);
    assert!(done.is_ok());
    values
}

fn knows_set(instance: &Instance<Mixed>, references: &[u32]) -> bool {
    let sets = &instance.routes.reals.sets;
    sets.find(references, references.len()).is_some()
}

#[test]
fn a_known_list_sets_and_gets_what_an_unknown_one_does() {
    let mut instance = running(Interface::Fmi2);
    let (inputs, outputs) = ([3, 0, 1], [2 * 256, 2 * 256 + 2, 2 * 256 + 1, 3]);
    for (i, u) in [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [-7.0, 8.0, -0.0]]
        .iter()
        .enumerate()
    {
        assert_eq!(knows_set(&instance, &inputs), i > 0);
        assert!(set(&mut instance, &inputs, u));
        assert!(instance.step(0.1 * i as f64, 0.1).is_ok());
        let expected = [u[1] * 0.1, u[0], u[2] + 1.0, u[0]];
        assert_eq!(get(&mut instance, &outputs), expected);
    }
    assert_eq!(instance.now.model.u, [8.0, -0.0, 0.0, -7.0]);
    assert!(instance.is_known::<fmi2::Real>(&outputs, 4));
    // Neither a part of a list nor another one is known, nor the list of another type.
    assert!(!instance.is_known::<fmi2::Real>(&outputs[..3], 3));
    assert!(!instance.is_known::<fmi2::Integer>(&outputs, 4));
    assert!(!instance.is_known::<fmi3::Float32>(&outputs, 4));
}

#[test]
fn a_value_that_is_refused_leaves_all_of_a_known_list_as_it_was() {
    let mut instance = running(Interface::Fmi2);
    assert!(set(&mut instance, &[0, 1, 2], &[1.0, 2.0, 3.0]) && knows_set(&instance, &[0, 1, 2]));
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(
            !set(&mut instance, &[0, 1, 2], &[4.0, 5.0, wrong]),
            "{wrong}"
        );
        assert_eq!(instance.now.model.u, [1.0, 2.0, 3.0, 0.0]);
    }
}

#[test]
fn parameters_are_tuned_and_refused_by_their_rows_however_often_they_come() {
    let mut instance = running(Interface::Fmi2);
    for i in 1..=200 {
        assert!(set(&mut instance, &[0, 1, 256], &[0.5; 3]));
        assert_eq!(instance.now.model.tuned, i);
        assert!(!set(&mut instance, &[0, 1, 3 * 256], &[0.5; 3]));
        assert!(!set(&mut instance, &[0, 1, 2 * 256], &[0.5; 3]));
        assert!(!set(&mut instance, &[0, 1, 77], &[0.5; 3]));
    }
    assert!(instance.routes.reals.sets.count == 0);
}

#[test]
fn lists_that_no_longer_come_make_room_for_others() {
    let mut instance = running(Interface::Fmi2);
    let list = |i: u32| [0, 1, 2, 3, i % 4, i / 4 % 4, i / 16];
    for i in 0..60 {
        for _ in 0..70 {
            let values = [0.5 + f64::from(i); 7];
            assert!(set(&mut instance, &list(i), &values));
            assert_eq!(get(&mut instance, &list(i)), values);
        }
        assert!(knows_set(&instance, &list(i)), "{i}");
        assert!(instance.routes.reals.sets.count <= LISTS);
    }
    assert!(!knows_set(&instance, &list(0)));
}

#[test]
fn in_initialization_mode_a_known_list_shows_a_model_that_was_computed() {
    let mut instance = running(Interface::Fmi2);
    assert_eq!(get(&mut instance, &[0, 1, 2]), [0.0; 3]);
    assert!(set(&mut instance, &[0, 1, 2], &[1.0; 3]));
    assert!(instance.reset().is_ok() && instance.enter_initialization_mode().is_ok());
    assert!(set(&mut instance, &[0, 1, 2], &[2.0; 3]) && instance.stale);
    assert_eq!(get(&mut instance, &[0, 1, 2]), [2.0; 3]);
    assert!(!instance.stale);
}

#[test]
fn a_known_reference_of_fmi_3_stands_for_all_elements_and_no_other_number_of_values() {
    let mut instance = running(Interface::CoSimulation);
    let mut values = [0.0; 7];
    for i in 0..3 {
        let take = |value| Ok::<_, Infallible>(value);
        let given = [1.0, 2.0, 3.0, 4.0 + f64::from(i)];
        let done = instance.set_all::<fmi3::Float64, f64, _>(&[0], &given, take);
        assert!(done.is_ok() && instance.step(0.1 * f64::from(i), 0.1).is_ok());
        let done =
            instance.get_all::<fmi3::Float64, f64>(&[2 * 256, 0], &mut values, |value| value);
        assert!(done.is_ok());
        assert_eq!(values[..3], [0.1, 3.0, given[3]]);
        assert_eq!(values[3..], given);
    }
    assert!(instance.is_known::<fmi3::Float64>(&[2 * 256, 0], 7));
    assert!(!instance.is_known::<fmi3::Float64>(&[2 * 256, 0], 6));
    assert!(instance.is_known::<fmi3::Float64>(&[0], 4));
}
