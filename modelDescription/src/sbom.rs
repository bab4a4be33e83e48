//! The bill of materials: CycloneDX 1.5 in JSON. No serial number and no date: the same parts give the same bytes.

use crate::{Component, Product};
use serde::Serialize;

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Bill<'a> {
    bom_format: &'a str,
    spec_version: &'a str,
    version: u32,
    metadata: Metadata<'a>,
    components: Vec<Part<'a>>,
    dependencies: Vec<Dependency>,
}

#[derive(Serialize)]
struct Metadata<'a> {
    component: Part<'a>,
}

#[derive(Serialize)]
struct Part<'a> {
    #[serde(rename = "type")]
    kind: &'a str,
    #[serde(rename = "bom-ref")]
    reference: String,
    name: &'a str,
    version: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    description: Option<&'a str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    hashes: Vec<Hash<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    licenses: Vec<Licence<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    purl: Option<&'a str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    properties: Vec<Property<'a>>,
}

#[derive(Serialize)]
struct Hash<'a> {
    alg: &'a str,
    content: &'a str,
}

#[derive(Serialize)]
struct Licence<'a> {
    expression: &'a str,
}

#[derive(Serialize)]
struct Property<'a> {
    name: &'a str,
    value: &'a str,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Dependency {
    #[serde(rename = "ref")]
    reference: String,
    depends_on: Vec<String>,
}

/// Writes the bill of what is delivered, with what is linked into its libraries.
///
/// # Panics
/// When serde_json cannot write our own elements: a programming error that the first test shows.
pub fn write(product: &Product<'_>, linked: &[Component]) -> String {
    let own = Part {
        kind: "library",
        reference: product.name.to_owned(),
        name: product.name,
        version: product.package.version,
        description: Some(product.about),
        hashes: Vec::new(),
        licenses: licence(product.package.license),
        purl: None,
        properties: product
            .guid
            .iter()
            .map(|value| Property {
                name: "fmi:guid",
                value,
            })
            .collect(),
    };
    // Used by no other component: used by the whole itself.
    let roots = linked
        .iter()
        .map(Component::id)
        .filter(|id| !linked.iter().any(|other| other.uses.contains(id)));
    let mut dependencies = vec![Dependency {
        reference: product.name.to_owned(),
        depends_on: roots.collect(),
    }];
    dependencies.extend(linked.iter().map(|component| Dependency {
        reference: component.id(),
        depends_on: component.uses.clone(),
    }));
    let bill = Bill {
        bom_format: "CycloneDX",
        spec_version: "1.5",
        version: 1,
        metadata: Metadata { component: own },
        components: linked.iter().map(part).collect(),
        dependencies,
    };
    let mut text = serde_json::to_string_pretty(&bill).expect("the elements are serializable");
    text.push('\n');
    text
}

/// None where the package names none.
fn licence(expression: &str) -> Vec<Licence<'_>> {
    let named = (!expression.is_empty()).then_some(Licence { expression });
    named.into_iter().collect()
}

fn part(component: &Component) -> Part<'_> {
    Part {
        kind: "library",
        reference: component.id(),
        name: &component.name,
        version: &component.version,
        description: None,
        hashes: component
            .sha256
            .iter()
            .map(|content| Hash {
                alg: "SHA-256",
                content,
            })
            .collect(),
        licenses: licence(&component.license),
        purl: component.purl.as_deref(),
        properties: Vec::new(),
    }
}
