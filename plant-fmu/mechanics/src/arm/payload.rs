//! A payload that a vacuum cup takes from the table, holds and may lose.
//!
//! The payload is a point mass of no height at the pad. While it is not held it does not exist for the arm: it rests
//! wherever the pad presses next.

use declaration::{Rows, Start};
use nalgebra::Vector3;

use super::flow::Flow;
use super::plant::Arm;
use super::rigid_body::RigidBody;
use super::state::Configuration;

/// The vacuum cup.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Vacuum {
    /// pull on the payload beyond which the bond breaks
    #[parameter(25, name = "vacuum.F_max", unit = NEWTON, range = 0.0..=1e9, start = 450.0)]
    pub F_max: f64,
    /// force of the table on the pad beyond which the cup grips the payload
    #[parameter(26, name = "vacuum.F_attach", unit = NEWTON, range = 0.0..=1e9, start = 5.0)]
    pub F_attach: f64,
}

/// What happens to the payload at the end of a substep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// Nothing.
    Stays,
    /// The cup grips a payload.
    Attaches,
    /// The vacuum is off: the payload is left behind.
    Released,
    /// The bond could not bear the pull.
    Breaks,
}

impl Vacuum {
    /// What happens to a payload that is `attached` or not, from the vacuum's switch `on`, the `tension` of the bond
    /// (N) and the `pressure` of the table on the pad (N).
    pub fn event(&self, attached: bool, on: bool, tension: f64, pressure: f64) -> Event {
        match (attached, on) {
            (true, false) => Event::Released,
            (true, true) if tension > self.F_max => Event::Breaks,
            (false, true) if pressure > self.F_attach => Event::Attaches,
            _ => Event::Stays,
        }
    }
}

/// Upward pull of the pad on a payload of mass `m` (kg), in N: what its acceleration `a` (m/s²) takes beyond gravity and
/// the force `f_e` (N) of the surfaces, which act on the payload while it is held. Base frame, z.
///
/// ```text
/// m a_z = tension + m g_z + f_e,z
/// ```
pub fn tension(m: f64, a: &Vector3<f64>, gravity: &[f64; 3], f_e: &Vector3<f64>) -> f64 {
    m * (a.z - gravity[2]) - f_e.z
}

/// Joint velocities after a resting payload was gripped: M⁺ v⁺ = M v. The impulse acts at the pad; it is too short for
/// friction, stops and surfaces to answer. `with` has the payload, `without` has not.
pub fn gripped(without: &RigidBody, with: &RigidBody, v: &Vector3<f64>) -> Vector3<f64> {
    // M⁺ is positive definite for all accepted parameters.
    with.M
        .try_inverse()
        .map_or(*v, |inverse| inverse * (without.M * v))
}

impl Arm {
    /// The payload is gripped, released or lost; what the substep moved, `flow` and the payload's share, is booked and
    /// returned.
    #[inline]
    pub(crate) fn finish(&mut self, mut flow: Flow, event: Event) -> Flow {
        if event != Event::Stays && self.parameters.payload_m > 0.0 {
            self.exchange(&mut flow, event);
        }
        self.ledger.book(&flow);
        flow
    }

    fn exchange(&mut self, flow: &mut Flow, event: Event) {
        let Self {
            parameters,
            state,
            configuration: Configuration { place, body },
            ..
        } = self;
        let m = parameters.payload_m;
        let potential = -m * Vector3::from(parameters.masses.gravity).dot(&place.pad.p);
        state.attached = event == Event::Attaches;
        let exchanged = parameters.body(&place.pose, state.attached);
        if state.attached {
            let v = gripped(body, &exchanged, &state.dq);
            flow.payload = potential;
            flow.loss_grip =
                body.kinetic(&(state.dq - v)) + 0.5 * m * (place.pad.J * v).norm_squared();
            state.dq = v;
        } else {
            flow.payload = -(potential + 0.5 * m * (place.pad.J * state.dq).norm_squared());
        }
        *body = exchanged;
    }
}
