//! No NaN and no infinity may leave a model, but for NaN where a row says so (a sensor's failure); and no more bytes than a row
//! says.

use crate::model::Model;
use crate::value::{Value as _, behind};
use fmu_declaration::place::Finite;
use fmu_declaration::{Access, Place, Variable};

/// What is looked at of the values that a model computes: its Reals, found once and not row by row, and its Binaries.
pub(crate) struct Outputs<M: Model> {
    finite: Finite<M>,
    may_be_nan: Vec<Place<M, f64>>,
    binaries: Vec<&'static Variable<M>>,
}

impl<M: Model> Outputs<M> {
    /// Those of the model's rows.
    pub(crate) fn new() -> Self {
        Self {
            finite: Finite::new(reals(false)),
            may_be_nan: reals(true).collect(),
            binaries: M::DESCRIPTION
                .variables
                .iter()
                .filter(|row| row.is_calculated() && matches!(row.access, Access::Binary { .. }))
                .collect(),
        }
    }

    /// Whether all values in `model` may leave it.
    ///
    /// # Errors
    /// The first that may not, with its name and unit.
    #[inline]
    pub(crate) fn check(&self, model: &M) -> Result<(), String> {
        if !self.finite.is_met(model) {
            return Err(refused(model));
        }
        if self.may_be_nan.is_empty() && self.binaries.is_empty() {
            return Ok(());
        }
        self.check_seldom(model)
    }

    /// What most models do not have.
    #[inline(never)]
    fn check_seldom(&self, model: &M) -> Result<(), String> {
        let mut readings = self.may_be_nan.iter().flat_map(|place| place.values(model));
        if readings.any(f64::is_infinite) {
            return Err(refused(model));
        }
        let objection = |row: &&Variable<M>| {
            (0..row.len).find_map(|i| {
                let objection = row.value::<Vec<u8>>(model, i)?.objection(row)?;
                Some(format!("{} {objection}", row.element_name(i)))
            })
        };
        self.binaries.iter().find_map(objection).map_or(Ok(()), Err)
    }
}

/// The places of the calculated Reals that may be NaN, or of the others.
fn reals<M: Model>(may_be_nan: bool) -> impl Iterator<Item = Place<M, f64>> {
    M::DESCRIPTION
        .variables
        .iter()
        .filter(move |row| row.is_calculated() && row.may_be_nan == may_be_nan)
        .filter_map(|row| match row.access {
            Access::Real { at, .. } => Some(at),
            _ => None,
        })
}

/// What is wrong with a model's outputs.
#[cold]
fn refused<M: Model>(model: &M) -> String {
    let wrong = |row: &Variable<M>| {
        let (Access::Real { at, unit, .. }, true) = (&row.access, row.is_calculated()) else {
            return None;
        };
        let meant = |value: f64| value.is_finite() || (row.may_be_nan && value.is_nan());
        let (i, value) = at
            .values(model)
            .enumerate()
            .find(|(_, value)| !meant(*value))?;
        let name = row.element_name(i);
        Some(format!(
            "{name} = {value}{}, expected a finite value",
            behind(unit.name)
        ))
    };
    M::DESCRIPTION
        .variables
        .iter()
        .find_map(wrong)
        .unwrap_or_default()
}
