//! A payload that a vacuum cup takes from the table, holds and may lose.
//!
//! The payload is a point mass of no height at the pad. While it is not held it does not exist for the arm: it rests
//! wherever the pad presses next. One that hangs from the start on stays until the vacuum has been on: an input that nobody
//! wired drops nothing.

use fmu_declaration::{Rows, Start};
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
    /// shear force between pad and payload, level, beyond which the bond breaks; 0: none breaks it
    #[parameter(49, name = "vacuum.F_shear", unit = NEWTON, range = 0.0..=1e9)]
    pub F_shear: f64,
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
    /// The bond could not bear the pull or the shear.
    Breaks,
}

/// Force with which a pad holds its payload (N), base frame, mean of a substep.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hold(pub Vector3<f64>);

impl Hold {
    /// What the acceleration `a` (m/s²) of a mass `m` (kg) takes beyond gravity and the force `f_e` (N) of the surfaces, which
    /// act on the payload while it is held.
    ///
    /// ```text
    /// m a = hold + m g + f_e
    /// ```
    pub(crate) fn of(m: f64, a: &Vector3<f64>, gravity: &[f64; 3], f_e: &Vector3<f64>) -> Self {
        Self((a - Vector3::from(*gravity)) * m - f_e)
    }

    /// Upward pull on the payload (N).
    pub fn tension(&self) -> f64 {
        self.0.z
    }

    /// Level force on the payload, its size (N).
    pub fn shear(&self) -> f64 {
        let square = self.0.x * self.0.x + self.0.y * self.0.y;
        libm::sqrt(square)
    }
}

impl Vacuum {
    /// What happens to a payload that is `attached` or not, from the vacuum's switch `on`, whether its load `breaks` the
    /// bond, and the `pressure` of the table on the pad (N).
    pub fn event(&self, attached: bool, on: bool, breaks: bool, pressure: f64) -> Event {
        match (attached, on) {
            (true, false) => Event::Released,
            (true, true) if breaks => Event::Breaks,
            (false, true) if pressure > self.F_attach => Event::Attaches,
            _ => Event::Stays,
        }
    }

    /// Whether `hold` is more than the bond bears.
    pub fn breaks(&self, hold: &Hold) -> bool {
        hold.tension() > self.F_max || (self.F_shear > 0.0 && hold.shear() > self.F_shear)
    }
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
            self.ledger.exchange(&flow);
        }
        self.kept &= self.state.attached;
        self.ledger.book(&flow);
        flow
    }

    /// Whether the cup sucks: `vacuum` says so, or a payload hangs from the start on and `vacuum` has not been true yet.
    pub(crate) fn sucks(&mut self, vacuum: bool) -> bool {
        self.kept &= !vacuum;
        vacuum || self.kept
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
