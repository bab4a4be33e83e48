//! The law in joint space for joints with position or velocity drives (footnote of sec:standard_adm): [`admittance::servo`] of three joints.
//!
//! Each joint's drive closes K (dq_d − dq + K_P (q_d − q)) within ±tau_max by itself, with K = joint.K, K_P = joint.K_P and
//! tau_max of that joint. In task space the coupling turns with J(q), and no drive of a joint can close it.
//!
//! Out of the loop, in a fault, and where the angles are not known, the drives are told to stand still. The authority of a
//! [`Request`] has no meaning here: the torque is the drives'. What fades in and out in torque form begins and ends with a
//! nominal at rest at the sensed angles instead.

use super::joints::Angles;
use super::law::{of_the_joints, show, show_rest};
use super::{JointGains, JointParameters, Joints, Nominal};
use crate::handle::{HandleTick, NotFinite};
use crate::kinematics::{Kinematics, Pose};
use crate::workspace::Workspace;
use admittance::servo::{Command, Feedback, Inputs, Servo};
use admittance::{Ledger, ParameterError, Reach, Real, Request, Settings};
use nalgebra::Vector3;

/// The law between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct JointServo {
    servo: Servo<Joints, 3>,
    tau_max: Vector3<Real>,
    /// what the drives measured over the sample that ends at the next tick, N·m
    measured: Vector3<Real>,
    /// what they are told, rad and rad/s
    q_d: Vector3<Real>,
    dq_d: Vector3<Real>,
}

impl JointServo {
    /// A law out of the loop, whose drives give up to `tau_max` (N·m).
    ///
    /// # Errors
    /// The first parameter of the law out of its range, or a law without a servo form.
    pub fn new(
        settings: Settings,
        parameters: &JointParameters,
        kinematics: Kinematics,
        reach: Reach<3>,
        tau_max: Vector3<Real>,
    ) -> Result<Self, ParameterError> {
        let joints = parameters.joints(settings, kinematics, tau_max)?;
        Ok(Self {
            servo: Servo::of(joints, &reach)?,
            tau_max,
            measured: Vector3::zeros(),
            q_d: Vector3::zeros(),
            dq_d: Vector3::zeros(),
        })
    }

    /// The same with a nominal that keeps within the angles of `workspace`, which has been checked; `None`: it may go
    /// anywhere.
    #[must_use]
    pub fn within(mut self, workspace: Option<Workspace>) -> Self {
        self.servo.law_mut().keep_within(workspace);
        self
    }

    /// Another nominal damping: on a straight line over the tuning time. K and K_P are the drives' as well, which this law
    /// cannot change.
    ///
    /// # Errors
    /// A gain out of its range, or a gain of the drives other than it was; all gains stay as they were.
    pub fn tune(&mut self, gains: JointGains) -> Result<(), ParameterError> {
        gains.check()?;
        let gains = JointGains {
            tau_max: self.tau_max,
            ..gains
        };
        let names = ["joint.K", "joint.K_P", "tau_max"];
        self.servo.law().of_the_drives(&gains, names)?;
        self.servo.law_mut().tune(gains)
    }

    /// What the drives measured over the sample that ends at the next tick: means of their torques on the joints, N·m.
    pub fn measure(&mut self, tau_m: Vector3<Real>) {
        self.measured = tau_m;
    }

    /// One tick, as [`JointSpace::step`](super::JointSpace::step).
    ///
    /// # Errors
    /// A result that is not finite: the law is as it was.
    pub fn step(
        &mut self,
        pose: &Pose,
        q: &Vector3<Real>,
        f_h: &Vector3<Real>,
        request: &Request<3>,
        shown: &mut HandleTick,
        nominal: &mut Nominal,
    ) -> Result<(), NotFinite> {
        let kinematics = *self.servo.law().kinematics();
        let inputs = Inputs {
            place: &Angles::with(q, &pose.sin_cos),
            q,
            f_h: &pose.J.tr_mul(f_h),
            tau_m: &self.measured,
            request: &of_the_joints(pose, request),
            after: request.after,
        };
        let (q_d, dq_d) = (&mut self.q_d, &mut self.dq_d);
        let accept = |command: &Command<3>, G: Real| {
            show(&kinematics, pose, &command.tick, shown, nominal);
            let accepted = shown.is_finite() && command.is_finite() && G.is_finite();
            if accepted {
                (*q_d, *dq_d) = (command.q_d, command.dq_d);
            }
            accepted
        };
        self.servo.tick(&inputs, accept)?;
        nominal.M_n = self.servo.law().M_n(&pose.sin_cos);
        Ok(())
    }

    /// One tick out of the loop: the drives are told to stand still at `q` (rad).
    ///
    /// # Errors
    /// A result that is not finite: the law is as it was.
    pub fn rest(
        &mut self,
        pose: &Pose,
        q: &Vector3<Real>,
        shown: &mut HandleTick,
        nominal: &mut Nominal,
    ) -> Result<(), NotFinite> {
        let outside = self.servo.rest(q, &self.measured, |G| {
            G.is_finite() && HandleTick::at_rest(&pose.p, false).is_finite()
        })?;
        self.stand(pose, q, outside, shown, nominal);
        Ok(())
    }

    /// The same where the angles at this tick are not known, or no numbers. `q` (rad) and `pose` are the last that were.
    pub fn abandon(
        &mut self,
        pose: &Pose,
        q: &Vector3<Real>,
        shown: &mut HandleTick,
        nominal: &mut Nominal,
    ) {
        let known = self.measured.iter().all(|tau| tau.is_finite());
        let tau_m = if known {
            self.measured
        } else {
            *self.servo.tau_m()
        };
        let outside = self.servo.abandon(&tau_m);
        self.stand(pose, q, outside, shown, nominal);
    }

    fn stand(
        &mut self,
        pose: &Pose,
        q: &Vector3<Real>,
        outside: bool,
        shown: &mut HandleTick,
        nominal: &mut Nominal,
    ) {
        (self.q_d, self.dq_d) = (*q, Vector3::zeros());
        show_rest(self.servo.law(), pose, q, outside, shown, nominal);
    }

    /// Angles (rad) and velocities (rad/s) that the drives are told.
    pub const fn told(&self) -> [&Vector3<Real>; 2] {
        [&self.q_d, &self.dq_d]
    }

    /// What is wrong with what the drives measure.
    pub fn feedback(&self) -> &Feedback<3> {
        self.servo.feedback()
    }

    /// Sample period, s.
    pub fn T(&self) -> Real {
        self.servo.T()
    }

    /// What the drives measured at the last tick, N·m.
    pub fn tau(&self) -> &Vector3<Real> {
        self.servo.tau_m()
    }

    /// Energy stored and created, as of the last tick.
    pub fn ledger(&self) -> &Ledger<3> {
        self.servo.ledger()
    }
}
