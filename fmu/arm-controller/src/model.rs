//! The variables and what a step does.

use admittance::advice::{Advice, advise};
use admittance::{Gains, Law, ParameterError, Settings};
use arm_law::kinematics::{Kinematics, Pose};
use arm_law::limits::{Limits, TorqueLimiting};
use arm_law::singularity::Singularity;
use arm_law::task_space::{Outcome, TaskSpace};
use export::{Log, Model, Refusal, Step, Ticks};
use nalgebra::Vector3;
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
    pub v_max: f64,
    pub a_max: f64,
    pub dp_cutoff: f64,
    pub kinematics: Kinematics,
    pub ft: ForceSensor,
    pub singularity: Singularity,

    pub M_min: f64,
    pub gain_warning: i32,

    ticks: Ticks,
    task_space: Option<TaskSpace>,
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

/// The variables `ft.*`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "a variable is described once, in its row")]
pub struct ForceSensor {
    pub frame: i32,
}

/// `ft.frame`: f_h in the base frame.
const BASE: i32 = 1;
/// `ft.frame`: f_h in link 3's frame.
const SENSOR: i32 = 2;

impl Default for ArmController {
    fn default() -> Self {
        let Settings {
            law,
            alpha,
            delayed,
            dq_cutoff,
            E_0,
            ..
        } = Settings::default();
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
            v_max: 2.0,
            a_max: 1e3,
            dp_cutoff: dq_cutoff,
            kinematics: Kinematics::default(),
            ft: ForceSensor { frame: BASE },
            singularity: Singularity::default(),
            M_min: 14.0,
            gain_warning: 0,
            ticks: Ticks::default(),
            task_space: None,
        }
    }
}

impl Model for ArmController {
    fn initialize(&mut self, _start_time: f64, log: &mut Log<'_>) -> Result<(), Refusal> {
        let settings = self.settings()?;
        let limits = self.limits(settings.law)?;
        let gains = self.gains(settings.law)?;
        self.kinematics.check().map_err(refusal)?;
        self.singularity.check().map_err(refusal)?;
        if ![BASE, SENSOR].contains(&self.ft.frame) {
            let frame = self.ft.frame;
            return Err(Refusal(format!(
                "ft.frame = {frame}: expected 1 (base), 2 (sensor)"
            )));
        }
        let mut task_space =
            TaskSpace::new(settings, gains, limits, self.singularity).map_err(refusal)?;
        self.gain_warning = 0;
        self.advise(log)?;
        let q = self.q.into();
        let pose = self.kinematics.at(&q);
        let out_of_the_loop = task_space.rest(&pose, &q);
        self.show(&pose, &out_of_the_loop, &task_space);
        self.task_space = Some(task_space);
        self.ticks = Ticks::default();
        self.tick = -1;
        Ok(())
    }

    fn tune(&mut self, log: &mut Log<'_>) -> Result<(), Refusal> {
        let gains = self.gains(Law::try_from(self.law).map_err(refusal)?)?;
        self.task_space
            .as_mut()
            .map_or(Ok(()), |task_space| task_space.tune(gains))
            .map_err(refusal)?;
        self.advise(log)
    }

    fn accepts(&self, step: &Step) -> Result<(), Refusal> {
        step.at_most("T", self.T)
    }

    fn step(&mut self, step: Step, _log: &mut Log<'_>) -> Result<(), Refusal> {
        let mut task_space = self
            .task_space
            .ok_or_else(|| Refusal::new("a step before initialization"))?;
        let q = self.q.into();
        let pose = self.kinematics.at(&q);
        let f_h = self.f_h_in_base(&pose);
        for k in self.ticks.within(&step, self.T) {
            let outcome = if self.engage {
                task_space.step(&pose, &q, &f_h).map_err(refusal)?
            } else {
                task_space.rest(&pose, &q)
            };
            if !is_finite(&outcome, &task_space) {
                return Err(self.overflow(k));
            }
            self.show(&pose, &outcome, &task_space);
            self.tick = i32::try_from(k).unwrap_or(i32::MAX);
        }
        self.task_space = Some(task_space);
        Ok(())
    }
}

impl ArmController {
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
            v_max: self.v_max,
            a_max: self.a_max,
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

    /// f_h (N) in the base frame.
    fn f_h_in_base(&self, pose: &Pose) -> Vector3<f64> {
        let f_h = self.f_h.into();
        if self.ft.frame == SENSOR {
            pose.R * f_h
        } else {
            f_h
        }
    }

    fn show(&mut self, pose: &Pose, outcome: &Outcome, task_space: &TaskSpace) {
        let Outcome {
            law,
            f_a,
            tau,
            tau_demand,
            saturated,
            slowed,
        } = outcome;
        self.p = pose.p.into();
        self.sigma_min = pose.sigma_min;
        self.p_n = law.q_n.into();
        self.dp_n = law.dq_n.into();
        self.e_nr = law.e_nr.into();
        self.dp = law.dq.into();
        self.outside_bounds = law.outside_bounds;
        self.engaged = law.engaged;
        self.f_a = (*f_a).into();
        self.tau_a = (*tau).into();
        self.tau_demand = (*tau_demand).into();
        (self.saturated, self.slowed) = (*saturated, *slowed);
        let ledger = task_space.ledger();
        self.energy = Energy {
            H: ledger.H(),
            G: ledger.G(),
            tank: ledger.tank(),
            ..self.energy
        };
    }

    #[cold]
    fn overflow(&self, tick: u64) -> Refusal {
        let Self { q, f_h, .. } = self;
        Refusal(format!(
            "tick {tick}: the law's result is not finite with q = {q:?} rad and f_h = {f_h:?} N"
        ))
    }
}

/// Whether all that follows from a tick is: a torque that is not a number must not reach the robot.
fn is_finite(outcome: &Outcome, task_space: &TaskSpace) -> bool {
    let Outcome {
        law,
        f_a,
        tau,
        tau_demand,
        ..
    } = outcome;
    [f_a, tau, tau_demand, &law.q_n, &law.dq_n]
        .into_iter()
        .flatten()
        .chain(&[task_space.ledger().G()])
        .all(|value| value.is_finite())
}

/// A parameter error under the names of this interface.
fn refusal(error: ParameterError) -> Refusal {
    Refusal::new(match error {
        ParameterError::OutOfRange {
            name,
            axis,
            value,
            expected,
        } => ParameterError::OutOfRange {
            name: match name {
                "M_n" => "Lambda_n",
                "E_0" => "energy.E_0",
                "dq_cutoff" => "dp_cutoff",
                other => other,
            },
            axis,
            value,
            expected,
        },
        other => other,
    })
}
