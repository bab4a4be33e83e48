//! An instance that the `fmi` crate made, by variable name.

use fmi::CS;
use fmi::fmi2::import::Fmi2Import;
use fmi::fmi2::instance::{CoSimulation as _, Common as _, Instance};
use fmi::schema::fmi2::{Causality, ScalarVariableElement};
use fmi::traits::FmiImport as _;
use std::path::Path;

/// Type of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    /// `<Real>`
    Real,
    /// `<Integer>`
    Integer,
    /// `<Boolean>`
    Boolean,
    /// `<String>`, `<Enumeration>`
    Other,
}

/// A variable as the importer read it.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Name.
    pub name: String,
    /// Value reference.
    pub reference: u32,
    /// `input`, `output`, …
    pub causality: Causality,
    /// Type.
    pub kind: Type,
}

/// The variables of a description, in its order.
pub fn variables(import: &Fmi2Import) -> Vec<Variable> {
    import
        .model_description()
        .get_model_variables()
        .map(|variable| Variable {
            name: variable.name.clone(),
            reference: variable.value_reference,
            causality: variable.causality.clone(),
            kind: match variable.elem {
                ScalarVariableElement::Real(_) => Type::Real,
                ScalarVariableElement::Integer(_) => Type::Integer,
                ScalarVariableElement::Boolean(_) => Type::Boolean,
                _ => Type::Other,
            },
        })
        .collect()
}

/// Unpacks an archive and reads its description.
///
/// # Errors
/// What the importer says.
pub fn import(path: &Path) -> Result<Fmi2Import, String> {
    fmi::import::from_path(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// An instance of an FMU.
pub struct Imported {
    /// The instance, for calls that no method here makes.
    pub instance: Instance<CS>,
    /// Its variables.
    pub variables: Vec<Variable>,
    /// Its unpacked archive: removed with this value.
    _import: Fmi2Import,
}

impl Imported {
    /// Unpacks, loads and instantiates.
    ///
    /// # Errors
    /// What the importer says.
    pub fn open(path: &Path) -> Result<Self, String> {
        let import = import(path)?;
        let instance = import
            .instantiate_cs("one", false, false)
            .map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(Self {
            instance,
            variables: variables(&import),
            _import: import,
        })
    }

    /// A variable.
    ///
    /// # Errors
    /// Names it when there is none.
    pub fn variable(&self, name: &str) -> Result<&Variable, String> {
        self.variables
            .iter()
            .find(|variable| variable.name == name)
            .ok_or_else(|| format!("no variable {name}"))
    }

    /// Value reference of a variable.
    ///
    /// # Errors
    /// Names it when there is none.
    pub fn reference(&self, name: &str) -> Result<u32, String> {
        Ok(self.variable(name)?.reference)
    }

    /// Value references of the outputs of a type.
    pub fn outputs(&self, kind: Type) -> Vec<u32> {
        let outputs = self
            .variables
            .iter()
            .filter(|variable| variable.causality == Causality::Output && variable.kind == kind);
        outputs.map(|variable| variable.reference).collect()
    }

    /// Sets a variable of any type but String: an Integer gets the whole number, a Boolean whether it is not 0.
    ///
    /// # Errors
    /// Names variable and value when it is refused.
    pub fn set(&mut self, name: &str, value: f64) -> Result<(), String> {
        let Variable {
            reference, kind, ..
        } = *self.variable(name)?;
        let status = match kind {
            Type::Real => self.instance.set_real(&[reference], &[value]),
            Type::Integer if value.fract() == 0.0 => {
                self.instance.set_integer(&[reference], &[value as i32])
            }
            Type::Boolean => self
                .instance
                .set_boolean(&[reference], &[i32::from(value != 0.0)]),
            Type::Integer | Type::Other => {
                return Err(format!("{name}: {value} is not of its type"));
            }
        };
        status
            .map(|_| ())
            .map_err(|error| format!("{name} = {value}: {error:?}"))
    }

    /// Reads a variable of any type but String.
    ///
    /// # Errors
    /// Names the variable when it is refused.
    pub fn get(&mut self, name: &str) -> Result<f64, String> {
        let Variable {
            reference, kind, ..
        } = *self.variable(name)?;
        let (mut real, mut whole) = ([f64::NAN], [i32::MIN]);
        let status = match kind {
            Type::Real => self.instance.get_real(&[reference], &mut real),
            Type::Integer => self.instance.get_integer(&[reference], &mut whole),
            Type::Boolean => self.instance.get_boolean(&[reference], &mut whole),
            Type::Other => return Err(format!("{name} is no number")),
        };
        status.map_err(|error| format!("{name}: {error:?}"))?;
        Ok(if kind == Type::Real {
            real[0]
        } else {
            f64::from(whole[0])
        })
    }

    /// From *instantiated* through Initialization Mode, at time 0.
    ///
    /// # Errors
    /// Names the call that is refused.
    pub fn initialize(&mut self) -> Result<(), String> {
        self.initialize_until(None)
    }

    /// The same with a stop time (s).
    ///
    /// # Errors
    /// Names the call that is refused.
    pub fn initialize_until(&mut self, stop: Option<f64>) -> Result<(), String> {
        let failed = |what| move |error| format!("{what}: {error:?}");
        self.instance
            .setup_experiment(None, 0.0, stop)
            .map_err(failed("fmi2SetupExperiment"))?;
        self.instance
            .enter_initialization_mode()
            .map_err(failed("fmi2EnterInitializationMode"))?;
        self.instance
            .exit_initialization_mode()
            .map_err(failed("fmi2ExitInitializationMode"))?;
        Ok(())
    }

    /// One communication step.
    ///
    /// # Errors
    /// Names the step that is refused.
    pub fn step(&mut self, t: f64, h: f64) -> Result<(), String> {
        self.instance
            .do_step(t, h, true)
            .map(|_| ())
            .map_err(|error| format!("fmi2DoStep({t}, {h}): {error:?}"))
    }
}
