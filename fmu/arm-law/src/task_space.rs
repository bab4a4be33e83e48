//! The law at the handle, its torques and its ledger at the joints.
//!
//! The law acts on the handle's position p; tau_a = Jᵀ f_a is held at the joints. Over a sample it does tau_a·Δq of work
//! there, whatever the path. f_a·Δp differs from it by the curvature of p(q), which is of second order in Δq. So the ledger is
//! kept with tau_a and q. It is exact also where each joint is clipped by itself, and its budget looks ahead over what the
//! joints can do.
//!
//! The storage is that of the law without f_max for all laws but `passive_bounded`: ½ K K_P e² for a spring whose force the
//! joints deliver a part of. Under `standard` and `passive_applied` a spring that winds up behind saturated joints then
//! counts as energy created, up to some MJ: it is what these laws would have to be able to give back.

use crate::handle::{HandleTick, NotFinite};
use crate::kinematics::{Kinematics, Pose};
use crate::limits::{AtTheHandle, Limits, TorqueLimiting};
use crate::workspace::{HandleAxes, Workspace, edges};
use admittance::tick::{Coordinates, Inputs, Sampled, Tick};
use admittance::{Axes, Bounds, Gains, Ledger, ParameterError, Reach, Real, Request, Settings};
use nalgebra::Vector3;

/// The law between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TaskSpace {
    sampled: Sampled<HandleAxes, 3>,
    limits: Limits,
    workspace: Option<edges::Limits>,
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
            sampled: Sampled::new(HandleAxes { axes, near: None }, &reach)?
                .rated(&limits.tau_rate)?,
            limits,
            workspace: None,
        })
    }

    /// The same with a nominal that keeps within `workspace`, which has been checked; `None`: it may go anywhere.
    #[must_use]
    pub fn within(self, workspace: Option<Workspace>, kinematics: Kinematics) -> Self {
        Self {
            workspace: workspace.map(|workspace| {
                edges::Limits::new(workspace, kinematics, self.sampled.law().settings().T)
            }),
            ..self
        }
    }

    /// Counts the joint angles from `q_0` (rad), a place that is further on by `by` (rad), and keeps to `bounds`, which are
    /// counted from where the handle is there. While the law is out of the loop.
    ///
    /// # Errors
    /// The first bound out of its range; nothing has changed.
    pub fn count_from(
        &mut self,
        q_0: &Vector3<Real>,
        by: &Vector3<Real>,
        bounds: [Bounds; 3],
    ) -> Result<(), ParameterError> {
        self.sampled.law_mut().axes.bound(bounds)?;
        self.workspace = self.workspace.map(|limits| limits.counted_from(q_0));
        self.sampled.count_from(by);
        Ok(())
    }

    /// Other gains: on a straight line over the tuning time, each step taken over so that the stored energy does not rise.
    ///
    /// # Errors
    /// The first gain out of its range; the gains stay as they were.
    pub fn tune(&mut self, gains: [Gains; 3]) -> Result<(), ParameterError> {
        self.sampled.law_mut().axes.tune(gains)
    }

    /// One tick at joint angles `q` (rad), where the handle is at `pose`, with the human's force `f_h` (N, base frame). `show` is
    /// called with what happened, if it is accepted.
    ///
    /// # Errors
    /// A result that is not finite: the law is as it was.
    #[inline]
    pub fn step(
        &mut self,
        pose: &Pose,
        q: &Vector3<Real>,
        f_h: &Vector3<Real>,
        request: &Request<3>,
        show: impl FnOnce(&HandleTick),
    ) -> Result<(), NotFinite> {
        let is_near = match &self.workspace {
            Some(limits) if !limits.are_far(q, self.sampled.ledger().motion(), pose) => {
                self.sampled.law_mut().near = Some(limits.at(q, pose));
                true
            }
            _ => false,
        };
        let inputs = Inputs {
            place: &pose.p,
            q,
            f_h,
            authority: request.authority(),
            request,
            after: request.after,
        };
        let joints = AtTheHandle {
            limits: &self.limits,
            J: &pose.J,
        };
        let accept = |tick: &Tick<3>, G: Real| {
            let done = HandleTick {
                f_a: match self.limits.limiting {
                    TorqueLimiting::Clip if tick.limited => {
                        let inverse = pose.J.transpose().try_inverse();
                        inverse.map_or(tick.f, |inverse| inverse * tick.tau)
                    }
                    TorqueLimiting::Clip | TorqueLimiting::Scale => tick.f,
                },
                tau: tick.tau,
                tau_demand: pose.J.tr_mul(&tick.f_demand),
                p_n: tick.q_n,
                dp_n: tick.dq_n,
                e_nr: tick.e_nr,
                dp: tick.dq,
                saturated: tick.saturated,
                held: tick.held,
                share: tick.share,
                outside_bounds: tick.outside_bounds,
                engaged: tick.engaged,
            };
            let is_accepted = done.is_finite() && G.is_finite();
            if is_accepted {
                show(&done);
            }
            is_accepted
        };
        let done = self.sampled.tick(&inputs, &joints, accept);
        if is_near {
            self.sampled.law_mut().near = None;
        }
        Ok(done?)
    }

    /// One tick out of the loop: no torque, the nominal at the handle. The energy that was stored is given up; the next
    /// [`step`](Self::step) engages anew.
    ///
    /// # Errors
    /// A result that is not finite: the law is as it was.
    pub fn rest(
        &mut self,
        pose: &Pose,
        q: &Vector3<Real>,
        shown: &mut HandleTick,
    ) -> Result<(), NotFinite> {
        let outside = self.sampled.rest(q, |G| {
            G.is_finite() && HandleTick::at_rest(&pose.p, false).is_finite()
        })?;
        *shown = HandleTick::at_rest(&pose.p, outside);
        Ok(())
    }

    /// The same where the robot's position at this tick is not known, or no number: the tank pays for the most that the
    /// torques can have done since the last one.
    pub fn abandon(&mut self, pose: &Pose, shown: &mut HandleTick) {
        let outside = self.sampled.abandon();
        *shown = HandleTick::at_rest(&pose.p, outside);
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

    /// Energy stored and created, as of the last tick; the work is that at the joints.
    pub fn ledger(&self) -> &Ledger<3> {
        self.sampled.ledger()
    }
}
