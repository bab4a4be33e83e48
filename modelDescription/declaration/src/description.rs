//! The model as a whole.

use crate::{Access, Variable, provenance};
use core::fmt::Write as _;

/// How the model advances; decides the variability that its inputs and outputs declare and the step size advice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stepping {
    /// Runs ticks of a sample period; between them outputs hold. `experiment.step` is the period.
    Sampled,
    /// Integrates to the exact end of every step.
    Exact,
}

/// Default experiment. All times in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Experiment {
    /// Start time.
    pub start: f64,
    /// Stop time.
    pub stop: f64,
    /// Relative tolerance (of no effect on a fixed-step model; importers warn when it is missing).
    pub tolerance: f64,
    /// Communication step size.
    pub step: f64,
}

/// A model's interface.
pub struct Description<M: 'static> {
    /// Model name and model identifier (a C identifier).
    pub name: &'static str,
    /// One sentence.
    pub about: &'static str,
    /// How it advances.
    pub stepping: Stepping,
    /// Default experiment.
    pub experiment: Experiment,
    /// The rows. Append, never reorder: a row's position is its value reference.
    pub variables: &'static [Variable<M>],
}

/// A model that declares its interface. Its start values are its [`Default`].
pub trait Declare: Default + 'static {
    /// The interface.
    const DESCRIPTION: Description<Self>;
}

/// Scalars per row in the value reference: `reference = SCALARS_PER_ROW · row + element`.
pub const SCALARS_PER_ROW: u32 = 256;

/// One scalar of the interface: a row and an element of it.
pub struct Scalar<M: 'static> {
    /// The row.
    pub variable: &'static Variable<M>,
    /// Position of the row, from 0.
    pub row: usize,
    /// Element in the row, from 0.
    pub element: usize,
}

impl<M> Scalar<M> {
    /// Name, with `[i]` replaced by the element's number, from 1.
    pub fn name(&self) -> String {
        self.variable.element_name(self.element)
    }

    /// Value reference.
    pub fn reference(&self) -> u32 {
        self.row as u32 * SCALARS_PER_ROW + self.element as u32
    }
}

impl<M> Description<M> {
    /// Row and element of a value reference; `None` when nothing stands there.
    pub fn find(&self, reference: u32) -> Option<(&'static Variable<M>, usize)> {
        let variable = self.variables.get((reference / SCALARS_PER_ROW) as usize)?;
        let element = (reference % SCALARS_PER_ROW) as usize;
        (element < variable.len).then_some((variable, element))
    }

    /// All scalars, in the order of the XML.
    pub fn scalars(&self) -> impl Iterator<Item = Scalar<M>> + use<M> {
        self.variables
            .iter()
            .enumerate()
            .flat_map(|(row, variable)| {
                (0..variable.len).map(move |element| Scalar {
                    variable,
                    row,
                    element,
                })
            })
    }
}

impl<M: Declare> Description<M> {
    /// The guid: a hash (UUID version 5) over everything an importer can rely on: names, value references, types,
    /// units, bounds, start values, causality, variability. Descriptions are left out.
    pub fn guid(&self) -> String {
        let mut start = M::default();
        let mut text = format!("{} {:?} {:?}\n", self.name, self.stepping, self.experiment);
        for scalar in self.scalars() {
            let (v, i) = (scalar.variable, scalar.element);
            let kind = match v.access {
                Access::Real { unit, min, max, at } => {
                    format!("{unit:?} {min} {max} {:?}", at(&mut start)[i])
                }
                Access::Integer { min, max, at } => {
                    format!("Integer {min} {max} {}", at(&mut start)[i])
                }
                Access::Boolean { at } => format!("Boolean {}", at(&mut start)[i]),
                Access::String { at } => format!("String {:?}", at(&mut start)[i]),
                Access::Enumeration { of, declared, at } => {
                    let items: Vec<_> = of
                        .items
                        .iter()
                        .map(|item| (item.value, item.name))
                        .collect();
                    format!("{declared:?} {} {items:?} {}", of.name, at(&mut start)[i])
                }
            };
            let nan = if v.may_be_nan { " or NaN" } else { "" };
            let _ = writeln!(
                text,
                "{} {} {:?} {:?} {:?} {kind}{nan}",
                scalar.reference(),
                scalar.name(),
                v.causality,
                v.variability,
                v.initially_from
            );
        }
        for one in provenance::ALL {
            let _ = writeln!(
                text,
                "{} {} fixed local String",
                one.reference(),
                one.name()
            );
        }
        uuid::Uuid::new_v5(&uuid::Uuid::NAMESPACE_OID, text.as_bytes())
            .braced()
            .to_string()
    }
}
