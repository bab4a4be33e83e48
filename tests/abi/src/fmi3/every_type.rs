//! The test model with every type, `modelDescription/export/examples/feedthrough`, which FMI 2.0 cannot show: its variables are read
//! from its description for FMI 3.0.

use super::fmu::{Fmu, Row, Type};
use super::library::Library;
use crate::fmu::{SUFFIX, directory, existing};
use crate::{Kind, Variable};
use serde::Deserialize;
use std::sync::Arc;

#[derive(Debug, Deserialize)]
struct Description {
    #[serde(rename = "@modelName")]
    name: String,
    #[serde(rename = "@instantiationToken")]
    token: String,
    #[serde(rename = "ModelVariables")]
    variables: Variables,
}

#[derive(Debug, Deserialize)]
struct Variables {
    #[serde(rename = "$value")]
    list: Vec<Element>,
}

#[derive(Debug, Deserialize)]
enum Element {
    Float32(Attributes),
    Float64(Attributes),
    Int8(Attributes),
    UInt8(Attributes),
    Int16(Attributes),
    UInt16(Attributes),
    Int32(Attributes),
    UInt32(Attributes),
    Int64(Attributes),
    UInt64(Attributes),
    Boolean(Attributes),
    String(Attributes),
    Binary(Attributes),
    Enumeration(Attributes),
}

#[derive(Debug, Deserialize)]
struct Attributes {
    #[serde(rename = "@name")]
    name: String,
    #[serde(rename = "@valueReference")]
    reference: u32,
    #[serde(rename = "@causality")]
    causality: String,
    #[serde(rename = "@variability")]
    variability: String,
    #[serde(rename = "Dimension")]
    dimension: Option<Dimension>,
}

#[derive(Debug, Deserialize)]
struct Dimension {
    #[serde(rename = "@start")]
    start: u32,
}

impl Element {
    /// Its type, the one of FMI 2.0 that comes closest, and the rest.
    fn split(self) -> (Type, Kind, Attributes) {
        match self {
            Self::Float32(rest) => (Type::Float32, Kind::Real {}, rest),
            Self::Float64(rest) => (Type::Float64, Kind::Real {}, rest),
            Self::Int8(rest) => (Type::Int8, Kind::Integer {}, rest),
            Self::UInt8(rest) => (Type::UInt8, Kind::Integer {}, rest),
            Self::Int16(rest) => (Type::Int16, Kind::Integer {}, rest),
            Self::UInt16(rest) => (Type::UInt16, Kind::Integer {}, rest),
            Self::Int32(rest) => (Type::Int32, Kind::Integer {}, rest),
            Self::UInt32(rest) => (Type::UInt32, Kind::Integer {}, rest),
            Self::Int64(rest) => (Type::Int64, Kind::Integer {}, rest),
            Self::UInt64(rest) => (Type::UInt64, Kind::Integer {}, rest),
            Self::Boolean(rest) => (Type::Boolean, Kind::Boolean {}, rest),
            Self::String(rest) => (Type::Text, Kind::String {}, rest),
            Self::Binary(rest) => (Type::Binary, Kind::String {}, rest),
            Self::Enumeration(rest) => (Type::Enumeration, Kind::Enumeration {}, rest),
        }
    }
}

fn row(element: Element) -> Row {
    let (kind, closest, rest) = element.split();
    let length = rest.dimension.as_ref().map_or(1, |one| one.start);
    let scalar = |i| Variable {
        name: match rest.dimension {
            Some(_) => format!("{}[{}]", rest.name, i + 1),
            None => rest.name.clone(),
        },
        reference: rest.reference + i,
        kind: closest,
        causality: rest.causality.clone(),
        variability: rest.variability.clone(),
        bounds: None,
        start: None,
    };
    Row {
        elements: (0..length).map(scalar).collect(),
        name: rest.name.clone(),
        reference: rest.reference,
        kind,
    }
}

impl Fmu {
    /// Unpacks and loads the archive of the test model with every type.
    ///
    /// # Panics
    /// When it is missing or no FMU.
    pub fn every_type() -> Self {
        let archive = existing(directory().join("test/fmi3/feedthrough.fmu"));
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = std::fs::File::open(&archive).expect("readable");
        let mut zip = zip::ZipArchive::new(file).expect("an archive");
        zip.extract(folder.path()).expect("unpacked");
        let text = std::fs::read_to_string(folder.path().join("modelDescription.xml"));
        let description: Description =
            quick_xml::de::from_str(&text.expect("there")).expect("a description");
        let path = library(folder.path(), &description.name);
        let rows = description.variables.list.into_iter().map(row);
        // The independent variable has no row.
        let rows: Vec<_> = rows
            .filter(|row| row.causality() != "independent")
            .collect();
        Self {
            library: Arc::new(Library::load(&path)),
            fmi2: crate::Fmu {
                name: description.name,
                guid: description.token,
                variables: rows.iter().flat_map(|row| row.elements.clone()).collect(),
                log_categories: ["logStatusError", "logStatusWarning", "logEvents"]
                    .map(Into::into)
                    .into(),
                step_size: 0.1,
                library: Arc::new(crate::Library::load(&path)),
                path,
                folder: Some(folder),
            },
            rows,
        }
    }
}

/// The library of the one platform in the archive.
fn library(folder: &std::path::Path, name: &str) -> std::path::PathBuf {
    let binaries = std::fs::read_dir(folder.join("binaries")).expect("a folder");
    let mut libraries = binaries.map(|platform| {
        let platform = platform.expect("readable").path();
        platform.join(format!("{name}{SUFFIX}"))
    });
    libraries.next().expect("a platform")
}
