//! The model as a whole.

use crate::Variable;
use crate::variable::IN_ORDER;

/// How the model advances; decides the variability that its inputs and outputs declare and the step size advice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Stepping {
    /// Runs ticks of a sample period; between them outputs hold. `experiment.step` is the period.
    Sampled,
    /// Integrates to the exact end of every step.
    Exact,
}

/// Default experiment. All times in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
    /// The rows. Each bears a number, or none does: then its position is one. The number decides the value reference, so it
    /// stays when others come: append, never reorder. The XML has an [order](Self::in_order) of its own.
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
    /// Number of the row.
    pub row: u32,
    /// Element in the row, from 0.
    pub element: usize,
}

impl<M> Scalar<M> {
    /// Name, with `[i]` replaced by the element's number, from 1.
    #[cfg(feature = "std")]
    pub fn name(&self) -> String {
        self.variable.element_name(self.element)
    }

    /// Value reference.
    pub fn reference(&self) -> u32 {
        self.row * SCALARS_PER_ROW + self.element as u32
    }
}

impl<M> Description<M> {
    /// Row and element of a value reference; `None` when nothing stands there.
    #[inline]
    pub fn find(&self, reference: u32) -> Option<(&'static Variable<M>, usize)> {
        let number = reference / SCALARS_PER_ROW;
        let element = (reference % SCALARS_PER_ROW) as usize;
        // Without gaps in the numbers a row stands at its own.
        let variable = match self.variables.get(number as usize) {
            Some(variable) if [number, IN_ORDER].contains(&variable.number) => variable,
            _ => {
                let found = self
                    .variables
                    .binary_search_by_key(&number, |row| row.number);
                self.variables.get(found.ok()?)?
            }
        };
        (element < variable.len).then_some((variable, element))
    }

    /// All scalars, in the order of the rows.
    pub fn scalars(&self) -> impl Iterator<Item = Scalar<M>> + use<M> {
        self.variables
            .iter()
            .zip(0..)
            .flat_map(|(variable, position)| {
                let row = if variable.number == IN_ORDER {
                    position
                } else {
                    variable.number
                };
                (0..variable.len).map(move |element| Scalar {
                    variable,
                    row,
                    element,
                })
            })
    }

    /// All scalars in the order of the XML, in which importers show them: by causality, then by group, then as the rows stand.
    /// A group is what bears one name before the first dot; what has no dot comes first.
    #[cfg(feature = "std")]
    pub fn in_order(&self) -> Vec<Scalar<M>> {
        let mut groups = vec![String::new()];
        let mut sorted: Vec<_> = self
            .scalars()
            .map(|scalar| {
                let name = scalar.variable.full_name();
                let group = name.split_once('.').map_or("", |(group, _)| group);
                let known = groups.iter().position(|one| one == group);
                let group = known.unwrap_or_else(|| {
                    groups.push(group.to_owned());
                    groups.len() - 1
                });
                ((scalar.variable.causality.position(), group), scalar)
            })
            .collect();
        // Stable.
        sorted.sort_by_key(|(key, _)| *key);
        sorted.into_iter().map(|(_, scalar)| scalar).collect()
    }
}
