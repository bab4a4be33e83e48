//! One axis: the law of TestbedController.fmu in torque form, for the four laws of the paper's family.

use crate::Real;
use crate::gains::{AxisGains, bounds, or_none};
use crate::origin::{Move, Origin};
use crate::pointer::{self, Cause, Place, initialize, read, refusing, with_law};
use crate::refusal::{Bad, Refusal, Status, truth};
use crate::storage::{Storage, fits};
use admittance::{Admittance, Bounds, Law, Reach, Request, Settings};
use nalgebra::Vector1;

/// Memory of one axis's law. Its content is the library's; it may be copied as bytes, to keep and restore a state.
#[repr(C)]
pub struct AxisState {
    words: [u64; 128],
}

// SAFETY: plain words, enough of them, aligned as the law.
unsafe impl Storage for AxisState {
    type Law = Axis;
    const MARK: u64 = 0x6578_6f5f_6178_6973; // "exo_axis"
}
const _: () = assert!(fits::<AxisState>());

/// Parameters of one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct AxisParameters {
    /// 1 standard, 2 passive, 3 passive_applied, 4 passive_bounded.
    pub law: i32,
    /// 0 or 1: samples after which the force reaches the robot.
    pub delay: i32,
    /// Whether the nominal keeps to q_n_min … q_n_max.
    pub q_n_box: i32,
    /// The gains to begin with.
    pub gains: AxisGains,
    /// Damper of the reaction on the nominal, N·s/m, ≥ 0; 1 is the paper.
    pub alpha: Real,
    /// Sample period, s.
    pub T: Real,
    /// Largest speed of the robot for which passivity is promised, m/s.
    pub v_max: Real,
    /// Largest acceleration of the robot for which passivity is promised, m/s².
    pub a_max: Real,
    /// Corner frequency of a low pass on the velocity, Hz; 0 = off.
    pub dq_cutoff: Real,
    /// Energy with which the tank starts and above which it does not fill, J.
    pub E_0: Real,
    /// Time that changed gains take to come into force, s.
    pub tuning_time: Real,
    /// Largest speed of the nominal, m/s; 0 = no limit.
    pub dq_n_max: Real,
    /// Least position of the nominal, m.
    pub q_n_min: Real,
    /// Largest position of the nominal, m.
    pub q_n_max: Real,
    /// Largest rate of change of the force, N/s; 0 = no limit.
    pub tau_rate_max: Real,
}

/// What is sensed and asked for at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct AxisInputs {
    /// Position, m.
    pub q: f64,
    /// Force of the human on the robot, N.
    pub tau_h: Real,
    /// Whether the law is to be in the loop.
    pub engage: i32,
    /// Whether the nominal is to stay where it is.
    pub hold: i32,
}

/// What came of a tick; every value is the one at t_k.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct AxisOutputs {
    /// Force on the robot, N, to be held until the next tick.
    pub tau_a: Real,
    /// The force before any limit, N.
    pub tau_demand: Real,
    /// Nominal position, m.
    pub q_n: Real,
    /// Nominal velocity, m/s.
    pub dq_n: Real,
    /// q_n − q, m.
    pub e_nr: Real,
    /// The robot's velocity as the law used it, m/s.
    pub dq: Real,
    /// Energy stored, J.
    pub H: Real,
    /// Energy created since the start, J; negative: dissipated.
    pub G: Real,
    /// What the energy tank holds, J.
    pub tank: Real,
    /// Share of the force that the energy budget left, in [0, 1].
    pub share: Real,
    /// Whether a limit leaves less than tau_demand.
    pub saturated: i32,
    /// Whether a limit of the nominal, or hold, kept it back.
    pub held: i32,
    /// Whether the robot moved faster than v_max and a_max allow.
    pub outside_bounds: i32,
    /// Whether the law is in the loop.
    pub engaged: i32,
    /// Whether the tank is below zero after a motion outside the bounds.
    pub debt: i32,
}

/// The law between two ticks.
#[derive(Clone, Copy)]
pub struct Axis {
    law: Admittance<1>,
    bounds: Bounds,
    origin: Origin<1>,
}

impl Default for AxisParameters {
    /// The start values of TestbedController.fmu.
    fn default() -> Self {
        let Settings {
            law,
            alpha,
            T,
            delayed,
            dq_cutoff,
            E_0,
            tuning_time,
        } = Settings::default();
        Self {
            law: law.number(),
            delay: delayed.into(),
            q_n_box: 0,
            gains: AxisGains::default(),
            alpha,
            T,
            v_max: 10.0,
            a_max: 1e4,
            dq_cutoff,
            E_0,
            tuning_time,
            dq_n_max: 0.0,
            q_n_min: -1.0,
            q_n_max: 1.0,
            tau_rate_max: 0.0,
        }
    }
}

/// A name of the law under its name in this interface.
fn renamed(name: &'static str) -> &'static str {
    match name {
        "f_max" => "tau_max",
        "E_0" => "energy.E_0",
        "speed_max" => "dq_n_max",
        "q_min" => "q_n_min",
        "q_max" => "q_n_max",
        "f_rate" => "tau_rate_max",
        other => other,
    }
}

fn bad(error: admittance::ParameterError) -> Bad {
    Bad::from_law(error, renamed)
}

impl AxisParameters {
    fn settings(&self) -> Result<Settings, Bad> {
        Ok(Settings {
            law: Law::try_from(self.law).map_err(bad)?,
            alpha: self.alpha,
            T: self.T,
            delayed: truth("delay", self.delay)?,
            dq_cutoff: self.dq_cutoff,
            E_0: self.E_0,
            tuning_time: self.tuning_time,
        })
    }

    fn axis(&self) -> Result<Axis, Bad> {
        let boxed = truth("q_n_box", self.q_n_box)?;
        let bounds = bounds(self.dq_n_max, boxed.then_some((self.q_n_min, self.q_n_max)));
        let reach = Reach {
            v_max: Vector1::new(self.v_max),
            a_max: Vector1::new(self.a_max),
        };
        let mut law = Admittance::new(self.settings()?, [self.gains.into()])
            .and_then(|law| law.reaching(reach))
            .and_then(|law| law.rated(Vector1::new(or_none(self.tau_rate_max))))
            .map_err(bad)?;
        law.bound([bounds]).map_err(bad)?;
        Ok(Axis {
            law,
            bounds,
            origin: Origin::default(),
        })
    }
}

impl AxisInputs {
    fn why_not_finite(&self) -> Cause {
        Bad::sensed("q", &[self.q as Real])
            .or(Bad::sensed("tau_h", &[self.tau_h]))
            .map_or(Status::NotFinite.into(), Cause::from)
    }
}

impl Axis {
    fn tick(&mut self, inputs: &AxisInputs) -> Result<AxisOutputs, Cause> {
        let engage = truth("engage", inputs.engage)?;
        let hold = truth("hold", inputs.hold)?;

        let mut next = *self;
        let q = Vector1::new(inputs.q);
        if let Some(Move { q_0, by }) = next.origin.moves(&q, engage) {
            let relative = Bounds {
                q_min: self.bounds.q_min - q_0.x,
                q_max: self.bounds.q_max - q_0.x,
                ..self.bounds
            };
            // Bounds that have been checked stay in order, but for an origin so far away that they round to one.
            next.law
                .count_from(&by, [relative])
                .map_err(|_| Status::NotFinite)?;
        }
        let q = next.origin.counted(&q);
        let tick = if engage {
            let request = Request {
                hold,
                ..Request::default()
            };
            next.law.tick(&q, &Vector1::new(inputs.tau_h), &request)
        } else {
            next.law.rest(&q)
        };
        next.origin.ticked(tick.engaged);
        let ledger = next.law.ledger();
        let q_n = tick.q_n.x;
        let outputs = AxisOutputs {
            tau_a: tick.f.x,
            tau_demand: tick.f_demand.x,
            q_n: next.origin.place().map_or(q_n, |q_0| q_0.x as Real + q_n),
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
        if !numbers.iter().all(|number| number.is_finite()) {
            return Err(inputs.why_not_finite());
        }
        *self = next;
        Ok(outputs)
    }
}

/// Writes the start values into `parameters`.
#[unsafe(no_mangle)]
pub extern "C" fn exo_axis_defaults(parameters: *mut AxisParameters) -> Status {
    pointer::status(Place::at(parameters).map(|place| place.write(AxisParameters::default())))
}

/// A law out of the loop in `state`, which may hold anything. Where a value is refused, `refusal`, which may be null, says
/// which, and `state` stays as it was.
#[unsafe(no_mangle)]
pub extern "C" fn exo_axis_init(
    state: *mut AxisState,
    parameters: *const AxisParameters,
    refusal: *mut Refusal,
) -> Status {
    refusing(refusal, || {
        let (state, parameters) = (Place::at(state)?, read(parameters)?);
        initialize(state, parameters.axis()?);
        Ok(())
    })
}

/// Other gains: on a straight line over tuning_time, so that the stored energy does not rise. Where one is refused, the
/// gains stay as they were.
#[unsafe(no_mangle)]
pub extern "C" fn exo_axis_tune(
    state: *mut AxisState,
    gains: *const AxisGains,
    refusal: *mut Refusal,
) -> Status {
    refusing(refusal, || {
        let gains = read(gains)?;
        with_law(state, |axis| {
            Ok(axis.law.tune([gains.into()]).map_err(bad)?)
        })
    })
}

/// One tick, every T. Where the status is not 0, `outputs` and `state` stay as they were; `refusal`, which may be null, says
/// which input was refused.
#[unsafe(no_mangle)]
pub extern "C" fn exo_axis_tick(
    state: *mut AxisState,
    inputs: *const AxisInputs,
    outputs: *mut AxisOutputs,
    refusal: *mut Refusal,
) -> Status {
    refusing(refusal, || {
        let (inputs, outputs) = (read(inputs)?, Place::at(outputs)?);
        outputs.write(with_law(state, |axis| axis.tick(&inputs))?);
        Ok(())
    })
}
