//! One substep of the arm: the implicit equation put together, what its solution does to the state, and the energy.

use nalgebra::{Matrix3, Vector3};

use super::drive::Drive;
use super::floored;
use super::flow::{Flow, Taken};
use super::kinematics::Pose;
use super::parameters::Parameters;
use super::payload;
use super::problem::{Contact, FACINGS, Joint, Problem, Solution};
use super::rigid_body::RigidBody;
use super::state::{Configuration, Inputs, Place, Shown, State};
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
    pub(crate) from: &'a Configuration,
    pub(crate) inputs: &'a Inputs,
    /// Torques at the joints (N·m).
    pub(crate) tau: Vector3<f64>,
    pub(crate) problem: Problem,
    pub(crate) dt: f64,
}

/// Where a substep arrives, what it showed and what it moved; the payload is still as before.
pub(crate) struct Arrived {
    pub(crate) state: State,
    /// None where the joints did not move.
    pub(crate) configuration: Option<Configuration>,
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
        from: &'a Configuration,
        inputs: &'a Inputs,
        dt: f64,
    ) -> Self {
        let tau = drive.step(&state.tau, &Vector3::from(inputs.tau_a));
        let problem = problem(parameters, state, &from.place, &from.body, &tau, inputs, dt);
        Self {
            parameters,
            state,
            from,
            inputs,
            tau,
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
            from,
            inputs,
            ref tau,
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
        let configuration =
            (!identical(&next.q, &state.q)).then(|| Configuration::of(parameters, &next));
        let to = configuration.as_ref().unwrap_or(from);
        for (k, surface) in parameters.surfaces().iter().enumerate() {
            let penetration = surface.penetration(FACINGS[k], to.place.pad.p[FACINGS[k].axis()]);
            next.s[k] = penetration.max(surface.wall().relaxed(state.s[k], dt));
        }

        let friction = Vector3::from_fn(|i, _| problem.joints[i].friction(solution.joint[i]));
        let flow = Taken {
            parameters,
            body: &from.body,
            solution,
            friction: &friction,
            before: (state, &from.place),
            after: (&next, &to.place),
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
            let a = (to.place.pad.J * next.dq - from.place.pad.J * state.dq) / dt;
            let (m, gravity) = (parameters.payload_m, &parameters.masses.gravity);
            shown.tension = payload::tension(m, &a, gravity, &shown.f_e);
        }
        Arrived {
            state: next,
            configuration,
            shown,
            flow,
            pressure: solution.normal[0] / dt,
        }
    }
}

/// Equal in every bit: −0 is not 0.
fn identical(a: &Vector3<f64>, b: &Vector3<f64>) -> bool {
    a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits())
}
