//! The variables and what a step does.

use admittance::advice::advise;
use admittance::{Admittance, Gains, Law, ParameterError, Settings, Tick};
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

    ticks: Ticks,
    admittance: Option<Admittance<1>>,
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
            ticks: Ticks::default(),
            admittance: None,
        }
    }
}

impl Model for TestbedController {
    fn initialize(&mut self, _start_time: f64, log: &mut Log<'_>) -> Result<(), Refusal> {
        let mut admittance = Admittance::new(self.settings()?, [self.gains()]).map_err(refusal)?;
        self.gain_warning = 0;
        self.advise(log)?;
        let out_of_the_loop = admittance.rest(&Vector1::new(self.q));
        self.show(&out_of_the_loop, &admittance);
        self.admittance = Some(admittance);
        self.ticks = Ticks::default();
        self.tick = -1;
        Ok(())
    }

    fn tune(&mut self, log: &mut Log<'_>) -> Result<(), Refusal> {
        let gains = self.gains();
        self.admittance
            .as_mut()
            .map_or(Ok(()), |admittance| admittance.tune([gains]))
            .map_err(refusal)?;
        self.advise(log)
    }

    fn accepts(&self, step: &Step) -> Result<(), Refusal> {
        step.at_most("T", self.T)
    }

    fn step(&mut self, step: Step, _log: &mut Log<'_>) -> Result<(), Refusal> {
        let mut admittance = self
            .admittance
            .ok_or_else(|| Refusal::new("a step before initialization"))?;
        let (q, tau_h) = (Vector1::new(self.q), Vector1::new(self.tau_h));
        for k in self.ticks.within(&step, self.T) {
            let tick = if self.engage {
                admittance.step(&q, &tau_h)
            } else {
                admittance.rest(&q)
            };
            let results = [
                tick.f_demand.x,
                tick.q_n.x,
                tick.dq_n.x,
                admittance.ledger().G(),
            ];
            if !results.into_iter().all(f64::is_finite) {
                return Err(overflow(k, self.q, self.tau_h));
            }
            self.show(&tick, &admittance);
            self.tick = i32::try_from(k).unwrap_or(i32::MAX);
        }
        self.admittance = Some(admittance);
        Ok(())
    }
}

impl TestbedController {
    fn settings(&self) -> Result<Settings, Refusal> {
        Ok(Settings {
            law: Law::try_from(self.law).map_err(refusal)?,
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
        let advice = advise(&self.settings()?, &self.gains(), self.M_min);
        let before = std::mem::replace(&mut self.gain_warning, advice.number());
        if ![0, before].contains(&self.gain_warning) {
            log.warning(format_args!("gain_warning: {}", advice.message()));
        }
        Ok(())
    }

    fn show(&mut self, tick: &Tick<1>, admittance: &Admittance<1>) {
        self.tau_a = tick.f.x;
        self.tau_demand = tick.f_demand.x;
        self.q_n = tick.q_n.x;
        self.dq_n = tick.dq_n.x;
        self.e_nr = tick.e_nr.x;
        self.dq = tick.dq.x;
        self.saturated = tick.saturated;
        self.outside_bounds = tick.outside_bounds;
        self.engaged = tick.engaged;
        let ledger = admittance.ledger();
        self.energy = Energy {
            H: ledger.H(),
            G: ledger.G(),
            tank: ledger.tank(),
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

#[cold]
fn overflow(tick: u64, q: f64, tau_h: f64) -> Refusal {
    Refusal(format!(
        "tick {tick}: the law's result is not finite with q = {q} m and tau_h = {tau_h} N"
    ))
}
