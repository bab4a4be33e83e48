//! `modelDescription.xml`, as much of it as an importer needs to couple FMUs.

use serde::Deserialize;

/// The root element.
#[derive(Debug, Deserialize)]
pub struct Description {
    /// Model name.
    #[serde(rename = "@modelName")]
    pub name: String,
    /// Guid.
    #[serde(rename = "@guid")]
    pub guid: String,
    #[serde(rename = "CoSimulation")]
    co_simulation: CoSimulation,
    #[serde(rename = "LogCategories", default)]
    log_categories: LogCategories,
    #[serde(rename = "ModelVariables")]
    variables: Variables,
}

#[derive(Debug, Deserialize)]
struct CoSimulation {
    #[serde(rename = "@modelIdentifier")]
    model_identifier: String,
}

#[derive(Debug, Default, Deserialize)]
struct LogCategories {
    #[serde(rename = "Category", default)]
    list: Vec<Category>,
}

#[derive(Debug, Deserialize)]
struct Category {
    #[serde(rename = "@name")]
    name: String,
}

#[derive(Debug, Deserialize)]
struct Variables {
    #[serde(rename = "ScalarVariable")]
    list: Vec<Scalar>,
}

#[derive(Debug, Deserialize)]
struct Scalar {
    #[serde(rename = "@name")]
    name: String,
    #[serde(rename = "@valueReference")]
    reference: u32,
    #[serde(rename = "@causality", default)]
    causality: String,
    #[serde(rename = "@variability", default)]
    variability: String,
    #[serde(rename = "$value")]
    kind: Vec<Kind>,
}

/// Type of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
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
}

impl Description {
    /// Parses the XML text.
    ///
    /// # Errors
    /// What the parser expected and found.
    pub fn parse(text: &str) -> Result<Self, quick_xml::DeError> {
        quick_xml::de::from_str(text)
    }

    /// Base name of the shared library.
    pub fn model_identifier(&self) -> &str {
        &self.co_simulation.model_identifier
    }

    /// Declared log categories.
    pub fn log_categories(&self) -> Vec<String> {
        self.log_categories
            .list
            .iter()
            .map(|c| c.name.clone())
            .collect()
    }

    /// All variables, in the order of the file.
    pub fn variables(&self) -> Vec<Variable> {
        self.variables
            .list
            .iter()
            .map(|scalar| Variable {
                name: scalar.name.clone(),
                reference: scalar.reference,
                kind: scalar.kind[0],
                causality: scalar.causality.clone(),
                variability: scalar.variability.clone(),
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn name_guid_reference_and_type_are_read() {
        let text = r#"<?xml version="1.0" encoding="UTF-8"?>
            <fmiModelDescription fmiVersion="2.0" modelName="M" guid="{g}">
              <CoSimulation modelIdentifier="M_id" canGetAndSetFMUstate="true"/>
              <LogCategories><Category name="a" description="b"/></LogCategories>
              <ModelVariables>
                <ScalarVariable name="x[1]" valueReference="256" causality="input" variability="continuous">
                  <Real unit="m" start="0"/>
                </ScalarVariable>
                <!-- a comment between two variables -->
                <ScalarVariable name="law" valueReference="7" causality="parameter" variability="fixed">
                  <Enumeration declaredType="Law" start="4"/>
                </ScalarVariable>
              </ModelVariables>
            </fmiModelDescription>"#;
        let description = Description::parse(text).expect("valid XML");
        assert_eq!(
            (description.name.as_str(), description.guid.as_str()),
            ("M", "{g}")
        );
        assert_eq!(description.model_identifier(), "M_id");
        assert_eq!(description.log_categories(), ["a"]);
        let variables = description.variables();
        assert_eq!(variables.len(), 2);
        assert_eq!(
            (variables[0].reference, variables[0].kind),
            (256, Kind::Real {})
        );
        assert_eq!(
            (variables[1].name.as_str(), variables[1].kind),
            ("law", Kind::Enumeration {})
        );
        assert_eq!(variables[1].variability, "fixed");
    }
}
