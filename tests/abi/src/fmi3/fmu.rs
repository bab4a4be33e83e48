//! A built FMU with its rows, as FMI 3.0 has them: an array is one variable.

use super::instance::{Instance, Interface, Setup};
use super::library::Library;
use super::types::*;
use crate::{Kind, Variable};
use std::sync::Arc;

/// Type of a variable in FMI 3.0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    /// `<Float64>`
    Float64,
    /// `<Int32>`
    Int32,
    /// `<Enumeration>`, read and written as Int64
    Enumeration,
    /// `<Boolean>`
    Boolean,
    /// `<String>`
    Text,
}

/// One value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Float64
    Number(f64),
    /// Int32 or Int64
    Integer(i64),
    /// Boolean, as a byte
    Truth(u8),
    /// String
    Text(String),
}

/// A variable of FMI 3.0: a scalar, or an array whose elements FMI 2.0 has as scalars.
#[derive(Clone, Debug)]
pub struct Row {
    /// Name, without `[1]`.
    pub name: String,
    /// Value reference: that of the first element in FMI 2.0.
    pub reference: Reference,
    /// Type.
    pub kind: Type,
    /// Its elements in FMI 2.0, in order.
    pub elements: Vec<Variable>,
}

impl Row {
    /// Causality.
    pub fn causality(&self) -> &str {
        &self.elements[0].causality
    }

    /// Variability.
    pub fn variability(&self) -> &str {
        &self.elements[0].variability
    }

    /// How many values it has.
    #[allow(clippy::len_without_is_empty, reason = "a row has a value")]
    pub fn len(&self) -> usize {
        self.elements.len()
    }
}

/// A loaded FMU.
pub struct Fmu {
    /// The same by FMI 2.0.
    pub fmi2: crate::Fmu,
    /// Its variables.
    pub rows: Vec<Row>,
    /// The shared library.
    pub library: Arc<Library>,
}

/// Scalars that a row has in the value references of FMI 2.0.
const PER_ROW: Reference = 256;

impl Fmu {
    /// With the rows of the FMU's description for FMI 2.0. Whether an Integer is one of items, which FMI 2.0 has as text
    /// only, the library says: `tests/fmi3_values.rs` holds that against the declarations.
    pub fn new(fmi2: crate::Fmu) -> Self {
        let library = Arc::new(Library::load(&fmi2.path));
        let mut rows: Vec<Row> = Vec::new();
        for variable in &fmi2.variables {
            let provenance = ["version", "git_hash"].contains(&variable.name.as_str());
            let number = variable.reference / PER_ROW;
            let same = |row: &&mut Row| row.reference / PER_ROW == number && !provenance;
            match rows.iter_mut().find(same) {
                Some(row) => row.elements.push(variable.clone()),
                None => rows.push(Row {
                    name: String::new(),
                    reference: variable.reference,
                    kind: match variable.kind {
                        Kind::Real {} => Type::Float64,
                        Kind::Integer {} => Type::Int32,
                        Kind::Enumeration {} => Type::Enumeration,
                        Kind::Boolean {} => Type::Boolean,
                        Kind::String {} => Type::Text,
                    },
                    elements: vec![variable.clone()],
                }),
            }
        }
        for row in &mut rows {
            row.elements.sort_by_key(|element| element.reference);
            row.reference = row.elements[0].reference;
            let name = &row.elements[0].name;
            row.name = match row.len() {
                1 => name.clone(),
                _ => name.replace("[1]", ""),
            };
        }
        let mut fmu = Self {
            fmi2,
            rows,
            library,
        };
        let asked = fmu.instantiate();
        let items: Vec<_> = fmu
            .rows
            .iter()
            .map(|row| row.kind == Type::Int32 && asked.read(row).is_err())
            .collect();
        for (row, items) in fmu.rows.iter_mut().zip(items) {
            if items {
                row.kind = Type::Enumeration;
            }
        }
        fmu
    }

    /// The test model and the project's FMUs.
    pub fn all() -> Vec<Self> {
        crate::Fmu::all().into_iter().map(Self::new).collect()
    }

    /// Those with a sample period.
    pub fn sampled() -> Vec<Self> {
        ["TestbedController", "ArmController"]
            .map(|name| Self::new(crate::Fmu::open(name)))
            .into()
    }

    /// Model name.
    pub fn name(&self) -> &str {
        &self.fmi2.name
    }

    /// A row by its name.
    ///
    /// # Panics
    /// When there is none.
    pub fn row(&self, name: &str) -> &Row {
        let row = self.rows.iter().find(|row| row.name == name);
        row.unwrap_or_else(|| panic!("{} has no row {name}", self.name()))
    }

    /// What an ordinary importer passes: all logging on, no resources, co-simulation.
    pub fn setup(&self) -> Setup {
        Setup::new(self.name(), &self.fmi2.guid)
    }

    /// An instance of co-simulation with all logging on.
    ///
    /// # Panics
    /// When it is refused; the message has the log.
    pub fn instantiate(&self) -> Instance {
        self.instantiate_as(Interface::CoSimulation)
    }

    /// An instance with all logging on.
    ///
    /// # Panics
    /// When it is refused; the message has the log.
    pub fn instantiate_as(&self, interface: Interface) -> Instance {
        let setup = Setup {
            interface,
            ..self.setup()
        };
        Instance::new(&self.library, &setup)
            .unwrap_or_else(|log| panic!("{} refuses to be instantiated: {log:?}", self.name()))
    }
}
