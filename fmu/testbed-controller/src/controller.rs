//! One of the controllers that the model offers, behind one tick.

use crate::rows::Comparator;
use admittance::one_axis::{AxisInputs, AxisOutputs, AxisParameters, Checked, NotFinite, OneAxis};
use admittance::{Law, Natural, ParameterError, SlidingMode, comparator};
use serde::{Deserialize, Serialize};

/// The controller between two ticks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[allow(
    clippy::large_enum_variant,
    reason = "one of them, once: a box would cost more than it saves"
)]
pub enum Controller {
    /// One of the four laws, in either form.
    Law(OneAxis),
    /// The comparator `natural`.
    Natural(Natural),
    /// The comparator `sliding_mode`.
    SlidingMode(SlidingMode),
}

impl Controller {
    /// Out of the loop.
    ///
    /// # Errors
    /// The first parameter out of its range, or a law that does not exist in this form.
    pub fn new(
        parameters: &AxisParameters,
        comparator: &Comparator,
    ) -> Result<Self, ParameterError> {
        let Checked {
            settings, gains, ..
        } = parameters.checked()?;
        let row = settings.law.row();
        if !row.offered {
            check_no_limits(parameters)?;
        }
        Ok(match settings.law {
            Law::Natural => Self::Natural(Natural::new(settings, gains, comparator.M)?),
            Law::SlidingMode => Self::SlidingMode(SlidingMode::new(settings, gains, comparator.H)?),
            Law::Standard | Law::Passive | Law::PassiveApplied | Law::PassiveBounded => {
                Self::Law(OneAxis::new(parameters)?)
            }
        })
    }

    /// Other gains from the next tick on.
    ///
    /// # Errors
    /// The first one that is refused; the gains stay as they were.
    pub fn tune(&mut self, parameters: &AxisParameters) -> Result<(), ParameterError> {
        match self {
            Self::Law(law) => law.tune(parameters),
            Self::Natural(natural) => natural.tune(parameters.tuned()?),
            Self::SlidingMode(sliding_mode) => sliding_mode.tune(parameters.tuned()?),
        }
    }

    /// A force begins to act this `part` of a sample after its tick, in place of a whole one: [`acts`](Self::acts) says where.
    /// Only with a delay.
    pub fn lag(&mut self, part: f64) {
        if let Self::Law(law) = self {
            law.lag(part);
        }
    }

    /// The force of the last tick begins to act now, at the position of the inputs.
    pub fn acts(&mut self, inputs: &AxisInputs) {
        if let Self::Law(law) = self {
            law.acts(inputs);
        }
    }

    /// One tick, in the loop or out of it, with a position that was read `after` sample periods after the one before; what
    /// came of it stands in `outputs`.
    ///
    /// # Errors
    /// [`NotFinite`].
    pub fn tick(
        &mut self,
        inputs: &AxisInputs,
        after: f64,
        outputs: &mut AxisOutputs,
    ) -> Result<(), NotFinite> {
        let AxisInputs {
            q, tau_h, engage, ..
        } = *inputs;
        let engage = engage != 0;
        match self {
            Self::Law(law) => return law.tick_after(after, inputs, outputs),
            Self::Natural(natural) => {
                let tick = if engage {
                    natural.step(q, tau_h)
                } else {
                    natural.rest(q)
                };
                *outputs = compared(&tick, engage);
            }
            Self::SlidingMode(sliding_mode) => {
                let tick = if engage {
                    sliding_mode.step(q, tau_h)
                } else {
                    sliding_mode.rest(q)
                };
                *outputs = compared(&tick, engage);
            }
        }
        let numbers = [outputs.tau_demand, outputs.q_n, outputs.dq_n];
        let finite = numbers.iter().all(|number| number.is_finite());
        finite.then_some(()).ok_or(NotFinite)
    }
}

/// Comparators do not keep limits: none may be set.
fn check_no_limits(parameters: &AxisParameters) -> Result<(), ParameterError> {
    let boxed = parameters.q_n_box != 0;
    for (name, value, is_set) in [
        ("dq_n_max", parameters.dq_n_max, parameters.dq_n_max != 0.0),
        ("q_n_min", parameters.q_n_min, boxed),
        (
            "tau_rate_max",
            parameters.tau_rate_max,
            parameters.tau_rate_max != 0.0,
        ),
    ] {
        if is_set {
            let expected = "no limit, which the laws 1 to 4 in torque form alone keep";
            return Err(ParameterError::of(name, None, value, expected));
        }
    }
    Ok(())
}

/// What a comparator shows. It has no storage and no tank: H, G and the tank are 0.
fn compared(tick: &comparator::ComparatorTick, engaged: bool) -> AxisOutputs {
    AxisOutputs {
        tau_a: tick.f,
        tau_demand: tick.f_demand,
        q_n: tick.q_n,
        dq_n: tick.dq_n,
        q_d: tick.q_n,
        dq_d: tick.dq_n,
        e_nr: tick.e_nr,
        dq: tick.dq,
        tank: 0.0,
        saturated: tick.is_saturated().into(),
        engaged: engaged.into(),
        ..AxisOutputs::default()
    }
}
