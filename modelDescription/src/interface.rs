//! The declaration read once: every rule of the standard that a row can break is checked here, so that the writers
//! need not check anything. The model's type is gone afterwards, so interfaces of different models fit one list.

use crate::name::{is_identifier, is_structured};
use core::fmt;
use declaration::{
    Access, Causality, Declare, Declared, Description, Enumeration, Experiment, Provenance, Scalar,
    Stepping, Unit, Variability, description::SCALARS_PER_ROW, provenance,
};
use std::collections::BTreeMap;

/// A model's interface, checked.
#[derive(Clone, Debug)]
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
    /// All scalars in the order of the XML, those of the rows and then [`provenance`]: position 0 has index 1 there.
    pub scalars: Vec<Entry>,
}

/// One scalar variable.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Name, the element's number in it.
    pub name: String,
    /// Value reference.
    pub reference: u32,
    /// Who computes it.
    pub causality: Causality,
    /// When it may change.
    pub variability: Variability,
    /// Type, bounds and start value.
    pub kind: Kind,
    /// Positions (from 0, ascending, unique) of the inputs and parameters that decide its value at initialization.
    pub initially_from: Vec<usize>,
    /// Description.
    pub about: &'static str,
}

/// Type, bounds and start value. Bounds are `None` where there are none.
#[derive(Clone, Debug)]
pub enum Kind {
    /// fmi2Real
    Real {
        /// Unit of the three values.
        unit: Unit,
        /// Start value.
        start: f64,
        /// Smallest accepted value.
        min: Option<f64>,
        /// Largest accepted value.
        max: Option<f64>,
    },
    /// fmi2Integer
    Integer {
        /// Start value.
        start: i32,
        /// Smallest accepted value.
        min: Option<i32>,
        /// Largest accepted value.
        max: Option<i32>,
    },
    /// fmi2Boolean
    Boolean {
        /// Start value.
        start: bool,
    },
    /// fmi2String
    String {
        /// Start value.
        start: String,
    },
    /// fmi2Integer that takes the values of an enumeration's items
    Enumeration {
        /// The type.
        of: &'static Enumeration,
        /// How the XML declares it.
        declared: Declared,
        /// Start value.
        start: i32,
    },
}

impl Entry {
    /// Whether the model computes it, so that it has no start value.
    pub fn is_calculated(&self) -> bool {
        matches!(
            self.causality,
            Causality::Output | Causality::CalculatedParameter | Causality::Local
        )
    }

    /// Whether it stands in the XML's InitialUnknowns: calculated outputs and calculated parameters (2.2.8).
    pub fn is_initial_unknown(&self) -> bool {
        matches!(
            self.causality,
            Causality::Output | Causality::CalculatedParameter
        )
    }
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
        let mut start = D::default();
        for variable in description.variables {
            check_row(description.stepping, variable, &mut start)?;
        }
        let mut scalars = Vec::new();
        for scalar in description.scalars() {
            scalars.push(Entry {
                name: scalar.name(),
                reference: scalar.reference(),
                causality: scalar.variable.causality,
                variability: scalar.variable.variability,
                kind: kind(&scalar, &mut start),
                initially_from: known(description, scalar.variable)?,
                about: scalar.variable.about,
            });
        }
        scalars.extend(provenance::ALL.map(built_from));
        check_scalars(&scalars)?;
        Ok(Self {
            name: description.name,
            about: description.about,
            guid: description.guid(),
            stepping: description.stepping,
            experiment: description.experiment,
            scalars,
        })
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

/// What no single row can get wrong.
fn check_frame<D>(description: &Description<D>) -> Result<(), Error> {
    let Experiment {
        start,
        stop,
        tolerance,
        step,
    } = description.experiment;
    let positive = |value: f64| value.is_finite() && value > 0.0;
    if !is_identifier(description.name) {
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
    if description.variables.len() > provenance::ROW as usize {
        return Err(Error::Rows(description.variables.len()));
    }
    Ok(())
}

fn check_row<D>(
    stepping: Stepping,
    row: &declaration::Variable<D>,
    start: &mut D,
) -> Result<(), Error> {
    let name = row.name;
    let held = match row.access {
        Access::Real { at, .. } => at(start).len(),
        Access::Integer { at, .. } | Access::Enumeration { at, .. } => at(start).len(),
        Access::Boolean { at } => at(start).len(),
        Access::String { at } => at(start).len(),
    };
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

fn kind<D>(scalar: &Scalar<D>, start: &mut D) -> Kind {
    let i = scalar.element;
    match scalar.variable.access {
        Access::Real { unit, min, max, at } => Kind::Real {
            unit,
            start: at(start)[i],
            min: (min != f64::NEG_INFINITY).then_some(min),
            max: (max != f64::INFINITY).then_some(max),
        },
        Access::Integer { min, max, at } => Kind::Integer {
            start: at(start)[i],
            min: (min != i32::MIN).then_some(min),
            max: (max != i32::MAX).then_some(max),
        },
        Access::Boolean { at } => Kind::Boolean {
            start: at(start)[i],
        },
        Access::String { at } => Kind::String {
            start: at(start)[i].clone(),
        },
        Access::Enumeration { of, declared, at } => Kind::Enumeration {
            of,
            declared,
            start: at(start)[i],
        },
    }
}

/// Positions of the scalars named by `initially_from`; a vector's name (`q[i]`) means all of its elements.
fn known<D>(
    description: &Description<D>,
    row: &declaration::Variable<D>,
) -> Result<Vec<usize>, Error> {
    let calculated = matches!(
        row.causality,
        Causality::Output | Causality::CalculatedParameter
    );
    let mut positions = Vec::new();
    for &name in row.initially_from {
        let before = positions.len();
        positions.extend(
            description
                .scalars()
                .enumerate()
                .filter_map(|(position, scalar)| {
                    let given = matches!(
                        scalar.variable.causality,
                        Causality::Input | Causality::Parameter
                    );
                    (given && scalar.variable.name == name).then_some(position)
                }),
        );
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

fn check_scalars(scalars: &[Entry]) -> Result<(), Error> {
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
        let fits = match &entry.kind {
            Kind::Real {
                unit,
                start,
                min,
                max,
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
                let bounds = [min, max]
                    .into_iter()
                    .flatten()
                    .all(|bound| bound.is_finite());
                bounds
                    && start.is_finite()
                    && min.is_none_or(|min| min <= *start)
                    && max.is_none_or(|max| *start <= max)
            }
            Kind::Integer { start, min, max } => {
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
            Kind::String { start } => !start.chars().any(|c| c.is_control()),
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

fn unique(names: impl Iterator<Item = String>) -> bool {
    let mut seen = std::collections::BTreeSet::new();
    names
        .into_iter()
        .all(|name| seen.insert(name.to_lowercase()))
}

/// What a declaration got wrong.
#[derive(Clone, Debug)]
pub enum Error {
    /// The model's name is no C identifier.
    ModelName(&'static str),
    /// The default experiment is not finite, ends before it starts, or has a step or tolerance that is not positive.
    Experiment(Experiment),
    /// More rows than value references.
    Rows(usize),
    /// The row's length is 0, above 256, or not that of the field it borrows.
    Length {
        /// Row.
        row: &'static str,
        /// Length in the row.
        declared: usize,
        /// Length of the field.
        held: usize,
    },
    /// A vector's name lacks `[i]`, or a scalar's has it.
    VectorName {
        /// Row.
        row: &'static str,
        /// Length.
        len: usize,
    },
    /// The standard, or the way the model steps, does not allow this combination.
    Variability {
        /// Row.
        row: &'static str,
        /// Its causality.
        causality: Causality,
        /// Its variability.
        variability: Variability,
        /// How the model steps.
        stepping: Stepping,
    },
    /// An enumeration without items, or whose items do not ascend, or with two items of one name.
    Items {
        /// Row.
        row: &'static str,
        /// Type.
        enumeration: &'static str,
    },
    /// `initially_from` stands at a row that is neither output nor calculated parameter, or names a row that is
    /// neither input nor parameter.
    InitiallyFrom {
        /// Row.
        row: &'static str,
        /// Name in `initially_from`.
        from: &'static str,
    },
    /// Not a name of the structured naming convention.
    Name {
        /// Scalar.
        row: String,
    },
    /// Two names that differ in case only, or not at all.
    SameName {
        /// Scalar.
        row: String,
        /// The scalar before it.
        other: String,
    },
    /// Two units of one name.
    Unit {
        /// Scalar.
        row: String,
        /// Name of the unit.
        unit: &'static str,
    },
    /// Two enumeration types of one name.
    Type {
        /// Scalar.
        row: String,
        /// Name of the type.
        name: &'static str,
    },
    /// A variable named like an enumeration type.
    TypeAndVariable {
        /// Scalar.
        row: String,
    },
    /// A start value that is not finite, outside of its bounds, or no item.
    Start {
        /// Scalar.
        row: String,
        /// Type, bounds and start value.
        kind: Box<Kind>,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ModelName(name) => write!(f, "model name {name}: expected a C identifier"),
            Self::Experiment(experiment) => {
                write!(
                    f,
                    "default experiment: expected finite times, start < stop, step and tolerance > 0, got {experiment:?}"
                )
            }
            Self::Rows(rows) => write!(f, "{rows} rows: expected at most {}", provenance::ROW),
            Self::Length {
                row,
                declared,
                held,
            } => {
                write!(
                    f,
                    "{row}: expected 1 to {SCALARS_PER_ROW} scalars, as many as its field has, got {declared} for {held}"
                )
            }
            Self::VectorName { row, len } => {
                write!(
                    f,
                    "{row}: expected [i] in the name of a vector and of no scalar, got length {len}"
                )
            }
            Self::Variability {
                row,
                causality,
                variability,
                stepping,
            } => write!(
                f,
                "{row}: {causality:?} and {variability:?} do not go together here (only Reals are Continuous; inputs and \
                 outputs are Discrete or Continuous, of a Sampled model Discrete; parameters are Fixed or Tunable; this \
                 model is {stepping:?})"
            ),
            Self::Items { row, enumeration } => {
                write!(
                    f,
                    "{row}: expected items of ascending value and different names in {enumeration}"
                )
            }
            Self::InitiallyFrom { row, from } => write!(
                f,
                "{row}: initially_from {from}: expected an output or calculated parameter that names rows of inputs or parameters"
            ),
            Self::Name { row } => write!(f, "{row}: expected a name like energy.H or tau_a[1]"),
            Self::SameName { row, other } => write!(
                f,
                "{row}: expected a name that differs from {other} in more than case"
            ),
            Self::Unit { row, unit } => write!(
                f,
                "{row}: expected one definition of the unit {unit}, got two"
            ),
            Self::Type { row, name } => write!(
                f,
                "{row}: expected one definition of the type {name}, got two"
            ),
            Self::TypeAndVariable { row } => {
                write!(f, "{row}: expected a name that no enumeration type has")
            }
            Self::Start { row, kind } => write!(
                f,
                "{row}: expected a start value within its bounds, got {kind:?}"
            ),
        }
    }
}

impl std::error::Error for Error {}
