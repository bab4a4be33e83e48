//! What moves an FMU: the parameters and inputs of the C host's table (`catalogue tables`), as `tests/host/host.c` reads them.

use abi::{Fmu, Instance, Status};
use std::path::Path;

/// Value references with values to set.
type Values<T> = (Vec<u32>, Vec<T>);

/// What is set, and how far each input goes.
#[derive(Default)]
pub struct Moving {
    reals: Values<f64>,
    booleans: Values<i32>,
    /// Value reference, start value and amplitude of each Real input.
    inputs: Vec<(u32, f64, f64)>,
}

impl Moving {
    /// Reads a table.
    ///
    /// # Panics
    /// When it cannot be read; the message names the line.
    pub fn read(path: &Path) -> Self {
        let text = std::fs::read_to_string(path)
            .unwrap_or_else(|cause| panic!("{}: {cause}", path.display()));
        let mut moving = Self::default();
        for line in text.lines() {
            moving
                .take(line)
                .unwrap_or_else(|| panic!("{}: {line}: expected numbers", path.display()));
        }
        moving
    }

    fn take(&mut self, line: &str) -> Option<()> {
        let mut words = line.split(' ');
        let kind = words.next()?;
        let mut number = || words.next()?.parse::<f64>().ok();
        match kind {
            "real-setting" => {
                self.reals.0.push(number()? as u32);
                self.reals.1.push(number()?);
            }
            "boolean-setting" => {
                self.booleans.0.push(number()? as u32);
                self.booleans.1.push(number()? as i32);
            }
            "real-input" => self.inputs.push((number()? as u32, number()?, number()?)),
            _ => {}
        }
        Some(())
    }

    /// Sets the parameters, before initialization, and turns the pads' vacuum on: a payload is carried.
    pub fn prepare(&self, fmu: &Fmu, instance: &Instance) {
        let (references, values) = &self.reals;
        assert_eq!(instance.set_real(references, values), Status::OK);
        let (references, values) = &self.booleans;
        assert_eq!(instance.set_boolean(references, values), Status::OK);
        for input in &fmu.variables {
            if input.causality == "input" && input.name.ends_with("vacuum") {
                assert_eq!(instance.set_boolean(&[input.reference], &[1]), Status::OK);
            }
        }
    }

    /// Sets the inputs for step `k`: each goes back and forth around its start value in 40 steps.
    pub fn set(&self, k: u32, instance: &Instance) {
        let references: Vec<_> = self.inputs.iter().map(|input| input.0).collect();
        let each = self.inputs.iter().zip((k..).step_by(7));
        let values: Vec<_> = each
            .map(|(&(_, start, amplitude), n)| start + amplitude * triangle(n))
            .collect();
        assert_eq!(instance.set_real(&references, &values), Status::OK);
    }
}

/// A triangle of period 40 and height 1.
fn triangle(n: u32) -> f64 {
    let phase = f64::from(n % 40);
    if phase < 10.0 {
        phase / 10.0
    } else if phase < 30.0 {
        (20.0 - phase) / 10.0
    } else {
        (phase - 40.0) / 10.0
    }
}

/// What shows that an FMU moves.
pub struct Watched<'a> {
    instance: &'a Instance,
    outputs: Vec<u32>,
    engaged: Option<u32>,
    last: Vec<f64>,
}

impl<'a> Watched<'a> {
    /// Its Real outputs, and whether a law is engaged.
    pub fn new(fmu: &Fmu, instance: &'a Instance) -> Self {
        let outputs = fmu.variables.iter().filter(|one| one.causality == "output");
        let reals = outputs.clone().filter(|one| one.kind == abi::Kind::Real {});
        Self {
            instance,
            outputs: reals.map(|one| one.reference).collect(),
            engaged: outputs
                .into_iter()
                .find(|one| one.name == "engaged")
                .map(|one| one.reference),
            last: Vec::new(),
        }
    }

    /// To be called after each step.
    ///
    /// # Panics
    /// When less than a third of the Real outputs changed in the step, or the law is not engaged.
    pub fn moved(&mut self) {
        let now = self.instance.get_real(&self.outputs).expect("outputs");
        let changed = std::iter::zip(&now, &self.last).filter(|(now, last)| now != last);
        let (changed, all) = (changed.count(), now.len());
        assert!(
            self.last.is_empty() || 3 * changed >= all,
            "it does not move: {changed} of {all} Real outputs changed in a step"
        );
        if let Some(engaged) = self.engaged {
            assert_eq!(self.instance.boolean(engaged), 1, "the law is not engaged");
        }
        self.last = now;
    }
}
