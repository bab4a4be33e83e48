//! The three joints between two ticks, without a ledger: transport, slip, midpoint, clamp, reset.
//!
//! The one-axis law ([`admittance::Axis`]) with a vector for each number and M_n(q) for the mass. The springs, the slip and
//! the clamp are each joint's own; the joints meet in M_n only.

mod driven;
mod sensed;

pub use sensed::{Angles, JointProposal, JointRequest, JointSensed};

use super::boxed::Solution;
use super::midpoint::{self, Sample};
use super::{JointGains, stored};
use crate::kinematics::{Kinematics, SinCos};
use crate::nominal::transport::transported;
use crate::nominal::{NominalArm, RigidBody};
use crate::workspace::Workspace;
use admittance::bounds::Bounds;
use admittance::motion::Sampling;
use admittance::real::{floored, sat};
use admittance::retune::Tuning;
use admittance::settling::Keep;
use admittance::tick::{Coordinates, Tick};
use admittance::{Motion, ParameterError, Real, Settings, timing};
use nalgebra::{Matrix3, Vector3};

/// The law in joint space between two ticks. It starts out of the loop; the first tick engages it with q_n = q, v_n = 0.
///
/// M_n(q) ddq_n + (C_n(q, dq) + D_n) dq_n = tau_h − alpha y,  y = de_nr + K_P e_nr,  tau_a = K y   eq:obs_dyn, eq:dob_input
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Joints {
    settings: Settings,
    sampling: Sampling,
    tuning_ticks: u32,
    arm: NominalArm,
    kinematics: Kinematics,
    tuning: Tuning<JointGains>,
    bounds: [Bounds; 3],
    workspace: Option<Workspace>,
    state: Option<State>,
}

/// What the law remembers of a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct State {
    q: Vector3<Real>,
    body: RigidBody,
    q_n: Vector3<Real>,
    v_n: Vector3<Real>,
    motion: [Motion; 3],
}

impl Joints {
    /// Out of the loop.
    ///
    /// # Errors
    /// The first parameter out of its range, or a law that is not offered.
    pub fn new(
        settings: Settings,
        arm: NominalArm,
        kinematics: Kinematics,
        gains: JointGains,
    ) -> Result<Self, ParameterError> {
        settings.check()?;
        arm.check()?;
        kinematics.check()?;
        gains.check()?;
        Ok(Self {
            settings,
            sampling: Sampling::new(&settings),
            tuning_ticks: settings.tuning_ticks(),
            arm,
            kinematics,
            tuning: Tuning::new(gains),
            bounds: [Bounds::default(); 3],
            workspace: None,
            state: None,
        })
    }

    /// Within other bounds of the nominal (rad, rad/s) from the next tick on.
    ///
    /// # Errors
    /// The first bound out of its range; the bounds stay as they were.
    pub fn bound(&mut self, bounds: [Bounds; 3]) -> Result<(), ParameterError> {
        (1..)
            .zip(&bounds)
            .try_for_each(|(joint, bounds)| bounds.check(Some(joint)))?;
        self.bounds = bounds;
        Ok(())
    }

    /// Within the angles of `workspace`, which has been checked, from the next tick on; `None`: anywhere.
    pub fn keep_within(&mut self, workspace: Option<Workspace>) {
        self.workspace = workspace;
    }

    /// Other gains: on a straight line over the tuning time, each step taken over so that the stored energy does not rise.
    ///
    /// # Errors
    /// The first gain out of its range; the gains stay as they were.
    pub fn tune(&mut self, gains: JointGains) -> Result<(), ParameterError> {
        gains.check()?;
        self.tuning.want(gains, self.tuning_ticks);
        if self.state.is_none() {
            self.tuning.finish();
        }
        Ok(())
    }

    /// M_n at the angles of which sines and cosines are given, kg·m².
    pub(crate) fn M_n(&self, sin_cos: &SinCos) -> Matrix3<Real> {
        self.arm.turned(&self.kinematics, sin_cos).M
    }

    /// Where the handle is.
    pub(crate) fn kinematics(&self) -> &Kinematics {
        &self.kinematics
    }
}

impl Coordinates<3> for Joints {
    type Place = Angles;
    type Request = JointRequest;
    type Sensed = JointSensed;
    type Proposal = JointProposal;
    type Driven = Solution;

    fn settings(&self) -> &Settings {
        &self.settings
    }

    fn is_engaged(&self) -> bool {
        self.state.is_some()
    }

    /// v_n is carried along the motion since the last tick, the springs slip, gains on their way take over.
    fn sense(&self, Angles { q, sin_cos }: &Angles, after: Real) -> JointSensed {
        let law = self.settings.law;
        let body = self.arm.turned(&self.kinematics, sin_cos);
        let Some(last) = &self.state else {
            return JointSensed {
                q: *q,
                body,
                dq: Vector3::zeros(),
                e: Vector3::zeros(),
                v_n: Vector3::zeros(),
            };
        };
        let gains = self.tuning.now();
        let mut q_n = last.q_n;
        if after != 1.0 {
            let way = timing::more(after) * self.settings.T * last.v_n;
            q_n = Vector3::from_fn(|i, _| Bounds::kept(Some(&self.bounds[i]), q_n[i], way[i]));
        }
        let (mut e, mut v_n) = (
            q_n - q,
            transported(&last.body, &body, &(q - last.q), &last.v_n),
        );
        if let Some(before) = self.tuning.changed_from() {
            e = stored::slipped(law, before, &e);
            (e, v_n) = stored::taken_over(law, before, gains, &e, &v_n);
        }
        let dq = |i: usize| last.motion[i].dq(q[i], after, &self.sampling);
        JointSensed {
            q: *q,
            body,
            dq: Vector3::new(dq(0), dq(1), dq(2)),
            e: stored::slipped(law, gains, &e),
            v_n,
        }
    }

    /// H = k (½ v_nᵀ M_n v_n/alpha + ½ eᵀ K_P e)
    fn stored(&self, sensed: &JointSensed) -> Real {
        self.masses(sensed) + self.springs(sensed)
    }

    fn springs(&self, sensed: &JointSensed) -> Real {
        stored::springs(self.settings.law, self.tuning.now(), &sensed.e)
    }

    fn masses(&self, sensed: &JointSensed) -> Real {
        let kinetic = sensed.body.kinetic(&sensed.v_n);
        self.tuning.now().K * self.settings.over_alpha(kinetic)
    }

    fn reduce(&self, sensed: &mut JointSensed, keep: Keep) {
        sensed.e *= keep.e;
        sensed.v_n *= keep.v_n;
    }

    fn propose(
        &self,
        sensed: &JointSensed,
        tau_h: &Vector3<Real>,
        request: &JointRequest,
    ) -> JointProposal {
        let (alpha, T) = (self.settings.reaction(), self.settings.T);
        let gains = self.tuning.now();
        let JointSensed {
            q,
            body,
            dq,
            e,
            v_n,
        } = sensed;
        let intervals = [0, 1, 2].map(|i| {
            let interval = self.bounds[i]
                .interval(q[i] + e[i], T, request.hold)
                .no_faster_than(request.speed[i]);
            self.workspace.as_ref().map_or(interval, |limits| {
                let ends = [limits.q_min[i], limits.q_max[i]];
                interval.approaching(q[i] + e[i], ends, limits.slowing_time)
            })
        });
        let sample = Sample {
            M_n: body.M,
            D_n: Matrix3::from_diagonal(&gains.D_n) + request.damping,
            e: *e,
            v_n: *v_n,
            dq: *dq,
            tau_h: *tau_h,
        };
        let wish = midpoint::coupled(gains, alpha, T, &sample, &intervals);
        let y = midpoint::coupling(gains, T, &sample, &wish.v_m);
        JointProposal {
            tau_demand: y * gains.K,
            q: *q,
            body: *body,
            intervals,
            sample,
            wish,
        }
    }

    /// K y of each joint within ±tau_max where the nominal feels what is delivered, else K y, which the caller's limits may
    /// cut as they like.
    fn f(&self, proposal: &JointProposal) -> Vector3<Real> {
        if self.settings.law.row().feels_what_is_delivered() {
            let tau_max = &self.tuning.now().tau_max;
            proposal.tau_demand.zip_map(tau_max, sat)
        } else {
            proposal.tau_demand
        }
    }

    fn driven(&self, proposal: &JointProposal, tau: &Vector3<Real>) -> Solution {
        let JointProposal {
            intervals,
            sample,
            wish,
            tau_demand,
            ..
        } = proposal;
        if self.settings.law.row().feels_what_is_delivered() && tau != tau_demand {
            let (alpha, T) = (self.settings.reaction(), self.settings.T);
            midpoint::driven(alpha, T, sample, &(tau / self.tuning.now().K), intervals)
        } else {
            *wish
        }
    }

    /// −ΔH + (k/alpha) tau_h·v_m T ≥ tau·v_m T + (k/alpha) v_mᵀ D_n v_m T + ½ k eᵀ K_P e
    fn taken(&self, proposal: &JointProposal, driven: &Solution, tau: &Vector3<Real>) -> Real {
        let Settings { law, T, .. } = self.settings;
        let port = self.settings.over_alpha(self.tuning.now().K);
        let (gains, sample, v_m) = (self.tuning.now(), &proposal.sample, &driven.v_m);
        let damped = v_m.dot(&(sample.D_n * v_m));
        tau.dot(v_m) * T + port * damped * T + stored::springs(law, gains, &sample.e)
    }

    fn supplied(&self, proposal: &JointProposal, driven: &Solution) -> Real {
        let T = self.settings.T;
        self.settings.over_alpha(self.tuning.now().K) * proposal.sample.tau_h.dot(&driven.v_m) * T
    }

    fn exchanged(&self, proposal: &JointProposal, driven: &Solution) -> Real {
        let (gains, T) = (self.tuning.now(), self.settings.T);
        let squares = |i: usize| {
            let (v_m, dq) = (driven.v_m[i], proposal.sample.dq[i]);
            (1.0 + gains.K_P[i] * T / 2.0) * (v_m * v_m + dq * dq)
        };
        gains.K * T * (squares(0) + squares(1) + squares(2))
    }

    fn show(&self, proposal: &JointProposal, driven: &Solution, tick: &mut Tick<3>) {
        let Sample { e, v_n, dq, .. } = &proposal.sample;
        tick.f_demand = proposal.tau_demand;
        tick.q_n = e + proposal.q;
        tick.dq_n = *v_n;
        tick.e_nr = *e;
        tick.dq = *dq;
        tick.held = driven.held.iter().any(|held| *held);
    }

    fn commit(&mut self, proposal: &JointProposal, driven: &Solution, tau: &Vector3<Real>) {
        let Settings { law, T, .. } = self.settings;
        let gains = self.tuning.now();
        let JointProposal {
            sample, tau_demand, ..
        } = proposal;
        let v_b = (law.row().slips() && tau != tau_demand).then(|| {
            let v_b = midpoint::at_the_bound(gains, T, sample, &(tau / gains.K));
            let limited = tau.zip_map(tau_demand, |tau, asked| tau != asked);
            (v_b, limited)
        });
        self.moved_on(proposal, driven, v_b.as_ref());
    }

    fn rest(&mut self) {
        self.tuning.finish();
        self.state = None;
    }
}

impl Joints {
    /// The nominal moves on, and is set back, joint by joint, to the velocities (rad/s) at which its coupling is at its bound.
    fn moved_on(
        &mut self,
        proposal: &JointProposal,
        driven: &Solution,
        v_b: Option<&(Vector3<Real>, Vector3<bool>)>,
    ) {
        let JointProposal {
            q, body, sample, ..
        } = proposal;
        let Solution { v_m, held } = driven;
        let mut v_n = slower(body, v_m * 2.0 - sample.v_n, v_m, held);
        if let Some((v_b, limited)) = v_b {
            v_n = slower(body, v_n, v_b, limited);
        }
        self.state = Some(State {
            q: *q,
            body: *body,
            q_n: sample.e + q + v_m * self.settings.T,
            v_n: v_n.map(floored),
            motion: [0, 1, 2].map(|i| Motion::at(q[i], sample.dq[i])),
        });
        self.tuning.pass();
    }
}

/// Joint by joint, `other` in place of `v` where it is `allowed` and ½ vᵀ M_n v does not rise.
fn slower(
    body: &RigidBody,
    mut v: Vector3<Real>,
    other: &Vector3<Real>,
    allowed: &Vector3<bool>,
) -> Vector3<Real> {
    for i in 0..3 {
        let mut changed = v;
        changed[i] = other[i];
        if allowed[i] && body.kinetic(&changed) <= body.kinetic(&v) {
            v = changed;
        }
    }
    v
}
