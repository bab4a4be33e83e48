//! The `fmi` crate reads the description of every FMU. What it refuses although it is valid is shown beside.

use catalogue::models::*;
use fmi::schema::fmi2::{Causality as Read, Fmi2ModelDescription};
use fmi::traits::FmiImport as _;
use fmu_declaration::{Causality, Declare, provenance};
use importers::imported::{import, variables};
use std::path::Path;
use std::str::FromStr as _;

fn read_as_declared<M: Declare>() {
    let import = import(&importers::archive(M::DESCRIPTION.name)).expect("read");
    let read = variables(&import);
    let declared = M::DESCRIPTION.in_order();
    // After the rows of the model: what every library says of itself.
    let (read, last) = read.split_at(declared.len());
    let last: Vec<_> = last
        .iter()
        .map(|variable| (&*variable.name, variable.reference))
        .collect();
    assert_eq!(
        last,
        provenance::ALL.map(|one| (one.name(), one.reference()))
    );
    for (read, scalar) in read.iter().zip(&declared) {
        let name = &read.name;
        assert_eq!((name, read.reference), (&scalar.name(), scalar.reference()));
        let wanted = match scalar.variable.causality {
            Causality::Parameter => Read::Parameter,
            Causality::CalculatedParameter => Read::CalculatedParameter,
            Causality::Input => Read::Input,
            Causality::Output => Read::Output,
            Causality::Local => Read::Local,
        };
        assert_eq!(read.causality, wanted, "{name}");
    }
    let description = import.model_description();
    assert_eq!(description.guid, M::DESCRIPTION.guid());
    let outputs = &description.model_structure.outputs.unknowns;
    let read: Vec<_> = outputs.iter().map(|unknown| unknown.index).collect();
    let positions = (1..).zip(&declared);
    let positions: Vec<_> = positions
        .filter(|(_, scalar)| scalar.variable.causality == Causality::Output)
        .map(|(position, _)| position)
        .collect();
    assert_eq!(read, positions);
}

macro_rules! each_is_read_as_declared {
    ($($crate_name:ident::$Type:ident, picture $picture:literal;)*) => {
        $(read_as_declared::<$crate_name::$Type>();)*
    };
}

#[test]
fn the_importer_reads_the_declared_variables() {
    fmus::each!(each_is_read_as_declared);
}

/// The committed description of the testbed, with one part replaced.
fn with(part: &str, other: &str) -> Result<Fmi2ModelDescription, String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../modelDescription/Testbed.xml");
    let text = std::fs::read_to_string(path).expect("committed");
    assert!(text.contains(part), "{part}");
    Fmi2ModelDescription::from_str(&text.replacen(part, other, 1)).map_err(|e| e.to_string())
}

#[test]
fn the_importer_refuses_two_valid_things_that_our_descriptions_therefore_do_not_have() {
    let input = r#"causality="input""#;
    assert!(with(input, input).is_ok());
    let attribute = format!(r#"{input} canHandleMultipleSetPerTimeInstant="false""#);
    let annotations = r#"<Annotations><Tool name="org.example"/></Annotations></ScalarVariable>"#;
    // When one of these is accepted one day, docs/importers.md must lose it.
    let refusals = [
        with(input, &attribute),
        with("</ScalarVariable>", annotations),
    ];
    for refusal in refusals {
        println!("{:?}", refusal.as_ref().err());
        assert!(refusal.is_err());
    }
}
