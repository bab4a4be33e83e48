//! One substep of the arm: the implicit equation put together, what its solution does to the state, and the energy.

use nalgebra::{Matrix3, Vector3};

use super::drive::Drive;
use super::floored;
use super::flow::{Flow, Left, Taken};
use super::kinematics::Pose;
use super::order::{least, most};
use super::parameters::Parameters;
use super::payload::Hold;
use super::plant::Arm;
use super::problem::{Contact, FACINGS, Joint, Problem, Solution};
use super::rigid_body::RigidBody;
use super::state::{Configuration, Inputs, Place, Shown, State};
use super::surface::Surface;

impl Parameters {
    /// Table and wall, in the order of [`FACINGS`].
    pub(crate) fn surfaces(&self) -> [Surface; 2] {
        [self.table.surface(), self.wall.surface()]
    }

    /// The rigid body at `pose`, with a held payload or without.
    #[inline]
    pub(crate) fn body(&self, pose: &Pose, attached: bool) -> RigidBody {
        let payload = if attached { self.payload_m } else { 0.0 };
        RigidBody::at(pose, &self.lengths, &self.masses, payload)
    }

    /// The same, written into `body`: a copy would wait for what was just written.
    #[inline(never)]
    pub(crate) fn weigh(&self, body: &mut RigidBody, pose: &Pose, attached: bool) {
        *body = self.body(pose, attached);
    }

    /// Deflections (m) to which table and wall relax from `s` within `dt` (s).
    fn relaxed(&self, s: &[f64; 2], dt: f64) -> [f64; 2] {
        let surfaces = self.surfaces();
        [0, 1].map(|k| surfaces[k].wall().relaxed(s[k], dt))
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
    let relaxed = parameters.relaxed(&state.s, dt);
    put_together(parameters, state, place, body, tau, inputs, &relaxed, dt)
}

/// The same with the deflections to which the surfaces relax (m).
#[inline(always)]
#[allow(
    clippy::too_many_arguments,
    reason = "the terms of one equation, each by its name"
)]
fn put_together(
    parameters: &Parameters,
    state: &State,
    place: &Place,
    body: &RigidBody,
    tau: &Vector3<f64>,
    inputs: &Inputs,
    relaxed: &[f64; 2],
    dt: f64,
) -> Problem {
    let State { q, dq, .. } = state;
    let (f_h, f_d) = (Vector3::from(inputs.f_h), Vector3::from(inputs.f_d));
    let torque =
        tau + place.handle.J.tr_mul(&f_h) + place.pad.J.tr_mul(&f_d) - body.C(dq) * dq - body.g;
    let contact = |k: usize| {
        let (facing, surface) = (FACINGS[k], parameters.surfaces()[k]);
        let kappa = surface.wall().impedance(dt);
        let beyond = surface.penetration(facing, place.pad.p[facing.axis()]) - relaxed[k];
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
            against: parameters.gear_loss[i]
                .against(tau[i] * dt, parameters.friction[i].limit(dq[i]) * dt),
            low: ((parameters.stops[i].min - q[i]) / dt).min(0.0),
            high: ((parameters.stops[i].max - q[i]) / dt).max(0.0),
        }),
        J: place.pad.J,
        contacts: [contact(0), contact(1)],
    }
}

/// A substep whose equation is put together, but not solved.
pub(crate) struct Equation<'a> {
    inputs: &'a Inputs,
    /// Torques at the joints (N·m).
    tau: Vector3<f64>,
    pub(crate) problem: Problem,
    /// Deflections to which the surfaces relax (m).
    relaxed: [f64; 2],
    dt: f64,
}

/// What a substep moved; the payload is still as before.
pub(crate) struct Moved {
    pub(crate) flow: Flow,
    /// Force of the table along its normal (N).
    pub(crate) pressure: f64,
}

impl Arm {
    /// The substep of `dt` (s) from here.
    #[inline]
    pub(crate) fn equation<'a>(&self, drive: &Drive, inputs: &'a Inputs, dt: f64) -> Equation<'a> {
        let Self {
            parameters,
            state,
            configuration: Configuration { place, body },
            ..
        } = self;
        let tau = drive.step(&state.tau, &Vector3::from(inputs.tau_a));
        let relaxed = parameters.relaxed(&state.s, dt);
        Equation {
            inputs,
            tau,
            problem: put_together(parameters, state, place, body, &tau, inputs, &relaxed, dt),
            relaxed,
            dt,
        }
    }

    /// Does what the `solution` of the `equation` says.
    #[inline]
    pub(crate) fn take(&mut self, equation: &Equation<'_>, solution: &Solution) -> Moved {
        let Equation {
            inputs,
            tau,
            ref problem,
            relaxed,
            dt,
        } = *equation;
        let Self {
            parameters,
            state,
            configuration,
            ..
        } = self;
        let v = solution.v.map(floored);
        let Configuration { place: from, body } = &*configuration;
        let left = Left::of(state, from, body, &v);
        let w_before = if state.attached {
            from.pad.J * state.dq
        } else {
            Vector3::zeros() // not used
        };
        (state.q, state.dq, state.tau) = (left.q + solution.v * dt, v, tau);
        for (q, stops) in state.q.iter_mut().zip(&parameters.stops) {
            *q = least(most(*q, stops.min), stops.max); // not beyond a stop, not by rounding either
        }
        if !identical(&state.q, &left.q) {
            configuration.follow(parameters, state);
        }
        let to = &configuration.place;
        for (k, surface) in parameters.surfaces().iter().enumerate() {
            let penetration = surface.penetration(FACINGS[k], to.pad.p[FACINGS[k].axis()]);
            state.s[k] = most(penetration, relaxed[k]);
        }

        let friction = Vector3::from_fn(|i, _| problem.joints[i].friction(solution.joint[i]));
        let flow = Taken {
            parameters,
            solution,
            friction: &friction,
            left: &left,
            after: (state, to),
            dt,
        }
        .flow(inputs);
        self.shown = Shown {
            f_e: problem.on_pad(&solution.normal, &solution.tangent) / dt,
            tau_f: friction / dt - state.dq.component_mul(&parameters.viscous()),
            hold: Hold::default(),
            contact: solution.normal[0] > 0.0 || solution.normal[1] > 0.0,
            path: solution.path,
        };
        if state.attached {
            let a = (to.pad.J * state.dq - w_before) / dt;
            let (m, gravity) = (parameters.payload_m, &parameters.masses.gravity);
            self.shown.hold = Hold::of(m, &a, gravity, &self.shown.f_e);
        }
        Moved {
            flow,
            pressure: solution.normal[0] / dt,
        }
    }
}

/// Equal in every bit: −0 is not 0.
fn identical(a: &Vector3<f64>, b: &Vector3<f64>) -> bool {
    a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits())
}
