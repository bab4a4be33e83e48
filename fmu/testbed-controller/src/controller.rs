//! One of the controllers that the model offers, behind one tick.

use admittance::{
    Admittance, Bounds, Gains, Law, Natural, ParameterError, Reach, Request, Servo, Settings,
    SlidingMode, comparator, servo,
};
use nalgebra::Vector1;
use serde::{Deserialize, Serialize};

/// What a robot gets from the controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A force.
    Torque,
    /// Position and velocity for a drive that closes the loop itself.
    PositionServo,
}

/// What the comparators need besides the laws' parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparator {
    /// Mass of the robot (kg), for `natural`.
    pub M: f64,
    /// Time constant of the sliding surface (s), for `sliding_mode`.
    pub H: f64,
}

/// Limits inside the four laws in torque form, and the reach that their budget covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// How fast the robot can move.
    pub reach: Reach<1>,
    /// What the nominal keeps to.
    pub bounds: Bounds,
    /// Largest rate of change of the force, N/s.
    pub f_rate: f64,
}

impl Limits {
    /// Comparators and the servo form do not keep limits: none may be set.
    fn check_none(&self) -> Result<(), ParameterError> {
        let Bounds {
            speed,
            q_min,
            q_max,
        } = self.bounds;
        for (name, value) in [
            ("dq_n_max", speed),
            ("q_n_min", -q_min),
            ("q_n_max", q_max),
            ("tau_rate_max", self.f_rate),
        ] {
            if value != f64::INFINITY {
                let value = if name == "q_n_min" { -value } else { value };
                return Err(ParameterError::OutOfRange {
                    name,
                    axis: None,
                    value,
                    expected: "no limit, which the laws 1 to 4 in torque form alone keep",
                });
            }
        }
        Ok(())
    }
}

/// What is asked of the controller at a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Demand {
    /// Out of the loop.
    Rest,
    /// In the loop.
    Run,
    /// In the loop, the nominal stays where it is; the four laws in torque form only.
    Hold,
}

/// The controller between two ticks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[allow(
    clippy::large_enum_variant,
    reason = "one of them, once: a box would cost more than it saves"
)]
pub enum Controller {
    /// One of the four laws, torque form.
    Law(Admittance<1>),
    /// One of the laws, servo form.
    Servo(Servo),
    /// The comparator `natural`.
    Natural(Natural),
    /// The comparator `sliding_mode`.
    SlidingMode(SlidingMode),
}

/// What is sensed at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensed {
    /// Position, m.
    pub q: f64,
    /// Force of the human, N.
    pub tau_h: f64,
    /// Mean force of the drive over the sample that ended, N; servo form only.
    pub tau_m: f64,
}

/// What a controller did at a tick; every value is the one at t_k.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "outputs of the model, described in their rows")]
pub struct Done {
    pub tau_a: f64,
    pub tau_demand: f64,
    pub q_n: f64,
    pub dq_n: f64,
    pub e_nr: f64,
    pub dq: f64,
    pub q_d: f64,
    pub dq_d: f64,
    pub saturated: bool,
    pub held: bool,
    pub outside_bounds: bool,
    pub engaged: bool,
    pub H: f64,
    pub G: f64,
    pub tank: f64,
    pub share: f64,
    pub debt: bool,
}

impl Done {
    /// Whether every number is one.
    pub fn is_finite(&self) -> bool {
        [self.tau_demand, self.q_n, self.dq_n, self.q_d, self.G]
            .into_iter()
            .all(f64::is_finite)
    }
}

impl Controller {
    /// Out of the loop.
    ///
    /// # Errors
    /// The first parameter out of its range, or a law that does not exist in this form.
    pub fn new(
        settings: Settings,
        gains: Gains,
        form: Form,
        comparator: Comparator,
        limits: Limits,
    ) -> Result<Self, ParameterError> {
        if !settings.law.row().offered || form == Form::PositionServo {
            limits.check_none()?;
        }
        if form == Form::PositionServo {
            if !settings.law.row().servo {
                return Err(ParameterError::NoServoForm(settings.law));
            }
            return Ok(Self::Servo(Servo::new(settings, gains)?));
        }
        Ok(match settings.law {
            Law::Natural => Self::Natural(Natural::new(settings, gains, comparator.M)?),
            Law::SlidingMode => Self::SlidingMode(SlidingMode::new(settings, gains, comparator.H)?),
            Law::Standard | Law::Passive | Law::PassiveApplied | Law::PassiveBounded => {
                let mut law = Admittance::new(settings, [gains])?
                    .reaching(limits.reach)?
                    .rated(Vector1::new(limits.f_rate))?;
                law.bound([limits.bounds])?;
                Self::Law(law)
            }
        })
    }

    /// Other gains from the next tick on.
    ///
    /// # Errors
    /// The first one that is refused; the gains stay as they were.
    pub fn tune(&mut self, gains: Gains) -> Result<(), ParameterError> {
        match self {
            Self::Law(law) => law.tune([gains]),
            Self::Servo(servo) => servo.tune(gains),
            Self::Natural(natural) => natural.tune(gains),
            Self::SlidingMode(sliding_mode) => sliding_mode.tune(gains),
        }
    }

    /// One tick, in the loop or out of it.
    pub fn tick(&mut self, sensed: &Sensed, demand: Demand) -> Done {
        let Sensed { q, tau_h, tau_m } = *sensed;
        let engage = demand != Demand::Rest;
        match self {
            Self::Law(law) => {
                let tick = if engage {
                    let request = Request {
                        hold: demand == Demand::Hold,
                        ..Request::default()
                    };
                    law.tick(&Vector1::new(q), &Vector1::new(tau_h), &request)
                } else {
                    law.rest(&Vector1::new(q))
                };
                let ledger = law.ledger();
                Done {
                    tau_a: tick.f.x,
                    tau_demand: tick.f_demand.x,
                    q_n: tick.q_n.x,
                    dq_n: tick.dq_n.x,
                    e_nr: tick.e_nr.x,
                    dq: tick.dq.x,
                    q_d: tick.q_n.x,
                    dq_d: tick.dq_n.x,
                    saturated: tick.saturated,
                    held: tick.held,
                    outside_bounds: tick.outside_bounds,
                    engaged: tick.engaged,
                    H: ledger.H(),
                    G: ledger.G(),
                    tank: ledger.tank(),
                    share: tick.share,
                    debt: ledger.is_in_debt(),
                }
            }
            Self::Servo(servo) => {
                let tick = if engage {
                    servo.step(q, tau_h, tau_m)
                } else {
                    servo.rest(q, tau_m)
                };
                in_servo_form(&tick, servo.energy(), engage)
            }
            Self::Natural(natural) => compared(
                &if engage {
                    natural.step(q, tau_h)
                } else {
                    natural.rest(q)
                },
                engage,
            ),
            Self::SlidingMode(sliding_mode) => compared(
                &if engage {
                    sliding_mode.step(q, tau_h)
                } else {
                    sliding_mode.rest(q)
                },
                engage,
            ),
        }
    }
}

fn in_servo_form(tick: &servo::Tick, energy: &servo::Energy, engaged: bool) -> Done {
    Done {
        tau_a: 0.0,
        tau_demand: 0.0,
        q_n: tick.q_n,
        dq_n: tick.dq_n,
        e_nr: tick.e_nr,
        dq: tick.dq,
        q_d: tick.q_d,
        dq_d: tick.dq_d,
        saturated: tick.saturated,
        held: false,
        outside_bounds: false,
        engaged,
        H: energy.H,
        G: energy.G,
        tank: energy.tank,
        share: 1.0,
        debt: false,
    }
}

fn compared(tick: &comparator::Tick, engaged: bool) -> Done {
    Done {
        tau_a: tick.f,
        tau_demand: tick.f_demand,
        q_n: tick.q_n,
        dq_n: tick.dq_n,
        e_nr: tick.e_nr,
        dq: tick.dq,
        q_d: tick.q_n,
        dq_d: tick.dq_n,
        saturated: tick.is_saturated(),
        held: false,
        outside_bounds: false,
        engaged,
        H: 0.0,
        G: 0.0,
        tank: 0.0,
        share: 1.0,
        debt: false,
    }
}
