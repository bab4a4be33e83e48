//! What the written `modelDescription.xml` says of variables, units and types, read back by name. (Its validity against the XSD
//! is a system test.)

mod subject;

use fmu_declaration::Declare as _;
use std::collections::BTreeSet;
use subject::{Subject, under, variable, variables, written};

#[test]
fn value_references_are_256_times_the_row_plus_the_element() {
    let all = written();
    let references: Vec<_> = variables(&all)
        .iter()
        .map(|(v, _)| {
            (
                v.get("name").unwrap().to_owned(),
                v.get("valueReference").unwrap().parse::<u32>().unwrap(),
            )
        })
        .collect();
    for (name, reference) in [
        ("u[1]", 0),
        ("u[3]", 2),
        ("on", 256),
        ("angle[2]", 513),
        ("inner", 12 * 256),
    ] {
        assert!(references.contains(&(name.to_owned(), reference)), "{name}");
    }
    assert_eq!(
        references
            .iter()
            .map(|(_, r)| r)
            .collect::<BTreeSet<_>>()
            .len(),
        references.len()
    );
}

#[test]
fn start_and_initial_follow_the_causality() {
    let all = written();
    for (v, kind) in variables(&all) {
        let wanted = match v.get("causality").unwrap() {
            "input" => (None, true),
            "parameter" => (Some("exact"), true),
            _ => (Some("calculated"), false),
        };
        assert_eq!(
            (v.get("initial"), kind.get("start").is_some()),
            wanted,
            "{v:?}"
        );
        assert!(v.get("variability").is_some(), "{v:?}");
    }
    assert!(
        all.iter()
            .all(|e| e.get("causality") != Some("independent"))
    );
}

#[test]
fn numbers_read_back_to_the_same_bits() {
    let all = written();
    for (name, value) in [
        ("u[3]", 1.0 / 3.0),
        ("tiny", 8e-5),
        ("huge", 1e300),
        ("gain", 30.0),
    ] {
        let text = variable(&all, name).1.get("start").unwrap();
        assert_eq!(
            text.parse::<f64>().unwrap().to_bits(),
            f64::to_bits(value),
            "{name} {text}"
        );
        assert!(text.len() < 25, "shortest form: {text}");
    }
}

#[test]
fn bounds_are_written_only_where_there_are_some() {
    let all = written();
    let bounds = |name: &str| {
        let kind = variable(&all, name).1;
        (
            kind.get("min").map(str::to_owned),
            kind.get("max").map(str::to_owned),
        )
    };
    let some = |text: &str| Some(text.to_owned());
    assert_eq!(bounds("u[1]"), (some("-10000.0"), some("10000.0")));
    assert_eq!(bounds("gain"), (some("0.0"), None));
    assert_eq!(bounds("tiny"), (None, None));
    assert_eq!(bounds("delay"), (some("0"), some("1")));
    assert_eq!(bounds("tick"), (None, None));
    assert_eq!(bounds("mode"), (some("1"), some("4")));
}

#[test]
fn each_real_has_a_unit_that_is_defined_once_with_its_exponents() {
    let all = written();
    let defined: Vec<_> = under(&all, "UnitDefinitions/Unit")
        .into_iter()
        .map(|i| all[i].get("name").unwrap())
        .collect();
    assert_eq!(defined, ["1", "J", "N", "N.s/m", "m", "rad", "s"]);
    for (v, kind) in variables(&all) {
        assert_eq!(
            kind.path.ends_with("/Real"),
            kind.get("unit").is_some_and(|unit| defined.contains(&unit)),
            "{v:?}"
        );
    }
    let joule = under(&all, "UnitDefinitions/Unit")
        .into_iter()
        .find(|&i| all[i].get("name") == Some("J"))
        .unwrap();
    let exponents: Vec<_> = all[joule + 1]
        .attributes
        .iter()
        .map(|(k, v)| format!("{k}{v}"))
        .collect();
    assert_eq!(exponents, ["kg1", "m2", "s-2"]);
    let display: Vec<_> = all
        .iter()
        .filter(|e| e.path.ends_with("/DisplayUnit"))
        .collect();
    assert_eq!(display.len(), 1);
    assert_eq!(
        (display[0].get("name"), display[0].get("factor")),
        (Some("deg"), Some("57.29577951308232"))
    );
    assert_eq!(variable(&all, "angle[1]").1.get("displayUnit"), Some("deg"));
}

#[test]
fn enumerations_declare_their_type() {
    let all = written();
    let items: Vec<_> = under(&all, "TypeDefinitions/SimpleType/Enumeration/Item")
        .into_iter()
        .map(|i| (all[i].get("name").unwrap(), all[i].get("value").unwrap()))
        .collect();
    assert_eq!(items, [("idle", "1"), ("busy", "4")]);
    let kind = variable(&all, "mode").1;
    assert!(kind.path.ends_with("/Enumeration"));
    assert_eq!(
        (kind.get("declaredType"), kind.get("start")),
        (Some("Mode"), Some("4"))
    );
}

#[test]
fn a_choice_is_an_integer_that_names_its_items() {
    let all = written();
    let (scalar, kind) = variable(&all, "choice");
    assert!(kind.path.ends_with("/Integer"));
    assert_eq!(
        (kind.get("min"), kind.get("max"), kind.get("start")),
        (Some("1"), Some("4"), Some("1"))
    );
    assert_eq!(kind.get("declaredType"), None);
    assert_eq!(scalar.get("description"), Some("choice: 1 idle, 4 busy"));
}

#[test]
fn version_and_git_hash_follow_the_rows_and_the_xml_has_no_value_of_theirs() {
    let all = written();
    let last: Vec<_> = variables(&all).into_iter().rev().take(2).rev().collect();
    for ((scalar, kind), (name, reference)) in last
        .into_iter()
        .zip([("version", "16776960"), ("git_hash", "16776961")])
    {
        let attribute = |name: &str| scalar.get(name);
        assert_eq!(attribute("name"), Some(name));
        assert_eq!(attribute("valueReference"), Some(reference));
        assert_eq!(attribute("causality"), Some("local"));
        assert_eq!(attribute("variability"), Some("fixed"));
        assert_eq!(attribute("initial"), Some("calculated"));
        assert!(kind.path.ends_with("/String"));
        assert!(kind.attributes.is_empty(), "{name} has no start");
    }
    // Local variables are no InitialUnknowns (section 2.2.8): outputs and calculated parameters are.
    let count = variables(&all).len();
    for i in under(&all, "ModelStructure/InitialUnknowns/Unknown") {
        let index: usize = all[i].get("index").unwrap().parse().unwrap();
        assert!(index <= count - 2);
    }
}

#[test]
fn special_characters_survive() {
    let all = written();
    assert_eq!(
        all[0].get("description"),
        Some("A row of each kind, with ττ & <angles>")
    );
    assert_eq!(
        variable(&all, "u[1]").0.get("description"),
        Some("force & \"sign\"")
    );
    assert_eq!(
        variable(&all, "label").1.get("start"),
        Some("a <b> & \"c\"")
    );
}

#[test]
fn variables_stand_by_causality_then_by_group_and_keep_their_value_references() {
    let all = written();
    let found: Vec<_> = variables(&all)
        .iter()
        .map(|(v, _)| {
            let reference: u32 = v.get("valueReference").unwrap().parse().unwrap();
            (
                v.get("causality").unwrap(),
                v.get("name").unwrap(),
                reference,
            )
        })
        .collect();
    // The rows of the subject are mixed: `scale` stands before the parameters, `energy.total` before `tick`.
    let rows: Vec<_> = Subject::DESCRIPTION
        .scalars()
        .map(|scalar| scalar.name())
        .collect();
    assert_ne!(
        rows,
        found[..rows.len()]
            .iter()
            .map(|(_, name, _)| (*name).to_owned())
            .collect::<Vec<_>>()
    );
    let order: Vec<_> = found.iter().map(|(causality, ..)| *causality).collect();
    let mut runs = order.clone();
    runs.dedup();
    assert_eq!(
        runs,
        [
            "input",
            "output",
            "parameter",
            "calculatedParameter",
            "local"
        ]
    );
    let outputs: Vec<_> = found
        .iter()
        .filter(|(causality, ..)| *causality == "output")
        .map(|(_, name, reference)| (*name, *reference))
        .collect();
    assert_eq!(
        outputs,
        [
            ("angle[1]", 512),
            ("angle[2]", 513),
            ("angle[3]", 514),
            ("tick", 1024),
            ("energy.total", 768)
        ]
    );
}
