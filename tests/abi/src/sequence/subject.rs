//! An FMU with what a random sequence needs to know of its variables.

use super::call::{TEXTS, Value};
use crate::{Fmu, Kind, Variable};

/// A loaded FMU, ready to be played with.
pub struct Subject {
    /// The FMU.
    pub fmu: Fmu,
    /// Positions of the inputs.
    pub inputs: Vec<usize>,
    /// Positions of the parameters.
    pub parameters: Vec<usize>,
    /// All positions.
    pub all: Vec<usize>,
    /// Value references of the Real inputs, and numbers that no model can compute with.
    pub ruin: (Vec<u32>, Vec<f64>),
    /// Start values of the Reals and Integers, as a new instance has them.
    starts: Vec<f64>,
}

impl Subject {
    /// Prepares an FMU.
    pub fn new(fmu: Fmu) -> Self {
        let instance = fmu.instantiate();
        let starts = fmu.variables.iter().map(|v| match v.kind {
            Kind::Real {} => instance.real(v.reference),
            Kind::Integer {} | Kind::Enumeration {} => f64::from(instance.integer(v.reference)),
            Kind::Boolean {} => f64::from(instance.boolean(v.reference)),
            Kind::String {} => 0.0,
        });
        let starts = starts.collect();
        drop(instance);
        let of = |causality: &str| {
            let all = fmu.variables.iter().enumerate();
            all.filter(|(_, v)| v.causality == causality)
                .map(|(i, _)| i)
                .collect()
        };
        let reals = fmu.variables.iter().filter(|v| v.causality == "input");
        let reals = reals.filter(|v| v.kind == Kind::Real {});
        let ruin = reals
            .zip([f64::MAX, -f64::MAX].into_iter().cycle())
            .map(|(v, value)| (v.reference, value))
            .unzip();
        Self {
            ruin,
            inputs: of("input"),
            parameters: of("parameter"),
            all: (0..fmu.variables.len()).collect(),
            starts,
            fmu,
        }
    }

    /// The variable at a position.
    pub fn variable(&self, position: usize) -> &Variable {
        &self.fmu.variables[position]
    }

    /// One of 64 values for a variable: mostly good ones, some at and beyond the bounds, some beyond all numbers.
    pub fn value(&self, position: usize, pick: usize) -> Value {
        let variable = self.variable(position);
        let start = self.starts[position];
        let (mut min, max) = variable.bounds.unwrap_or((-1e9, 1e9));
        if ["T", "substep"].contains(&variable.name.as_str()) {
            min = 0.5 * start; // at the row's bound one step would take 1e5 substeps
        }
        match variable.kind {
            Kind::Real {} => Value::Real(match pick {
                0 => f64::NAN,
                1 => f64::INFINITY,
                2 => f64::NEG_INFINITY,
                3 => min,
                4 => max,
                5 => variable.bounds.map_or(0.0, |(min, _)| min - 1.0),
                6 => max + 1.0,
                7 => f64::MAX,
                8 => -f64::MAX,
                9..=20 => start,
                _ => start + 0.01 * (pick as f64 - 40.0),
            }),
            Kind::Integer {} | Kind::Enumeration {} => Value::Integer(match pick {
                0 => min.max(f64::from(i32::MIN)) as i32,
                1 => max.min(f64::from(i32::MAX)) as i32,
                2 => i32::MIN,
                3 => i32::MAX,
                4..=20 => pick as i32 - 8,
                _ => start as i32,
            }),
            // The test model's only Boolean makes the next step fail.
            Kind::Boolean {} => Value::Boolean(if variable.name == "panic" {
                pick < 8
            } else {
                pick % 2 == 0
            }),
            Kind::String {} => Value::Text(pick % TEXTS.len()),
        }
    }

    /// Whether a value is one that the variable's row allows.
    pub fn allows(&self, position: usize, value: Value) -> bool {
        let variable = self.variable(position);
        let within = |value: f64| {
            variable
                .bounds
                .is_none_or(|(min, max)| (min..=max).contains(&value))
        };
        match value {
            Value::Real(value) if !value.is_finite() => self.fmu.takes_nan(variable),
            Value::Real(value) => within(value),
            Value::Integer(value) => within(f64::from(value)),
            Value::Boolean(_) | Value::Text(_) => true,
        }
    }

    /// Whether after this the model may object to its parameters as a whole, or fail to compute a step: any parameter that
    /// is not at its start value, and any input far from it.
    pub fn is_wild(&self, position: usize, value: Value) -> bool {
        let variable = self.variable(position);
        let (start, parameter) = (self.starts[position], variable.causality == "parameter");
        match value {
            Value::Real(value) if parameter => value != start,
            Value::Real(value) => value.is_nan() || (value - start).abs() >= 1.0,
            Value::Integer(value) => parameter && f64::from(value) != start,
            Value::Boolean(value) => {
                (parameter && f64::from(value) != start) || variable.name == "panic"
            }
            Value::Text(_) => false,
        }
    }
}
