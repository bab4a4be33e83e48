//! The complete law of one axis: from what is sensed at a tick to the force.
//!
//! It knows no FMI: the FMU TestbedController and the C library are shells around it.

pub mod form;
pub mod parameters;
pub mod signals;

pub use parameters::{AxisParameters, Checked};
pub use signals::{AxisInputs, AxisOutputs};

use crate::encoder::{Believed, Encoders, Fault, Positions};
use crate::origin::{Move, Origin};
use crate::servo;
use crate::tick::{Refused, Tick};
use crate::{Bounds, ParameterError, Real, Request, timing};
use form::{Came, InForm, Sensed};
use nalgebra::Vector1;

/// A tick whose result is not finite: an input was not, or numbers overflow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotFinite;

/// The law between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OneAxis {
    law: InForm,
    bounds: Bounds,
    counting: Origin<1>,
    encoder: Encoders<1>,
    /// the last position that was believed, m, as it is counted
    q: Vector1<Real>,
}

impl OneAxis {
    /// A law out of the loop.
    ///
    /// # Errors
    /// The first parameter out of its range, or a law that is a comparator.
    pub fn new(parameters: &AxisParameters) -> Result<Self, ParameterError> {
        let checked = parameters.checked()?;
        Ok(Self {
            law: InForm::new(&checked, parameters)?,
            bounds: checked.bounds,
            counting: Origin::default(),
            encoder: checked.encoder,
            q: Vector1::zeros(),
        })
    }

    /// Other gains: on a straight line over the tuning time, each step taken over so that the stored energy does not rise. Of
    /// the parameters those that may be tuned count; the others are as they were when the law was built.
    ///
    /// # Errors
    /// The first gain out of its range; the gains stay as they were.
    pub fn tune(&mut self, parameters: &AxisParameters) -> Result<(), ParameterError> {
        self.law.tune(parameters.tuned()?)
    }

    /// One tick with a position that was read for it; its results stand in `outputs`.
    ///
    /// # Errors
    /// [`NotFinite`]; law and outputs stay as they were before the tick.
    pub fn tick(
        &mut self,
        inputs: &AxisInputs,
        outputs: &mut AxisOutputs,
    ) -> Result<(), NotFinite> {
        self.tick_after(1.0, inputs, outputs)
    }

    /// The same with a position that was read `after` sample periods after the one before it: 1 where the tick is in time. Any
    /// number that is not negative will do; the velocity is that over this time.
    ///
    /// # Errors
    /// Those of [`tick`](Self::tick).
    pub fn tick_after(
        &mut self,
        after: Real,
        inputs: &AxisInputs,
        outputs: &mut AxisOutputs,
    ) -> Result<(), NotFinite> {
        let reading = Positions {
            q: Vector1::new(inputs.q),
            valid: inputs.encoder_valid != 0,
            after,
        };
        if self.encoder.is_sound(&reading) {
            self.tick_at(&reading.believed(), after, inputs, outputs)?;
            self.encoder.keep(&reading);
        } else {
            let mut encoder = self.encoder;
            let believed = encoder.read(&reading, self.counting.is_engaged(), self.law.f());
            self.tick_at(&believed, after, inputs, outputs)?;
            self.encoder = encoder;
        }
        outputs.timing = timing::of(after);
        Ok(())
    }

    /// Sample period, s.
    pub fn T(&self) -> Real {
        self.law.T()
    }

    /// A force begins to act this `part` of a sample after its tick, in (0, 1), in place of a whole one: [`acts`](Self::acts)
    /// says where. Only with a delay.
    pub fn lag(&mut self, part: Real) {
        self.law.lag(part);
    }

    /// The force of the last tick begins to act now, at the position `q` (m) of the inputs.
    pub fn acts(&mut self, inputs: &AxisInputs) {
        let q = Vector1::new(inputs.q);
        let is_known = inputs.encoder_valid != 0 && self.encoder.is_near(&q);
        let q = self.counting.counted(&q);
        self.law.acts(is_known.then_some(&q));
    }

    /// One tick with what is `believed` of the position.
    #[inline]
    fn tick_at(
        &mut self,
        believed: &Believed<1>,
        after: Real,
        inputs: &AxisInputs,
        outputs: &mut AxisOutputs,
    ) -> Result<(), NotFinite> {
        let engage = inputs.engage != 0;
        let moves = believed
            .q
            .is_some_and(|q| self.counting.would_move(&q, engage));
        if moves {
            // Seldom, and in single precision only: a tick that is refused leaves the origin where it was, too.
            let mut law = *self;
            law.tick_believing(believed, after, inputs, outputs)?;
            *self = law;
            Ok(())
        } else {
            self.tick_believing(believed, after, inputs, outputs)
        }
    }

    fn tick_believing(
        &mut self,
        believed: &Believed<1>,
        after: Real,
        inputs: &AxisInputs,
        outputs: &mut AxisOutputs,
    ) -> Result<(), NotFinite> {
        let engage = inputs.engage != 0 && believed.q.is_some();
        let q = believed.q.map(|q| self.counted(q.x, engage)).transpose()?;
        let place = self.counting.place().map(|q_0| q_0.x as Real);
        let q_n = |tick: &Tick<1>| place.map_or(tick.q_n.x, |q_0| q_0 + tick.q_n.x);
        let origin = self.counting.place().map_or(0.0, |q_0| q_0.x);
        let q_d = |q_d: Real| origin + Vector1::new(q_d).cast::<f64>().x;
        let finite = |(tick, q_d, dq_d): Came<'_>, G: Real| {
            let numbers = [tick.f_demand.x, q_n(tick), tick.dq_n.x, q_d, dq_d, G];
            numbers.iter().all(|number| number.is_finite())
        };
        let sensed = Sensed {
            tau_h: Vector1::new(inputs.tau_h),
            tau_m: Vector1::new(inputs.tau_a_measured),
        };
        match q {
            None if believed.fault == Some(Fault::NotFinite) => return Err(NotFinite),
            None => {
                let tick = self.law.abandon(&self.q, &sensed);
                show(&tick, q_n(&tick), outputs);
                (outputs.q_d, outputs.dq_d) = (q_d(tick.q_n.x), 0.0);
            }
            Some(q) if engage => {
                let request = Request {
                    hold: inputs.hold != 0,
                    after,
                    ..Request::default()
                };
                let accept = |came: Came<'_>, G| {
                    let accepted = finite(came, G);
                    if accepted {
                        let (tick, position, velocity) = came;
                        show(tick, q_n(tick), outputs);
                        (outputs.q_d, outputs.dq_d) = (q_d(position), velocity);
                    }
                    accepted
                };
                self.law
                    .tick(&q, &sensed, &request, accept)
                    .map_err(|Refused| NotFinite)?;
            }
            Some(q) => {
                let at_rest = Tick::at_rest(&q);
                let accept = |G| finite((&at_rest, q.x, 0.0), G);
                let tick = self
                    .law
                    .rest(&q, &sensed, accept)
                    .map_err(|Refused| NotFinite)?;
                show(&tick, q_n(&tick), outputs);
                (outputs.q_d, outputs.dq_d) = (q_d(tick.q_n.x), 0.0);
            }
        }
        if believed.doubted {
            outputs.outside_bounds = 1;
        }
        outputs.encoder_fault = believed.fault.map_or(0, Fault::number);
        self.q = q.unwrap_or(self.q);
        self.counting.ticked(engage);
        let ledger = self.law.ledger();
        outputs.H = ledger.H();
        outputs.G = ledger.G();
        outputs.tank = ledger.tank();
        outputs.debt = ledger.is_in_debt().into();
        outputs.drive_fault = self.law.drive_fault().map_or(0, servo::Fault::number);
        Ok(())
    }

    /// The position `q` (m) from where it is counted.
    fn counted(&mut self, q: f64, engage: bool) -> Result<Vector1<Real>, NotFinite> {
        let q = Vector1::new(q);
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
            self.q -= by;
        }
        Ok(self.counting.counted(&q))
    }
}

/// What a tick shows, but for the energy.
fn show(tick: &Tick<1>, q_n: Real, outputs: &mut AxisOutputs) {
    outputs.tau_a = tick.f.x;
    outputs.tau_demand = tick.f_demand.x;
    outputs.q_n = q_n;
    outputs.dq_n = tick.dq_n.x;
    outputs.e_nr = tick.e_nr.x;
    outputs.dq = tick.dq.x;
    outputs.share = tick.share;
    outputs.saturated = tick.saturated.into();
    outputs.held = tick.held.into();
    outputs.outside_bounds = tick.outside_bounds.into();
    outputs.engaged = tick.engaged.into();
}
