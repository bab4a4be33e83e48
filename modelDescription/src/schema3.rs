//! The elements of FMI 3.0's `modelDescription.xml` that we write, in the order of its XSD. Units, log categories and the default
//! experiment are those of FMI 2.0. Attributes start with `@`.

use crate::schema::{DefaultExperiment, Item, LogCategories, UnitDefinitions, element};
use serde::Serialize;

type Text = String;
type Optional = Option<String>;

element! {
    /// The root.
    #[serde(rename = "fmiModelDescription")]
    Root {
        #[serde(rename = "@fmiVersion")] fmi_version: Text,
        #[serde(rename = "@modelName")] model_name: Text,
        #[serde(rename = "@instantiationToken")] instantiation_token: Text,
        #[serde(rename = "@description")] description: Text,
        #[serde(rename = "@author", skip_serializing_if = "Option::is_none")] author: Optional,
        #[serde(rename = "@version", skip_serializing_if = "Option::is_none")] version: Optional,
        #[serde(rename = "@copyright", skip_serializing_if = "Option::is_none")] copyright: Optional,
        #[serde(rename = "@license", skip_serializing_if = "Option::is_none")] license: Optional,
        #[serde(rename = "@generationTool")] generation_tool: Text,
        #[serde(rename = "@variableNamingConvention")] variable_naming_convention: Text,
        #[serde(rename = "CoSimulation", skip_serializing_if = "Option::is_none")] co_simulation: Option<CoSimulation>,
        #[serde(rename = "ScheduledExecution", skip_serializing_if = "Option::is_none")] scheduled_execution: Option<ScheduledExecution>,
        #[serde(rename = "UnitDefinitions", skip_serializing_if = "Option::is_none")] units: Option<UnitDefinitions>,
        #[serde(rename = "TypeDefinitions", skip_serializing_if = "Option::is_none")] types: Option<TypeDefinitions>,
        #[serde(rename = "LogCategories")] log: LogCategories,
        #[serde(rename = "DefaultExperiment")] experiment: DefaultExperiment,
        #[serde(rename = "ModelVariables")] variables: ModelVariables,
        #[serde(rename = "ModelStructure")] structure: ModelStructure,
    }
}
element! {
    /// Capabilities of co-simulation.
    CoSimulation {
        #[serde(rename = "@modelIdentifier")] model_identifier: Text,
        #[serde(rename = "@needsExecutionTool")] needs_execution_tool: bool,
        #[serde(rename = "@canBeInstantiatedOnlyOncePerProcess")] only_once_per_process: bool,
        #[serde(rename = "@canGetAndSetFMUState")] can_get_and_set_state: bool,
        #[serde(rename = "@canSerializeFMUState")] can_serialize_state: bool,
        #[serde(rename = "@providesDirectionalDerivatives")] directional_derivatives: bool,
        #[serde(rename = "@providesAdjointDerivatives")] adjoint_derivatives: bool,
        #[serde(rename = "@providesPerElementDependencies")] per_element_dependencies: bool,
        #[serde(rename = "@canHandleVariableCommunicationStepSize")] can_handle_variable_step: bool,
        #[serde(rename = "@fixedInternalStepSize", skip_serializing_if = "Option::is_none")] fixed_internal_step: Optional,
        #[serde(rename = "@maxOutputDerivativeOrder")] max_output_derivative_order: u32,
        // There is no recommendedIntermediateInputSmoothness: its smallest value, 0, asks for continuous intermediate inputs.
        #[serde(rename = "@providesIntermediateUpdate")] intermediate_update: bool,
        #[serde(rename = "@mightReturnEarlyFromDoStep")] might_return_early: bool,
        #[serde(rename = "@canReturnEarlyAfterIntermediateUpdate")] can_return_early: bool,
        #[serde(rename = "@hasEventMode")] event_mode: bool,
        #[serde(rename = "@providesEvaluateDiscreteStates")] evaluate_discrete_states: bool,
    }
}
element! {
    /// Capabilities of scheduled execution.
    ScheduledExecution {
        #[serde(rename = "@modelIdentifier")] model_identifier: Text,
        #[serde(rename = "@needsExecutionTool")] needs_execution_tool: bool,
        #[serde(rename = "@canBeInstantiatedOnlyOncePerProcess")] only_once_per_process: bool,
        #[serde(rename = "@canGetAndSetFMUState")] can_get_and_set_state: bool,
        #[serde(rename = "@canSerializeFMUState")] can_serialize_state: bool,
        #[serde(rename = "@providesDirectionalDerivatives")] directional_derivatives: bool,
        #[serde(rename = "@providesAdjointDerivatives")] adjoint_derivatives: bool,
        #[serde(rename = "@providesPerElementDependencies")] per_element_dependencies: bool,
    }
}
element! {
    /// Enumeration types.
    TypeDefinitions { #[serde(rename = "EnumerationType")] list: Vec<EnumerationType> }
}
element! {
    /// One enumeration type.
    EnumerationType {
        #[serde(rename = "@name")] name: Text,
        #[serde(rename = "@description")] description: Text,
        #[serde(rename = "Item")] items: Vec<Item>,
    }
}
element! {
    /// Variables.
    ModelVariables { #[serde(rename = "$value")] list: Vec<Variable> }
}

/// One variable: the element says its type.
#[derive(Clone, Debug, Serialize)]
#[allow(missing_docs, reason = "named as in the XSD")]
pub enum Variable {
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
    Clock(Attributes),
}

element! {
    /// Attributes and elements of a variable; each type uses those that it has.
    Attributes {
        #[serde(rename = "@name")] name: Text,
        #[serde(rename = "@valueReference")] value_reference: u32,
        #[serde(rename = "@description")] description: Text,
        #[serde(rename = "@causality")] causality: Text,
        #[serde(rename = "@variability")] variability: Text,
        #[serde(rename = "@clocks", skip_serializing_if = "Option::is_none")] clocks: Option<u32>,
        #[serde(rename = "@declaredType", skip_serializing_if = "Option::is_none")] declared_type: Optional,
        #[serde(rename = "@initial", skip_serializing_if = "Option::is_none")] initial: Optional,
        #[serde(rename = "@unit", skip_serializing_if = "Option::is_none")] unit: Optional,
        #[serde(rename = "@displayUnit", skip_serializing_if = "Option::is_none")] display_unit: Optional,
        #[serde(rename = "@min", skip_serializing_if = "Option::is_none")] min: Optional,
        #[serde(rename = "@max", skip_serializing_if = "Option::is_none")] max: Optional,
        #[serde(rename = "@start", skip_serializing_if = "Option::is_none")] start: Optional,
        #[serde(rename = "@mimeType", skip_serializing_if = "Option::is_none")] mime_type: Optional,
        #[serde(rename = "@maxSize", skip_serializing_if = "Option::is_none")] max_size: Option<usize>,
        #[serde(rename = "@priority", skip_serializing_if = "Option::is_none")] priority: Option<u32>,
        #[serde(rename = "@intervalVariability", skip_serializing_if = "Option::is_none")] interval_variability: Optional,
        #[serde(rename = "@intervalDecimal", skip_serializing_if = "Option::is_none")] interval: Optional,
        #[serde(rename = "Dimension", skip_serializing_if = "Option::is_none")] dimension: Option<Dimension>,
        #[serde(rename = "Start", skip_serializing_if = "Vec::is_empty")] starts: Vec<Start>,
    }
}
element! {
    /// The length of an array.
    Dimension { #[serde(rename = "@start")] start: usize }
}
element! {
    /// The start value of a String, or of a Binary in hexadecimal digits.
    Start { #[serde(rename = "@value")] value: Text }
}
element! {
    /// Which variable depends on which.
    ModelStructure {
        #[serde(rename = "Output", skip_serializing_if = "Vec::is_empty")] outputs: Vec<Unknown>,
        #[serde(rename = "InitialUnknown", skip_serializing_if = "Vec::is_empty")] initial_unknowns: Vec<Unknown>,
    }
}
element! {
    /// One unknown, and the value references that it depends on: an empty list is none, no list all.
    Unknown {
        #[serde(rename = "@valueReference")] value_reference: u32,
        #[serde(rename = "@dependencies", skip_serializing_if = "Option::is_none")] dependencies: Optional,
        #[serde(rename = "@dependenciesKind", skip_serializing_if = "Option::is_none")] dependencies_kind: Optional,
    }
}
