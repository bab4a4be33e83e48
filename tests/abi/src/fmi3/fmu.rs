//! A built FMU with its rows, as FMI 3.0 has them: an array is one variable.

use super::instance::{Instance, Interface, Setup};
use super::library::Library;
use super::types::*;
use crate::fmu::directory;
use crate::{Kind, Variable};
use std::sync::Arc;

/// Type of a variable in FMI 3.0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    /// `<Float32>`
    Float32,
    /// `<Float64>`
    Float64,
    /// `<Int8>`
    Int8,
    /// `<UInt8>`
    UInt8,
    /// `<Int16>`
    Int16,
    /// `<UInt16>`
    UInt16,
    /// `<Int32>`
    Int32,
    /// `<UInt32>`
    UInt32,
    /// `<Int64>`
    Int64,
    /// `<UInt64>`
    UInt64,
    /// `<Enumeration>`, read and written as Int64
    Enumeration,
    /// `<Boolean>`
    Boolean,
    /// `<String>`
    Text,
    /// `<Binary>`
    Binary,
}

impl Type {
    /// All of them.
    pub const ALL: [Self; 14] = [
        Self::Float32,
        Self::Float64,
        Self::Int8,
        Self::UInt8,
        Self::Int16,
        Self::UInt16,
        Self::Int32,
        Self::UInt32,
        Self::Int64,
        Self::UInt64,
        Self::Enumeration,
        Self::Boolean,
        Self::Text,
        Self::Binary,
    ];

    /// Those that FMI 2.0 shows as a Real.
    pub const REALS: [Self; 2] = [Self::Float64, Self::Float32];

    /// Those that it shows as an Integer.
    pub const INTEGERS: [Self; 6] = [
        Self::Int32,
        Self::Enumeration,
        Self::Int8,
        Self::UInt8,
        Self::Int16,
        Self::UInt16,
    ];

    /// Whether both have the same functions: items are read and written as Int64.
    pub fn is_called_as(self, other: Self) -> bool {
        let called = |one| match one {
            Self::Enumeration => Self::Int64,
            one => one,
        };
        called(self) == called(other)
    }
}

/// One value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Float32 or Float64
    Number(f64),
    /// An integer of any size
    Integer(i128),
    /// Boolean, as a byte
    Truth(u8),
    /// String
    Text(String),
    /// Binary
    Bytes(Vec<u8>),
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
    /// only, and how large it is, the library says: `tests/fmi3_values.rs` holds that against the declarations.
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
        for row in &mut fmu.rows {
            let candidates: &[Type] = match row.kind {
                Type::Float64 => &Type::REALS,
                Type::Int32 => &Type::INTEGERS,
                _ => continue,
            };
            let is = |kind: &&Type| {
                let row = Row {
                    kind: **kind,
                    ..row.clone()
                };
                asked.read(&row).is_ok()
            };
            let found = candidates.iter().find(is);
            row.kind = *found.unwrap_or_else(|| panic!("{}: of no type", row.name));
        }
        fmu
    }

    /// The test model with the types of numbers that both versions have.
    pub fn narrow() -> Self {
        Self::new(crate::Fmu::open_in(&directory().join("test"), "narrow"))
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
