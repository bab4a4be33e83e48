//! The complete law of the arm: from what is sensed at a tick to the torques on the joints.
//!
//! It knows no FMI: the FMU ArmController and the C library are shells around it.

use crate::choices::WRENCH;
use crate::displacement::Origin;
use crate::form::Form;
use crate::joint_space::Nominal;
use crate::kinematics::{Kinematics, Pose};
use crate::parameters::{ArmParameters, Checked};
use crate::signals::{ArmInputs, ArmOutputs};
use crate::singularity::Singularity;
use crate::stiff_hand::Detectors;
use crate::supervision::{self, Demand, Report, Status, Supervisor};
use crate::task_space::Outcome;
use crate::wrench::{Conditioned, Conditioner, Fault, Frame, Sample, TareFailure, Wrench};
use admittance::origin::{self, Move};
use admittance::{Bounds, Ledger, ParameterError, Real, Request, real};
use nalgebra::Vector3;

pub use crate::form::Space;

/// What came of a tick, before it is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Ran {
    pose: Pose,
    outcome: Outcome,
    /// the nominal in joint coordinates; in task space, where it has none, the robot at rest, M_n 0
    nominal: Nominal,
    slowed: bool,
    stiff_hand: Detectors,
    ft: Conditioned,
    /// what supervision says; without it, that the law does what `engage` and `hold` say
    status: Status,
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
    source: i32,
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
    counting: origin::Origin<3>,
}

impl ArmLaw {
    /// A law out of the loop.
    ///
    /// # Errors
    /// The first parameter out of its range, a law that is not offered, or limits that do not suit it.
    pub fn new(parameters: &ArmParameters) -> Result<Self, ParameterError> {
        let Checked {
            settings,
            gains,
            bounds,
            reach,
            limits,
            space,
            joint,
            supervision,
        } = parameters.checked()?;
        let (kinematics, T) = (parameters.kinematics, settings.T);
        Ok(Self {
            kinematics,
            singularity: parameters.singularity,
            stiff_hand: Detectors::new(parameters.stiff_hand, T)?,
            frame: parameters.ft.sensed_in(),
            source: parameters.ft.source,
            conditioner: Conditioner::new(parameters.ft, T)?,
            form: match space {
                Space::Task => Form::task(settings, gains, bounds, reach, limits)?,
                Space::Joint => Form::joint(settings, &joint, kinematics, reach, limits)?,
            },
            supervisor: supervision
                .map(|supervision| Supervisor::new(&supervision, T))
                .transpose()?,
            q: Vector3::zeros(),
            v_n: Vector3::zeros(),
            bounds,
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
        self.form.tune(gains)?;
        self.form.tune_joints(joint_gains)
    }

    /// Counts from the joint angles `q_0` (rad) and from where the handle is there, from the next tick on: `q` of the
    /// [`ArmInputs`], and p, p_n of the [`ArmOutputs`]. The [`Bounds`] stay where they are. Only while the law is out of the loop,
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

    /// One tick, whose results stand in `outputs`.
    ///
    /// # Errors
    /// [`NotFinite`], without supervision; law and outputs stay as they were before the tick. With supervision that is a fault
    /// with a name and no torque.
    pub fn tick(&mut self, inputs: &ArmInputs, outputs: &mut ArmOutputs) -> Result<(), NotFinite> {
        let before = *self;
        let ran = self.ran(inputs).inspect_err(|NotFinite| *self = before)?;
        self.counting.ticked(ran.outcome.engaged);
        self.show(&ran, outputs);
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
        law.tick(
            &ArmInputs {
                engage: 0,
                ..*inputs
            },
            outputs,
        )?;
        law.show_hand(&Conditioned::NOTHING, outputs);
        Ok(())
    }

    fn ran(&mut self, inputs: &ArmInputs) -> Result<Ran, NotFinite> {
        let q = Vector3::from(inputs.q);
        // In joint space the law counts from zero: the nominal arm is one at the angles themselves.
        let may_engage = inputs.engage != 0 && matches!(self.form, Form::Task(_));
        if let Some(Move { q_0, .. }) = self.counting.moves(&q, may_engage) {
            self.count_from(&q_0).map_err(|_| NotFinite)?;
        }
        let q = self.counting.counted(&q);
        if let Some(supervisor) = self.supervisor {
            return Ok(self.supervised(inputs, q, supervisor));
        }
        let demand = if inputs.engage != 0 {
            Demand::Run {
                authority: 1.0,
                freedom: if inputs.hold != 0 { 0.0 } else { 1.0 },
            }
        } else {
            Demand::Rest
        };
        let pose = self.pose(&q);
        let ft = self.sensed(&pose, &q, inputs);
        self.run(&pose, &q, ft, demand)
    }

    /// One tick in which supervision decides. What cannot be trusted does not reach the law: without joint angles it rests
    /// where it last knew the arm to be, without a force it feels none.
    fn supervised(
        &mut self,
        inputs: &ArmInputs,
        q: Vector3<Real>,
        mut supervisor: Supervisor,
    ) -> Ran {
        let before = *self;
        let is_known = q.iter().all(|q| q.is_finite());
        let q = if is_known { q } else { self.q };
        let pose = self.pose(&q);
        let ft = self.sensed(&pose, &q, inputs);
        let is_seen = is_known && inputs.encoder_valid != 0;
        let demand = supervisor.step(&supervision::Inputs {
            enable: inputs.enable != 0,
            engage: inputs.engage != 0,
            acknowledge: inputs.acknowledge != 0,
            emergency_stop: inputs.emergency_stop != 0,
            hold: inputs.hold != 0,
            heartbeat: inputs.heartbeat,
            ft_valid: ft.fault.is_none(),
            encoder_valid: is_seen,
            force: ft.hand.force.norm(),
        });

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
        Ran { status, ..ran }
    }

    /// No torque, the nominal where the arm was last known to be.
    fn abandon(&mut self, ft: Conditioned) -> Ran {
        let pose = self.pose(&self.q);
        self.stiff_hand = self.stiff_hand.at_rest();
        let (outcome, nominal) = self.form.abandon(&pose, &self.q);
        Ran {
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
    ) -> Result<Ran, NotFinite> {
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
        Ok(Ran {
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
    fn sensed(&mut self, pose: &Pose, q: &Vector3<Real>, inputs: &ArmInputs) -> Conditioned {
        let turn = self.frame.at(pose);
        let (force, torque) = if self.source == WRENCH {
            (inputs.ft_force, inputs.ft_torque)
        } else {
            (inputs.f_h, [0.0; 3])
        };
        let ft = self.conditioner.step(&Sample {
            wrench: Wrench {
                force: force.into(),
                torque: torque.into(),
            },
            R: turn.R(),
            q: self.absolute(q),
            valid: inputs.ft_valid != 0,
            tare: inputs.ft_tare != 0,
        });
        Conditioned {
            hand: Wrench {
                force: turn.to_base(&ft.hand.force),
                torque: turn.to_base(&ft.hand.torque),
            },
            ..ft
        }
    }

    fn show(&self, ran: &Ran, outputs: &mut ArmOutputs) {
        let Ran {
            pose,
            outcome,
            nominal,
            slowed,
            stiff_hand,
            ft,
            status,
        } = ran;
        let absolute = |p: Vector3<Real>| self.origin().map_or(p, |p_0| p_0 + p).into();
        outputs.tau_a = outcome.tau.into();
        outputs.tau_demand = outcome.tau_demand.into();
        outputs.f_a = outcome.f_a.into();
        outputs.p = absolute(pose.p);
        outputs.dp = outcome.dp.into();
        outputs.p_n = absolute(outcome.p_n);
        outputs.dp_n = outcome.dp_n.into();
        outputs.e_nr = outcome.e_nr.into();
        outputs.sigma_min = pose.sigma_min;
        outputs.saturated = outcome.saturated.into();
        outputs.held = outcome.held.into();
        outputs.outside_bounds = outcome.outside_bounds.into();
        outputs.engaged = outcome.engaged.into();
        outputs.slowed = i32::from(*slowed);
        outputs.q_n = self.absolute(&nominal.q_n).into();
        outputs.dq_n = nominal.dq_n.into();
        outputs.e_q = nominal.e_nr.into();
        outputs.M_n = core::array::from_fn(|i| nominal.M_n[(i / 3, i % 3)]);
        outputs.stiff_hand_detected = stiff_hand.detected().into();
        outputs.stiff_hand_D = stiff_hand.D().into();
        outputs.stiff_hand_k_h = stiff_hand.k_h().into();
        outputs.state = status.state.number();
        outputs.diagnostic = status.diagnostic.number();
        outputs.first_fault = status.first_fault.number();
        outputs.authority = status.authority;
        let ledger = self.ledger();
        outputs.H = ledger.H();
        outputs.G = ledger.G();
        outputs.tank = ledger.tank();
        outputs.debt = ledger.is_in_debt().into();
        outputs.share = outcome.share;
        self.show_hand(ft, outputs);
    }

    fn show_hand(&self, ft: &Conditioned, outputs: &mut ArmOutputs) {
        outputs.ft_f_h = ft.hand.force.into();
        outputs.ft_moment = ft.hand.torque.into();
        outputs.ft_fault = ft.fault.map_or(0, Fault::number);
        outputs.ft_tare_state = ft.tare.number();
        outputs.ft_tare_failure = ft.tare.failure().map_or(0, TareFailure::number);
        let bias = self.conditioner.bias();
        outputs.ft_bias_force = bias.force.into();
        outputs.ft_bias_torque = bias.torque.into();
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
