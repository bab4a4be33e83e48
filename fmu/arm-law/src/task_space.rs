//! The law at the handle, its torques and its ledger at the joints.
//!
//! The law acts on the handle's position p; tau_a = Jᵀ f_a is held at the joints. Over a sample it does tau_a·Δq of
//! work there, whatever the path; f_a·Δp differs from it by the curvature of p(q), second order in Δq. So the ledger
//! here is kept with tau_a and q, which is exact, also where each joint is clipped by itself, and its budget looks ahead
//! over what the joints can do.
//!
//! The storage is that of the law without f_max for all laws but `passive_bounded`: ½ K K_P e² for a spring whose force the
//! joints deliver a share of. Under `standard` and `passive_applied` a spring that winds up behind saturated joints then
//! counts as energy created, up to some MJ: it is what these laws would have to be able to give back.

use crate::kinematics::Pose;
use crate::limits::{Limits, TorqueLimiting};
use admittance::axes::{Axes, Committed};
use admittance::budget::share_of_the_way;
use admittance::{Bounds, Gains, Ledger, ParameterError, Reach, Real, Request, Settings};
use nalgebra::Vector3;

/// The law between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TaskSpace {
    axes: Axes<3>,
    ledger: Ledger<3>,
    limits: Limits,
    /// what the last tick said: force at the handle (N) and torques (N·m)
    f: Vector3<Real>,
    tau: Vector3<Real>,
}

/// What happened at a tick; every value is the one at t_k, vectors at the handle in the base frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Force at the handle that tau amounts to, N: J⁻ᵀ tau. Clipped where J cannot be inverted: what was asked for.
    pub f_a: Vector3<Real>,
    /// Torques on the joints, N·m.
    pub tau: Vector3<Real>,
    /// Jᵀ K y before any limit, N·m.
    pub tau_demand: Vector3<Real>,
    /// Nominal position, m.
    pub p_n: Vector3<Real>,
    /// Nominal velocity, m/s.
    pub dp_n: Vector3<Real>,
    /// p_n − p after the slip, m.
    pub e_nr: Vector3<Real>,
    /// The handle's velocity as the law used it, m/s.
    pub dp: Vector3<Real>,
    /// Whether a limit leaves less than tau_demand.
    pub saturated: bool,
    /// Whether a bound, or hold, kept the nominal back.
    pub held: bool,
    /// Share of the torques that the energy budget left, in [0, 1]: 1 unless something is wrong.
    pub share: Real,
    /// Whether the joints' motion since the last tick exceeded their reach, to which the passivity argument is restricted.
    pub outside_bounds: bool,
    /// Whether the law is in the loop.
    pub engaged: bool,
}

impl TaskSpace {
    /// A law out of the loop. The caller has checked `limits`.
    ///
    /// # Errors
    /// The first parameter of the law out of its range, or a law that is not offered.
    pub fn new(
        settings: Settings,
        gains: [Gains; 3],
        bounds: [Bounds; 3],
        reach: Reach<3>,
        limits: Limits,
    ) -> Result<Self, ParameterError> {
        reach.check()?;
        let mut axes = Axes::new(settings, gains)?;
        axes.bound(bounds)?;
        Ok(Self {
            axes,
            ledger: Ledger::new(&settings, reach),
            limits,
            f: Vector3::zeros(),
            tau: Vector3::zeros(),
        })
    }

    /// Counts the joint angles from a place that is further on by `by` (rad), and keeps to `bounds`, which are counted from
    /// where the handle is there. While the law is out of the loop.
    ///
    /// # Errors
    /// The first bound out of its range; nothing has changed.
    pub fn count_from(
        &mut self,
        by: &Vector3<Real>,
        bounds: [Bounds; 3],
    ) -> Result<(), ParameterError> {
        self.axes.bound(bounds)?;
        self.ledger = self.ledger.counted_from(by);
        Ok(())
    }

    /// Other gains: on a straight line over the tuning time, each step taken over so that the stored energy does not rise.
    ///
    /// # Errors
    /// The first gain out of its range; the gains stay as they were.
    pub fn tune(&mut self, gains: [Gains; 3]) -> Result<(), ParameterError> {
        self.axes.tune(gains)
    }

    /// One tick at joint angles `q` (rad), where the handle is at `pose`, with the human's force `f_h` (N, base frame).
    pub fn step(
        &mut self,
        pose: &Pose,
        q: &Vector3<Real>,
        f_h: &Vector3<Real>,
        request: &Request<3>,
    ) -> Outcome {
        let settings = *self.axes.settings();
        let (ledger, sensed) = self.ledger.settle(self.axes.sense(&pose.p), &settings, q);
        let ledger = if self.axes.is_engaged() {
            ledger
        } else {
            ledger.without_motion()
        };
        let proposal = sensed.propose(f_h, request, &settings);

        let asked = proposal.f() * request.share();
        let delivered = self.limits.deliver(&pose.J.tr_mul(&asked));
        let (f, tau) = self.rated(asked * delivered.s, delivered.tau, settings.T);
        let share = ledger.share(&tau, |s| proposal.taken(&(f * s), &settings));
        let (f, tau) = if share < 1.0 {
            (f * share, tau * share)
        } else {
            (f, tau)
        };

        let done = self.axes.commit(proposal, &f);
        self.ledger = ledger.opened(&tau, done.supplied);
        (self.f, self.tau) = (f, tau);
        let Committed {
            f_demand,
            q_n,
            dq_n,
            e_nr,
            dq,
            held,
            ..
        } = done;
        Outcome {
            f_a: match self.limits.limiting {
                TorqueLimiting::Clip if delivered.limited => {
                    let inverse = pose.J.transpose().try_inverse();
                    inverse.map_or(f, |inverse| inverse * tau)
                }
                TorqueLimiting::Clip | TorqueLimiting::Scale => f,
            },
            tau,
            tau_demand: pose.J.tr_mul(&f_demand),
            p_n: q_n,
            dp_n: dq_n,
            e_nr,
            dp: dq,
            saturated: f != f_demand || delivered.limited,
            held,
            share,
            outside_bounds: self.ledger.is_outside(),
            engaged: true,
        }
    }

    /// As far towards the force `f` (N) and its torques `tau` (N·m) as the torques' rate allows.
    fn rated(
        &self,
        f: Vector3<Real>,
        tau: Vector3<Real>,
        T: Real,
    ) -> (Vector3<Real>, Vector3<Real>) {
        let way = share_of_the_way(&self.tau, &tau, &(self.limits.tau_rate * T));
        if way < 1.0 {
            (
                self.f + (f - self.f) * way,
                self.tau + (tau - self.tau) * way,
            )
        } else {
            (f, tau)
        }
    }

    /// One tick out of the loop: no torque, the nominal at the handle. The energy that was stored is given up; the next
    /// [`step`](Self::step) engages anew.
    pub fn rest(&mut self, pose: &Pose, q: &Vector3<Real>) -> Outcome {
        self.ledger = self.ledger.settled(0.0, q);
        self.out_of_the_loop(pose)
    }

    /// The same where the robot's position at this tick is not known, or no number: the tank pays for the most that the
    /// torques can have done since the last one.
    pub fn abandon(&mut self, pose: &Pose) -> Outcome {
        self.ledger = self.ledger.unseen();
        self.out_of_the_loop(pose)
    }

    fn out_of_the_loop(&mut self, pose: &Pose) -> Outcome {
        let zeros = Vector3::zeros();
        self.axes.rest(&pose.p);
        self.ledger = self.ledger.opened(&zeros, 0.0);
        (self.f, self.tau) = (zeros, zeros);
        Outcome {
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
        }
    }

    /// Energy stored and created, as of the last tick; the work is that at the joints.
    pub fn ledger(&self) -> &Ledger<3> {
        &self.ledger
    }
}

impl Outcome {
    /// Whether all that follows from the tick is: a torque that is not a number must not reach the robot.
    pub fn is_finite(&self) -> bool {
        [
            &self.f_a,
            &self.tau,
            &self.tau_demand,
            &self.p_n,
            &self.dp_n,
        ]
        .into_iter()
        .flatten()
        .all(|value| value.is_finite())
    }
}
