//! The energy that one substep moved, each term by its own formula.

use nalgebra::Vector3;

use super::parameters::Parameters;
use super::problem::{FACINGS, Solution};
use super::rigid_body::RigidBody;
use super::state::{Inputs, Place, State};

/// Energy that crossed the arm's boundaries in one substep (J).
///
/// Each term has its own formula. Δ is the change over the substep as it came out, w = J dq⁺ the pad's velocity; losses
/// are never negative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flow {
    /// Work of the torques that arrive at the joints: τ · Δq.
    pub work_tau: f64,
    /// Work of the human at the handle: f_h · Δp.
    pub work_f_h: f64,
    /// Work of the disturbance at the pad: f_d · Δp.
    pub work_f_d: f64,
    /// What a payload brings when it is gripped (its potential energy) or takes along when it leaves (negative: its
    /// kinetic and potential energy).
    pub payload: f64,
    /// Heat of dry friction in the joints: −λ dq⁺.
    pub loss_friction: f64,
    /// Heat of viscous friction in the joints: dt b dq⁺².
    pub loss_viscous: f64,
    /// Lost at the stops: −λ dq⁺, and the jump ½ Δdqᵀ M Δdq in a substep in which a stop pushes.
    pub loss_stop: f64,
    /// Heat of the surfaces' dampers: c Δs²/dt, also while they relax by themselves.
    pub loss_surface: f64,
    /// Heat of friction on the surfaces: −t · w.
    pub loss_rub: f64,
    /// Lost in landings on a surface: n/dt (s − pen), the force of the landing substep over the gap that was left. First
    /// order in dt.
    pub loss_impact: f64,
    /// Lost in gripping a payload at rest: ½ Δdqᵀ M Δdq + ½ m w², a perfectly inelastic impact.
    pub loss_grip: f64,
    /// The integrator's own loss (backward Euler): ½ Δdqᵀ M Δdq + Σ ½ k Δs². First order in dt.
    pub loss_step: f64,
}

/// What the energy needs of where a substep began: kept, as the arm moves on in place.
pub(crate) struct Left {
    /// Joint angles (rad).
    pub(crate) q: Vector3<f64>,
    /// Deflections of table and wall (m).
    pub(crate) s: [f64; 2],
    /// Positions of handle and pad (m).
    handle: Vector3<f64>,
    pad: Vector3<f64>,
    /// J dq⁺: velocity of the pad at the end (m/s), with the Jacobian there.
    w: Vector3<f64>,
    /// ½ Δdqᵀ M Δdq (J).
    jump: f64,
}

impl Left {
    /// A `state` at `place`, where the rigid body is `body`, from which the arm moves on with the velocities `v` (rad/s).
    pub(crate) fn of(state: &State, place: &Place, body: &RigidBody, v: &Vector3<f64>) -> Self {
        Self {
            q: state.q,
            s: state.s,
            handle: place.handle.p,
            pad: place.pad.p,
            w: place.pad.J * v,
            jump: body.kinetic(&(v - state.dq)),
        }
    }
}

/// A substep that was taken.
pub(crate) struct Taken<'a> {
    pub(crate) parameters: &'a Parameters,
    pub(crate) solution: &'a Solution,
    /// Impulse of dry friction on the joints (N·m·s).
    pub(crate) friction: &'a Vector3<f64>,
    /// Where it began.
    pub(crate) left: &'a Left,
    /// State and place after it; the payload is still as before.
    pub(crate) after: (&'a State, &'a Place),
    pub(crate) dt: f64,
}

impl Taken<'_> {
    /// The energy that it moved.
    pub(crate) fn flow(&self, inputs: &Inputs) -> Flow {
        let (left, (after, to), dt) = (self.left, self.after, self.dt);
        let (v, jump) = (&after.dq, left.jump);
        let stop = self.solution.joint - self.friction;
        let stopped = stop != Vector3::zeros();
        let mut flow = Flow {
            work_tau: after.tau.dot(&(after.q - left.q)),
            work_f_h: Vector3::from(inputs.f_h).dot(&(to.handle.p - left.handle)),
            work_f_d: Vector3::from(inputs.f_d).dot(&(to.pad.p - left.pad)),
            loss_friction: -self.friction.dot(v),
            loss_viscous: dt * self.parameters.viscous().dot(&v.component_mul(v)),
            loss_stop: -stop.dot(v) + if stopped { jump } else { 0.0 },
            loss_rub: -self.solution.tangent.dot(&left.w),
            loss_step: if stopped { 0.0 } else { jump },
            ..Flow::default()
        };
        for (k, surface) in self.parameters.surfaces().iter().enumerate() {
            let facing = FACINGS[k];
            let penetration = surface.penetration(facing, left.pad[facing.axis()]);
            let delta_s = after.s[k] - left.s[k];
            flow.loss_surface += surface.c * delta_s * (delta_s / dt);
            flow.loss_impact += self.solution.normal[k] / dt * (left.s[k] - penetration);
            flow.loss_step += surface.wall().energy(delta_s);
        }
        flow
    }
}
