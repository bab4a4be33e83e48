//! The `fmi` crate couples the built FMUs; the models linked into this test do the same without FMI.

use fmi::fmi2::instance::{CoSimulation as _, Common as _};
use fmu_declaration::place::Place;
use fmu_declaration::{Access, Causality, Declare};
use fmu_export::{Log, Model, Step};
use importers::{Imported, Type};
use testbed::Testbed;
use testbed_controller::TestbedController;

/// Sample period of the controller (s).
const T: f64 = 0.002;

/// One second of the loop, into the wall and out again.
const STEPS: u32 = 500;

/// A model as the test drives it: by variable name, behind FMI or not.
trait Driven {
    fn set(&mut self, name: &str, value: f64);
    fn initialize(&mut self);
    fn step(&mut self, t: f64);
    /// All Real outputs as bits, then the Integers and Booleans.
    fn outputs(&mut self) -> Vec<u64>;
    fn real(&mut self, name: &str) -> f64;
}

/// The built FMU.
struct Built(Imported);

impl Built {
    fn new<M: Declare>() -> Self {
        let path = importers::archive(M::DESCRIPTION.name);
        Self(Imported::open(&path).unwrap_or_else(|error| panic!("{error}")))
    }

    fn reference(&self, name: &str) -> u32 {
        self.0
            .reference(name)
            .unwrap_or_else(|error| panic!("{error}"))
    }
}

impl Driven for Built {
    fn set(&mut self, name: &str, value: f64) {
        self.0
            .set(name, value)
            .unwrap_or_else(|error| panic!("{error}"));
    }

    fn initialize(&mut self) {
        self.0
            .initialize()
            .unwrap_or_else(|error| panic!("{error}"));
    }

    fn step(&mut self, t: f64) {
        self.0.step(t, T).unwrap_or_else(|error| panic!("{error}"));
    }

    fn outputs(&mut self) -> Vec<u64> {
        let references = self.0.outputs(Type::Real);
        let mut reals = vec![f64::NAN; references.len()];
        self.0
            .instance
            .get_real(&references, &mut reals)
            .expect("read");
        let mut all: Vec<u64> = reals.into_iter().map(f64::to_bits).collect();
        let references = self.0.outputs(Type::Integer);
        let mut integers = vec![i32::MIN; references.len()];
        self.0
            .instance
            .get_integer(&references, &mut integers)
            .expect("read");
        all.extend(integers.into_iter().map(|value| u64::from(value as u32)));
        let references = self.0.outputs(Type::Boolean);
        let mut booleans = vec![-1; references.len()];
        self.0
            .instance
            .get_boolean(&references, &mut booleans)
            .expect("read");
        all.extend(booleans.into_iter().map(|value| u64::from(value as u32)));
        all
    }

    fn real(&mut self, name: &str) -> f64 {
        self.0.get(name).unwrap_or_else(|error| panic!("{error}"))
    }
}

/// The model itself.
struct Linked<M>(M);

impl<M: Model> Linked<M> {
    /// Where the Real of this name lies.
    fn place(name: &str) -> (Place<M, f64>, usize) {
        let scalar = M::DESCRIPTION
            .scalars()
            .find(|scalar| scalar.name() == name)
            .unwrap_or_else(|| panic!("no {name}"));
        match scalar.variable.access {
            Access::Real { at, .. } => (at, scalar.element),
            _ => panic!("{name} is not a Real"),
        }
    }
}

impl<M: Model> Driven for Linked<M> {
    fn set(&mut self, name: &str, value: f64) {
        let (place, element) = Self::place(name);
        place.set(&mut self.0, element, value);
    }

    fn initialize(&mut self) {
        self.0
            .initialize(0.0, &mut Log::silent())
            .expect("initialized");
    }

    fn step(&mut self, t: f64) {
        self.0
            .step(Step::at(t, T), &mut Log::silent())
            .expect("stepped");
    }

    fn outputs(&mut self) -> Vec<u64> {
        let (mut reals, mut integers, mut booleans) = (Vec::new(), Vec::new(), Vec::new());
        for scalar in M::DESCRIPTION.in_order() {
            if scalar.variable.causality != Causality::Output {
                continue;
            }
            let (model, i) = (&self.0, scalar.element);
            match scalar.variable.access {
                Access::Real { at, .. } => reals.push(at.get(model, i).to_bits()),
                // A choice is an Integer in the description.
                Access::Integer { at, .. } | Access::Enumeration { at, .. } => {
                    integers.push(u64::from(at.get(model, i) as u32));
                }
                Access::Boolean { at } => booleans.push(u64::from(at.get(model, i))),
                Access::String { .. } => {}
                Access::Wide { .. } | Access::Binary { .. } => panic!("no FMU here has one"),
            }
        }
        [reals, integers, booleans].concat()
    }

    fn real(&mut self, name: &str) -> f64 {
        let (place, element) = Self::place(name);
        place.get(&self.0, element)
    }
}

/// The zero-delay loop with a hand that pushes the mass against the wall and pulls it back; all outputs of both models
/// after each step.
fn run(
    controller: &mut impl Driven,
    plant: &mut impl Driven,
    steps: std::ops::Range<u32>,
) -> Vec<Vec<u64>> {
    let step = |k| {
        let t = f64::from(k) * T;
        let hand = 12.0 * (std::f64::consts::TAU * 0.9 * t).sin();
        controller.set("tau_h", hand);
        controller.set("q", plant.real("q"));
        controller.step(t);
        plant.set("tau_a", controller.real("tau_a"));
        plant.set("tau_h", hand);
        plant.step(t);
        [controller.outputs(), plant.outputs()].concat()
    };
    steps.map(step).collect()
}

fn prepared<C: Driven, P: Driven>(mut controller: C, mut plant: P) -> (C, P) {
    plant.set("wall.q", 0.02); // near, so that a second is enough to meet it
    controller.set("K", 25.0);
    plant.initialize();
    controller.set("q", plant.real("q"));
    controller.initialize();
    (controller, plant)
}

fn imported() -> (Built, Built) {
    prepared(Built::new::<TestbedController>(), Built::new::<Testbed>())
}

#[test]
fn the_imported_loop_equals_the_linked_models_bit_for_bit() {
    let (mut controller, mut plant) = imported();
    let (mut own_controller, mut own_plant) = prepared(
        Linked(TestbedController::default()),
        Linked(Testbed::default()),
    );
    assert_eq!(
        [controller.outputs(), plant.outputs()],
        [own_controller.outputs(), own_plant.outputs()]
    );
    let through_fmi = run(&mut controller, &mut plant, 0..STEPS);
    let linked = run(&mut own_controller, &mut own_plant, 0..STEPS);
    for (k, (a, b)) in through_fmi.iter().zip(&linked).enumerate() {
        assert_eq!(a, b, "after step {k}");
    }
    assert!(plant.real("energy.loss_wall") > 0.0, "the wall was met");
    assert!(plant.real("q") < 0.02, "and left");
}

#[test]
fn a_restored_state_runs_on_bit_for_bit() {
    let (mut controller, mut plant) = imported();
    run(&mut controller, &mut plant, 0..STEPS / 2);
    let (controller_state, plant_state) = (
        controller.0.instance.get_fmu_state().expect("saved"),
        plant.0.instance.get_fmu_state().expect("saved"),
    );
    let first = run(&mut controller, &mut plant, STEPS / 2..STEPS);
    use fmi::traits::FmiStatus as _;
    controller
        .0
        .instance
        .set_fmu_state(&controller_state)
        .ok()
        .expect("restored");
    plant
        .0
        .instance
        .set_fmu_state(&plant_state)
        .ok()
        .expect("restored");
    assert_eq!(run(&mut controller, &mut plant, STEPS / 2..STEPS), first);
}

#[test]
fn the_last_step_to_the_stop_time_is_made_and_one_past_it_is_refused() {
    let parts = [Built::new::<TestbedController>(), Built::new::<Testbed>()];
    for Built(mut part) in parts {
        part.initialize_until(Some(3.0 * T)).expect("initialized");
        for k in 0..3 {
            part.step(f64::from(k) * T, T).expect("within");
        }
        let refusal = part.step(3.0 * T, T).expect_err("past the stop time");
        assert!(refusal.contains("fmi2DoStep(0.006, 0.002)"), "{refusal}");
    }
}

#[test]
fn a_refused_call_leaves_the_instance_usable() {
    let (mut controller, mut plant) = imported();
    run(&mut controller, &mut plant, 0..3);
    let before = plant.outputs();
    for (t, h) in [
        (3.0 * T, 0.0),
        (3.0 * T, -T),
        (3.0 * T, f64::NAN),
        (3.0 * T, f64::INFINITY),
        (0.5, T),
    ] {
        assert!(
            plant.0.instance.do_step(t, h, true).is_err(),
            "t = {t}, h = {h}"
        );
    }
    let (q, dq) = (plant.reference("q"), plant.reference("tau_h"));
    assert!(
        plant.0.instance.set_real(&[q], &[0.1]).is_err(),
        "an output"
    );
    assert!(
        plant.0.instance.set_real(&[dq], &[f64::NAN]).is_err(),
        "NaN"
    );
    assert!(
        plant.0.instance.set_real(&[u32::MAX], &[0.0]).is_err(),
        "no such value reference"
    );
    assert_eq!(plant.outputs(), before);
    run(&mut controller, &mut plant, 3..6);
    assert_ne!(plant.outputs(), before);
}
