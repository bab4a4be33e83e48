//! The complete law of the arm: from what is sensed at a tick to the torques on the joints.
//!
//! It knows no FMI: the FMU ArmController and the C library are shells around it.

use crate::displacement::Origin;
use crate::form::Form;
use crate::joint_space::{JointGains, JointParameters, Nominal};
use crate::kinematics::{Kinematics, Pose};
use crate::limits::Limits;
use crate::singularity::Singularity;
use crate::stiff_hand::Detectors;
use crate::supervision::{self, Demand, Report, Status, Supervisor};
use crate::task_space::Outcome;
use crate::wrench::{Conditioned, Conditioner, Frame, Sample, Sensor, Wrench};
use admittance::hand::StiffHand;
use admittance::{Bounds, Gains, Ledger, ParameterError, Reach, Real, Request, Settings, real};
use nalgebra::Vector3;

pub use crate::form::Space;

/// What stays fixed while the law is in use, but for the gains.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Parameters {
    /// What all axes share.
    pub settings: Settings,
    /// Gains along x, y, z of the base frame.
    pub gains: [Gains; 3],
    /// Limits of the nominal along x, y, z.
    pub bounds: [Bounds; 3],
    /// How fast the joints can move: the motions for which passivity is promised, rad/s and rad/s².
    pub reach: Reach<3>,
    /// Where the handle is.
    pub kinematics: Kinematics,
    /// What the joints deliver.
    pub limits: Limits,
    /// Slowing before a singularity.
    pub singularity: Singularity,
    /// Damping for a hand too stiff for the gains.
    pub stiff_hand: StiffHand,
    /// The frame of the hand's force sensor.
    pub frame: Frame,
    /// What is made of its reading.
    pub sensor: Sensor,
    /// Supervision; `None`: `engage` alone decides.
    pub supervision: Option<supervision::Parameters>,
    /// The coordinates in which the nominal lives: in task space with `gains` and `bounds`, in joint space with `joint`.
    pub space: Space,
    /// The nominal in joint space.
    pub joint: JointParameters,
}

/// What is sensed and asked for at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs {
    /// Joint angles, rad.
    pub q: Vector3<Real>,
    /// What the hand's force sensor reads: about its origin, in [`Parameters::frame`]. No moment if it has none.
    pub hand: Wrench,
    /// The sensor's own word: false = invalid.
    pub ft_valid: bool,
    /// Whether a tare of the sensor is requested; its change to true starts one.
    pub tare: bool,
    /// Whether the law is to be in the loop.
    pub engage: bool,
    /// Whether the nominal is to stay where it is.
    pub hold: bool,
    /// What supervision sees besides; without it nobody does.
    pub signals: Signals,
}

/// What an operator and a machine's other parts say: [`supervision::Inputs`] less what [`Inputs`] has already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signals {
    /// Whether the controller may run at all.
    pub enable: bool,
    /// Its rising edge acknowledges a fault.
    pub acknowledge: bool,
    /// Whether the emergency stop is pressed.
    pub emergency_stop: bool,
    /// A counter that changes as long as its sender lives.
    pub heartbeat: i32,
    /// Whether the joint angles can be trusted. Angles that are not finite never are.
    pub encoder_valid: bool,
}

impl Default for Signals {
    /// Not enabled, with good sensors.
    fn default() -> Self {
        Self {
            enable: false,
            acknowledge: false,
            emergency_stop: false,
            heartbeat: 0,
            encoder_valid: true,
        }
    }
}

/// What came of a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs {
    /// Where the handle is.
    pub pose: Pose,
    /// What the law did.
    pub outcome: Outcome,
    /// The nominal in joint coordinates; in task space, where it has none, the robot at rest, M_n 0.
    pub nominal: Nominal,
    /// Whether the nominal is slowed before a singularity.
    pub slowed: bool,
    /// What is known of a stiff hand, after this tick.
    pub stiff_hand: Detectors,
    /// What the law knows of the hand: about the handle, in the base frame.
    pub ft: Conditioned,
    /// What supervision says; without it, that the law does what `engage` and `hold` say.
    pub status: Status,
}

/// A tick whose result is not finite: an input was not, or numbers overflow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotFinite;

/// The law between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ArmLaw {
    kinematics: Kinematics,
    singularity: Singularity,
    stiff_hand: Detectors,
    frame: Frame,
    conditioner: Conditioner,
    form: Form,
    supervisor: Option<Supervisor>,
    /// the joint angles of the last tick that had a result, rad
    q: Vector3<Real>,
    /// the nominal's velocity at the last tick at which it was free, in its own coordinates: m/s or rad/s
    v_n: Vector3<Real>,
    bounds: [Bounds; 3],
    /// where angles and positions are counted from, if not from zero
    origin: Option<Origin>,
}

impl ArmLaw {
    /// A law out of the loop.
    ///
    /// # Errors
    /// The first parameter out of its range, a law that is not offered, or limits that do not suit it.
    pub fn new(parameters: &Parameters) -> Result<Self, ParameterError> {
        parameters.limits.check()?;
        parameters.limits.check_under(parameters.settings.law)?;
        parameters.kinematics.check()?;
        parameters.singularity.check()?;
        parameters.joint.arm.check()?;
        parameters.joint.gains.check()?;
        parameters.frame.check()?;
        Ok(Self {
            kinematics: parameters.kinematics,
            singularity: parameters.singularity,
            stiff_hand: Detectors::new(parameters.stiff_hand, parameters.settings.T)?,
            frame: parameters.frame,
            conditioner: Conditioner::new(parameters.sensor, parameters.settings.T)?,
            form: match parameters.space {
                Space::Task => Form::task(
                    parameters.settings,
                    parameters.gains,
                    parameters.bounds,
                    parameters.reach,
                    parameters.limits,
                )?,
                Space::Joint => Form::joint(
                    parameters.settings,
                    &parameters.joint,
                    parameters.kinematics,
                    parameters.reach,
                    parameters.limits,
                )?,
            },
            supervisor: parameters
                .supervision
                .map(|supervision| Supervisor::new(&supervision, parameters.settings.T))
                .transpose()?,
            q: Vector3::zeros(),
            v_n: Vector3::zeros(),
            bounds: parameters.bounds,
            origin: None,
        })
    }

    /// Other gains: on a straight line over the tuning time, each step taken over so that the stored energy does not rise.
    /// In joint space they are checked and have no effect.
    ///
    /// # Errors
    /// The first gain out of its range; the gains stay as they were.
    pub fn tune(&mut self, gains: [Gains; 3]) -> Result<(), ParameterError> {
        self.form.tune(gains)
    }

    /// Other gains of the joints, likewise. In task space they are checked and have no effect.
    ///
    /// # Errors
    /// The first gain out of its range; the gains stay as they were.
    pub fn tune_joints(&mut self, gains: JointGains) -> Result<(), ParameterError> {
        self.form.tune_joints(gains)
    }

    /// Counts from the joint angles `q_0` (rad) and from where the handle is there, from the next tick on: `q` of the
    /// [`Inputs`], and p, p_n of the [`Outputs`]. The [`Bounds`] stay where they are. Only while the law is out of the loop,
    /// and in task space; in joint space nothing changes.
    ///
    /// Single precision needs it, see [`displacement`](crate::displacement).
    ///
    /// # Errors
    /// A bound that the origin's distance rounds away; the origin stays as it was.
    pub fn count_from(&mut self, q_0: &Vector3<Real>) -> Result<(), ParameterError> {
        let Form::Task(task_space) = &mut self.form else {
            return Ok(());
        };
        let origin = Origin::new(&self.kinematics, q_0);
        let mut bounds = self.bounds;
        for (bounds, p_0) in bounds.iter_mut().zip(origin.p()) {
            bounds.q_min -= p_0;
            bounds.q_max -= p_0;
        }
        let by = q_0 - self.origin.map_or(Vector3::zeros(), |before| *before.q());
        task_space.count_from(&by, bounds)?;
        self.q -= by;
        self.origin = Some(origin);
        Ok(())
    }

    /// Position of the handle from which positions are counted, base frame, m; `None`: from zero.
    pub fn origin(&self) -> Option<&Vector3<Real>> {
        self.origin.as_ref().map(Origin::p)
    }

    /// Joint angles counted from zero, rad.
    pub fn absolute(&self, q: &Vector3<Real>) -> Vector3<Real> {
        self.origin.map_or(*q, |origin| origin.q() + q)
    }

    fn pose(&self, q: &Vector3<Real>) -> Pose {
        match &self.origin {
            Some(origin) => origin.displaced(&self.kinematics, q),
            None => self.kinematics.at(q),
        }
    }

    /// One tick.
    ///
    /// # Errors
    /// [`NotFinite`], without supervision; the law stays as it was before the tick. With supervision that is a fault with a
    /// name and no torque.
    pub fn tick(&mut self, inputs: &Inputs) -> Result<Outputs, NotFinite> {
        let before = *self;
        match self.supervisor {
            Some(supervisor) => Ok(self.supervised(inputs, supervisor)),
            None => {
                let demand = if inputs.engage {
                    Demand::Run {
                        authority: 1.0,
                        freedom: if inputs.hold { 0.0 } else { 1.0 },
                    }
                } else {
                    Demand::Rest
                };
                let pose = self.pose(&inputs.q);
                let ft = self.sensed(&pose, inputs);
                self.run(&pose, &inputs.q, ft, demand)
                    .inspect_err(|NotFinite| *self = before)
            }
        }
    }

    /// One tick in which supervision decides. What cannot be trusted does not reach the law: without joint angles it rests
    /// where it last knew the arm to be, without a force it feels none.
    fn supervised(&mut self, inputs: &Inputs, mut supervisor: Supervisor) -> Outputs {
        let before = *self;
        let Inputs {
            signals,
            engage,
            hold,
            ..
        } = *inputs;
        let is_known = inputs.q.iter().all(|q| q.is_finite());
        let q = if is_known { inputs.q } else { self.q };
        let pose = self.pose(&q);
        let ft = self.sensed(&pose, &Inputs { q, ..*inputs });
        let demand = supervisor.step(&supervision::Inputs {
            enable: signals.enable,
            engage,
            acknowledge: signals.acknowledge,
            emergency_stop: signals.emergency_stop,
            hold,
            heartbeat: signals.heartbeat,
            ft_valid: ft.fault.is_none(),
            encoder_valid: signals.encoder_valid && is_known,
            force: ft.hand.force.norm(),
        });

        let is_seen = is_known && signals.encoder_valid;
        let ran = if demand == Demand::Rest && !is_seen {
            Ok(self.abandon(ft))
        } else {
            self.run(&pose, &q, ft, demand)
        };
        let status = supervisor.judge(&ran.as_ref().map_or(Report::NOT_FINITE, |ran| Report {
            finite: true,
            debt: self.ledger().is_in_debt(),
            outside_bounds: ran.outcome.outside_bounds,
            saturated: ran.outcome.saturated,
        }));
        let ran = ran.unwrap_or_else(|NotFinite| {
            *self = before;
            self.abandon(ft)
        });
        self.supervisor = Some(supervisor);
        Outputs { status, ..ran }
    }

    /// No torque, the nominal where the arm was last known to be.
    fn abandon(&mut self, ft: Conditioned) -> Outputs {
        let pose = self.pose(&self.q);
        self.stiff_hand = self.stiff_hand.at_rest();
        let (outcome, nominal) = self.form.abandon(&pose, &self.q);
        Outputs {
            outcome,
            nominal,
            pose,
            slowed: false,
            stiff_hand: self.stiff_hand,
            ft,
            status: Status::of(Demand::Rest),
        }
    }

    /// What the law does at joint angles `q` (rad), where the handle is at `pose`, with the hand as it is known; judged by
    /// nobody. After an error it is not as it was.
    fn run(
        &mut self,
        pose: &Pose,
        q: &Vector3<Real>,
        ft: Conditioned,
        demand: Demand,
    ) -> Result<Outputs, NotFinite> {
        let damping = if self.form.knows_singularities() {
            self.singularity.damping(pose.sigma_min)
        } else {
            0.0
        };
        let (outcome, nominal) = match demand {
            Demand::Run { authority, freedom } => {
                self.stiff_hand = self.stiff_hand.sensed(&pose.p, &ft.hand.force);
                let request = Request {
                    authority,
                    hold: freedom <= 0.0,
                    damping: Vector3::repeat(damping) + self.stiff_hand.D(),
                    speed: self.speed(freedom),
                };
                self.form.step(pose, q, &ft.hand.force, &request)
            }
            Demand::Rest => {
                self.stiff_hand = self.stiff_hand.at_rest();
                self.form.rest(pose, q)
            }
        };
        if !(outcome.is_finite() && self.ledger().G().is_finite()) {
            return Err(NotFinite);
        }
        self.q = *q;
        if !matches!(demand, Demand::Run { freedom, .. } if freedom < 1.0) {
            self.v_n = self.form.velocity(&outcome, &nominal);
        }
        Ok(Outputs {
            pose: *pose,
            outcome,
            nominal,
            slowed: demand != Demand::Rest && damping > 0.0,
            stiff_hand: self.stiff_hand,
            ft,
            status: Status::of(demand),
        })
    }

    /// Speed in each of its coordinates that a nominal of this `freedom` may have, m/s or rad/s: it brakes in equal steps.
    fn speed(&self, freedom: Real) -> Vector3<Real> {
        if freedom < 1.0 {
            self.v_n.map(|v| real::abs(v) * freedom)
        } else {
            Vector3::repeat(Real::INFINITY)
        }
    }

    /// What the hand does, in the base frame.
    fn sensed(&mut self, pose: &Pose, inputs: &Inputs) -> Conditioned {
        let turn = self.frame.at(pose);
        let ft = self.conditioner.step(&Sample {
            wrench: inputs.hand,
            R: turn.R(),
            q: self.absolute(&inputs.q),
            valid: inputs.ft_valid,
            tare: inputs.tare,
        });
        Conditioned {
            hand: Wrench {
                force: turn.to_base(&ft.hand.force),
                torque: turn.to_base(&ft.hand.torque),
            },
            ..ft
        }
    }

    /// What the hand's force sensor reads when nothing acts on it, as far as a tare has found it; sensor frame.
    pub fn bias(&self) -> Wrench {
        self.conditioner.bias()
    }

    /// Energy stored and created, as of the last tick; the work is that at the joints.
    pub fn ledger(&self) -> &Ledger<3> {
        self.form.ledger()
    }
}
