//! The complete law of the arm: from what is sensed at a tick to the torques on the joints.
//!
//! It knows no FMI: the FMU ArmController and the C library are shells around it. Who decides whether it runs stands
//! in `arm_law/decision.rs`, what a tick shows in `arm_law/show.rs`, from where positions are counted in `arm_law/counting.rs`.
//!
//! The way of a tick at which nothing is wrong is one long function: what it calls is inlined whatever its size, what is rare is
//! not.

mod counting;
mod decision;
mod show;

pub(crate) use show::{Done, Shown};

use crate::choices::POSITION_SERVO;
use crate::choices::WRENCH;
use crate::displacement::Origin;
use crate::kinematics::{Kinematics, Pose};
use crate::parameters::ArmParameters;
use crate::signals::{ArmInputs, ArmOutputs};
use crate::singularity::Singularity;
use crate::space::InSpace;
use crate::stiff_hand::{self, Detectors};
use crate::supervision::{Demand, Supervisor};
use crate::wrench::conditioner::{Made, Reading};
use crate::wrench::frame::FixedFrame;
use crate::wrench::{Conditioned, Conditioner, Wrench};
use admittance::encoder::{self, Believed, Encoders, Positions};
use admittance::origin;
use admittance::{Bounds, Ledger, ParameterError, Real, Request, real, timing};
use nalgebra::Vector3;

pub use crate::handle::{HandleTick, NotFinite};
pub use crate::space::Space;

/// The law between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ArmLaw {
    kinematics: Kinematics,
    singularity: Singularity,
    frame: FixedFrame,
    /// where the hand's force is read: ft.source
    source: i32,
    /// whether next to nothing is made of what is read
    plain: bool,
    bounds: [Bounds; 3],
    /// where angles and positions are counted from, if not from zero
    origin: Option<Origin>,
    counting: origin::Origin<3>,

    supervisor: Option<Supervisor>,
    encoders: Encoders<3>,
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
    pub fn new(parameters: &ArmParameters) -> Result<Self, ParameterError> {
        let checked = parameters.checked()?;
        let (kinematics, T) = (parameters.kinematics, checked.settings.T);
        Ok(Self {
            kinematics,
            singularity: parameters.singularity,
            stiff_hand: Detectors::new(parameters.stiff_hand, T)?,
            frame: parameters.ft.sensed_in().fixed(),
            source: parameters.ft.source,
            plain: parameters.ft.is_plain(),
            conditioner: Conditioner::new(parameters.ft, T)?,
            encoders: parameters.encoder.checks(&checked.reach, T),
            // Each is made in a function of its own: a stack that holds one of them at a time is a third as deep.
            law: match checked.space {
                Space::Task => InSpace::task(&checked, kinematics)?,
                Space::Joint if parameters.form == POSITION_SERVO => {
                    InSpace::servo(&checked, kinematics)?
                }
                Space::Joint => InSpace::joint(&checked, kinematics)?,
            },
            supervisor: checked
                .supervision
                .map(|supervision| Supervisor::new(&supervision, T))
                .transpose()?,
            q: Vector3::zeros(),
            v_n: Vector3::zeros(),
            bounds: checked.bounds,
            origin: None,
            counting: origin::Origin::default(),
        })
    }

    /// Other gains: on a straight line over the tuning time, each step taken over so that the stored energy does not rise. Of
    /// the parameters those that may be tuned count; the others are as they were when the law was built.
    ///
    /// # Errors
    /// The first gain out of its range; the gains stay as they were.
    pub fn tune(&mut self, parameters: &ArmParameters) -> Result<(), ParameterError> {
        let (gains, joint_gains) = parameters.tuned()?;
        self.law.tune(gains)?;
        self.law.tune_joints(joint_gains)
    }

    /// One tick, with joint angles that were read for it. What came of it is written into `outputs`.
    ///
    /// # Errors
    /// [`NotFinite`], without supervision: law and outputs stay as they were before the tick. With supervision that is a fault
    /// with a name and no torque.
    pub fn tick(&mut self, inputs: &ArmInputs, outputs: &mut ArmOutputs) -> Result<(), NotFinite> {
        self.tick_after(1.0, inputs, outputs)
    }

    /// The same with joint angles that were read `after` sample periods after those before them: 1 where the tick is in time.
    /// Any number that is not negative will do; velocities are those over this time.
    ///
    /// # Errors
    /// Those of [`tick`](Self::tick).
    pub fn tick_after(
        &mut self,
        after: Real,
        inputs: &ArmInputs,
        outputs: &mut ArmOutputs,
    ) -> Result<(), NotFinite> {
        if let InSpace::Servo(_) = self.law {
            self.tick_driven(after, inputs, outputs)
        } else {
            self.tick_reading(after, inputs, outputs)
        }
    }

    /// The same in servo form: the drives' torques are measured, and they are told what to do.
    #[cold]
    fn tick_driven(
        &mut self,
        after: Real,
        inputs: &ArmInputs,
        outputs: &mut ArmOutputs,
    ) -> Result<(), NotFinite> {
        let mut law = *self;
        if let InSpace::Servo(joints) = &mut law.law {
            joints.measure(inputs.tau_a_measured.into());
        }
        law.tick_reading(after, inputs, outputs)?;
        if let InSpace::Servo(joints) = &law.law {
            let [q_d, dq_d] = joints.told();
            outputs.q_d = q_d.cast::<f64>().into();
            outputs.dq_d = (*dq_d).into();
            outputs.drive_fault = joints.feedback().number();
        }
        *self = law;
        Ok(())
    }

    fn tick_reading(
        &mut self,
        after: Real,
        inputs: &ArmInputs,
        outputs: &mut ArmOutputs,
    ) -> Result<(), NotFinite> {
        let reading = Positions {
            q: inputs.q.into(),
            valid: inputs.encoder_valid != 0,
            after,
        };
        if !self.encoders.is_sound(&reading) {
            return self.tick_doubting(reading, inputs, outputs);
        }
        self.tick_at(&reading.believed(), after, inputs, outputs)?;
        self.encoders.keep(&reading);
        outputs.timing = timing::of(after);
        Ok(())
    }

    /// The same where not all is well with the joint angles.
    #[cold]
    #[inline(never)]
    fn tick_doubting(
        &mut self,
        reading: Positions<3>,
        inputs: &ArmInputs,
        outputs: &mut ArmOutputs,
    ) -> Result<(), NotFinite> {
        let mut encoders = self.encoders;
        let believed = encoders.read(&reading, self.counting.is_engaged(), self.law.tau());
        self.tick_at(&believed, reading.after, inputs, outputs)?;
        self.encoders = encoders;
        outputs.timing = timing::of(reading.after);
        Ok(())
    }

    /// Sample period, s.
    pub fn T(&self) -> Real {
        self.law.T()
    }

    /// A torque begins to act this `part` of a sample after its tick, in (0, 1), in place of a whole one:
    /// [`acts`](Self::acts) says where. Only with a delay.
    pub fn lag(&mut self, part: Real) {
        self.law.lag(part);
    }

    /// The torque of the last tick begins to act now, at the joint angles of the inputs.
    pub fn acts(&mut self, inputs: &ArmInputs) {
        let q = Vector3::from(inputs.q);
        let is_known = inputs.encoder_valid != 0 && self.encoders.is_near(&q);
        let q = self.counting.counted(&q);
        self.law.acts(is_known.then_some(&q));
    }

    /// One tick with what is `believed` of the joint angles.
    #[inline(always)]
    fn tick_at(
        &mut self,
        believed: &Believed<3>,
        after: Real,
        inputs: &ArmInputs,
        outputs: &mut ArmOutputs,
    ) -> Result<(), NotFinite> {
        let moves = believed
            .q
            .is_some_and(|q| self.counting.would_move(&q, self.may_engage(inputs)));
        if moves {
            self.tick_moving(believed, after, inputs, outputs)
        } else {
            self.tick_believing(believed, after, inputs, outputs)
        }
    }

    /// The same where the origin moves: seldom, and in single precision only. A tick that is refused leaves it where it was, too.
    #[cold]
    #[inline(never)]
    fn tick_moving(
        &mut self,
        believed: &Believed<3>,
        after: Real,
        inputs: &ArmInputs,
        outputs: &mut ArmOutputs,
    ) -> Result<(), NotFinite> {
        let mut law = *self;
        law.tick_believing(believed, after, inputs, outputs)?;
        *self = law;
        Ok(())
    }

    #[inline(always)]
    fn tick_believing(
        &mut self,
        believed: &Believed<3>,
        after: Real,
        inputs: &ArmInputs,
        outputs: &mut ArmOutputs,
    ) -> Result<(), NotFinite> {
        let q = believed.q.map(|q| self.counted(&q, inputs)).transpose()?;
        if self.supervisor.is_some() {
            self.supervised(inputs, q.as_ref(), believed, after, outputs);
            self.show_drift(outputs);
        } else {
            self.unsupervised(inputs, q.as_ref(), believed, after, outputs)?;
        }
        outputs.encoder_fault = believed.fault.map_or(0, encoder::Fault::number);
        self.counting.ticked(outputs.engaged != 0);
        Ok(())
    }

    /// What is shown before the first tick: a law at rest that has sensed no force.
    ///
    /// # Errors
    /// [`NotFinite`]: the joint angles are not, or numbers overflow.
    pub fn at_rest(&self, inputs: &ArmInputs, outputs: &mut ArmOutputs) -> Result<(), NotFinite> {
        let mut law = Self {
            supervisor: None,
            ..*self
        };
        let resting = ArmInputs {
            engage: 0,
            ..*inputs
        };
        law.tick(&resting, outputs)?;
        self.show_hand(&Conditioned::default(), outputs);
        Ok(())
    }

    /// What the law does at joint angles `q` (rad), where the handle is at `pose`, with the force `f_h` (N, base frame) of the
    /// hand and joint angles read `after` sample periods after those before; judged by nobody, and shown. After an error law
    /// and outputs are as they were.
    #[inline]
    fn run(
        &mut self,
        q: &Vector3<Real>,
        pose: &Pose,
        f_h: &Vector3<Real>,
        demand: Demand,
        after: Real,
        outputs: &mut ArmOutputs,
    ) -> Result<(), NotFinite> {
        let shown = Shown {
            outputs,
            origin: self.origin.as_ref(),
        };
        let damping = if self.law.knows_singularities() {
            self.singularity.damping(pose.sigma_min)
        } else {
            0.0
        };
        match demand {
            Demand::Run { authority, freedom } => {
                let seen = self.stiff_hand.sensed(&pose.p, f_h);
                let damping = Vector3::repeat(damping);
                let request = Request {
                    authority,
                    hold: freedom <= 0.0,
                    damping: seen
                        .as_ref()
                        .map_or(damping, |seen| damping + stiff_hand::damping(seen)),
                    speed: self.speed(freedom),
                    after,
                };
                self.law.step(pose, q, f_h, &request, shown)?;
                self.stiff_hand.keep(seen.as_ref());
                if freedom >= 1.0 {
                    self.v_n = self.law.velocity(outputs);
                }
            }
            Demand::Rest => {
                self.law.rest(pose, q, shown)?;
                self.stiff_hand.rest();
                self.v_n = self.law.velocity(outputs);
            }
        }
        self.q = *q;
        outputs.slowed = i32::from(demand != Demand::Rest && damping > 0.0);
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

    /// The raw reading of the hand's sensor, sensor frame.
    #[inline]
    fn wrench(&self, inputs: &ArmInputs) -> Wrench {
        let (force, torque) = if self.source == WRENCH {
            (inputs.ft_force, inputs.ft_torque)
        } else {
            (inputs.f_h, [0.0; 3])
        };
        Wrench {
            force: force.into(),
            torque: torque.into(),
        }
    }

    /// What the hand does at joint angles `q` (rad), where the handle is at `pose`: in the base frame. What the sensor's
    /// conditioning is to remember of it is written into `made`.
    #[inline(always)]
    fn sensed(
        &self,
        q: &Vector3<Real>,
        pose: &Pose,
        inputs: &ArmInputs,
        made: &mut Made,
    ) -> Conditioned {
        let reading = Reading {
            wrench: &self.wrench(inputs),
            valid: inputs.ft_valid != 0,
            tare: inputs.ft_tare != 0,
        };
        if self.plain {
            if let Some(hand) = self.conditioner.plainly(&reading) {
                return hand;
            }
        }
        self.conditioned(q, pose, &reading, made)
    }

    /// The same with all that may be made of a reading.
    #[inline(never)]
    fn conditioned(
        &self,
        q: &Vector3<Real>,
        pose: &Pose,
        reading: &Reading<'_>,
        made: &mut Made,
    ) -> Conditioned {
        let turn = self.frame.at(pose);
        let (R, absolute) = (|| turn.R(), || self.absolute(q));
        let hand = self.conditioner.sampled(reading, R, absolute, made);
        Conditioned {
            hand: Wrench {
                force: turn.in_base(&hand.hand.force),
                torque: turn.in_base(&hand.hand.torque),
            },
            ..hand
        }
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
