//! The variables and what a step does.

use crate::controller::{self, Controller, Demand, Done, Form, Limits, Sensed};
use admittance::advice::advise;
use admittance::{Bounds, Gains, Law, ParameterError, Reach, Settings};
use export::{Log, Model, Refusal, Step, Ticks};
use nalgebra::Vector1;
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
    pub hold: bool,
    pub held: bool,
    pub tuning_time: f64,
    pub dq_n_max: f64,
    pub q_n_box: bool,
    pub q_n_min: f64,
    pub q_n_max: f64,
    pub tau_rate_max: f64,

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
    pub share: f64,
    pub debt: bool,
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
            tuning_time,
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
                share: 1.0,
                debt: false,
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
            v_max: 10.0,
            a_max: 1e4,
            dq_cutoff,
            M_min: 6.0,
            gain_warning: 0,
            tau_a_measured: 0.0,
            q_d: 0.0,
            dq_d: 0.0,
            form: 1,
            comparator: Comparator { M: 6.0, H: 0.7 },
            hold: false,
            held: false,
            tuning_time,
            dq_n_max: 0.0,
            q_n_box: false,
            q_n_min: -1.0,
            q_n_max: 1.0,
            tau_rate_max: 0.0,
            ticks: Ticks::default(),
            controller: None,
        }
    }
}

impl Model for TestbedController {
    fn initialize(&mut self, _start_time: f64, log: &mut Log<'_>) -> Result<(), Refusal> {
        let controller = self.controller()?;
        self.gain_warning = 0;
        self.advise(log)?;
        // What is shown is a controller at rest; what begins to run knows no motion yet.
        let mut at_rest = controller;
        let shown = at_rest.tick(&self.sensed(), Demand::Rest);
        self.show(&shown);
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
        let demand = match (self.engage, self.hold) {
            (false, _) => Demand::Rest,
            (true, false) => Demand::Run,
            (true, true) => Demand::Hold,
        };
        for k in self.ticks.within(&step, self.T) {
            let done = controller.tick(&sensed, demand);
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
    fn controller(&self) -> Result<Controller, Refusal> {
        let reach = Reach {
            v_max: Vector1::new(self.v_max),
            a_max: Vector1::new(self.a_max),
        };
        let speed = or_none(self.dq_n_max);
        let bounds = if self.q_n_box {
            Bounds {
                speed,
                q_min: self.q_n_min,
                q_max: self.q_n_max,
            }
        } else {
            Bounds {
                speed,
                ..Bounds::default()
            }
        };
        let limits = Limits {
            reach,
            bounds,
            f_rate: or_none(self.tau_rate_max),
        };
        Controller::new(
            self.settings()?,
            self.gains(),
            self.form()?,
            self.comparator(),
            limits,
        )
        .map_err(refusal)
    }

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
            tuning_time: self.tuning_time,
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
        let settings = self.settings()?;
        let mut advice = advise(&settings, &self.gains(), self.M_min);
        advice.stiff_coupling &= self.form()? == Form::Torque; // else the coupling is the drive's
        advice.light_nominal &= settings.law.row().nominal_mass;
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
        let Done {
            H,
            G,
            tank,
            share,
            debt,
            ..
        } = *done;
        (self.tau_a, self.tau_demand) = (done.tau_a, done.tau_demand);
        (self.q_n, self.dq_n, self.e_nr) = (done.q_n, done.dq_n, done.e_nr);
        (self.q_d, self.dq_d, self.dq) = (done.q_d, done.dq_d, done.dq);
        self.saturated = done.saturated;
        self.held = done.held;
        self.outside_bounds = done.outside_bounds;
        self.engaged = done.engaged;
        self.energy = Energy {
            H,
            G,
            tank,
            share,
            debt,
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
                "speed_max" => "dq_n_max",
                "q_min" => "q_n_min",
                "q_max" => "q_n_max",
                "f_rate" => "tau_rate_max",
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
    Refusal(format!("law = {number}: expected {}", Law::NUMBERED))
}

/// A limit of the interface, where 0 stands for none.
fn or_none(limit: f64) -> f64 {
    if limit == 0.0 { f64::INFINITY } else { limit }
}

#[cold]
fn overflow(tick: u64, q: f64, tau_h: f64) -> Refusal {
    Refusal(format!(
        "tick {tick}: the law's result is not finite with q = {q} m and tau_h = {tau_h} N"
    ))
}
