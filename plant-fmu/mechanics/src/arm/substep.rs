//! One substep of the arm: the implicit equation put together, what its solution does to the state, and the energy.

use nalgebra::{Matrix3, Vector3};

use super::drive::Drive;
use super::floored;
use super::flow::{Flow, Taken};
use super::guess::Guess;
use super::kinematics::Pose;
use super::parameters::Parameters;
use super::payload::{self, Event};
use super::problem::{Contact, FACINGS, Joint, Problem, Solution};
use super::rigid_body::RigidBody;
use super::solver;
use super::state::{Inputs, Place, Shown, State};
use super::surface::Surface;

impl Parameters {
    /// Table and wall, in the order of [`FACINGS`].
    pub(crate) fn surfaces(&self) -> [&Surface; 2] {
        [&self.table, &self.wall]
    }

    /// The rigid body at `pose`, with a held payload or without.
    pub(crate) fn body(&self, pose: &Pose, attached: bool) -> RigidBody {
        let payload = if attached { self.payload_m } else { 0.0 };
        RigidBody::at(pose, &self.lengths, &self.masses, payload)
    }

    /// Viscous friction of the joints (N·m·s/rad).
    pub(crate) fn viscous(&self) -> Vector3<f64> {
        Vector3::new(self.friction[0].b, self.friction[1].b, self.friction[2].b)
    }
}

/// The equation of a substep of `dt` (s) from `state`, with the torques `tau` (N·m) at the joints. Backward Euler in the
/// velocity; configuration and Coriolis terms at the begin:
///
/// ```text
/// (M + dt B) v = M dq + dt (τ + J_hᵀ f_h + J_pᵀ f_d − C dq − g) + impulses of friction, stops and surfaces
/// ```
pub fn problem(
    parameters: &Parameters,
    state: &State,
    place: &Place,
    body: &RigidBody,
    tau: &Vector3<f64>,
    inputs: &Inputs,
    dt: f64,
) -> Problem {
    let State { q, dq, .. } = state;
    let (f_h, f_d) = (Vector3::from(inputs.f_h), Vector3::from(inputs.f_d));
    let torque =
        tau + place.handle.J.tr_mul(&f_h) + place.pad.J.tr_mul(&f_d) - body.C(dq) * dq - body.g;
    let contact = |k: usize| {
        let (facing, surface) = (FACINGS[k], parameters.surfaces()[k]);
        let wall = surface.wall();
        let kappa = wall.impedance(dt);
        let beyond =
            surface.penetration(facing, place.pad.p[facing.axis()]) - wall.relaxed(state.s[k], dt);
        Contact {
            push: kappa * beyond,
            kappa_dt: kappa * dt,
            mu: surface.mu,
        }
    };
    Problem {
        A: body.M + Matrix3::from_diagonal(&(parameters.viscous() * dt)),
        b: body.M * dq + torque * dt,
        joints: [0, 1, 2].map(|i| Joint {
            limit: parameters.friction[i].limit(dq[i]) * dt,
            low: ((parameters.stops[i].min - q[i]) / dt).min(0.0),
            high: ((parameters.stops[i].max - q[i]) / dt).max(0.0),
        }),
        J: place.pad.J,
        contacts: [contact(0), contact(1)],
    }
}

/// A substep whose equation is put together, but not solved: from where it starts, and what acts.
pub(crate) struct Posed<'a> {
    pub(crate) parameters: &'a Parameters,
    pub(crate) state: &'a State,
    pub(crate) place: &'a Place,
    pub(crate) inputs: &'a Inputs,
    /// Torques at the joints (N·m).
    pub(crate) tau: Vector3<f64>,
    pub(crate) body: RigidBody,
    pub(crate) problem: Problem,
    pub(crate) dt: f64,
}

/// Where a substep arrives, what it showed and what it moved; the payload is still as before.
pub(crate) struct Arrived {
    pub(crate) state: State,
    pub(crate) place: Place,
    pub(crate) shown: Shown,
    pub(crate) flow: Flow,
    /// Force of the table along its normal (N).
    pub(crate) pressure: f64,
}

impl<'a> Posed<'a> {
    #[inline]
    pub(crate) fn at(
        parameters: &'a Parameters,
        drive: &Drive,
        state: &'a State,
        place: &'a Place,
        inputs: &'a Inputs,
        dt: f64,
    ) -> Self {
        let tau = drive.step(&state.tau, &Vector3::from(inputs.tau_a));
        let body = parameters.body(&place.pose, state.attached);
        let problem = problem(parameters, state, place, &body, &tau, inputs, dt);
        Self {
            parameters,
            state,
            place,
            inputs,
            tau,
            body,
            problem,
            dt,
        }
    }

    /// What the `solution` does.
    #[inline]
    pub(crate) fn take(&self, solution: &Solution) -> Arrived {
        let Self {
            parameters,
            state,
            place,
            inputs,
            ref tau,
            ref body,
            ref problem,
            dt,
        } = *self;
        let mut next = State {
            q: state.q + solution.v * dt,
            dq: solution.v.map(floored),
            tau: *tau,
            ..*state
        };
        for (q, stops) in next.q.iter_mut().zip(&parameters.stops) {
            *q = q.max(stops.min).min(stops.max); // not beyond a stop, not by rounding either
        }
        let there = Place::at(parameters, &next.q);
        for (k, surface) in parameters.surfaces().iter().enumerate() {
            let penetration = surface.penetration(FACINGS[k], there.pad.p[FACINGS[k].axis()]);
            next.s[k] = penetration.max(surface.wall().relaxed(state.s[k], dt));
        }

        let friction = Vector3::from_fn(|i, _| problem.joints[i].friction(solution.joint[i]));
        let flow = Taken {
            parameters,
            body,
            solution,
            friction: &friction,
            before: (state, place),
            after: (&next, &there),
            dt,
        }
        .flow(inputs);
        let mut shown = Shown {
            f_e: problem.on_pad(&solution.normal, &solution.tangent) / dt,
            tau_f: friction / dt - next.dq.component_mul(&parameters.viscous()),
            tension: 0.0,
            contact: solution.normal[0] > 0.0 || solution.normal[1] > 0.0,
            path: solution.path,
        };
        if state.attached {
            let a = (there.pad.J * next.dq - place.pad.J * state.dq) / dt;
            let (m, gravity) = (parameters.payload_m, &parameters.masses.gravity);
            shown.tension = payload::tension(m, &a, gravity, &shown.f_e);
        }
        Arrived {
            state: next,
            place: there,
            shown,
            flow,
            pressure: solution.normal[0] / dt,
        }
    }
}

impl Arrived {
    /// The payload is gripped, released or lost.
    #[inline]
    pub(crate) fn exchange(&mut self, parameters: &Parameters, event: Event) {
        if event == Event::Stays || parameters.payload_m == 0.0 {
            return;
        }
        let Self {
            state, place, flow, ..
        } = self;
        let m = parameters.payload_m;
        let potential = -m * Vector3::from(parameters.masses.gravity).dot(&place.pad.p);
        let without = parameters.body(&place.pose, false);
        if event == Event::Attaches {
            let with = parameters.body(&place.pose, true);
            let v = payload::gripped(&without, &with, &state.dq);
            flow.payload = potential;
            flow.loss_grip =
                without.kinetic(&(state.dq - v)) + 0.5 * m * (place.pad.J * v).norm_squared();
            state.dq = v;
            state.attached = true;
        } else {
            flow.payload = -(potential + 0.5 * m * (place.pad.J * state.dq).norm_squared());
            state.attached = false;
        }
    }
}

/// Advances `state` by `dt` (s) with `inputs` held. `place` is the arm at `state.q`, and afterwards at the new one; `guess`
/// carries the solver's guess on.
pub fn substep(
    parameters: &Parameters,
    drive: &Drive,
    state: &mut State,
    place: &mut Place,
    guess: &mut Guess,
    inputs: &Inputs,
    dt: f64,
) -> (Shown, Flow) {
    let posed = Posed::at(parameters, drive, state, place, inputs, dt);
    let mut arrived = posed.take(&solver::solve(&posed.problem, guess));
    let event = parameters.vacuum.event(
        state.attached,
        inputs.vacuum,
        arrived.shown.tension,
        arrived.pressure,
    );
    arrived.exchange(parameters, event);
    (*state, *place) = (arrived.state, arrived.place);
    (arrived.shown, arrived.flow)
}
