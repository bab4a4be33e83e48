//! Every rule of the standard that a declaration can break.

use crate::arrays::{self, CLOCK, TIME};
use crate::entry::{Entry, Kind};
use crate::error::Error;
use crate::name::{is_line, is_model_name, is_structured};
use crate::texts::{check_texts, line};
use fmu_declaration::{
    Access, Brief, Causality, Description, Enumeration, Experiment, Scalar, Stepping, Unit,
    Variability, Variable, description::SCALARS_PER_ROW, provenance, variable::IN_ORDER,
};
use std::collections::BTreeMap;

/// What no single row can get wrong.
pub(crate) fn check_frame<D>(description: &Description<D>) -> Result<(), Error> {
    let Experiment {
        start,
        stop,
        tolerance,
        step,
    } = description.experiment;
    // Smaller ones are no step, not even for the exporter.
    let positive = |value: f64| value.is_normal() && value > 0.0;
    if !is_model_name(description.name) {
        return Err(Error::ModelName(description.name));
    }
    if !(start.is_finite()
        && stop.is_finite()
        && start < stop
        && positive(tolerance)
        && positive(step))
    {
        return Err(Error::Experiment(description.experiment));
    }
    line(description.name, "description", description.about)?;
    if description.variables.len() > provenance::ROW as usize {
        return Err(Error::Rows(description.variables.len()));
    }
    // A row without a number has the largest one there is.
    let in_order = |pair: &[Variable<D>]| match (pair[0].number, pair[1].number) {
        (IN_ORDER, IN_ORDER) => true,
        (before, after) => before < after && after < provenance::ROW,
    };
    match description
        .variables
        .windows(2)
        .find(|pair| !in_order(pair))
    {
        Some(pair) => Err(Error::Numbers { row: pair[1].name }),
        None => Ok(()),
    }
}

pub(crate) fn check_row<D>(
    stepping: Stepping,
    row: &fmu_declaration::Variable<D>,
) -> Result<(), Error> {
    let name = row.name;
    let held = row.access.len();
    if row.len == 0 || row.len > SCALARS_PER_ROW as usize || row.len != held {
        return Err(Error::Length {
            row: name,
            declared: row.len,
            held,
        });
    }
    if (row.len > 1) != name.contains("[i]") {
        return Err(Error::VectorName {
            row: name,
            len: row.len,
        });
    }
    let allowed: &[Variability] = match row.causality {
        Causality::Parameter | Causality::CalculatedParameter => {
            &[Variability::Fixed, Variability::Tunable]
        }
        Causality::Input | Causality::Output => &[Variability::Discrete, Variability::Continuous],
        Causality::Local => &[
            Variability::Fixed,
            Variability::Tunable,
            Variability::Discrete,
            Variability::Continuous,
        ],
    };
    let continuous = row.variability == Variability::Continuous;
    let sampled = stepping == Stepping::Sampled && row.causality != Causality::Local;
    let real = matches!(row.access, Access::Real { .. });
    if !allowed.contains(&row.variability) || (continuous && (sampled || !real)) {
        return Err(Error::Variability {
            row: name,
            causality: row.causality,
            variability: row.variability,
            stepping,
        });
    }
    if let Access::Enumeration { of, .. } = row.access {
        let ascending = of
            .items
            .windows(2)
            .all(|pair| pair[0].value < pair[1].value);
        if of.items.is_empty()
            || !ascending
            || !unique(of.items.iter().map(|item| item.name.to_owned()))
        {
            return Err(Error::Items {
                row: name,
                enumeration: of.name,
            });
        }
    }
    Ok(())
}

/// Positions of the scalars named by `initially_from` among `scalars`; a vector's name (`q[i]`) means all of its elements.
pub(crate) fn known<D>(
    scalars: &[Scalar<D>],
    row: &fmu_declaration::Variable<D>,
) -> Result<Vec<usize>, Error> {
    let calculated = matches!(
        row.causality,
        Causality::Output | Causality::CalculatedParameter
    );
    let mut positions = Vec::new();
    for &name in row.initially_from {
        let before = positions.len();
        positions.extend(scalars.iter().enumerate().filter_map(|(position, scalar)| {
            let given = matches!(
                scalar.variable.causality,
                Causality::Input | Causality::Parameter
            );
            (given && scalar.variable.full_name() == name).then_some(position)
        }));
        if !calculated || positions.len() == before {
            return Err(Error::InitiallyFrom {
                row: row.name,
                from: name,
            });
        }
    }
    positions.sort_unstable();
    positions.dedup();
    Ok(positions)
}

pub(crate) fn check_scalars(scalars: &[Entry]) -> Result<(), Error> {
    let mut names = BTreeMap::new();
    let mut units: BTreeMap<_, Unit> = BTreeMap::new();
    let mut types: BTreeMap<_, &Enumeration> = BTreeMap::new();
    for entry in scalars {
        let row = || entry.name.clone();
        if !is_structured(&entry.name) {
            return Err(Error::Name { row: row() });
        }
        if let Some(other) = names.insert(entry.name.to_lowercase(), row()) {
            return Err(Error::SameName { row: row(), other });
        }
        check_texts(entry)?;
        let fits = match &entry.kind {
            Kind::Real {
                unit,
                start,
                min,
                max,
                ..
            } => {
                if units
                    .insert(unit.name, *unit)
                    .is_some_and(|other| other != *unit)
                {
                    return Err(Error::Unit {
                        row: row(),
                        unit: unit.name,
                    });
                }
                check_bounds(entry, *min, *max)?;
                start.is_finite()
                    && min.is_none_or(|min| min <= *start)
                    && max.is_none_or(|max| *start <= max)
            }
            Kind::Integer {
                start, min, max, ..
            } => {
                let number = |bound: &Option<i128>| bound.map(|bound| bound as f64);
                check_bounds(entry, number(min), number(max))?;
                min.is_none_or(|min| min <= *start) && max.is_none_or(|max| *start <= max)
            }
            Kind::Enumeration { of, start, .. } => {
                if types.insert(of.name, of).is_some_and(|other| other != *of) {
                    return Err(Error::Type {
                        row: row(),
                        name: of.name,
                    });
                }
                of.items.iter().any(|item| item.value == *start)
            }
            Kind::String { start } => is_line(start),
            Kind::Binary {
                start, max_size, ..
            } => max_size.is_none_or(|most| start.len() <= most),
            Kind::Boolean { .. } => true,
        };
        if !fits && !entry.is_calculated() {
            return Err(Error::Start {
                row: row(),
                kind: Box::new(entry.kind.clone()),
            });
        }
    }
    match scalars
        .iter()
        .find(|entry| types.contains_key(entry.name.as_str()))
    {
        Some(entry) => Err(Error::TypeAndVariable {
            row: entry.name.clone(),
        }),
        None => Ok(()),
    }
}

/// Bounds stand in the description of what the model computes, too.
fn check_bounds(entry: &Entry, min: Option<f64>, max: Option<f64>) -> Result<(), Error> {
    let (low, high) = (
        min.unwrap_or(f64::NEG_INFINITY),
        max.unwrap_or(f64::INFINITY),
    );
    let finite = min.is_none_or(f64::is_finite) && max.is_none_or(f64::is_finite);
    if finite && low <= high {
        return Ok(());
    }
    Err(Error::Bounds {
        row: entry.name.clone(),
        low: Brief(low),
        high: Brief(high),
    })
}

/// The names of FMI 3.0, where a vector is one variable, and there is a variable for time and one for the clock.
pub(crate) fn check_arrays(stepping: Stepping, scalars: &[Entry]) -> Result<(), Error> {
    let of_fmi3 = |name: &str| format!("{name} of FMI 3.0");
    let mut names = BTreeMap::from([(TIME.to_owned(), of_fmi3(TIME))]);
    if stepping == Stepping::Sampled {
        names.insert(CLOCK.to_owned(), of_fmi3(CLOCK));
    }
    let enumerations: Vec<_> = scalars
        .iter()
        .filter_map(|entry| match &entry.kind {
            Kind::Enumeration { of, .. } => Some(of.name),
            _ => None,
        })
        .collect();
    for elements in scalars.chunk_by(|one, next| one.row == next.row) {
        let row = elements[0].row.clone();
        let name = arrays::name(&row);
        if enumerations.contains(&name.as_str()) {
            return Err(Error::TypeAndVariable { row });
        }
        if let Some(other) = names.insert(name.to_lowercase(), row.clone()) {
            return Err(Error::SameName { row, other });
        }
    }
    Ok(())
}

fn unique(names: impl Iterator<Item = String>) -> bool {
    let mut seen = std::collections::BTreeSet::new();
    names
        .into_iter()
        .all(|name| seen.insert(name.to_lowercase()))
}
