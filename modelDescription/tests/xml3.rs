//! What the written `modelDescription.xml` of FMI 3.0 says, read back by name. (Its validity against the XSD is a system test.)

mod subject;

use fmu_archive::{Interface, Standard, xml};
use fmu_declaration::{Declare as _, Description, Experiment, Stepping};
use std::collections::{BTreeMap, BTreeSet};
use subject::{Element, PACKAGE, Subject, elements};

fn interface() -> Interface {
    Interface::of::<Subject>().expect("a legal declaration")
}

fn written(standard: Standard) -> Vec<Element> {
    elements(&standard.description(&interface(), PACKAGE))
}

fn under<'a>(all: &'a [Element], path: &str) -> Vec<&'a Element> {
    let path = format!("fmiModelDescription/{path}");
    all.iter().filter(|one| one.path == path).collect()
}

/// Type, variable, and the elements in it, by the variable's name.
fn variables(all: &[Element]) -> BTreeMap<&str, (&str, &Element, Vec<&Element>)> {
    let begin = "fmiModelDescription/ModelVariables/";
    let mut found = BTreeMap::new();
    let mut last = "";
    for element in all {
        match element
            .path
            .strip_prefix(begin)
            .map(|path| path.split_once('/'))
        {
            Some(None) => {
                last = element.get("name").expect("a name");
                let known = found.insert(last, (&element.path[begin.len()..], element, Vec::new()));
                assert!(known.is_none(), "{last} stands twice");
            }
            Some(Some(_)) => found.get_mut(last).expect("a variable").2.push(element),
            None => {}
        }
    }
    found
}

fn numbers(text: &str) -> Vec<u32> {
    let words = text.split_whitespace();
    words.map(|word| word.parse().expect("a number")).collect()
}

#[test]
fn the_sections_stand_in_the_order_of_the_xsd() {
    for (standard, interface_type) in [
        (Standard::Fmi3, "CoSimulation"),
        (Standard::Fmi3Scheduled, "ScheduledExecution"),
    ] {
        let all = written(standard);
        let sections: Vec<_> = all
            .iter()
            .filter(|one| one.path.matches('/').count() == 1)
            .map(|one| &one.path[20..])
            .collect();
        assert_eq!(
            sections,
            [
                interface_type,
                "UnitDefinitions",
                "TypeDefinitions",
                "LogCategories",
                "DefaultExperiment",
                "ModelVariables",
                "ModelStructure"
            ]
        );
        assert_eq!(all[0].get("fmiVersion"), Some("3.0"));
    }
}

#[test]
fn the_token_is_the_guid_of_fmi_2() {
    let two = elements(&xml(&interface(), PACKAGE));
    let three = written(Standard::Fmi3);
    assert!(two[0].get("guid").is_some_and(|guid| guid.len() == 38));
    assert_eq!(three[0].get("instantiationToken"), two[0].get("guid"));
}

#[test]
fn a_row_is_one_variable_and_a_vector_an_array() {
    let all = written(Standard::Fmi3);
    let variables = variables(&all);
    let shown: BTreeMap<_, _> = variables
        .iter()
        .map(|(name, (kind, variable, inside))| {
            let length = inside.iter().find(|one| one.path.ends_with("/Dimension"));
            let length = length.map(|one| one.get("start").expect("a constant length"));
            (
                *name,
                (*kind, variable.get("valueReference").unwrap(), length),
            )
        })
        .collect();
    let wanted = BTreeMap::from([
        ("time", ("Float64", "4294967295", None)),
        ("u", ("Float64", "0", Some("3"))),
        ("on", ("Boolean", "256", None)),
        ("angle", ("Float64", "512", Some("3"))),
        ("energy.total", ("Float64", "768", None)),
        ("tick", ("Int32", "1024", None)),
        ("scale", ("Float64", "1280", None)),
        ("gain", ("Float64", "1536", None)),
        ("tiny", ("Float64", "1792", None)),
        ("huge", ("Float64", "2048", None)),
        ("delay", ("Int32", "2304", None)),
        ("mode", ("Enumeration", "2560", None)),
        ("label", ("String", "2816", None)),
        ("inner", ("Float64", "3072", None)),
        ("choice", ("Enumeration", "3328", None)),
        ("version", ("String", "16776960", None)),
        ("git_hash", ("String", "16776961", None)),
    ]);
    assert_eq!(shown, wanted);
}

#[test]
fn start_and_initial_follow_the_causality() {
    let all = written(Standard::Fmi3);
    for (name, (kind, variable, inside)) in variables(&all) {
        let started = variable.get("start").is_some()
            || inside.iter().any(|one| one.path.ends_with("/Start"));
        let wanted = match variable.get("causality").expect("is said") {
            "independent" => {
                assert_eq!(
                    (name, kind, variable.get("unit")),
                    ("time", "Float64", Some("s"))
                );
                (None, false)
            }
            "input" => (None, true),
            "parameter" => (Some("exact"), true),
            _ => (Some("calculated"), false),
        };
        assert_eq!((variable.get("initial"), started), wanted, "{name}");
        assert!(variable.get("variability").is_some(), "{name}");
    }
}

#[test]
fn start_values_read_back_to_the_same_bits_and_a_string_has_its_own_element() {
    let all = written(Standard::Fmi3);
    let variables = variables(&all);
    let u: Vec<f64> = variables["u"]
        .1
        .get("start")
        .expect("given")
        .split(' ')
        .map(|word| word.parse().expect("a number"))
        .collect();
    assert_eq!(u, Subject::default().u);
    for (name, start) in [
        ("huge", "1e300"),
        ("on", "true"),
        ("mode", "4"),
        ("delay", "0"),
    ] {
        assert_eq!(variables[name].1.get("start"), Some(start), "{name}");
    }
    let [label] = &*variables["label"].2 else {
        panic!("one start value");
    };
    assert_eq!(
        (label.get("value"), variables["label"].1.get("start")),
        (Some("a <b> & \"c\""), None)
    );
}

#[test]
fn a_row_with_items_is_an_enumeration_of_a_type_however_fmi_2_declares_it() {
    let all = written(Standard::Fmi3);
    let variables = variables(&all);
    for name in ["mode", "choice"] {
        let variable = variables[name].1;
        let declared = ["declaredType", "min", "max"].map(|key| variable.get(key));
        assert_eq!(declared, [Some("Mode"), Some("1"), Some("4")], "{name}");
        assert_eq!(variable.get("description"), Some(name), "no list of items");
    }
    let items = under(&all, "TypeDefinitions/EnumerationType/Item");
    let shown: Vec<_> = items
        .iter()
        .map(|one| ["name", "value", "description"].map(|key| one.get(key).unwrap()))
        .collect();
    assert_eq!(
        shown,
        [["idle", "1", "nothing"], ["busy", "4", "x < y & z"]]
    );
}

#[test]
fn units_bounds_and_display_units_are_those_of_fmi_2() {
    let (two, three) = (
        elements(&xml(&interface(), PACKAGE)),
        written(Standard::Fmi3),
    );
    let of = |all: &[Element]| -> Vec<String> {
        let units = all
            .iter()
            .filter(|one| one.path.contains("/UnitDefinitions"));
        units
            .map(|one| format!("{} {:?}", one.path, one.attributes))
            .collect()
    };
    assert_eq!(of(&two), of(&three));
    let variables = variables(&three);
    let angle = variables["angle"].1;
    assert_eq!(
        (angle.get("unit"), angle.get("displayUnit")),
        (Some("rad"), Some("deg"))
    );
    let u = variables["u"].1;
    assert_eq!(
        (u.get("min"), u.get("max")),
        (Some("-10000.0"), Some("10000.0"))
    );
}

#[test]
fn seconds_are_defined_for_time_even_where_no_row_has_them() {
    const ROWS: Description<Subject> = Description {
        variables: &[Subject::DESCRIPTION.variables[1]],
        ..Subject::DESCRIPTION
    };
    let interface = Interface::read(&ROWS).expect("legal");
    assert!(interface.units().is_empty());
    let all = elements(&Standard::Fmi3.description(&interface, PACKAGE));
    let units = under(&all, "UnitDefinitions/Unit");
    let names: Vec<_> = units.iter().map(|one| one.get("name")).collect();
    assert_eq!(names, [Some("s")]);
}

#[test]
fn the_structure_names_value_references_each_array_once() {
    let all = written(Standard::Fmi3);
    let listed = |element: &str| -> BTreeMap<u32, (Vec<u32>, usize)> {
        let unknowns = under(&all, &format!("ModelStructure/{element}"));
        let count = unknowns.len();
        let map: BTreeMap<_, _> = unknowns
            .iter()
            .map(|one| {
                let kinds = one.get("dependenciesKind").unwrap_or_default();
                let kinds = kinds.split_whitespace();
                (
                    numbers(one.get("valueReference").unwrap())[0],
                    (
                        numbers(one.get("dependencies").expect("listed")),
                        kinds.inspect(|kind| assert_eq!(*kind, "dependent")).count(),
                    ),
                )
            })
            .collect();
        assert_eq!(map.len(), count);
        map
    };
    let none = || (Vec::new(), 0);
    assert_eq!(
        listed("Output"),
        BTreeMap::from([(512, none()), (768, none()), (1024, none())])
    );
    assert_eq!(
        listed("InitialUnknown"),
        BTreeMap::from([
            (512, (vec![0, 1536], 2)),
            (768, none()),
            (1024, none()),
            (1280, (vec![1536, 2304], 2)),
        ])
    );
}

#[test]
fn co_simulation_has_no_clock_and_so_needs_no_event_mode() {
    let all = written(Standard::Fmi3);
    let [flags] = &*under(&all, "CoSimulation") else {
        panic!("one");
    };
    for (flag, wanted) in [
        ("modelIdentifier", "Subject"),
        ("hasEventMode", "false"),
        ("canHandleVariableCommunicationStepSize", "true"),
        ("canGetAndSetFMUState", "true"),
        ("canSerializeFMUState", "true"),
        ("providesIntermediateUpdate", "false"),
        ("mightReturnEarlyFromDoStep", "false"),
        ("fixedInternalStepSize", "0.002"),
    ] {
        assert_eq!(flags.get(flag), Some(wanted), "{flag}");
    }
    assert!(
        flags
            .get("recommendedIntermediateInputSmoothness")
            .is_none()
    );
    assert!(
        variables(&all)
            .values()
            .all(|(kind, variable, _)| { *kind != "Clock" && variable.get("clocks").is_none() })
    );
}

#[test]
fn a_model_that_steps_exactly_has_no_internal_step_and_no_scheduled_execution() {
    const EXACT: Description<Subject> = Description {
        stepping: Stepping::Exact,
        ..Subject::DESCRIPTION
    };
    let exact = Interface::read(&EXACT).expect("legal");
    let all = elements(&Standard::Fmi3.description(&exact, PACKAGE));
    assert!(
        under(&all, "CoSimulation")[0]
            .get("fixedInternalStepSize")
            .is_none()
    );
    let of = |interface: &Interface| Standard::of(interface).collect::<Vec<_>>();
    assert_eq!(of(&exact), [Standard::Fmi2, Standard::Fmi3]);
    assert_eq!(of(&interface()), Standard::ALL);
}

#[test]
fn the_clock_has_the_sample_period_and_what_a_tick_reads_and_writes_belongs_to_it() {
    const SLOW: Description<Subject> = Description {
        experiment: Experiment {
            step: 0.25,
            ..Subject::DESCRIPTION.experiment
        },
        ..Subject::DESCRIPTION
    };
    let all =
        elements(&Standard::Fmi3Scheduled.description(&Interface::read(&SLOW).unwrap(), PACKAGE));
    let variables = variables(&all);
    let (kind, clock, _) = &variables["clock"];
    assert_eq!(*kind, "Clock");
    for (key, wanted) in [
        ("valueReference", "4294967294"),
        ("causality", "input"),
        ("variability", "discrete"),
        ("intervalVariability", "constant"),
        ("intervalDecimal", "0.25"),
        ("priority", "0"),
    ] {
        assert_eq!(clock.get(key), Some(wanted), "{key}");
    }
    let clocked: BTreeSet<_> = variables
        .iter()
        .filter(|(_, (_, variable, _))| variable.get("clocks") == Some("4294967294"))
        .map(|(name, _)| *name)
        .collect();
    assert_eq!(
        clocked,
        BTreeSet::from(["u", "on", "angle", "energy.total", "tick", "inner"])
    );
    assert!(variables.values().all(|(_, variable, _)| {
        variable.get("clocks").is_none() || variable.get("variability") == Some("discrete")
    }));
    // All knowns, the clock among them.
    let outputs = under(&all, "ModelStructure/Output");
    assert_eq!(outputs.len(), 3);
    assert!(outputs.iter().all(|one| one.get("dependencies").is_none()));
    let unknowns = under(&all, "ModelStructure/InitialUnknown");
    let references: Vec<_> = unknowns
        .iter()
        .map(|one| one.get("valueReference"))
        .collect();
    assert_eq!(references, [Some("1280")], "the calculated parameter");
}
