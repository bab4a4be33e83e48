//! The elements of `modelDescription.xml` that we write, in the order of the FMI 2.0 XSD. Attributes start with `@`. What FMI 3.0
//! has otherwise is in [`schema3`](crate::schema3).

use serde::Serialize;

type Text = String;
type Optional = Option<String>;

macro_rules! element {
    ($(#[$meta:meta])* $element:ident { $($(#[$field_meta:meta])* $field:ident: $type:ty),* $(,)? }) => {
        #[derive(Clone, Debug, Default, Serialize)]
        $(#[$meta])*
        pub struct $element { $($(#[$field_meta])* #[allow(missing_docs, reason = "named as in the XSD")] pub $field: $type),* }
    };
}
pub(crate) use element;

element! {
    /// The root.
    #[serde(rename = "fmiModelDescription")]
    Root {
        #[serde(rename = "@fmiVersion")] fmi_version: Text,
        #[serde(rename = "@modelName")] model_name: Text,
        #[serde(rename = "@guid")] guid: Text,
        #[serde(rename = "@description")] description: Text,
        #[serde(rename = "@author", skip_serializing_if = "Option::is_none")] author: Optional,
        #[serde(rename = "@version", skip_serializing_if = "Option::is_none")] version: Optional,
        #[serde(rename = "@copyright", skip_serializing_if = "Option::is_none")] copyright: Optional,
        #[serde(rename = "@license", skip_serializing_if = "Option::is_none")] license: Optional,
        #[serde(rename = "@generationTool")] generation_tool: Text,
        #[serde(rename = "@variableNamingConvention")] variable_naming_convention: Text,
        #[serde(rename = "CoSimulation")] co_simulation: CoSimulation,
        #[serde(rename = "UnitDefinitions", skip_serializing_if = "Option::is_none")] units: Option<UnitDefinitions>,
        #[serde(rename = "TypeDefinitions", skip_serializing_if = "Option::is_none")] types: Option<TypeDefinitions>,
        #[serde(rename = "LogCategories")] log: LogCategories,
        #[serde(rename = "DefaultExperiment")] experiment: DefaultExperiment,
        #[serde(rename = "ModelVariables")] variables: ModelVariables,
        #[serde(rename = "ModelStructure")] structure: ModelStructure,
    }
}
element! {
    /// Capabilities.
    CoSimulation {
        #[serde(rename = "@modelIdentifier")] model_identifier: Text,
        #[serde(rename = "@needsExecutionTool")] needs_execution_tool: bool,
        #[serde(rename = "@canHandleVariableCommunicationStepSize")] can_handle_variable_step: bool,
        #[serde(rename = "@canInterpolateInputs")] can_interpolate_inputs: bool,
        #[serde(rename = "@maxOutputDerivativeOrder")] max_output_derivative_order: u32,
        // Spelt as in the standard.
        #[serde(rename = "@canRunAsynchronuously")] can_run_asynchronously: bool,
        #[serde(rename = "@canBeInstantiatedOnlyOncePerProcess")] only_once_per_process: bool,
        #[serde(rename = "@canNotUseMemoryManagementFunctions")] own_memory: bool,
        #[serde(rename = "@canGetAndSetFMUstate")] can_get_and_set_state: bool,
        #[serde(rename = "@canSerializeFMUstate")] can_serialize_state: bool,
        #[serde(rename = "@providesDirectionalDerivative")] directional_derivative: bool,
    }
}
element! {
    /// Units.
    UnitDefinitions { #[serde(rename = "Unit")] list: Vec<Unit> }
}
element! {
    /// One unit.
    Unit {
        #[serde(rename = "@name")] name: Text,
        #[serde(rename = "BaseUnit")] base: BaseUnit,
        #[serde(rename = "DisplayUnit", skip_serializing_if = "Option::is_none")] display: Option<DisplayUnit>,
    }
}
element! {
    /// SI exponents other than 0; factor 1 and offset 0.
    BaseUnit {
        #[serde(rename = "@kg", skip_serializing_if = "Option::is_none")] kg: Option<i8>,
        #[serde(rename = "@m", skip_serializing_if = "Option::is_none")] m: Option<i8>,
        #[serde(rename = "@s", skip_serializing_if = "Option::is_none")] s: Option<i8>,
        #[serde(rename = "@A", skip_serializing_if = "Option::is_none")] ampere: Option<i8>,
        #[serde(rename = "@K", skip_serializing_if = "Option::is_none")] kelvin: Option<i8>,
        #[serde(rename = "@mol", skip_serializing_if = "Option::is_none")] mol: Option<i8>,
        #[serde(rename = "@cd", skip_serializing_if = "Option::is_none")] cd: Option<i8>,
        #[serde(rename = "@rad", skip_serializing_if = "Option::is_none")] rad: Option<i8>,
    }
}
element! {
    /// A unit for display: display value = factor · value + offset.
    DisplayUnit {
        #[serde(rename = "@name")] name: Text,
        #[serde(rename = "@factor")] factor: Text,
        #[serde(rename = "@offset", skip_serializing_if = "Option::is_none")] offset: Optional,
    }
}
element! {
    /// Enumeration types.
    TypeDefinitions { #[serde(rename = "SimpleType")] list: Vec<SimpleType> }
}
element! {
    /// One enumeration type.
    SimpleType {
        #[serde(rename = "@name")] name: Text,
        #[serde(rename = "@description")] description: Text,
        #[serde(rename = "Enumeration")] enumeration: Items,
    }
}
element! {
    /// Items of an enumeration type.
    Items { #[serde(rename = "Item")] list: Vec<Item> }
}
element! {
    /// One item.
    Item {
        #[serde(rename = "@name")] name: Text,
        #[serde(rename = "@value")] value: i32,
        #[serde(rename = "@description")] description: Text,
    }
}
element! {
    /// Log categories.
    LogCategories { #[serde(rename = "Category")] list: Vec<Category> }
}
element! {
    /// One log category.
    Category {
        #[serde(rename = "@name")] name: Text,
        #[serde(rename = "@description")] description: Text,
    }
}
element! {
    /// Default experiment.
    DefaultExperiment {
        #[serde(rename = "@startTime")] start_time: Text,
        #[serde(rename = "@stopTime")] stop_time: Text,
        #[serde(rename = "@tolerance")] tolerance: Text,
        #[serde(rename = "@stepSize")] step_size: Text,
    }
}
element! {
    /// Variables.
    ModelVariables { #[serde(rename = "ScalarVariable")] list: Vec<ScalarVariable> }
}
element! {
    /// One variable.
    ScalarVariable {
        #[serde(rename = "@name")] name: Text,
        #[serde(rename = "@valueReference")] value_reference: u32,
        #[serde(rename = "@description")] description: Text,
        #[serde(rename = "@causality")] causality: Text,
        #[serde(rename = "@variability")] variability: Text,
        #[serde(rename = "@initial", skip_serializing_if = "Option::is_none")] initial: Optional,
        #[serde(rename = "$value")] kind: Kind,
    }
}

/// The element inside a variable that says its type.
#[derive(Clone, Debug, Serialize)]
#[allow(missing_docs, reason = "named as in the XSD")]
pub enum Kind {
    Real(Attributes),
    Integer(Attributes),
    Boolean(Attributes),
    String(Attributes),
    Enumeration(Attributes),
}

impl Default for Kind {
    fn default() -> Self {
        Self::Real(Attributes::default())
    }
}

element! {
    /// Attributes of the type; each type uses those that it has.
    Attributes {
        #[serde(rename = "@declaredType", skip_serializing_if = "Option::is_none")] declared_type: Optional,
        #[serde(rename = "@unit", skip_serializing_if = "Option::is_none")] unit: Optional,
        #[serde(rename = "@displayUnit", skip_serializing_if = "Option::is_none")] display_unit: Optional,
        #[serde(rename = "@min", skip_serializing_if = "Option::is_none")] min: Optional,
        #[serde(rename = "@max", skip_serializing_if = "Option::is_none")] max: Optional,
        #[serde(rename = "@start", skip_serializing_if = "Option::is_none")] start: Optional,
    }
}
element! {
    /// Which variable depends on which.
    ModelStructure {
        #[serde(rename = "Outputs", skip_serializing_if = "Option::is_none")] outputs: Option<Unknowns>,
        #[serde(rename = "InitialUnknowns", skip_serializing_if = "Option::is_none")] initial_unknowns: Option<Unknowns>,
    }
}
element! {
    /// A list of unknowns.
    Unknowns { #[serde(rename = "Unknown")] list: Vec<Unknown> }
}
element! {
    /// One unknown: its position from 1, and the positions it depends on (an empty list: on none).
    Unknown {
        #[serde(rename = "@index")] index: usize,
        #[serde(rename = "@dependencies")] dependencies: Text,
        #[serde(rename = "@dependenciesKind", skip_serializing_if = "Option::is_none")] dependencies_kind: Optional,
    }
}
