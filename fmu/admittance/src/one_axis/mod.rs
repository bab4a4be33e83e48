//! The complete law of one axis: from what is sensed at a tick to the force.
//!
//! It knows no FMI: the FMU TestbedController, in torque form, and the C library are shells around it.

pub mod parameters;
pub mod signals;

pub use parameters::{AxisParameters, Checked};
pub use signals::{AxisInputs, AxisOutputs};

use crate::origin::{Move, Origin};
use crate::{Admittance, Bounds, ParameterError, Real, Request};
use nalgebra::Vector1;

/// A tick whose result is not finite: an input was not, or numbers overflow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotFinite;

/// The law between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OneAxis {
    law: Admittance<1>,
    bounds: Bounds,
    counting: Origin<1>,
}

impl OneAxis {
    /// A law out of the loop.
    ///
    /// # Errors
    /// The first parameter out of its range, or a law that is a comparator.
    pub fn new(parameters: &AxisParameters) -> Result<Self, ParameterError> {
        let Checked {
            settings,
            gains,
            bounds,
            reach,
            f_rate,
        } = parameters.checked()?;
        let mut law = Admittance::new(settings, [gains])?
            .reaching(reach)?
            .rated(Vector1::new(f_rate))?;
        law.bound([bounds])?;
        Ok(Self {
            law,
            bounds,
            counting: Origin::default(),
        })
    }

    /// Other gains: on a straight line over the tuning time, each step taken over so that the stored energy does not rise. Of
    /// the parameters those that may be tuned count; the others are as they were when the law was built.
    ///
    /// # Errors
    /// The first gain out of its range; the gains stay as they were.
    pub fn tune(&mut self, parameters: &AxisParameters) -> Result<(), ParameterError> {
        self.law.tune([parameters.tuned()?])
    }

    /// One tick, whose results stand in `outputs`.
    ///
    /// # Errors
    /// [`NotFinite`]; law and outputs stay as they were before the tick.
    pub fn tick(
        &mut self,
        inputs: &AxisInputs,
        outputs: &mut AxisOutputs,
    ) -> Result<(), NotFinite> {
        let before = *self;
        let shown = self.shown(inputs).inspect_err(|NotFinite| *self = before)?;
        *outputs = shown;
        Ok(())
    }

    fn shown(&mut self, inputs: &AxisInputs) -> Result<AxisOutputs, NotFinite> {
        let engage = inputs.engage != 0;
        let q = Vector1::new(inputs.q);
        if let Some(Move { q_0, by }) = self.counting.moves(&q, engage) {
            let relative = Bounds {
                q_min: self.bounds.q_min - q_0.x,
                q_max: self.bounds.q_max - q_0.x,
                ..self.bounds
            };
            // Bounds that have been checked stay in order, but for an origin so far away that they round to one.
            self.law
                .count_from(&by, [relative])
                .map_err(|_| NotFinite)?;
        }
        let q = self.counting.counted(&q);
        let tick = if engage {
            let request = Request {
                hold: inputs.hold != 0,
                ..Request::default()
            };
            self.law.tick(&q, &Vector1::new(inputs.tau_h), &request)
        } else {
            self.law.rest(&q)
        };
        self.counting.ticked(tick.engaged);
        let ledger = self.law.ledger();
        let q_n = tick.q_n.x;
        let outputs = AxisOutputs {
            tau_a: tick.f.x,
            tau_demand: tick.f_demand.x,
            q_n: self.counting.place().map_or(q_n, |q_0| q_0.x as Real + q_n),
            dq_n: tick.dq_n.x,
            e_nr: tick.e_nr.x,
            dq: tick.dq.x,
            H: ledger.H(),
            G: ledger.G(),
            tank: ledger.tank(),
            share: tick.share,
            saturated: tick.saturated.into(),
            held: tick.held.into(),
            outside_bounds: tick.outside_bounds.into(),
            engaged: tick.engaged.into(),
            debt: ledger.is_in_debt().into(),
        };
        let numbers = [outputs.tau_demand, outputs.q_n, outputs.dq_n, outputs.G];
        if numbers.iter().all(|number| number.is_finite()) {
            Ok(outputs)
        } else {
            Err(NotFinite)
        }
    }
}
