//! `modelDescription.xml`, as much of it as an importer needs to couple FMUs.

use crate::variable::{Scalar, Variable};
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
    #[serde(rename = "DefaultExperiment", default)]
    experiment: Experiment,
    #[serde(rename = "ModelVariables")]
    variables: Variables,
}

#[derive(Debug, Deserialize)]
struct CoSimulation {
    #[serde(rename = "@modelIdentifier")]
    model_identifier: String,
}

#[derive(Debug, Default, Deserialize)]
struct Experiment {
    #[serde(rename = "@stepSize")]
    step_size: Option<f64>,
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
        self.variables.list.iter().map(Variable::new).collect()
    }

    /// Step size of the default experiment (s).
    pub fn step_size(&self) -> Option<f64> {
        self.experiment.step_size
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kind;

    #[test]
    fn name_guid_reference_and_type_are_read() {
        let text = r#"<?xml version="1.0" encoding="UTF-8"?>
            <fmiModelDescription fmiVersion="2.0" modelName="M" guid="{g}">
              <CoSimulation modelIdentifier="M_id" canGetAndSetFMUstate="true"/>
              <LogCategories><Category name="a" description="b"/></LogCategories>
              <DefaultExperiment startTime="0.0" stepSize="0.25"/>
              <ModelVariables>
                <ScalarVariable name="x[1]" valueReference="256" causality="input" variability="continuous">
                  <Real unit="m" min="-1" start="0"/>
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
        assert_eq!(variables[0].bounds, Some((-1.0, f64::INFINITY)));
        assert_eq!(
            (variables[1].bounds, variables[1].start.as_deref()),
            (None, Some("4"))
        );
        assert_eq!(description.step_size(), Some(0.25));
    }
}
