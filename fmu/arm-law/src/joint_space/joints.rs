//! The three joints between two ticks, without a ledger: transport, slip, midpoint, clamp, reset.
//!
//! The one-axis law ([`admittance::Axis`]) with a vector for each number and M_n(q) for the mass. The springs, the slip and
//! the clamp are each joint's own; the joints meet in M_n only.

use super::midpoint::{self, Sample};
use super::{JointGains, stored};
use crate::kinematics::Kinematics;
use crate::nominal::transport::transported;
use crate::nominal::{NominalArm, RigidBody};
use admittance::real::{floored, sat};
use admittance::{Law, Motion, ParameterError, Real, Settings};
use nalgebra::Vector3;

/// The law in joint space between two ticks. It starts out of the loop; the first tick engages it with q_n = q, v_n = 0.
///
/// M_n(q) ddq_n + (C_n(q, dq) + D_n) dq_n = tau_h − alpha y,  y = de_nr + K_P e_nr,  tau_a = K y   eq:obs_dyn, eq:dob_input
///
/// A tick: [`sense`](Joints::sense) → the caller settles its ledger, perhaps [`reduced`](Sensed::reduced) →
/// [`propose`](Sensed::propose) → the caller's limits → [`commit`](Joints::commit).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Joints {
    settings: Settings,
    arm: NominalArm,
    kinematics: Kinematics,
    gains: JointGains,
    wanted: JointGains,
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
    state: State,
    e: Vector3<Real>,
}

/// What the joints ask for at a tick. Nothing has happened until it is committed; it may be dropped.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Proposal {
    gains: JointGains,
    state: State,
    sample: Sample,
    v_m: Vector3<Real>,
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
            state: None,
        })
    }

    /// Other gains from the next tick on, taken over so that the stored energy does not rise.
    ///
    /// # Errors
    /// The first gain out of its range; the gains stay as they were.
    pub fn tune(&mut self, gains: JointGains) -> Result<(), ParameterError> {
        gains.check()?;
        self.wanted = gains;
        Ok(())
    }

    /// The joints at a tick with angles `q` (rad): v_n is carried along the motion since the last tick, the springs
    /// slip, gains that are wanted take over.
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
                state,
                e: Vector3::zeros(),
            };
        };
        let v_n = transported(&last.body, &body, &(q - last.q), &last.v_n);
        let (e, v_n) = stored::taken_over(
            self.settings.law,
            &self.gains,
            &self.wanted,
            &slipped(self.settings.law, &self.gains, &(last.q_n - q)),
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
            gains: self.wanted,
            state,
            e: slipped(self.settings.law, &self.wanted, &e),
        }
    }

    /// The nominal moves on, while the robot gets the torques `tau` (N·m): what the caller's limits left of
    /// [`Proposal::tau`].
    ///
    /// Under `passive_applied` and `passive_bounded` the nominal feels `tau`, under `passive` the whole y, under
    /// `standard` nothing.
    pub fn commit(&mut self, proposal: Proposal, tau: &Vector3<Real>) -> Committed {
        let Settings { law, alpha, T, .. } = self.settings;
        let v_m = proposal.v_m(tau, &self.settings);
        let Proposal {
            gains,
            state,
            sample,
            tau_demand,
            ..
        } = proposal;
        let (q_n, v_n) = (sample.e + state.q, sample.v_n);
        let next = v_m * 2.0 - v_n;
        self.gains = gains;
        self.state = Some(State {
            q_n: q_n + v_m * T,
            v_n: match law {
                Law::PassiveBounded if *tau != tau_demand => {
                    let v_b = midpoint::at_the_bound(&gains, T, &sample, &(tau / gains.K));
                    let limited = tau.zip_map(&tau_demand, |tau, asked| tau != asked);
                    slower(&state.body, next, &v_b, &limited)
                }
                _ => next,
            }
            .map(floored),
            ..state
        });
        Committed {
            tau_demand,
            q_n,
            dq_n: v_n,
            e_nr: sample.e,
            dq: sample.dq,
            supplied: gains.K / alpha * sample.tau_h.dot(&v_m) * T,
        }
    }

    /// Out of the loop: nothing stored. The next tick engages anew.
    pub fn rest(&mut self) {
        self.gains = self.wanted;
        self.state = None;
    }

    /// What stays fixed during a run.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }
}

/// Under `passive_bounded`, |K K_P e| ≤ tau_max on each joint: beyond it the spring slips, and q_n with it.
fn slipped(law: Law, gains: &JointGains, e: &Vector3<Real>) -> Vector3<Real> {
    match law {
        Law::PassiveBounded => e.zip_zip_map(&gains.tau_max, &gains.K_P, |e, tau_max, K_P| {
            sat(e, tau_max / (gains.K * K_P))
        }),
        _ => *e,
    }
}

/// The reset: joint by joint, v_b in place of v where the joint is limited and ½ vᵀ M_n v does not rise.
fn slower(
    body: &RigidBody,
    mut v: Vector3<Real>,
    v_b: &Vector3<Real>,
    limited: &Vector3<bool>,
) -> Vector3<Real> {
    for i in 0..3 {
        let mut other = v;
        other[i] = v_b[i];
        if limited[i] && body.kinetic(&other) <= body.kinetic(&v) {
            v = other;
        }
    }
    v
}

impl Sensed {
    /// Energy stored at this tick, J. Not finite for alpha = 0.
    ///
    /// H = k (½ v_nᵀ M_n v_n/alpha + ½ eᵀ K_P e)
    pub fn stored(&self, settings: &Settings) -> Real {
        self.gains.K * (self.state.body.kinetic(&self.state.v_n) / settings.alpha)
            + self.spring(settings)
    }

    /// The springs' part of it, J.
    pub fn spring(&self, settings: &Settings) -> Real {
        stored::springs(settings.law, &self.gains, &self.e)
    }

    /// With the position errors and the nominal velocities reduced to these shares, in [0, 1]: energy given up.
    #[must_use]
    pub fn reduced(mut self, e: Real, v_n: Real) -> Self {
        self.e *= e;
        self.state.v_n *= v_n;
        self
    }

    /// What the joints ask for with the human's torques `tau_h` (N·m): nominal and coupling are solved together.
    pub fn propose(self, tau_h: &Vector3<Real>, settings: &Settings) -> Proposal {
        let Self { gains, state, e } = self;
        let sample = Sample {
            M_n: state.body.M,
            e,
            v_n: state.v_n,
            dq: Vector3::from(state.motion.map(|motion| motion.dq())),
            tau_h: *tau_h,
        };
        let v_m = midpoint::coupled(&gains, settings.reaction(), settings.T, &sample);
        let y = midpoint::coupling(&gains, settings.T, &sample, &v_m);
        Proposal {
            gains,
            state,
            sample,
            v_m,
            tau_demand: y * gains.K,
        }
    }
}

impl Proposal {
    /// K y before any limit, N·m.
    pub fn tau_demand(&self) -> &Vector3<Real> {
        &self.tau_demand
    }

    /// What the joints ask for, N·m: under `passive_applied` and `passive_bounded` K y of each joint within ±tau_max, under
    /// the other laws K y, which the caller's limits may cut as they like.
    pub fn tau(&self, settings: &Settings) -> Vector3<Real> {
        match settings.law {
            Law::PassiveApplied | Law::PassiveBounded => {
                self.tau_demand.zip_map(&self.gains.tau_max, sat)
            }
            _ => self.tau_demand,
        }
    }

    /// v_m (rad/s) if the robot gets the torques `tau` (N·m).
    fn v_m(&self, tau: &Vector3<Real>, settings: &Settings) -> Vector3<Real> {
        match settings.law {
            Law::PassiveApplied | Law::PassiveBounded if *tau != self.tau_demand => {
                let (alpha, T) = (settings.reaction(), settings.T);
                midpoint::driven(&self.gains, alpha, T, &self.sample, &(tau / self.gains.K))
            }
            _ => self.v_m,
        }
    }

    /// Energy (J) that the law is sure to take in the sample that begins, if the robot gets the torques `tau` (N·m) under
    /// `passive_bounded`: what the human brings less what the nominal keeps, its damping, and the springs, which can be
    /// given up afterwards.
    ///
    /// −ΔH + (k/alpha) tau_h·v_m T ≥ tau·v_m T + (k/alpha) v_mᵀ D_n v_m T + ½ k eᵀ K_P e
    pub fn taken(&self, tau: &Vector3<Real>, settings: &Settings) -> Real {
        let v_m = self.v_m(tau, settings);
        let damped = self.gains.D_n.component_mul(&v_m).dot(&v_m);
        tau.dot(&v_m) * settings.T
            + self.gains.K / settings.alpha * damped * settings.T
            + stored::springs(settings.law, &self.gains, &self.sample.e)
    }
}
