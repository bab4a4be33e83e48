//! A variable of `modelDescription.xml`.

use serde::Deserialize;

/// The element as it stands there.
#[derive(Debug, Deserialize)]
pub(crate) struct Scalar {
    #[serde(rename = "@name")]
    name: String,
    #[serde(rename = "@valueReference")]
    reference: u32,
    #[serde(rename = "@causality", default)]
    causality: String,
    #[serde(rename = "@variability", default)]
    variability: String,
    #[serde(rename = "$value")]
    kind: Vec<Element>,
}

#[derive(Debug, Deserialize)]
enum Element {
    Real(Attributes),
    Integer(Attributes),
    Boolean(Attributes),
    String(Attributes),
    Enumeration(Attributes),
}

#[derive(Clone, Debug, Deserialize)]
struct Attributes {
    #[serde(rename = "@min")]
    min: Option<f64>,
    #[serde(rename = "@max")]
    max: Option<f64>,
    #[serde(rename = "@start")]
    start: Option<String>,
}

/// Type of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// `<Real>`
    Real {},
    /// `<Integer>`
    Integer {},
    /// `<Boolean>`
    Boolean {},
    /// `<String>`
    String {},
    /// `<Enumeration>`
    Enumeration {},
}

/// One scalar variable.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Name.
    pub name: String,
    /// Value reference.
    pub reference: u32,
    /// Type.
    pub kind: Kind,
    /// `input`, `output`, `parameter`, …
    pub causality: String,
    /// `fixed`, `tunable`, `discrete`, `continuous`, …
    pub variability: String,
    /// Smallest and largest value; infinite on a side that has none, absent when neither is given.
    pub bounds: Option<(f64, f64)>,
    /// The attribute `start`.
    pub start: Option<String>,
}

impl Variable {
    pub(crate) fn new(scalar: &Scalar) -> Self {
        let (kind, attributes) = match &scalar.kind[0] {
            Element::Real(attributes) => (Kind::Real {}, attributes),
            Element::Integer(attributes) => (Kind::Integer {}, attributes),
            Element::Boolean(attributes) => (Kind::Boolean {}, attributes),
            Element::String(attributes) => (Kind::String {}, attributes),
            Element::Enumeration(attributes) => (Kind::Enumeration {}, attributes),
        };
        let (min, max) = (attributes.min, attributes.max);
        Self {
            name: scalar.name.clone(),
            reference: scalar.reference,
            kind,
            causality: scalar.causality.clone(),
            variability: scalar.variability.clone(),
            bounds: (min.is_some() || max.is_some()).then_some((
                min.unwrap_or(f64::NEG_INFINITY),
                max.unwrap_or(f64::INFINITY),
            )),
            start: attributes.start.clone(),
        }
    }
}
