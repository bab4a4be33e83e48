//! What the written `modelDescription.xml` says of the whole: its sections, the head, and ModelStructure.

mod subject;

use fmu_archive::Interface;
use std::collections::BTreeMap;
use subject::{Subject, indices, under, variables, written};

#[test]
fn the_sections_stand_in_the_order_of_the_xsd() {
    let all = written();
    let sections: Vec<_> = all
        .iter()
        .filter(|e| e.path.matches('/').count() == 1)
        .map(|e| &e.path[20..])
        .collect();
    assert_eq!(
        sections,
        [
            "CoSimulation",
            "UnitDefinitions",
            "TypeDefinitions",
            "LogCategories",
            "DefaultExperiment",
            "ModelVariables",
            "ModelStructure"
        ]
    );
}

#[test]
fn outputs_lists_every_output_once_without_dependencies() {
    let all = written();
    let outputs: Vec<usize> = variables(&all)
        .iter()
        .enumerate()
        .filter(|(_, (v, _))| v.get("causality") == Some("output"))
        .map(|(position, _)| position + 1)
        .collect();
    let unknowns: Vec<_> = under(&all, "ModelStructure/Outputs/Unknown")
        .into_iter()
        .map(|i| &all[i])
        .collect();
    assert_eq!(
        unknowns
            .iter()
            .map(|u| u.get("index").unwrap().parse().unwrap())
            .collect::<Vec<usize>>(),
        outputs
    );
    assert!(
        unknowns
            .iter()
            .all(|u| u.get("dependencies") == Some("") && u.get("dependenciesKind").is_none())
    );
    assert_eq!(outputs.len(), 5);
}

#[test]
fn initial_unknowns_are_sorted_and_depend_on_what_the_rows_name() {
    let all = written();
    let names: Vec<_> = variables(&all)
        .iter()
        .map(|(v, _)| v.get("name").unwrap().to_owned())
        .collect();
    let mut found = BTreeMap::new();
    let mut last = 0;
    for i in under(&all, "ModelStructure/InitialUnknowns/Unknown") {
        let index: usize = all[i].get("index").unwrap().parse().unwrap();
        assert!(index > last, "sorted, unique");
        last = index;
        let dependencies = indices(all[i].get("dependencies").unwrap());
        assert!(dependencies.windows(2).all(|pair| pair[0] < pair[1]));
        let kinds = all[i]
            .get("dependenciesKind")
            .unwrap_or("")
            .split_whitespace()
            .collect::<Vec<_>>();
        assert_eq!(kinds, vec!["dependent"; dependencies.len()]);
        found.insert(
            &names[index - 1][..],
            dependencies
                .iter()
                .map(|&d| &names[d - 1][..])
                .collect::<Vec<_>>(),
        );
    }
    let from_u = vec!["u[1]", "u[2]", "u[3]", "gain"];
    let wanted = BTreeMap::from([
        ("angle[1]", from_u.clone()),
        ("angle[2]", from_u.clone()),
        ("angle[3]", from_u),
        ("energy.total", vec![]),
        ("tick", vec![]),
        ("scale", vec!["gain", "delay"]),
    ]);
    assert_eq!(
        found, wanted,
        "calculated outputs and calculated parameters, nothing else"
    );
}

#[test]
fn capabilities_are_those_that_the_exporter_has() {
    let all = written();
    let i = under(&all, "CoSimulation")[0];
    let yes: Vec<_> = all[i]
        .attributes
        .iter()
        .filter(|(_, v)| *v == "true")
        .map(|(k, _)| &k[..])
        .collect();
    assert_eq!(
        yes,
        [
            "canGetAndSetFMUstate",
            "canHandleVariableCommunicationStepSize",
            "canNotUseMemoryManagementFunctions",
            "canSerializeFMUstate"
        ]
    );
    assert_eq!(
        all[i].get("canRunAsynchronuously"),
        Some("false"),
        "spelt as in the standard"
    );
    assert_eq!(all[i].get("modelIdentifier"), Some("Subject"));
}

#[test]
fn root_and_default_experiment_are_complete_and_carry_no_date() {
    let all = written();
    let guid = Interface::of::<Subject>().unwrap().guid;
    assert_eq!(all[0].get("guid"), Some(&guid[..]));
    assert!(guid.starts_with('{') && guid.ends_with('}'));
    assert_eq!(
        (
            all[0].get("fmiVersion"),
            all[0].get("variableNamingConvention")
        ),
        (Some("2.0"), Some("structured"))
    );
    for (attribute, told) in [
        ("author", "Ada & Grace"),
        ("version", "3.1.4"),
        ("copyright", "Copyright Ada <ada@example.org>"),
        ("license", "MIT OR Zlib"),
    ] {
        assert_eq!(all[0].get(attribute), Some(told));
    }
    let tool = concat!("fmu-archive ", env!("CARGO_PKG_VERSION"));
    assert_eq!(all[0].get("generationTool"), Some(tool));
    assert_eq!(all[0].get("generationDateAndTime"), None);
    let experiment = &all[under(&all, "DefaultExperiment")[0]];
    let times: Vec<_> = ["startTime", "stopTime", "tolerance", "stepSize"]
        .map(|name| experiment.get(name).unwrap())
        .into();
    assert_eq!(times, ["0.0", "60.0", "1e-6", "0.002"]);
}
