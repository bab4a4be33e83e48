//! The variables and what a step does.

use crate::force_sensor::ForceSensor;
use crate::joint::{Joint, Nominal};
use admittance::advice::{Advice, advise};
use admittance::hand::StiffHand;
use admittance::{Bounds, Gains, Law, ParameterError, Reach, Settings};
use arm_law::ArmLaw;
use arm_law::arm_law::{Inputs, Outputs, Parameters, Signals, Space};
use arm_law::joint_space::JointParameters;
use arm_law::kinematics::Kinematics;
use arm_law::limits::{Limits, TorqueLimiting};
use arm_law::singularity::Singularity;
use arm_law::supervision::{self, Demand, Status};
use export::{Log, Model, Refusal, Step, Ticks};
use serde::{Deserialize, Serialize};

/// The controller. What each variable is, with unit, sign and frame, stands in its row ([`rows`](crate::rows)).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "a variable is described once, in its row")]
pub struct ArmController {
    pub q: [f64; 3],
    pub f_h: [f64; 3],
    pub engage: bool,

    pub tau_a: [f64; 3],
    pub p: [f64; 3],
    pub p_n: [f64; 3],
    pub dp_n: [f64; 3],
    pub e_nr: [f64; 3],
    pub f_a: [f64; 3],
    pub saturated: bool,
    pub sigma_min: f64,
    pub tick: i32,
    pub energy: Energy,
    pub dp: [f64; 3],
    pub tau_demand: [f64; 3],
    pub engaged: bool,
    pub outside_bounds: bool,
    pub slowed: bool,

    pub law: i32,
    pub Lambda_n: [f64; 3],
    pub D_n: [f64; 3],
    pub K: [f64; 3],
    pub K_P: [f64; 3],
    pub alpha: f64,
    pub f_max: [f64; 3],
    pub tau_max: [f64; 3],
    pub torque_limiting: i32,
    pub T: f64,
    pub delay: i32,
    pub dq_max: [f64; 3],
    pub ddq_max: [f64; 3],
    pub dp_cutoff: f64,
    pub kinematics: Kinematics,
    pub ft: ForceSensor,
    pub singularity: Singularity,

    pub M_min: f64,
    pub gain_warning: i32,
    pub hold: bool,
    pub held: bool,
    pub tuning_time: f64,
    pub dp_n_max: [f64; 3],
    pub p_n_box: bool,
    pub p_n_min: [f64; 3],
    pub p_n_max: [f64; 3],
    pub tau_rate_max: [f64; 3],

    pub stiff_hand: StiffHand,
    pub stiff_hand_seen: StiffHandSeen,
    pub enable: bool,
    pub acknowledge: bool,
    pub emergency_stop: bool,
    pub heartbeat: i32,
    pub ft_valid: bool,
    pub encoder_valid: bool,
    pub state: i32,
    pub diagnostic: i32,
    pub first_fault: i32,
    pub authority: f64,
    pub supervision: bool,
    pub init_time: f64,
    pub engage_time: f64,
    pub soft_stop_time: f64,
    pub heartbeat_timeout: f64,
    pub hold_enter: f64,
    pub hold_leave: f64,
    pub hold_time: f64,
    pub hold_brake: f64,
    pub saturation_time: f64,

    pub space: i32,
    pub joint: Joint,
    pub nominal: Nominal,
    pub M_n: [f64; 9],
    pub q_n: [f64; 3],
    pub dq_n: [f64; 3],
    pub e_q: [f64; 3],

    ticks: Ticks,
    arm_law: Option<ArmLaw>,
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

/// The outputs `stiff_hand.*`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "a variable is described once, in its row")]
pub struct StiffHandSeen {
    pub detected: bool,
    pub D: [f64; 3],
    pub k_h: [f64; 3],
}

/// `space`: the nominal is a mass at the handle.
const TASK: i32 = 1;
/// `space`: the nominal is an arm.
const JOINT: i32 = 2;

impl Default for ArmController {
    fn default() -> Self {
        let Settings {
            law,
            alpha,
            delayed,
            dq_cutoff,
            E_0,
            tuning_time,
            ..
        } = Settings::default();
        let Signals {
            enable,
            acknowledge,
            emergency_stop,
            heartbeat,
            encoder_valid,
        } = Signals::default();
        let supervision::Parameters {
            init_time,
            engage_time,
            soft_stop_time,
            heartbeat_timeout,
            hold_enter,
            hold_leave,
            hold_time,
            hold_brake,
            saturation_time,
        } = supervision::Parameters::default();
        Self {
            q: [0.0, -1.48096, 1.70138],
            f_h: [0.0; 3],
            engage: true,
            tau_a: [0.0; 3],
            p: [0.0; 3],
            p_n: [0.0; 3],
            dp_n: [0.0; 3],
            e_nr: [0.0; 3],
            f_a: [0.0; 3],
            saturated: false,
            sigma_min: 0.0,
            tick: -1,
            energy: Energy {
                H: 0.0,
                G: 0.0,
                tank: E_0,
                E_0,
                share: 1.0,
                debt: false,
            },
            dp: [0.0; 3],
            tau_demand: [0.0; 3],
            engaged: false,
            outside_bounds: false,
            slowed: false,
            law: law.number(),
            Lambda_n: [5.0; 3],
            D_n: [20.0; 3],
            K: [1000.0; 3],
            K_P: [20.0; 3],
            alpha,
            f_max: [400.0; 3],
            tau_max: [153.0, 259.0, 153.0],
            torque_limiting: TorqueLimiting::Scale as i32,
            T: 0.001,
            delay: i32::from(delayed),
            dq_max: [6.0; 3],
            ddq_max: [3e3; 3],
            dp_cutoff: dq_cutoff,
            kinematics: Kinematics::default(),
            ft: ForceSensor::default(),
            singularity: Singularity::default(),
            M_min: 14.0,
            gain_warning: 0,
            hold: false,
            held: false,
            tuning_time,
            dp_n_max: [0.0; 3],
            p_n_box: false,
            p_n_min: [-1.0; 3],
            p_n_max: [1.0; 3],
            tau_rate_max: [0.0; 3],
            stiff_hand: StiffHand::default(),
            stiff_hand_seen: StiffHandSeen::default(),
            enable,
            acknowledge,
            emergency_stop,
            heartbeat,
            ft_valid: true,
            encoder_valid,
            state: 0,
            diagnostic: 0,
            first_fault: 0,
            authority: 0.0,
            supervision: false,
            init_time,
            engage_time,
            soft_stop_time,
            heartbeat_timeout,
            hold_enter,
            hold_leave,
            hold_time,
            hold_brake,
            saturation_time,
            space: TASK,
            joint: Joint::default(),
            nominal: Nominal::default(),
            M_n: [0.0; 9],
            q_n: [0.0; 3],
            dq_n: [0.0; 3],
            e_q: [0.0; 3],
            ticks: Ticks::default(),
            arm_law: None,
        }
    }
}

impl Model for ArmController {
    fn initialize(&mut self, _start_time: f64, log: &mut Log<'_>) -> Result<(), Refusal> {
        let arm_law = ArmLaw::new(&self.parameters()?).map_err(refusal)?;
        self.gain_warning = 0;
        self.advise(log)?;
        // What is shown is a law at rest; what begins to run knows no motion yet.
        let mut at_rest = arm_law;
        let shown = at_rest
            .tick(&Inputs {
                engage: false,
                ..self.inputs()
            })
            .map_err(|_| self.overflow("the start"))?;
        self.show(&shown, &at_rest);
        self.ft.clear();
        self.show_status(&Status::of(Demand::Rest));
        self.arm_law = Some(arm_law);
        self.ticks = Ticks::default();
        self.tick = -1;
        Ok(())
    }

    fn tune(&mut self, log: &mut Log<'_>) -> Result<(), Refusal> {
        let gains = self.gains(Law::try_from(self.law).map_err(refusal)?)?;
        self.arm_law
            .as_mut()
            .map_or(Ok(()), |arm_law| {
                arm_law.tune_joints(self.joint.gains(self.tau_max))?;
                arm_law.tune(gains)
            })
            .map_err(refusal)?;
        self.advise(log)
    }

    fn accepts(&self, step: &Step) -> Result<(), Refusal> {
        step.at_most("T", self.T)
    }

    fn step(&mut self, step: Step, _log: &mut Log<'_>) -> Result<(), Refusal> {
        let mut arm_law = self
            .arm_law
            .ok_or_else(|| Refusal::new("a step before initialization"))?;
        let inputs = self.inputs();
        for k in self.ticks.within(&step, self.T) {
            let outputs = arm_law
                .tick(&inputs)
                .map_err(|_| self.overflow(&format!("tick {k}")))?;
            self.show(&outputs, &arm_law);
            self.tick = i32::try_from(k).unwrap_or(i32::MAX);
        }
        self.arm_law = Some(arm_law);
        Ok(())
    }
}

impl ArmController {
    fn parameters(&self) -> Result<Parameters, Refusal> {
        let settings = self.settings()?;
        let limits = self.limits(settings.law)?;
        Ok(Parameters {
            settings,
            gains: self.gains(settings.law)?,
            bounds: std::array::from_fn(|i| self.bounds(i)),
            reach: Reach {
                v_max: self.dq_max.into(),
                a_max: self.ddq_max.into(),
            },
            kinematics: self.kinematics,
            limits,
            singularity: self.singularity,
            stiff_hand: self.stiff_hand,
            frame: self.ft.sensed_in()?,
            sensor: self.ft.sensor()?,
            supervision: self.supervision.then_some(supervision::Parameters {
                init_time: self.init_time,
                engage_time: self.engage_time,
                soft_stop_time: self.soft_stop_time,
                heartbeat_timeout: self.heartbeat_timeout,
                hold_enter: self.hold_enter,
                hold_leave: self.hold_leave,
                hold_time: self.hold_time,
                hold_brake: self.hold_brake,
                saturation_time: self.saturation_time,
            }),
            space: match self.space {
                TASK => Space::Task,
                JOINT => Space::Joint,
                other => {
                    return Err(Refusal(format!(
                        "space = {other}: expected 1 (task), 2 (joint)"
                    )));
                }
            },
            joint: self.joint()?,
        })
    }

    fn joint(&self) -> Result<JointParameters, Refusal> {
        let joint = self.joint.parameters(&self.nominal, self.tau_max);
        for (i, bounds) in (1..).zip(&joint.bounds) {
            bounds.check(Some(i)).map_err(|error| {
                refusal(renamed(error, |name| match name {
                    "speed_max" => "joint.dq_n_max",
                    "q_min" => "joint.q_n_min",
                    "q_max" => "joint.q_n_max",
                    other => other,
                }))
            })?;
        }
        Ok(joint)
    }

    fn bounds(&self, i: usize) -> Bounds {
        let speed = or_none(self.dp_n_max[i]);
        if self.p_n_box {
            Bounds {
                speed,
                q_min: self.p_n_min[i],
                q_max: self.p_n_max[i],
            }
        } else {
            Bounds {
                speed,
                ..Bounds::default()
            }
        }
    }

    fn inputs(&self) -> Inputs {
        Inputs {
            q: self.q.into(),
            hand: self.ft.reading(self.f_h),
            ft_valid: self.ft_valid,
            tare: self.ft.tare,
            engage: self.engage,
            hold: self.hold,
            signals: Signals {
                enable: self.enable,
                acknowledge: self.acknowledge,
                emergency_stop: self.emergency_stop,
                heartbeat: self.heartbeat,
                encoder_valid: self.encoder_valid,
            },
        }
    }

    fn settings(&self) -> Result<Settings, Refusal> {
        let settings = Settings {
            law: Law::try_from(self.law).map_err(refusal)?,
            alpha: self.alpha,
            T: self.T,
            delayed: match self.delay {
                0 => false,
                1 => true,
                other => return Err(Refusal(format!("delay = {other}: expected 0 or 1"))),
            },
            dq_cutoff: self.dp_cutoff,
            E_0: self.energy.E_0,
            tuning_time: self.tuning_time,
        };
        settings.check().map_err(refusal)?;
        Ok(settings)
    }

    /// Under `passive_applied` and `passive_bounded` the nominal feels what the robot gets, as one share of what it was
    /// to get. No share describes joints that are clipped one by one.
    fn limits(&self, law: Law) -> Result<Limits, Refusal> {
        let limiting = TorqueLimiting::from_number(self.torque_limiting).ok_or_else(|| {
            let number = self.torque_limiting;
            Refusal(format!(
                "torque_limiting = {number}: expected 1 (scale), 2 (clip)"
            ))
        })?;
        if limiting == TorqueLimiting::Clip && !matches!(law, Law::Standard | Law::Passive) {
            return Err(Refusal(format!(
                "torque_limiting = {} (clip): expected 1 (scale) under law = {} ({}), whose nominal feels what the robot \
                 gets, for which joints clipped one by one leave no common factor",
                self.torque_limiting,
                law.number(),
                law.name()
            )));
        }
        let limits = Limits {
            tau_max: self.tau_max.into(),
            tau_rate: self.tau_rate_max.map(or_none).into(),
            limiting,
        };
        limits.check().map_err(refusal)?;
        Ok(limits)
    }

    /// f_max belongs to `passive_bounded` alone: the other laws ask for what they ask for and live on the joints' limits.
    fn gains(&self, law: Law) -> Result<[Gains; 3], Refusal> {
        let gains = std::array::from_fn(|i| Gains {
            M_n: self.Lambda_n[i],
            D_n: self.D_n[i],
            K: self.K[i],
            K_P: self.K_P[i],
            f_max: self.f_max[i],
        });
        for (i, gains) in (1..).zip(&gains) {
            gains.check(Some(i)).map_err(refusal)?;
        }
        Ok(match law {
            Law::PassiveBounded => gains,
            _ => gains.map(|gains| Gains {
                f_max: f64::INFINITY,
                ..gains
            }),
        })
    }

    /// Sets `gain_warning` to what any axis is advised against, and says why when it becomes another one than 0.
    fn advise(&mut self, log: &mut Log<'_>) -> Result<(), Refusal> {
        if self.space != TASK {
            self.gain_warning = 0;
            return Ok(());
        }
        let settings = self.settings()?;
        let advice = self
            .gains(settings.law)?
            .iter()
            .map(|gains| advise(&settings, gains, self.M_min))
            .fold(Advice::default(), Advice::or);
        let before = std::mem::replace(&mut self.gain_warning, advice.number());
        if ![0, before].contains(&self.gain_warning) {
            log.warning(format_args!("gain_warning: {}", advice.message()));
        }
        Ok(())
    }

    fn show(&mut self, outputs: &Outputs, arm_law: &ArmLaw) {
        let Outputs {
            pose,
            outcome,
            nominal,
            slowed,
            stiff_hand,
            ft,
            status,
        } = outputs;
        self.p = pose.p.into();
        self.sigma_min = pose.sigma_min;
        self.p_n = outcome.p_n.into();
        self.dp_n = outcome.dp_n.into();
        self.e_nr = outcome.e_nr.into();
        self.dp = outcome.dp.into();
        self.f_a = outcome.f_a.into();
        self.tau_a = outcome.tau.into();
        self.tau_demand = outcome.tau_demand.into();
        self.saturated = outcome.saturated;
        self.held = outcome.held;
        self.outside_bounds = outcome.outside_bounds;
        self.engaged = outcome.engaged;
        self.slowed = *slowed;
        self.stiff_hand_seen = StiffHandSeen {
            detected: stiff_hand.detected(),
            D: stiff_hand.D().into(),
            k_h: stiff_hand.k_h().into(),
        };
        self.ft.show(ft, &arm_law.bias());
        self.show_status(status);
        self.q_n = nominal.q_n.into();
        self.dq_n = nominal.dq_n.into();
        self.e_q = nominal.e_nr.into();
        self.M_n = std::array::from_fn(|i| nominal.M_n[(i / 3, i % 3)]);
        let ledger = arm_law.ledger();
        self.energy = Energy {
            H: ledger.H(),
            G: ledger.G(),
            tank: ledger.tank(),
            share: outcome.share,
            debt: ledger.is_in_debt(),
            ..self.energy
        };
    }

    fn show_status(&mut self, status: &Status) {
        self.state = status.state.number();
        self.diagnostic = status.diagnostic.number();
        self.first_fault = status.first_fault.number();
        self.authority = status.authority;
    }

    #[cold]
    fn overflow(&self, when: &str) -> Refusal {
        let Self { q, f_h, .. } = self;
        Refusal(format!(
            "{when}: the law's result is not finite with q = {q:?} rad and f_h = {f_h:?} N"
        ))
    }
}

/// A limit of the interface, where 0 stands for none.
fn or_none(limit: f64) -> f64 {
    if limit == 0.0 { f64::INFINITY } else { limit }
}

/// A parameter error under the names of this interface.
fn refusal(error: ParameterError) -> Refusal {
    Refusal::new(renamed(error, |name| match name {
        "v_max" => "dq_max",
        "a_max" => "ddq_max",
        "speed_max" => "dp_n_max",
        "q_min" => "p_n_min",
        "q_max" => "p_n_max",
        "M_n" => "Lambda_n",
        "E_0" => "energy.E_0",
        "dq_cutoff" => "dp_cutoff",
        other => other,
    }))
}

fn renamed(error: ParameterError, name_here: fn(&'static str) -> &'static str) -> ParameterError {
    match error {
        ParameterError::OutOfRange {
            name,
            axis,
            value,
            expected,
        } => ParameterError::OutOfRange {
            name: name_here(name),
            axis,
            value,
            expected,
        },
        other => other,
    }
}
