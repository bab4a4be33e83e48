//! One tick of the law in joint space: what [`TaskSpace`](crate::task_space::TaskSpace) is at the handle.
//!
//! Coordinates, torques and ledger are all the joints', so the work tau·Δq is exact as it stands.

use super::joints::Angles;
use super::{JointGains, JointRequest, Joints};
use crate::handle::{HandleTick, NotFinite};
use crate::kinematics::{Kinematics, Pose, sin_cos};
use crate::limits::{AtTheJoints, Limits};
use crate::nominal::NominalArm;
use crate::workspace::Workspace;
use admittance::tick::{Inputs, Sampled, Tick};
use admittance::{Bounds, Ledger, ParameterError, Reach, Real, Request, Settings};
use nalgebra::{Matrix3, Vector3};

/// What the law in joint space is built from, beside what both spaces have.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct JointParameters {
    /// The arm that the human is to feel.
    pub arm: NominalArm,
    /// Its damping and coupling.
    pub gains: JointGains,
    /// Limits of the nominal's angles (rad) and velocities (rad/s).
    pub bounds: [Bounds; 3],
}

impl JointParameters {
    /// The joints out of the loop, whose torques are limited to `tau_max` (N·m).
    ///
    /// # Errors
    /// The first parameter of the law out of its range.
    pub(super) fn joints(
        &self,
        settings: Settings,
        kinematics: Kinematics,
        tau_max: Vector3<Real>,
    ) -> Result<Joints, ParameterError> {
        let Self { arm, gains, bounds } = *self;
        let mut joints = Joints::new(settings, arm, kinematics, JointGains { tau_max, ..gains })?;
        joints.bound(bounds)?;
        Ok(joints)
    }
}

/// The law between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct JointSpace {
    sampled: Sampled<Joints, 3>,
    limits: Limits,
}

/// The nominal in joint coordinates at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nominal {
    /// Nominal angles q_n, rad.
    pub q_n: Vector3<Real>,
    /// Nominal velocities dq_n, rad/s.
    pub dq_n: Vector3<Real>,
    /// q_n − q after the slip, rad.
    pub e_nr: Vector3<Real>,
    /// M_n(q), kg·m².
    pub M_n: Matrix3<Real>,
}

impl Nominal {
    /// At the sensed angles `q` (rad), at rest, with the mass matrix `M_n` (kg·m²).
    pub fn at(q: &Vector3<Real>, M_n: Matrix3<Real>) -> Self {
        Self {
            M_n,
            q_n: *q,
            dq_n: Vector3::zeros(),
            e_nr: Vector3::zeros(),
        }
    }
}

impl JointSpace {
    /// A law out of the loop. The caller has checked `limits`, whose tau_max stands in for that of the gains.
    ///
    /// # Errors
    /// The first parameter of the law out of its range, or a law that is not offered.
    pub fn new(
        settings: Settings,
        parameters: &JointParameters,
        kinematics: Kinematics,
        reach: Reach<3>,
        limits: Limits,
    ) -> Result<Self, ParameterError> {
        reach.check()?;
        let joints = parameters.joints(settings, kinematics, limits.tau_max)?;
        Ok(Self {
            sampled: Sampled::new(joints, &reach)?.rated(&limits.tau_rate)?,
            limits,
        })
    }

    /// The same with a nominal that keeps within the angles of `workspace`, which has been checked; `None`: it may go
    /// anywhere.
    #[must_use]
    pub fn within(mut self, workspace: Option<Workspace>) -> Self {
        self.sampled.law_mut().keep_within(workspace);
        self
    }

    /// Other gains: on a straight line over the tuning time, each step taken over so that the stored energy does not rise.
    ///
    /// # Errors
    /// The first gain out of its range; the gains stay as they were.
    pub fn tune(&mut self, gains: JointGains) -> Result<(), ParameterError> {
        let tau_max = self.limits.tau_max;
        self.sampled.law_mut().tune(JointGains { tau_max, ..gains })
    }

    /// One tick at joint angles `q` (rad), where the handle is at `pose`, with the human's force `f_h` (N, base frame). The
    /// nominal is `shown` also as the handle that it amounts to.
    ///
    /// The speed that is requested is the joints', rad/s. Damping that is requested at the handle acts on the joints as d JᵀJ
    /// with d the largest of the three axes: alike in all directions, which keeps yaw and pitch apart.
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
        let kinematics = *self.sampled.law().kinematics();
        let inputs = Inputs {
            place: &Angles::with(q, &pose.sin_cos),
            q,
            f_h: &pose.J.tr_mul(f_h),
            authority: request.authority(),
            request: &of_the_joints(pose, request),
            after: request.after,
        };
        let accept = |tick: &Tick<3>, G: Real| {
            show(&kinematics, pose, tick, shown, nominal);
            shown.is_finite() && G.is_finite()
        };
        self.sampled
            .tick(&inputs, &AtTheJoints(&self.limits), accept)?;
        nominal.M_n = self.sampled.law().M_n(&pose.sin_cos);
        Ok(())
    }

    /// One tick out of the loop: no torque, the nominal where the robot is. The energy that was stored is given up; the next
    /// [`step`](Self::step) engages anew.
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
        let outside = self.sampled.rest(q, |G| {
            G.is_finite() && HandleTick::at_rest(&pose.p, false).is_finite()
        })?;
        show_rest(self.sampled.law(), pose, q, outside, shown, nominal);
        Ok(())
    }

    /// The same where the robot's angles at this tick are not known, or no numbers: the tank pays for the most that the
    /// torques can have done since the last one. `q` (rad) and `pose` are the last that were known.
    pub fn abandon(
        &mut self,
        pose: &Pose,
        q: &Vector3<Real>,
        shown: &mut HandleTick,
        nominal: &mut Nominal,
    ) {
        let outside = self.sampled.abandon();
        show_rest(self.sampled.law(), pose, q, outside, shown, nominal);
    }

    /// Sample period, s.
    pub fn T(&self) -> Real {
        self.sampled.T()
    }

    /// A torque begins to act this `part` of a sample after its tick, in (0, 1): [`acts`](Self::acts) says where. Only with
    /// a delay.
    pub fn lag(&mut self, part: Real) {
        self.sampled.lag(part);
    }

    /// The torque of the last tick begins to act at the joint angles `q` (rad); `None` where they are not known.
    pub fn acts(&mut self, q: Option<&Vector3<Real>>) {
        self.sampled.acts(q);
    }

    /// What the joints last got, N·m.
    pub fn tau(&self) -> &Vector3<Real> {
        self.sampled.tau()
    }

    /// Energy stored and created, as of the last tick.
    pub fn ledger(&self) -> &Ledger<3> {
        self.sampled.ledger()
    }
}

/// A tick out of the loop, of `joints` at the angles `q` (rad) and `pose`.
pub(super) fn show_rest(
    joints: &Joints,
    pose: &Pose,
    q: &Vector3<Real>,
    outside: bool,
    shown: &mut HandleTick,
    nominal: &mut Nominal,
) {
    *shown = HandleTick::at_rest(&pose.p, outside);
    *nominal = Nominal::at(q, joints.M_n(&pose.sin_cos));
}

/// The tick at the handle, which is at `pose`, and its nominal but for M_n.
pub(super) fn show(
    kinematics: &Kinematics,
    pose: &Pose,
    tick: &Tick<3>,
    shown: &mut HandleTick,
    of_joints: &mut Nominal,
) {
    of_joints.q_n = tick.q_n;
    of_joints.dq_n = tick.dq_n;
    of_joints.e_nr = tick.e_nr;
    let nominal = sin_cos(&tick.q_n);
    let p_n = kinematics.p(&nominal);
    *shown = HandleTick {
        f_a: force(pose, &tick.tau),
        tau: tick.tau,
        tau_demand: tick.f_demand,
        p_n,
        dp_n: kinematics.J(&nominal) * tick.dq_n,
        e_nr: p_n - pose.p,
        dp: pose.J * tick.dq,
        saturated: tick.saturated,
        held: tick.held,
        share: tick.share,
        outside_bounds: tick.outside_bounds,
        engaged: tick.engaged,
    };
}

/// What is asked of the handle, which is at `pose`, as it is asked of the joints.
pub(super) fn of_the_joints(pose: &Pose, request: &Request<3>) -> JointRequest {
    JointRequest {
        hold: request.hold,
        speed: request.speed,
        damping: at_the_joints(pose, request.damping.max()),
    }
}

/// d JᵀJ, N·m·s/rad, for a damping `d` (N·s/m) of the handle: without the elements that couple yaw and pitch, which are
/// rounding.
fn at_the_joints(pose: &Pose, d: Real) -> Matrix3<Real> {
    let mut D = pose.J.tr_mul(&pose.J) * d;
    (D.m12, D.m13, D.m21, D.m31) = (0.0, 0.0, 0.0, 0.0);
    D
}

/// sigma_min (m/rad) below which it is the rounding of J.
const ROUNDING: Real = 1e3 * Real::EPSILON;

/// The force at the handle (N, base frame) that torques `tau` (N·m) amount to, J⁻ᵀ tau; 0 at a singularity, where there is
/// none.
fn force(pose: &Pose, tau: &Vector3<Real>) -> Vector3<Real> {
    let inverse = pose.J.transpose().try_inverse();
    inverse
        .filter(|_| pose.sigma_min > ROUNDING)
        .map_or(Vector3::zeros(), |inverse| inverse * tau)
}
