//! The declaration read once, and checked by the [`rules`](crate::rules), so that the writers need not check anything. The
//! model's type is gone afterwards, so interfaces of different models fit one list.

use crate::entry::{Entry, Kind};
use crate::error::Error;
use crate::rules::{check_arrays, check_frame, check_row, check_scalars, known};
use fmu_declaration::{
    Access, Causality, Declare, Declared, Description, Enumeration, Experiment, IntegerType,
    Provenance, Scalar, Stepping, Unit, Variability, provenance,
};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A model's interface, checked.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Interface {
    /// Model name and model identifier.
    pub name: &'static str,
    /// One sentence.
    pub about: &'static str,
    /// Hash of the interface, in braces.
    pub guid: String,
    /// How the model advances.
    pub stepping: Stepping,
    /// Default experiment, times in seconds.
    pub experiment: Experiment,
    /// All scalars in the [order](Description::in_order) of the XML, and last [`provenance`]: position 0 has index 1 there.
    pub scalars: Vec<Entry>,
}

impl Interface {
    /// Reads and checks the declaration of `D`.
    ///
    /// # Errors
    /// The first rule that a row breaks, with the row's name.
    pub fn of<D: Declare>() -> Result<Self, Error> {
        Self::read(&D::DESCRIPTION)
    }

    /// Reads and checks a description, which need not be the one that `D` declares.
    ///
    /// # Errors
    /// The first rule that a row breaks, with the row's name.
    pub fn read<D: Declare>(description: &Description<D>) -> Result<Self, Error> {
        check_frame(description)?;
        let start = D::default();
        for variable in description.variables {
            check_row(description.stepping, variable)?;
        }
        let mut scalars = Vec::new();
        let in_order = description.in_order();
        for scalar in &in_order {
            scalars.push(Entry {
                name: scalar.name(),
                row: scalar.variable.full_name(),
                reference: scalar.reference(),
                causality: scalar.variable.causality,
                variability: scalar.variable.variability,
                kind: kind(scalar, &start),
                initially_from: known(&in_order, scalar.variable)?,
                about: scalar.variable.about,
            });
        }
        scalars.extend(provenance::ALL.map(built_from));
        check_scalars(&scalars)?;
        check_arrays(description.stepping, &scalars)?;
        Ok(Self {
            name: description.name,
            about: description.about,
            guid: description.guid(),
            stepping: description.stepping,
            experiment: description.experiment,
            scalars,
        })
    }

    /// The first variable that FMI 2.0 has no type for: without one, the model has an archive of FMI 2.0.
    pub fn beyond_fmi2(&self) -> Option<&Entry> {
        self.scalars.iter().find(|entry| !entry.kind.is_in_fmi2())
    }

    /// The units in use, each once, by name.
    pub fn units(&self) -> Vec<Unit> {
        let used = self.scalars.iter().filter_map(|entry| match entry.kind {
            Kind::Real { unit, .. } => Some((unit.name, unit)),
            _ => None,
        });
        used.collect::<BTreeMap<_, _>>().into_values().collect()
    }

    /// Those of [`enumerations`](Self::enumerations) that the XML declares as types.
    pub fn declared_types(&self) -> Vec<&'static Enumeration> {
        let used = self.scalars.iter().filter_map(|entry| match entry.kind {
            Kind::Enumeration {
                of,
                declared: Declared::Enumeration,
                ..
            } => Some((of.name, of)),
            _ => None,
        });
        used.collect::<BTreeMap<_, _>>().into_values().collect()
    }

    /// The enumerations in use, each once, by name.
    pub fn enumerations(&self) -> Vec<&'static Enumeration> {
        let used = self.scalars.iter().filter_map(|entry| match entry.kind {
            Kind::Enumeration { of, .. } => Some((of.name, of)),
            _ => None,
        });
        used.collect::<BTreeMap<_, _>>().into_values().collect()
    }
}

/// A variable that says what the library was built from.
fn built_from(of: Provenance) -> Entry {
    Entry {
        name: of.name().to_owned(),
        row: of.name().to_owned(),
        reference: of.reference(),
        causality: Causality::Local,
        variability: Variability::Fixed,
        kind: Kind::String {
            start: String::new(),
        },
        initially_from: Vec::new(),
        about: of.about(),
    }
}

fn kind<D>(scalar: &Scalar<D>, start: &D) -> Kind {
    let i = scalar.element;
    match &scalar.variable.access {
        Access::Real { unit, range, at } => Kind::Real {
            unit: *unit,
            start: at.get(start, i),
            single: at.is_single(),
            min: (range.low != f64::NEG_INFINITY).then_some(range.low),
            max: (range.high != f64::INFINITY).then_some(range.high),
        },
        Access::Integer { min, max, at } => integer(
            at.integer_type(),
            at.get(start, i).into(),
            (*min).into(),
            (*max).into(),
        ),
        Access::Wide { min, max, at } => {
            integer(at.integer_type(), at.get(start, i), min.get(), max.get())
        }
        Access::Boolean { at } => Kind::Boolean {
            start: at.get(start, i),
        },
        Access::String { at } => Kind::String {
            start: at.get(start, i),
        },
        Access::Binary {
            mime_type,
            max_size,
            at,
        } => Kind::Binary {
            mime_type,
            max_size: *max_size,
            start: at.get(start, i),
        },
        Access::Enumeration { of, declared, at } => Kind::Enumeration {
            of,
            declared: *declared,
            start: at.get(start, i),
        },
    }
}

fn integer(of: IntegerType, start: i128, min: i128, max: i128) -> Kind {
    Kind::Integer {
        of,
        start,
        min: (min != of.low()).then_some(min),
        max: (max != of.high()).then_some(max),
    }
}
