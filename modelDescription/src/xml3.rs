//! `modelDescription.xml` of FMI 3.0. The elements are in [`schema3`](mod@crate::schema3); units, log categories and the default
//! experiment are those of FMI 2.0, [`xml`](mod@crate::xml). What the standard says about the contents:
//!
//! * Exactly one variable is the independent one: `time` (section 2.4.7).
//! * Inputs and parameters have a start value, what the model computes is `calculated` without one (2.4.7.5).
//! * A row with items is an Enumeration however FMI 2.0 declares it: there is no importer of FMI 3.0 that drops them.
//! * A Binary's start value is an element with hexadecimal digits, a String's one with the text (2.4.7.2).
//! * In co-simulation no output depends on an input at the same communication point: `dependencies=""` (2.4.8).
//! * In scheduled execution a tick reads its inputs and writes its outputs at one time: without `dependencies` an output
//!   depends on all (2.4.8). What a tick reads and writes belongs to its clock, the one clock there is, and no such variable is
//!   an initial unknown: it may be one, but fmpy refuses that.
//! * There is no generation date: reproducibility. There are no sources, so there is no build description (2.5.1.3).

use crate::arrays::{self, Array, CLOCK, CLOCK_REFERENCE, TIME, TIME_REFERENCE};
use crate::entry::{Entry, Kind};
use crate::interface::Interface;
use crate::package::Package;
use crate::schema::Item;
use crate::schema3::{
    Attributes, CoSimulation, Dimension, EnumerationType, ModelStructure, ModelVariables, Root,
    ScheduledExecution, Start, TypeDefinitions, Unknown, Variable,
};
use crate::standard::Standard;
use crate::xml::{self, causality, double, spaced, variability};
use fmu_declaration::unit::SECOND;
use fmu_declaration::{Causality, IntegerType, Stepping, Variability};

/// Writes the description for co-simulation or scheduled execution.
///
/// # Panics
/// When quick-xml cannot write our own elements: a programming error that the first test shows.
pub fn write(interface: &Interface, package: Package<'_>, standard: Standard) -> String {
    xml::text(&root(interface, package, standard))
}

fn root(interface: &Interface, package: Package<'_>, standard: Standard) -> Root {
    let scheduled = standard == Standard::Fmi3Scheduled;
    let arrays = arrays::of(interface);
    Root {
        fmi_version: "3.0".into(),
        model_name: interface.name.into(),
        instantiation_token: interface.guid.clone(),
        description: interface.about.into(),
        author: xml::told(package.author),
        version: xml::told(package.version),
        copyright: xml::told(package.copyright),
        license: xml::told(package.license),
        generation_tool: format!("fmu-archive {}", crate::VERSION),
        variable_naming_convention: "structured".into(),
        co_simulation: (!scheduled).then(|| CoSimulation {
            model_identifier: interface.name.into(),
            can_get_and_set_state: true,
            can_serialize_state: true,
            can_handle_variable_step: true,
            fixed_internal_step: (interface.stepping == Stepping::Sampled)
                .then(|| double(interface.experiment.step)),
            ..CoSimulation::default()
        }),
        scheduled_execution: scheduled.then(|| ScheduledExecution {
            model_identifier: interface.name.into(),
            can_get_and_set_state: true,
            can_serialize_state: true,
            ..ScheduledExecution::default()
        }),
        units: xml::units(units(interface)),
        types: types(interface),
        log: xml::log(),
        experiment: xml::experiment(interface),
        variables: ModelVariables {
            list: variables(interface, &arrays, scheduled),
        },
        structure: structure(interface, &arrays, scheduled),
    }
}

/// Those of the rows, and that of time.
fn units(interface: &Interface) -> Vec<fmu_declaration::Unit> {
    let mut units = interface.units();
    if !units.iter().any(|unit| unit.name == SECOND.name) {
        units.push(SECOND);
        units.sort_by_key(|unit| unit.name);
    }
    units
}

fn types(interface: &Interface) -> Option<TypeDefinitions> {
    let item = |item: &fmu_declaration::Item| Item {
        name: item.name.into(),
        value: item.value,
        description: item.about.into(),
    };
    let list: Vec<_> = interface
        .enumerations()
        .into_iter()
        .map(|of| EnumerationType {
            name: of.name.into(),
            description: of.about.into(),
            items: of.items.iter().map(item).collect(),
        })
        .collect();
    (!list.is_empty()).then_some(TypeDefinitions { list })
}

fn variables(interface: &Interface, arrays: &[Array<'_>], scheduled: bool) -> Vec<Variable> {
    let mut list = vec![Variable::Float64(Attributes {
        name: TIME.into(),
        value_reference: TIME_REFERENCE,
        description: "time".into(),
        causality: "independent".into(),
        variability: "continuous".into(),
        unit: Some(SECOND.name.into()),
        ..Attributes::default()
    })];
    if scheduled {
        list.push(clock(interface));
    }
    list.extend(arrays.iter().map(|array| variable(array, scheduled)));
    list
}

/// The one clock: it ticks at the start time, and every sample period after.
fn clock(interface: &Interface) -> Variable {
    Variable::Clock(Attributes {
        name: CLOCK.into(),
        value_reference: CLOCK_REFERENCE,
        description: "runs a tick: reads the inputs, writes the outputs. The interval is constant, so a parameter that is the \
                      sample period keeps its start value"
            .into(),
        causality: "input".into(),
        variability: "discrete".into(),
        priority: Some(0),
        interval_variability: Some("constant".into()),
        interval: Some(double(interface.experiment.step)),
        ..Attributes::default()
    })
}

/// An element that is named by its type.
type Element = fn(Attributes) -> Variable;

fn integer(of: IntegerType) -> Element {
    match of {
        IntegerType::Int8 => Variable::Int8,
        IntegerType::UInt8 => Variable::UInt8,
        IntegerType::Int16 => Variable::Int16,
        IntegerType::UInt16 => Variable::UInt16,
        IntegerType::Int32 => Variable::Int32,
        IntegerType::UInt32 => Variable::UInt32,
        IntegerType::Int64 => Variable::Int64,
        IntegerType::UInt64 => Variable::UInt64,
    }
}

fn variable(array: &Array<'_>, scheduled: bool) -> Variable {
    let first = array.first();
    let computed = first.is_calculated();
    let list = |text: fn(&Kind) -> String| {
        (!computed).then(|| spaced(array.elements.iter().map(|entry| text(&entry.kind))))
    };
    let common = Attributes {
        name: array.name.clone(),
        value_reference: array.reference,
        description: first.about.into(),
        causality: causality(first.causality).into(),
        variability: variability(first.variability).into(),
        clocks: (scheduled && is_clocked(first)).then_some(CLOCK_REFERENCE),
        initial: match first.causality {
            Causality::Input => None,
            Causality::Parameter => Some("exact".into()),
            Causality::CalculatedParameter | Causality::Output | Causality::Local => {
                Some("calculated".into())
            }
        },
        start: list(start),
        dimension: array.is_vector().then_some(Dimension {
            start: array.elements.len(),
        }),
        ..Attributes::default()
    };
    match &first.kind {
        Kind::Real {
            single,
            unit,
            min,
            max,
            ..
        } => {
            let (element, number): (Element, fn(f64) -> String) = if *single {
                (Variable::Float32, float)
            } else {
                (Variable::Float64, double)
            };
            element(Attributes {
                unit: Some(unit.name.into()),
                display_unit: unit.display.map(|display| display.name.into()),
                min: min.map(number),
                max: max.map(number),
                ..common
            })
        }
        Kind::Integer { of, min, max, .. } => integer(*of)(Attributes {
            min: min.map(|value| value.to_string()),
            max: max.map(|value| value.to_string()),
            ..common
        }),
        Kind::Boolean { .. } => Variable::Boolean(common),
        Kind::String { .. } => Variable::String(Attributes {
            start: None,
            starts: elements(array),
            ..common
        }),
        Kind::Binary {
            mime_type,
            max_size,
            ..
        } => Variable::Binary(Attributes {
            start: None,
            starts: elements(array),
            mime_type: Some((*mime_type).into()),
            max_size: *max_size,
            ..common
        }),
        Kind::Enumeration { of, .. } => Variable::Enumeration(Attributes {
            declared_type: Some(of.name.into()),
            min: of.items.first().map(|item| item.value.to_string()),
            max: of.items.last().map(|item| item.value.to_string()),
            ..common
        }),
    }
}

/// Whether a tick reads or writes it. What is tunable, fixed or continuous has a value between ticks, too.
fn is_clocked(entry: &Entry) -> bool {
    entry.variability == Variability::Discrete
}

/// The start value as the attribute has it.
fn start(kind: &Kind) -> String {
    match kind {
        Kind::Real {
            single: true,
            start,
            ..
        } => float(*start),
        Kind::Real { start, .. } => double(*start),
        Kind::Integer { start, .. } => start.to_string(),
        Kind::Enumeration { start, .. } => start.to_string(),
        Kind::Boolean { start } => start.to_string(),
        Kind::String { .. } | Kind::Binary { .. } => String::new(), // as elements
    }
}

/// Start values of Strings and Binaries, which are elements.
fn elements(array: &Array<'_>) -> Vec<Start> {
    let given = array.elements.iter().filter(|entry| !entry.is_calculated());
    let value = |entry: &Entry| match &entry.kind {
        Kind::String { start } => Some(start.clone()),
        Kind::Binary { start, .. } => Some(hexadecimal(start)),
        _ => None,
    };
    given
        .filter_map(|entry| {
            Some(Start {
                value: value(entry)?,
            })
        })
        .collect()
}

/// Bytes as xs:hexBinary.
pub(crate) fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect()
}

/// A finite number of single precision as xs:float: the shortest text that reads back to the same bits.
pub(crate) fn float(value: f64) -> String {
    format!("{:?}", value as f32)
}

fn structure(interface: &Interface, arrays: &[Array<'_>], scheduled: bool) -> ModelStructure {
    let reference = |position: &usize| {
        let row = &interface.scalars[*position].row;
        arrays
            .iter()
            .find(|array| array.first().row == *row)
            .map(|array| array.reference)
    };
    let outputs = arrays
        .iter()
        .filter(|array| array.first().causality == Causality::Output);
    let initial_unknowns = arrays
        .iter()
        .filter(|array| array.first().is_initial_unknown())
        .filter(|array| !(scheduled && is_clocked(array.first())));
    ModelStructure {
        outputs: outputs
            .map(|array| Unknown {
                value_reference: array.reference,
                dependencies: (!scheduled).then(String::new),
                dependencies_kind: None,
            })
            .collect(),
        initial_unknowns: initial_unknowns
            .map(|array| {
                let mut from: Vec<_> = array
                    .first()
                    .initially_from
                    .iter()
                    .filter_map(reference)
                    .collect();
                from.dedup();
                Unknown {
                    value_reference: array.reference,
                    dependencies: Some(spaced(from.iter().map(u32::to_string))),
                    dependencies_kind: (!from.is_empty())
                        .then(|| spaced(from.iter().map(|_| "dependent".to_owned()))),
                }
            })
            .collect(),
    }
}
