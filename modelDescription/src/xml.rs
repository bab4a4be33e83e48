//! `modelDescription.xml`. The elements are in [`schema`](crate::schema), the rules that a declaration can break in
//! [`interface`](crate::interface); here is what the standard says about the contents.
//!
//! * Inputs have a start value and no `initial`; parameters are `exact` with a start value; what the model computes is
//!   `calculated` without one (section 2.2.7).
//! * No output depends on an input at the same communication point: `dependencies=""` (2.2.8).
//! * There is no independent variable and no generation date: the first upsets importers, the second reproducibility.

use crate::Package;
use crate::entry::{Entry, Kind};
use crate::interface::Interface;
use crate::schema::{
    Attributes, BaseUnit, Category, CoSimulation, DefaultExperiment, DisplayUnit, Item, Items,
    Kind as Element, LogCategories, ModelStructure, ModelVariables, Root, ScalarVariable,
    SimpleType, TypeDefinitions, Unit, UnitDefinitions, Unknown, Unknowns,
};
use fmu_declaration::{Causality, Declared, IntegerType, Variability};
use serde::Serialize;

/// Log categories and their descriptions: those of the `export` crate, and the one that stands for all.
pub const LOG_CATEGORIES: [(&str, &str); 4] = [
    ("logStatusError", "refused calls and failed steps"),
    ("logStatusWarning", "accepted, but probably not meant"),
    (
        "logEvents",
        "life cycle of the instance, events of the model",
    ),
    ("logAll", "all categories"),
];

/// Writes the description.
///
/// # Panics
/// When FMI 2.0 has no type for a variable ([`Interface::beyond_fmi2`]), or quick-xml cannot write our own elements: a programming error
/// that the first test shows.
pub fn write(interface: &Interface, package: Package<'_>) -> String {
    text(&root(interface, package))
}

/// A document with this root.
pub(crate) fn text(root: &impl Serialize) -> String {
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    let mut serializer = quick_xml::se::Serializer::new(&mut text);
    serializer.indent(' ', 2);
    root.serialize(serializer)
        .expect("the elements are serializable");
    text.push('\n');
    text
}

fn root(interface: &Interface, package: Package<'_>) -> Root {
    if let Some(Entry { name, .. }) = interface.beyond_fmi2() {
        panic!("{name}: FMI 2.0 has no type for it");
    }
    Root {
        fmi_version: "2.0".into(),
        model_name: interface.name.into(),
        guid: interface.guid.clone(),
        description: interface.about.into(),
        author: told(package.author),
        version: told(package.version),
        copyright: told(package.copyright),
        license: told(package.license),
        generation_tool: format!("fmu-archive {}", crate::VERSION),
        variable_naming_convention: "structured".into(),
        co_simulation: CoSimulation {
            model_identifier: interface.name.into(),
            can_handle_variable_step: true,
            own_memory: true,
            can_get_and_set_state: true,
            can_serialize_state: true,
            ..CoSimulation::default()
        },
        units: units(interface.units()),
        types: types(interface),
        log: log(),
        experiment: experiment(interface),
        variables: ModelVariables {
            list: interface.scalars.iter().map(variable).collect(),
        },
        structure: structure(interface),
    }
}

/// An attribute that is left out where there is nothing to say.
pub(crate) fn told(text: &str) -> Option<String> {
    (!text.is_empty()).then(|| text.to_owned())
}

pub(crate) fn log() -> LogCategories {
    LogCategories {
        list: LOG_CATEGORIES
            .map(|(name, about)| Category {
                name: name.into(),
                description: about.into(),
            })
            .into(),
    }
}

pub(crate) fn experiment(interface: &Interface) -> DefaultExperiment {
    DefaultExperiment {
        start_time: double(interface.experiment.start),
        stop_time: double(interface.experiment.stop),
        tolerance: double(interface.experiment.tolerance),
        step_size: double(interface.experiment.step),
    }
}

pub(crate) fn units(used: Vec<fmu_declaration::Unit>) -> Option<UnitDefinitions> {
    let exponent = |value: i8| (value != 0).then_some(value);
    let unit = |unit: fmu_declaration::Unit| Unit {
        name: unit.name.into(),
        base: BaseUnit {
            kg: exponent(unit.base.kg),
            m: exponent(unit.base.m),
            s: exponent(unit.base.s),
            ampere: exponent(unit.base.A),
            kelvin: exponent(unit.base.K),
            mol: exponent(unit.base.mol),
            cd: exponent(unit.base.cd),
            rad: exponent(unit.base.rad),
        },
        display: unit.display.map(|d| DisplayUnit {
            name: d.name.into(),
            factor: double(d.factor),
            offset: (d.offset != 0.0).then(|| double(d.offset)),
        }),
    };
    let list: Vec<_> = used.into_iter().map(unit).collect();
    (!list.is_empty()).then_some(UnitDefinitions { list })
}

fn types(interface: &Interface) -> Option<TypeDefinitions> {
    let item = |item: &fmu_declaration::Item| Item {
        name: item.name.into(),
        value: item.value,
        description: item.about.into(),
    };
    let list: Vec<_> = interface
        .declared_types()
        .into_iter()
        .map(|of| SimpleType {
            name: of.name.into(),
            description: of.about.into(),
            enumeration: Items {
                list: of.items.iter().map(item).collect(),
            },
        })
        .collect();
    (!list.is_empty()).then_some(TypeDefinitions { list })
}

fn variable(entry: &Entry) -> ScalarVariable {
    ScalarVariable {
        name: entry.name.clone(),
        value_reference: entry.reference,
        description: described(entry),
        causality: causality(entry.causality).into(),
        variability: variability(entry.variability).into(),
        initial: match entry.causality {
            Causality::Input => None,
            Causality::Parameter => Some("exact".into()),
            Causality::CalculatedParameter | Causality::Output | Causality::Local => {
                Some("calculated".into())
            }
        },
        kind: element(entry),
    }
}

/// The description, with the items where no type lists them.
fn described(entry: &Entry) -> String {
    match &entry.kind {
        Kind::Enumeration {
            of,
            declared: Declared::Integer,
            ..
        } => {
            let items: Vec<_> = of
                .items
                .iter()
                .map(|item| format!("{} {}", item.value, item.name))
                .collect();
            format!("{}: {}", entry.about, items.join(", "))
        }
        _ => entry.about.into(),
    }
}

fn element(entry: &Entry) -> Element {
    let text = |start: String| (!entry.is_calculated()).then_some(start);
    let plain = |start: String| Attributes {
        start: text(start),
        ..Attributes::default()
    };
    match &entry.kind {
        Kind::Real {
            unit,
            start,
            min,
            max,
            ..
        } => Element::Real(Attributes {
            unit: Some(unit.name.into()),
            display_unit: unit.display.map(|display| display.name.into()),
            min: min.map(double),
            max: max.map(double),
            ..plain(double(*start))
        }),
        Kind::Integer {
            of,
            start,
            min,
            max,
        } => {
            let (min, max) = bounds(*of, *min, *max);
            Element::Integer(Attributes {
                min: min.map(|value| value.to_string()),
                max: max.map(|value| value.to_string()),
                ..plain(start.to_string())
            })
        }
        Kind::Boolean { start } => Element::Boolean(plain(start.to_string())),
        Kind::String { start } => Element::String(plain(start.clone())),
        Kind::Binary { .. } => unreachable!("{}: FMI 2.0 has no type Binary", entry.name),
        Kind::Enumeration {
            of,
            declared,
            start,
        } => {
            let bounds = Attributes {
                min: of.items.first().map(|item| item.value.to_string()),
                max: of.items.last().map(|item| item.value.to_string()),
                ..plain(start.to_string())
            };
            match declared {
                Declared::Integer => Element::Integer(bounds),
                Declared::Enumeration => Element::Enumeration(Attributes {
                    declared_type: Some(of.name.into()),
                    ..bounds
                }),
            }
        }
    }
}

/// Bounds of an integer: a smaller type has its own where an fmi2Integer has none.
pub(crate) fn bounds(
    of: IntegerType,
    min: Option<i128>,
    max: Option<i128>,
) -> (Option<i128>, Option<i128>) {
    let small = of != IntegerType::Int32;
    let or = |bound: Option<i128>, own| bound.or(small.then_some(own));
    (or(min, of.low()), or(max, of.high()))
}

fn structure(interface: &Interface) -> ModelStructure {
    let list = |listed: fn(&Entry) -> bool, unknown: fn(usize, &Entry) -> Unknown| {
        let entries = interface
            .scalars
            .iter()
            .enumerate()
            .filter(|(_, entry)| listed(entry));
        let list: Vec<_> = entries
            .map(|(position, entry)| unknown(position + 1, entry))
            .collect();
        (!list.is_empty()).then_some(Unknowns { list })
    };
    ModelStructure {
        outputs: list(
            |entry| entry.causality == Causality::Output,
            |index, _| Unknown {
                index,
                ..Unknown::default()
            },
        ),
        initial_unknowns: list(Entry::is_initial_unknown, |index, entry| Unknown {
            index,
            dependencies: spaced(
                entry
                    .initially_from
                    .iter()
                    .map(|position| (position + 1).to_string()),
            ),
            dependencies_kind: (!entry.initially_from.is_empty())
                .then(|| spaced(entry.initially_from.iter().map(|_| "dependent".to_owned()))),
        }),
    }
}

pub(crate) fn spaced(words: impl Iterator<Item = String>) -> String {
    words.collect::<Vec<_>>().join(" ")
}

/// The standard's word.
pub fn causality(causality: Causality) -> &'static str {
    match causality {
        Causality::Parameter => "parameter",
        Causality::CalculatedParameter => "calculatedParameter",
        Causality::Input => "input",
        Causality::Output => "output",
        Causality::Local => "local",
    }
}

/// The standard's word.
pub fn variability(variability: Variability) -> &'static str {
    match variability {
        Variability::Fixed => "fixed",
        Variability::Tunable => "tunable",
        Variability::Discrete => "discrete",
        Variability::Continuous => "continuous",
    }
}

/// A finite number as xs:double: the shortest text that reads back to the same bits (`0.002`, `8e-5`, `1e300`).
pub fn double(value: f64) -> String {
    format!("{value:?}")
}
