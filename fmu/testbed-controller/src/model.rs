//! The variables and what a step does.

use crate::controller::{self, Controller, Done, Form, Sensed};
use admittance::advice::advise;
use admittance::{Gains, Law, ParameterError, Settings};
use export::{Log, Model, Refusal, Step, Ticks};
use serde::{Deserialize, Serialize};

/// The controller. What each variable is, with unit and sign, stands in its row ([`rows`](crate::rows)).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "a variable is described once, in its row")]
pub struct TestbedController {
    pub q: f64,
    pub tau_h: f64,
    pub engage: bool,

    pub tau_a: f64,
    pub q_n: f64,
    pub dq_n: f64,
    pub e_nr: f64,
    pub saturated: bool,
    pub tick: i32,
    pub energy: Energy,
    pub dq: f64,
    pub tau_demand: f64,
    pub engaged: bool,
    pub outside_bounds: bool,

    pub law: i32,
    pub M_n: f64,
    pub D_n: f64,
    pub K: f64,
    pub K_P: f64,
    pub alpha: f64,
    pub tau_max: f64,
    pub T: f64,
    pub delay: i32,
    pub v_max: f64,
    pub a_max: f64,
    pub dq_cutoff: f64,

    pub M_min: f64,
    pub gain_warning: i32,
    pub tau_a_measured: f64,
    pub q_d: f64,
    pub dq_d: f64,
    pub form: i32,
    pub comparator: Comparator,

    ticks: Ticks,
    controller: Option<Controller>,
}

/// The variables `comparator.*`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "a variable is described once, in its row")]
pub struct Comparator {
    pub M: f64,
    pub H: f64,
}

/// The variables `energy.*`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "a variable is described once, in its row")]
pub struct Energy {
    pub H: f64,
    pub G: f64,
    pub tank: f64,
    pub E_0: f64,
}

impl Default for TestbedController {
    fn default() -> Self {
        let Settings {
            law,
            alpha,
            T,
            delayed,
            dq_cutoff,
            E_0,
            v_max,
            a_max,
        } = Settings::default();
        Self {
            q: 0.0,
            tau_h: 0.0,
            engage: true,
            tau_a: 0.0,
            q_n: 0.0,
            dq_n: 0.0,
            e_nr: 0.0,
            saturated: false,
            tick: -1,
            energy: Energy {
                H: 0.0,
                G: 0.0,
                tank: E_0,
                E_0,
            },
            dq: 0.0,
            tau_demand: 0.0,
            engaged: false,
            outside_bounds: false,
            law: law.number(),
            M_n: 5.0,
            D_n: 0.5,
            K: 30.0,
            K_P: 10.0,
            alpha,
            tau_max: 12.5,
            T,
            delay: i32::from(delayed),
            v_max,
            a_max,
            dq_cutoff,
            M_min: 6.0,
            gain_warning: 0,
            tau_a_measured: 0.0,
            q_d: 0.0,
            dq_d: 0.0,
            form: 1,
            comparator: Comparator { M: 6.0, H: 0.7 },
            ticks: Ticks::default(),
            controller: None,
        }
    }
}

impl Model for TestbedController {
    fn initialize(&mut self, _start_time: f64, log: &mut Log<'_>) -> Result<(), Refusal> {
        let mut controller = Controller::new(
            self.settings()?,
            self.gains(),
            self.form()?,
            self.comparator(),
        )
        .map_err(refusal)?;
        self.gain_warning = 0;
        self.advise(log)?;
        let out_of_the_loop = controller.tick(&self.sensed(), false);
        self.show(&out_of_the_loop);
        self.controller = Some(controller);
        self.ticks = Ticks::default();
        self.tick = -1;
        Ok(())
    }

    fn tune(&mut self, log: &mut Log<'_>) -> Result<(), Refusal> {
        let gains = self.gains();
        self.controller
            .as_mut()
            .map_or(Ok(()), |controller| controller.tune(gains))
            .map_err(refusal)?;
        self.advise(log)
    }

    fn accepts(&self, step: &Step) -> Result<(), Refusal> {
        step.at_most("T", self.T)
    }

    fn step(&mut self, step: Step, _log: &mut Log<'_>) -> Result<(), Refusal> {
        let mut controller = self
            .controller
            .ok_or_else(|| Refusal::new("a step before initialization"))?;
        let sensed = self.sensed();
        for k in self.ticks.within(&step, self.T) {
            let done = controller.tick(&sensed, self.engage);
            if !done.is_finite() {
                return Err(overflow(k, self.q, self.tau_h));
            }
            self.show(&done);
            self.tick = i32::try_from(k).unwrap_or(i32::MAX);
        }
        self.controller = Some(controller);
        Ok(())
    }
}

impl TestbedController {
    fn settings(&self) -> Result<Settings, Refusal> {
        Ok(Settings {
            law: Law::try_from(self.law).map_err(|_| unknown_law(self.law))?,
            alpha: self.alpha,
            T: self.T,
            delayed: match self.delay {
                0 => false,
                1 => true,
                other => return Err(Refusal(format!("delay = {other}: expected 0 or 1"))),
            },
            dq_cutoff: self.dq_cutoff,
            E_0: self.energy.E_0,
            v_max: self.v_max,
            a_max: self.a_max,
        })
    }

    fn gains(&self) -> Gains {
        let Self {
            M_n,
            D_n,
            K,
            K_P,
            tau_max,
            ..
        } = *self;
        Gains {
            M_n,
            D_n,
            K,
            K_P,
            f_max: tau_max,
        }
    }

    /// Sets `gain_warning` and says why when it becomes another one than 0.
    fn advise(&mut self, log: &mut Log<'_>) -> Result<(), Refusal> {
        let mut advice = advise(&self.settings()?, &self.gains(), self.M_min);
        advice.stiff_coupling &= self.form()? == Form::Torque; // else the coupling is the drive's
        advice.light_nominal &= self.law != Law::Natural.number(); // which has comparator.M in place of M_n
        let before = std::mem::replace(&mut self.gain_warning, advice.number());
        if ![0, before].contains(&self.gain_warning) {
            log.warning(format_args!("gain_warning: {}", advice.message()));
        }
        Ok(())
    }

    fn form(&self) -> Result<Form, Refusal> {
        match self.form {
            1 => Ok(Form::Torque),
            2 => Ok(Form::PositionServo),
            other => Err(Refusal(format!(
                "form = {other}: expected 1 (torque) or 2 (position_servo)"
            ))),
        }
    }

    fn comparator(&self) -> controller::Comparator {
        let Comparator { M, H } = self.comparator;
        controller::Comparator { M, H }
    }

    fn sensed(&self) -> Sensed {
        Sensed {
            q: self.q,
            tau_h: self.tau_h,
            tau_m: self.tau_a_measured,
        }
    }

    fn show(&mut self, done: &Done) {
        let Done { H, G, tank, .. } = *done;
        (self.tau_a, self.tau_demand) = (done.tau_a, done.tau_demand);
        (self.q_n, self.dq_n, self.e_nr) = (done.q_n, done.dq_n, done.e_nr);
        (self.q_d, self.dq_d, self.dq) = (done.q_d, done.dq_d, done.dq);
        self.saturated = done.saturated;
        self.outside_bounds = done.outside_bounds;
        self.engaged = done.engaged;
        self.energy = Energy {
            H,
            G,
            tank,
            ..self.energy
        };
    }
}

/// A parameter error under the names of this interface.
fn refusal(error: ParameterError) -> Refusal {
    Refusal::new(match error {
        ParameterError::OutOfRange {
            name,
            axis,
            value,
            expected,
        } => {
            let name = match name {
                "f_max" => "tau_max",
                "E_0" => "energy.E_0",
                other => other,
            };
            ParameterError::OutOfRange {
                name,
                axis,
                value,
                expected,
            }
        }
        other => other,
    })
}

/// `law = 9: expected 1 (standard), …`, with the comparators, which the other models do not have.
#[cold]
fn unknown_law(number: i32) -> Refusal {
    let laws = Law::ALL.map(|law| format!("{} ({})", law.number(), law.name()));
    Refusal(format!("law = {number}: expected {}", laws.join(", ")))
}

#[cold]
fn overflow(tick: u64, q: f64, tau_h: f64) -> Refusal {
    Refusal(format!(
        "tick {tick}: the law's result is not finite with q = {q} m and tau_h = {tau_h} N"
    ))
}
