//! The three joints between two ticks, without a ledger: transport, slip, midpoint, clamp, reset.
//!
//! The one-axis law ([`admittance::Axis`]) with a vector for each number and M_n(q) for the mass. The springs, the slip and
//! the clamp are each joint's own; the joints meet in M_n only.

use super::boxed::Solution;
use super::midpoint::{self, Sample};
use super::{JointGains, stored};
use crate::kinematics::Kinematics;
use crate::nominal::transport::transported;
use crate::nominal::{NominalArm, RigidBody};
use admittance::bounds::{Bounds, Interval};
use admittance::law::{Felt, Spring};
use admittance::ledger::{Keep, Stored};
use admittance::real::{floored, sat};
use admittance::{Motion, ParameterError, Real, Settings};
use nalgebra::{Matrix3, Vector3};

/// The law in joint space between two ticks. It starts out of the loop; the first tick engages it with q_n = q, v_n = 0.
///
/// M_n(q) ddq_n + (C_n(q, dq) + D_n) dq_n = tau_h − alpha y,  y = de_nr + K_P e_nr,  tau_a = K y   eq:obs_dyn, eq:dob_input
///
/// A tick: [`sense`](Joints::sense) → the caller settles its ledger, perhaps [`reduced`](Stored::reduced) →
/// [`propose`](Sensed::propose) → the caller's limits → [`commit`](Joints::commit).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Joints {
    settings: Settings,
    arm: NominalArm,
    kinematics: Kinematics,
    gains: JointGains,
    wanted: JointGains,
    /// ticks until the gains are those wanted
    remaining: u32,
    bounds: [Bounds; 3],
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

/// The joints at a tick, once the position is known: what they store, before they act.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensed {
    gains: JointGains,
    remaining: u32,
    bounds: [Bounds; 3],
    state: State,
    e: Vector3<Real>,
}

/// What is asked of the joints at a tick, beside their inputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointRequest {
    /// Whether the nominal stays where it is.
    pub hold: bool,
    /// Speed that the nominal must not exceed, beside its bounds, rad/s, ≥ 0; infinite for no limit.
    pub speed: Vector3<Real>,
    /// Damping on top of D_n, N·m·s/rad, symmetric and not negative, block diagonal like M_n.
    pub damping: Matrix3<Real>,
}

impl Default for JointRequest {
    /// The law alone.
    fn default() -> Self {
        Self {
            hold: false,
            speed: Vector3::repeat(Real::INFINITY),
            damping: Matrix3::zeros(),
        }
    }
}

/// What the joints ask for at a tick. Nothing has happened until it is committed; it may be dropped.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Proposal {
    gains: JointGains,
    remaining: u32,
    intervals: [Interval; 3],
    state: State,
    sample: Sample,
    wish: Solution,
    tau_demand: Vector3<Real>,
}

/// What the joints did at a tick; every value is the one at t_k.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Committed {
    /// K y before any limit, N·m.
    pub tau_demand: Vector3<Real>,
    /// Nominal position q + e_nr, rad.
    pub q_n: Vector3<Real>,
    /// Nominal velocity, rad/s.
    pub dq_n: Vector3<Real>,
    /// q_n − q after the slip, rad.
    pub e_nr: Vector3<Real>,
    /// The robot's velocity as the law used it, rad/s.
    pub dq: Vector3<Real>,
    /// M_n(q), kg·m².
    pub M_n: Matrix3<Real>,
    /// Whether one of the bounds, or hold, kept a joint of the nominal back.
    pub held: bool,
    /// Energy (k/alpha) tau_h·v_m T that the human's port brings in the sample that begins, J. Not finite for alpha = 0.
    pub supplied: Real,
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
            arm,
            kinematics,
            gains,
            wanted: gains,
            remaining: 0,
            bounds: [Bounds::default(); 3],
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

    /// Other gains: on a straight line over the tuning time, each step taken over so that the stored energy does not rise.
    ///
    /// # Errors
    /// The first gain out of its range; the gains stay as they were.
    pub fn tune(&mut self, gains: JointGains) -> Result<(), ParameterError> {
        gains.check()?;
        if gains != self.wanted {
            self.wanted = gains;
            self.remaining = self.settings.tuning_ticks().max(1);
        }
        Ok(())
    }

    /// The joints at a tick with angles `q` (rad): v_n is carried along the motion since the last tick, the springs
    /// slip, gains on their way take over.
    #[must_use]
    pub fn sense(&self, q: &Vector3<Real>) -> Sensed {
        let body = self.arm.at(&self.kinematics, q);
        let Some(last) = &self.state else {
            let motion = Motion::default();
            let state = State {
                q: *q,
                body,
                q_n: *q,
                v_n: Vector3::zeros(),
                motion: [0, 1, 2].map(|i| motion.sensed(q[i], &self.settings)),
            };
            return Sensed {
                gains: self.wanted,
                remaining: 0,
                bounds: self.bounds,
                state,
                e: Vector3::zeros(),
            };
        };
        let gains = self.gains.toward(&self.wanted, self.remaining);
        let v_n = transported(&last.body, &body, &(q - last.q), &last.v_n);
        let (e, v_n) = stored::taken_over(
            self.settings.law,
            &self.gains,
            &gains,
            &stored::slipped(self.settings.law, &self.gains, &(last.q_n - q)),
            &v_n,
        );
        let state = State {
            q: *q,
            body,
            v_n,
            motion: [0, 1, 2].map(|i| last.motion[i].sensed(q[i], &self.settings)),
            ..*last
        };
        Sensed {
            gains,
            remaining: self.remaining.saturating_sub(1),
            bounds: self.bounds,
            state,
            e: stored::slipped(self.settings.law, &gains, &e),
        }
    }

    /// The nominal moves on, while the robot gets the torques `tau` (N·m): what the caller's limits left of
    /// [`Proposal::tau`].
    ///
    /// Under `passive_applied` and `passive_bounded` the nominal feels `tau`, under `passive` the whole y, under
    /// `standard` nothing.
    pub fn commit(&mut self, proposal: Proposal, tau: &Vector3<Real>) -> Committed {
        let Settings { law, alpha, T, .. } = self.settings;
        let Solution { v_m, held } = proposal.solution(tau, &self.settings);
        let Proposal {
            gains,
            state,
            sample,
            tau_demand,
            ..
        } = proposal;
        let (q_n, v_n) = (sample.e + state.q, sample.v_n);
        let mut next = slower(&state.body, v_m * 2.0 - v_n, &v_m, &held);
        match law.row().spring {
            Spring::Slips if *tau != tau_demand => {
                let v_b = midpoint::at_the_bound(&gains, T, &sample, &(tau / gains.K));
                let limited = tau.zip_map(&tau_demand, |tau, asked| tau != asked);
                next = slower(&state.body, next, &v_b, &limited);
            }
            Spring::Slips | Spring::Limited | Spring::Free => {}
        }
        self.gains = gains;
        self.remaining = proposal.remaining;
        self.state = Some(State {
            q_n: q_n + v_m * T,
            v_n: next.map(floored),
            ..state
        });
        Committed {
            tau_demand,
            q_n,
            dq_n: v_n,
            e_nr: sample.e,
            dq: sample.dq,
            M_n: sample.M_n,
            held: held.iter().any(|held| *held),
            supplied: gains.K / alpha * sample.tau_h.dot(&v_m) * T,
        }
    }

    /// Out of the loop: nothing stored. The next tick engages anew.
    pub fn rest(&mut self) {
        self.gains = self.wanted;
        self.remaining = 0;
        self.state = None;
    }

    /// M_n at joint angles `q` (rad), kg·m².
    pub fn M_n(&self, q: &Vector3<Real>) -> Matrix3<Real> {
        self.arm.at(&self.kinematics, q).M
    }

    /// Whether they are in the loop.
    pub fn is_engaged(&self) -> bool {
        self.state.is_some()
    }

    /// What stays fixed during a run.
    pub fn settings(&self) -> &Settings {
        &self.settings
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

impl Stored for Sensed {
    /// H = k (½ v_nᵀ M_n v_n/alpha + ½ eᵀ K_P e)
    fn stored(&self, settings: &Settings) -> Real {
        self.masses(settings) + self.spring(settings)
    }

    fn masses(&self, settings: &Settings) -> Real {
        self.gains.K * (self.state.body.kinetic(&self.state.v_n) / settings.alpha)
    }

    fn spring(&self, settings: &Settings) -> Real {
        stored::springs(settings.law, &self.gains, &self.e)
    }

    fn reduced(&self, keep: Keep) -> Self {
        let mut reduced = *self;
        reduced.e *= keep.e;
        reduced.state.v_n *= keep.v_n;
        reduced
    }
}

impl Sensed {
    /// What the joints ask for with the human's torques `tau_h` (N·m): nominal and coupling are solved together, within
    /// the bounds.
    pub fn propose(
        &self,
        tau_h: &Vector3<Real>,
        request: &JointRequest,
        settings: &Settings,
    ) -> Proposal {
        let Self {
            gains,
            remaining,
            bounds,
            state,
            e,
        } = *self;
        let (alpha, T) = (settings.reaction(), settings.T);
        let intervals = [0, 1, 2].map(|i| {
            bounds[i]
                .interval(state.q[i] + e[i], T, request.hold)
                .no_faster_than(request.speed[i])
        });
        let sample = Sample {
            M_n: state.body.M,
            D_n: Matrix3::from_diagonal(&gains.D_n) + request.damping,
            e,
            v_n: state.v_n,
            dq: Vector3::from(state.motion.map(|motion| motion.dq())),
            tau_h: *tau_h,
        };
        let wish = midpoint::coupled(&gains, alpha, T, &sample, &intervals);
        let y = midpoint::coupling(&gains, T, &sample, &wish.v_m);
        Proposal {
            gains,
            remaining,
            intervals,
            state,
            sample,
            wish,
            tau_demand: y * gains.K,
        }
    }
}

impl Proposal {
    /// K y before any limit, N·m.
    pub fn tau_demand(&self) -> &Vector3<Real> {
        &self.tau_demand
    }

    /// What the joints ask for, N·m: K y of each joint within ±tau_max where the nominal feels what is delivered, else K y,
    /// which the caller's limits may cut as they like.
    pub fn tau(&self, settings: &Settings) -> Vector3<Real> {
        match settings.law.row().felt {
            Felt::Delivered => self.tau_demand.zip_map(&self.gains.tau_max, sat),
            Felt::Nothing | Felt::Coupling => self.tau_demand,
        }
    }

    /// v_m if the robot gets the torques `tau` (N·m).
    fn solution(&self, tau: &Vector3<Real>, settings: &Settings) -> Solution {
        match settings.law.row().felt {
            Felt::Delivered if *tau != self.tau_demand => {
                let (alpha, T) = (settings.reaction(), settings.T);
                midpoint::driven(
                    alpha,
                    T,
                    &self.sample,
                    &(tau / self.gains.K),
                    &self.intervals,
                )
            }
            Felt::Delivered | Felt::Coupling | Felt::Nothing => self.wish,
        }
    }

    /// Energy (J) that the law is sure to take in the sample that begins, if the robot gets the torques `tau` (N·m) under
    /// `passive_bounded`: what the human brings less what the nominal keeps, its damping, and the springs, which can be
    /// given up afterwards.
    ///
    /// −ΔH + (k/alpha) tau_h·v_m T ≥ tau·v_m T + (k/alpha) v_mᵀ D_n v_m T + ½ k eᵀ K_P e
    pub fn taken(&self, tau: &Vector3<Real>, settings: &Settings) -> Real {
        let v_m = self.solution(tau, settings).v_m;
        let damped = v_m.dot(&(self.sample.D_n * v_m));
        tau.dot(&v_m) * settings.T
            + self.gains.K / settings.alpha * damped * settings.T
            + stored::springs(settings.law, &self.gains, &self.sample.e)
    }
}
