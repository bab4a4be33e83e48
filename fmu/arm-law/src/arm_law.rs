//! The complete law of the arm: from what is sensed at a tick to the torques on the joints.
//!
//! It knows no FMI: the FMU ArmController and the C library are shells around it.

use crate::displacement::Origin;
use crate::joint_space::{JointGains, JointParameters, JointSpace, Nominal};
use crate::kinematics::{Kinematics, Pose, sin_cos};
use crate::limits::Limits;
use crate::singularity::Singularity;
use crate::space::InSpace;
use crate::stiff_hand::{self, Detectors, StiffHandSeen};
use crate::supervision::{self, Demand, Report, Status, Supervisor};
use crate::task_space::TaskSpace;
use crate::wrench::conditioner::{Made, Reading};
use crate::wrench::frame::FixedFrame;
use crate::wrench::{Conditioned, Conditioner, Frame, Sensor, Wrench};
use admittance::hand::StiffHand;
use admittance::{Bounds, Gains, Ledger, ParameterError, Reach, Real, Request, Settings, real};
use nalgebra::{Matrix3, Vector3};

pub use crate::handle::{HandleTick, NotFinite};
pub use crate::space::Space;

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
    pub outcome: HandleTick,
    /// The nominal in joint coordinates; in task space, where it has none, the robot at rest, M_n 0.
    pub nominal: Nominal,
    /// Whether the nominal is slowed before a singularity.
    pub slowed: bool,
    /// What is known of a stiff hand, after this tick.
    pub stiff_hand: StiffHandSeen,
    /// What the law knows of the hand: about the handle, in the base frame.
    pub ft: Conditioned,
    /// What supervision says; without it, that the law does what `engage` and `hold` say.
    pub status: Status,
}

impl Default for Outputs {
    /// Of a law that has not had a tick.
    fn default() -> Self {
        let q = Vector3::zeros();
        let pose = Kinematics::default().at(&q);
        Self {
            outcome: HandleTick::at_rest(&pose.p, false),
            pose,
            nominal: Nominal::at(&q, Matrix3::zeros()),
            slowed: false,
            stiff_hand: StiffHandSeen::default(),
            ft: Conditioned::default(),
            status: Status::of(Demand::Rest),
        }
    }
}

/// The law between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ArmLaw {
    kinematics: Kinematics,
    singularity: Singularity,
    frame: FixedFrame,
    bounds: [Bounds; 3],
    /// where angles and positions are counted from, if not from zero
    origin: Option<Origin>,

    supervisor: Option<Supervisor>,
    conditioner: Conditioner,
    stiff_hand: Detectors,
    law: InSpace,
    /// the joint angles of the last tick that had a result, rad
    q: Vector3<Real>,
    /// the nominal's velocity at the last tick at which it was free, in its own coordinates: m/s or rad/s
    v_n: Vector3<Real>,
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
            frame: parameters.frame.fixed(),
            conditioner: Conditioner::new(parameters.sensor, parameters.settings.T)?,
            law: match parameters.space {
                Space::Task => InSpace::Task(TaskSpace::new(
                    parameters.settings,
                    parameters.gains,
                    parameters.bounds,
                    parameters.reach,
                    parameters.limits,
                )?),
                Space::Joint => InSpace::Joint(JointSpace::new(
                    parameters.settings,
                    &parameters.joint,
                    parameters.kinematics,
                    parameters.reach,
                    parameters.limits,
                )?),
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
        self.law.tune(gains)
    }

    /// Other gains of the joints, likewise. In task space they are checked and have no effect.
    ///
    /// # Errors
    /// The first gain out of its range; the gains stay as they were.
    pub fn tune_joints(&mut self, gains: JointGains) -> Result<(), ParameterError> {
        self.law.tune_joints(gains)
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
        let task_space = match &mut self.law {
            InSpace::Task(law) => law,
            InSpace::Joint(_) => return Ok(()),
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

    /// Brings `pose` to the joint angles `q` (rad).
    #[inline]
    fn turn(&self, pose: &mut Pose, q: &Vector3<Real>) {
        match &self.origin {
            Some(origin) => *pose = origin.displaced(&self.kinematics, q),
            None => self.kinematics.turn(pose, &sin_cos(q)),
        }
    }

    /// One tick. What came of it is written into `outputs`.
    ///
    /// # Errors
    /// [`NotFinite`], without supervision; the law stays as it was before the tick, and `outputs` are not to be used. With
    /// supervision that is a fault with a name and no torque.
    pub fn tick(&mut self, inputs: &Inputs, outputs: &mut Outputs) -> Result<(), NotFinite> {
        if self.supervisor.is_some() {
            self.supervised(inputs, outputs);
            return Ok(());
        }
        let demand = match (inputs.engage, inputs.hold) {
            (false, _) => Demand::Rest,
            (true, hold) => Demand::Run {
                authority: 1.0,
                freedom: if hold { 0.0 } else { 1.0 },
            },
        };
        self.turn(&mut outputs.pose, &inputs.q);
        let made = self.sensed(&inputs.q, inputs, outputs);
        self.run(&inputs.q, demand, outputs)?;
        self.conditioner.keep(&made);
        outputs.status = Status::of(demand);
        Ok(())
    }

    /// One tick in which supervision decides. What cannot be trusted does not reach the law: without joint angles it rests
    /// where it last knew the arm to be, without a force it feels none.
    fn supervised(&mut self, inputs: &Inputs, outputs: &mut Outputs) {
        let signals = &inputs.signals;
        let is_known = inputs.q.iter().all(|q| q.is_finite());
        let q = if is_known { inputs.q } else { self.q };
        self.turn(&mut outputs.pose, &q);
        let made = self.sensed(&q, inputs, outputs);
        let demand = self.decided(&supervision::Inputs {
            enable: signals.enable,
            engage: inputs.engage,
            acknowledge: signals.acknowledge,
            emergency_stop: signals.emergency_stop,
            hold: inputs.hold,
            heartbeat: signals.heartbeat,
            ft_valid: outputs.ft.fault.is_none(),
            encoder_valid: signals.encoder_valid && is_known,
            force: outputs.ft.hand.force.norm(),
        });

        let is_seen = is_known && signals.encoder_valid;
        let ran = if demand == Demand::Rest && !is_seen {
            self.abandon(outputs);
            Ok(())
        } else {
            self.run(&q, demand, outputs)
        };
        let report = match ran {
            Ok(()) => {
                self.conditioner.keep(&made);
                Report {
                    finite: true,
                    debt: self.ledger().is_in_debt(),
                    outside_bounds: outputs.outcome.outside_bounds,
                    saturated: outputs.outcome.saturated,
                }
            }
            Err(NotFinite) => {
                self.abandon(outputs);
                Report::NOT_FINITE
            }
        };
        if let Some(supervisor) = &mut self.supervisor {
            outputs.status = supervisor.judge(&report);
        }
    }

    /// What supervision demands; without it, rest.
    fn decided(&mut self, inputs: &supervision::Inputs) -> Demand {
        match &mut self.supervisor {
            Some(supervisor) => supervisor.step(inputs),
            None => Demand::Rest,
        }
    }

    /// No torque, the nominal where the arm was last known to be.
    #[cold]
    fn abandon(&mut self, outputs: &mut Outputs) {
        let Outputs {
            pose,
            outcome,
            nominal,
            ..
        } = outputs;
        self.turn(pose, &self.q);
        self.stiff_hand.rest();
        self.law.abandon(pose, &self.q, outcome, nominal);
        outputs.slowed = false;
        outputs.stiff_hand = self.stiff_hand.known();
    }

    /// What the law does at joint angles `q` (rad), with the pose and the hand in `outputs`; judged by nobody. After an error
    /// it is as it was.
    #[inline]
    fn run(
        &mut self,
        q: &Vector3<Real>,
        demand: Demand,
        outputs: &mut Outputs,
    ) -> Result<(), NotFinite> {
        let Outputs {
            pose,
            outcome,
            nominal,
            ft,
            ..
        } = outputs;
        let damping = if self.law.knows_singularities() {
            self.singularity.damping(pose.sigma_min)
        } else {
            0.0
        };
        match demand {
            Demand::Run { authority, freedom } => {
                let f_h = &ft.hand.force;
                let seen = self.stiff_hand.sensed(&pose.p, f_h);
                let of_hand = seen
                    .as_ref()
                    .map_or_else(Vector3::zeros, stiff_hand::damping);
                let request = Request {
                    authority,
                    hold: freedom <= 0.0,
                    damping: Vector3::repeat(damping) + of_hand,
                    speed: self.speed(freedom),
                };
                self.law.step(pose, q, f_h, &request, outcome, nominal)?;
                self.stiff_hand.keep(seen.as_ref());
                if freedom >= 1.0 {
                    self.v_n = *self.law.velocity(outcome, nominal);
                }
            }
            Demand::Rest => {
                self.law.rest(pose, q, outcome, nominal)?;
                self.stiff_hand.rest();
                self.v_n = *self.law.velocity(outcome, nominal);
            }
        }
        self.q = *q;
        outputs.slowed = demand != Demand::Rest && damping > 0.0;
        outputs.stiff_hand = self.stiff_hand.known();
        Ok(())
    }

    /// Speed in each of its coordinates that a nominal of this `freedom` may have, m/s or rad/s: it brakes in equal steps.
    fn speed(&self, freedom: Real) -> Vector3<Real> {
        if freedom < 1.0 {
            self.v_n.map(|v| real::abs(v) * freedom)
        } else {
            Vector3::repeat(Real::INFINITY)
        }
    }

    /// What the hand does, with the pose in `outputs` and joint angles `q` (rad): into `outputs` in the base frame. What the
    /// sensor's conditioning is to remember of it is returned.
    #[inline]
    fn sensed(&self, q: &Vector3<Real>, inputs: &Inputs, outputs: &mut Outputs) -> Made {
        let turn = self.frame.at(&outputs.pose);
        let reading = Reading {
            wrench: &inputs.hand,
            valid: inputs.ft_valid,
            tare: inputs.tare,
        };
        let (R, absolute) = (|| turn.R(), || self.absolute(q));
        let (made, hand) = self.conditioner.sampled(&reading, R, absolute);
        outputs.ft = Conditioned {
            hand: Wrench {
                force: turn.in_base(&hand.hand.force),
                torque: turn.in_base(&hand.hand.torque),
            },
            ..hand
        };
        made
    }

    /// What the hand's force sensor reads when nothing acts on it, as far as a tare has found it; sensor frame.
    pub fn bias(&self) -> Wrench {
        self.conditioner.bias()
    }

    /// Energy stored and created, as of the last tick; the work is that at the joints.
    pub fn ledger(&self) -> &Ledger<3> {
        self.law.ledger()
    }
}
