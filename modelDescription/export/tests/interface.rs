//! A model in one file, with the package `fmu-export` alone: what `#[interface]` and `#[group]` declare.

use fmu_export::declaration::{Access, Causality, Stepping, Variability};
use fmu_export::unit::{Base, Unit};
use fmu_export::{Declare, Log, Model, Refusal, Step, choices, group, interface};

const LITRE_PER_HOUR: Unit = Unit::new(
    "l/h",
    Base {
        m: 3,
        s: -1,
        ..Base::NONE
    },
);

choices! { VALVE "Valve" "What the valve does":
    SHUT = 1 "shut" "nothing flows";
    OPEN = 2 "open" "it flows";
}

/// One chamber.
#[group]
struct Chamber {
    /// volume
    #[parameter(0, unit = CUBIC_METRE, range = POSITIVE, start = 0.5)]
    volume: f64,
    /// temperature
    #[output(1, unit = KELVIN, start = 293.15)]
    temperature: f64,
}

/// A tank of two chambers,
/// with a valve between them.
#[interface(step = 0.01, stop = 5.0, sampled)]
struct Tank {
    /// flow into the first
    #[input(0, unit = self::LITRE_PER_HOUR, discrete)]
    inflow: f64,
    /// heating of each
    #[input(1, unit = WATT, discrete)]
    heating: [f64; 2],
    /// valve
    #[parameter(2, items = VALVE, tunable, start = SHUT)]
    valve: i32,
    /// samples so far
    #[output(3)]
    samples: i32,
    #[part(from = 4, prefix = "upper.")]
    upper: Chamber,
    #[part(from = 6, prefix = "lower.")]
    lower: Chamber,
    history: Vec<f64>,
}

impl Model for Tank {
    fn initialize(&mut self, _: f64, _: &mut Log<'_>) -> Result<(), Refusal> {
        Ok(())
    }

    fn step(&mut self, step: Step, _: &mut Log<'_>) -> Result<(), Refusal> {
        if self.valve == OPEN {
            self.history.push(step.h * self.inflow);
        }
        Ok(())
    }
}

/// y = u
#[interface(step = 0.5, name = "Wire", about = "passes on")]
struct Plain {
    /// in
    #[input]
    u: f64,
    /// out
    #[output]
    y: f64,
    #[part]
    chamber: Chamber,
}

impl Model for Plain {
    fn initialize(&mut self, _: f64, _: &mut Log<'_>) -> Result<(), Refusal> {
        Ok(())
    }

    fn step(&mut self, _: Step, _: &mut Log<'_>) -> Result<(), Refusal> {
        self.y = self.u;
        Ok(())
    }
}

#[test]
fn the_description_comes_from_the_struct_and_its_keys() {
    let tank = Tank::DESCRIPTION;
    assert_eq!(
        (tank.name, tank.about, tank.stepping),
        (
            "Tank",
            "A tank of two chambers, with a valve between them",
            Stepping::Sampled
        )
    );
    let experiment = tank.experiment;
    assert_eq!((experiment.start, experiment.stop), (0.0, 5.0));
    assert_eq!((experiment.step, experiment.tolerance), (0.01, 1e-6));
    assert_eq!(
        (Plain::DESCRIPTION.name, Plain::DESCRIPTION.about),
        ("Wire", "passes on")
    );
    assert_eq!(Plain::DESCRIPTION.stepping, Stepping::Exact);
}

#[test]
fn rows_have_units_and_numbers_of_parts_and_start_values() {
    let names: Vec<_> = Tank::DESCRIPTION
        .scalars()
        .map(|scalar| scalar.name())
        .collect();
    let expected = [
        "inflow",
        "heating[1]",
        "heating[2]",
        "valve",
        "samples",
        "upper.volume",
        "upper.temperature",
        "lower.volume",
        "lower.temperature",
    ];
    assert_eq!(names, expected);
    let Access::Real { unit, .. } = Tank::DESCRIPTION.variables[0].access else {
        panic!("a Real")
    };
    assert_eq!(unit, LITRE_PER_HOUR);
    let tank = Tank::default();
    assert_eq!(
        (tank.valve, tank.upper.volume, tank.lower.temperature),
        (SHUT, 0.5, 293.15)
    );
    let valve = &Tank::DESCRIPTION.variables[3 - 1];
    assert_eq!(
        (valve.causality, valve.variability),
        (Causality::Parameter, Variability::Tunable)
    );
}

#[test]
fn rows_without_numbers_are_numbered_by_their_places() {
    let numbers = Plain::DESCRIPTION.variables.iter().map(|row| row.number);
    assert_eq!(numbers.collect::<Vec<_>>(), [0, 1, 2, 3]);
    let references: Vec<_> = Plain::DESCRIPTION
        .scalars()
        .map(|scalar| scalar.reference())
        .collect();
    assert_eq!(references, [0, 256, 512, 768]);
}

#[test]
fn what_the_attribute_declares_steps_and_serializes() {
    let mut tank = Tank {
        valve: OPEN,
        inflow: 2.0,
        ..Tank::default()
    };
    tank.step(Step::at(0.0, 0.5), &mut Log::silent())
        .expect("steps");
    let bytes = postcard::to_allocvec(&tank).expect("serializes");
    let copy: Tank = postcard::from_bytes(&bytes).expect("reads");
    assert_eq!(copy.history, [1.0]);
}

/// A name that a model may well have, beside those that the attribute needs.
const N: usize = 100;

/// A cell.
#[group]
struct Cell {
    /// temperatures over its depth
    #[output(0, unit = KELVIN, range = 0.0..=(N as f64))]
    depth: f64,
    memory: [[f64; 2]; N + 1],
}

/// A rod of many cells
#[interface(step = 0.1)]
struct Rod {
    /// temperatures
    #[output(0, unit = KELVIN)]
    temperatures: [f64; 200],
    #[part(each, from = 1, prefix = "cell.")]
    cells: [Cell; N],
    texts: [String; 33],
    short: [f64; 32],
}

#[test]
fn arrays_may_be_longer_than_serde_knows_and_are_the_bytes_that_shorter_ones_are() {
    let mut rod = Rod::default();
    assert_eq!(Rod::DESCRIPTION.scalars().count(), 200 + N);
    (rod.temperatures[199], rod.cells[99].memory[N]) = (1.0, [2.0, 3.0]);
    rod.texts[32] = "the last".into();
    let bytes = postcard::to_allocvec(&rod).expect("serializes");
    let copy: Rod = postcard::from_bytes(&bytes).expect("reads");
    assert_eq!(copy.temperatures, rod.temperatures);
    assert_eq!(copy.cells[99].memory, rod.cells[99].memory);
    assert_eq!((copy.texts, copy.short), (rod.texts, rod.short));
    assert!(postcard::from_bytes::<Rod>(&bytes[..bytes.len() - 1]).is_err());
    // An array is its elements and nothing else.
    let cell = 8 * (1 + 2 * (N + 1));
    assert_eq!(bytes.len(), 8 * 200 + N * cell + 32 + 1 + 8 + 8 * 32);
}

/// A model may have the name of one of the standard's types, and stand beside one of Rust's.
mod named_like_others {
    use fmu_export::{Log, Model, Refusal, Step, interface};

    #[allow(dead_code, reason = "only its name matters")]
    struct Option;

    /// it is called like what the functions return
    #[interface(step = 0.1)]
    pub struct Status {
        /// how often it stepped
        #[output(0)]
        count: i32,
    }

    impl Model for Status {
        fn initialize(&mut self, _: f64, _: &mut Log<'_>) -> Result<(), Refusal> {
            Ok(())
        }

        fn step(&mut self, _: Step, _: &mut Log<'_>) -> Result<(), Refusal> {
            self.count += 1;
            Ok(())
        }
    }

    fmu_export::export!(Status);
}

#[test]
fn a_model_that_is_called_like_a_type_of_the_standard_is_exported() {
    assert_eq!(named_like_others::Status::DESCRIPTION.name, "Status");
}
