//! One tick of the law in joint space, with its ledger: what [`TaskSpace`](crate::task_space::TaskSpace) is at the handle.
//!
//! Coordinates, torques and ledger are all the joints', so the work tau·Δq is exact as it stands.

use super::{Committed, JointGains, JointRequest, Joints};
use crate::kinematics::{Kinematics, Pose};
use crate::limits::Limits;
use crate::nominal::NominalArm;
use crate::task_space::Outcome;
use admittance::budget::share_of_the_way;
use admittance::{Bounds, Ledger, ParameterError, Reach, Real, Request, Settings};
use nalgebra::{Matrix3, Vector3};

/// What the law in joint space is built from, beside what both forms share.
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

/// The law between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct JointSpace {
    joints: Joints,
    kinematics: Kinematics,
    ledger: Ledger<3>,
    limits: Limits,
    /// what the last tick said, N·m
    tau: Vector3<Real>,
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
        let JointParameters { arm, gains, bounds } = *parameters;
        let tau_max = limits.tau_max;
        let mut joints = Joints::new(settings, arm, kinematics, JointGains { tau_max, ..gains })?;
        joints.bound(bounds)?;
        Ok(Self {
            joints,
            kinematics,
            ledger: Ledger::new(&settings, reach),
            limits,
            tau: Vector3::zeros(),
        })
    }

    /// Other gains: on a straight line over the tuning time, each step taken over so that the stored energy does not rise.
    ///
    /// # Errors
    /// The first gain out of its range; the gains stay as they were.
    pub fn tune(&mut self, gains: JointGains) -> Result<(), ParameterError> {
        let tau_max = self.limits.tau_max;
        self.joints.tune(JointGains { tau_max, ..gains })
    }

    /// One tick at joint angles `q` (rad), where the handle is at `pose`, with the human's force `f_h` (N, base frame).
    ///
    /// The speed that is requested is the joints', rad/s. Damping that is requested at the handle acts on the joints as d JᵀJ with d the largest of the three axes: alike in
    /// all directions, which keeps yaw and pitch apart.
    pub fn step(
        &mut self,
        pose: &Pose,
        q: &Vector3<Real>,
        f_h: &Vector3<Real>,
        request: &Request<3>,
    ) -> (Outcome, Nominal) {
        let settings = *self.joints.settings();
        let (ledger, sensed) = self.ledger.settle(self.joints.sense(q), &settings, q);
        let ledger = if self.joints.is_engaged() {
            ledger
        } else {
            ledger.without_motion()
        };
        let of_joints = JointRequest {
            hold: request.hold,
            speed: request.speed,
            damping: at_the_joints(pose, request.damping.max()),
        };
        let proposal = sensed.propose(&pose.J.tr_mul(f_h), &of_joints, &settings);

        let asked = proposal.tau(&settings) * request.share();
        let delivered = self.limits.deliver(&asked);
        let tau = self.rated(delivered.tau, settings.T);
        let share = ledger.share(&tau, |s| proposal.taken(&(tau * s), &settings));
        let tau = if share < 1.0 { tau * share } else { tau };

        let done = self.joints.commit(proposal, &tau);
        self.ledger = ledger.opened(&tau, done.supplied);
        self.tau = tau;
        self.shown(pose, &done, share)
    }

    /// What a tick shows: the nominal also as the handle that it amounts to.
    fn shown(&self, pose: &Pose, done: &Committed, share: Real) -> (Outcome, Nominal) {
        let tau = &self.tau;
        let nominal = self.kinematics.at(&done.q_n);
        let outcome = Outcome {
            f_a: force(pose, tau),
            tau: *tau,
            tau_demand: done.tau_demand,
            p_n: nominal.p,
            dp_n: nominal.J * done.dq_n,
            e_nr: nominal.p - pose.p,
            dp: pose.J * done.dq,
            saturated: *tau != done.tau_demand,
            held: done.held,
            share,
            outside_bounds: self.ledger.is_outside(),
            engaged: true,
        };
        let joints = Nominal {
            q_n: done.q_n,
            dq_n: done.dq_n,
            e_nr: done.e_nr,
            M_n: done.M_n,
        };
        (outcome, joints)
    }

    /// As far towards the torques `tau` (N·m) as their rate allows.
    fn rated(&self, tau: Vector3<Real>, T: Real) -> Vector3<Real> {
        let way = share_of_the_way(&self.tau, &tau, &(self.limits.tau_rate * T));
        if way < 1.0 {
            self.tau + (tau - self.tau) * way
        } else {
            tau
        }
    }

    /// One tick out of the loop: no torque, the nominal where the robot is. The energy that was stored is given up; the next
    /// [`step`](Self::step) engages anew.
    pub fn rest(&mut self, pose: &Pose, q: &Vector3<Real>) -> (Outcome, Nominal) {
        self.ledger = self.ledger.settled(0.0, q);
        self.out_of_the_loop(pose, q)
    }

    /// The same where the robot's angles at this tick are not known, or no numbers: the tank pays for the most that the
    /// torques can have done since the last one. `q` (rad) and `pose` are the last that were known.
    pub fn abandon(&mut self, pose: &Pose, q: &Vector3<Real>) -> (Outcome, Nominal) {
        self.ledger = self.ledger.unseen();
        self.out_of_the_loop(pose, q)
    }

    fn out_of_the_loop(&mut self, pose: &Pose, q: &Vector3<Real>) -> (Outcome, Nominal) {
        let zeros = Vector3::zeros();
        self.joints.rest();
        self.ledger = self.ledger.opened(&zeros, 0.0);
        self.tau = zeros;
        let outcome = Outcome {
            f_a: zeros,
            tau: zeros,
            tau_demand: zeros,
            p_n: pose.p,
            dp_n: zeros,
            e_nr: zeros,
            dp: zeros,
            saturated: false,
            held: false,
            share: 1.0,
            outside_bounds: self.ledger.is_outside(),
            engaged: false,
        };
        (outcome, Nominal::at(q, self.joints.M_n(q)))
    }

    /// Energy stored and created, as of the last tick.
    pub fn ledger(&self) -> &Ledger<3> {
        &self.ledger
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
