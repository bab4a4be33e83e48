//! The arm as a plant: built, run, read.

use nalgebra::Vector3;

use super::drive::Drive;
use super::energy::{Energy, Ledger, Stored};
use super::flow::Flow;
use super::guess::Guess;
use super::parameters::{Parameters, Start};
use super::payload::{self, Event};
use super::rigid_body::RigidBody;
use super::solver;
use super::state::{Configuration, Inputs, Place, Shown, State};
use super::substep::{Arrived, Posed};
use crate::ParameterError;

/// The 3-DoF geared exoskeleton arm with its payload, table and wall.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "Saved", into = "Saved"))]
pub struct Arm {
    parameters: Parameters,
    state: State,
    /// Follows from `parameters` and `state`.
    configuration: Configuration,
    pub(crate) guess: Guess,
    pub(crate) shown: Shown,
    ledger: Ledger,
}

impl Default for Arm {
    /// The default arm at rest in its start pose.
    fn default() -> Self {
        Self::start(Parameters::default(), &Start::default())
    }
}

impl Arm {
    /// The arm at `start`: no torque, the surfaces undeflected.
    ///
    /// # Errors
    /// A parameter outside its range; a start beyond a stop or inside a surface.
    pub fn new(parameters: Parameters, start: &Start) -> Result<Self, ParameterError> {
        parameters.check(start)?;
        Ok(Self::start(parameters, start))
    }

    pub(crate) fn start(parameters: Parameters, start: &Start) -> Self {
        let state = State {
            q: Vector3::from(start.q),
            dq: Vector3::from(start.dq),
            tau: Vector3::zeros(),
            s: [0.0; 2],
            attached: start.attached && parameters.payload_m > 0.0,
        };
        let configuration = Configuration::of(&parameters, &state);
        Self {
            parameters,
            state,
            configuration,
            guess: Guess::default(),
            shown: Shown::default(),
            ledger: Ledger::open(&Stored::of(&parameters, &state, &configuration.body)),
        }
    }

    /// Runs `n` substeps of `dt` (s) with `inputs` held.
    pub fn advance(&mut self, inputs: &Inputs, n: u32, dt: f64) {
        let drive = Drive::new(self.parameters.drive_cutoff, dt);
        for _ in 0..n {
            let posed = self.posed(&drive, inputs, dt);
            let mut guess = self.guess;
            let arrived = posed.take(&solver::solve(&posed.problem, &mut guess));
            let event = self.parameters.vacuum.event(
                self.state.attached,
                inputs.vacuum,
                arrived.shown.tension,
                arrived.pressure,
            );
            self.guess = guess;
            self.arrive(&arrived, event);
        }
    }

    /// A substep from here, not yet solved.
    pub(crate) fn posed<'a>(&'a self, drive: &Drive, inputs: &'a Inputs, dt: f64) -> Posed<'a> {
        Posed::at(
            &self.parameters,
            drive,
            &self.state,
            &self.configuration,
            inputs,
            dt,
        )
    }

    /// Goes where a substep arrived; then the payload is gripped, released or lost.
    pub(crate) fn arrive(&mut self, arrived: &Arrived, event: Event) {
        (self.state, self.shown) = (arrived.state, arrived.shown);
        if let Some(configuration) = arrived.configuration {
            self.configuration = configuration;
        }
        let mut flow = arrived.flow;
        if event != Event::Stays && self.parameters.payload_m > 0.0 {
            self.exchange(event, &mut flow);
        }
        self.ledger.book(&flow);
    }

    fn exchange(&mut self, event: Event, flow: &mut Flow) {
        let Self {
            parameters,
            state,
            configuration,
            ..
        } = self;
        let Configuration { place, body } = configuration;
        let m = parameters.payload_m;
        let potential = -m * Vector3::from(parameters.masses.gravity).dot(&place.pad.p);
        state.attached = event == Event::Attaches;
        let exchanged = parameters.body(&place.pose, state.attached);
        if state.attached {
            let v = payload::gripped(body, &exchanged, &state.dq);
            flow.payload = potential;
            flow.loss_grip =
                body.kinetic(&(state.dq - v)) + 0.5 * m * (place.pad.J * v).norm_squared();
            state.dq = v;
        } else {
            flow.payload = -(potential + 0.5 * m * (place.pad.J * state.dq).norm_squared());
        }
        *body = exchanged;
    }

    /// What the arm is made of.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// Joint angles and velocities, torques, deflections, payload.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Joint angles (rad).
    pub fn q(&self) -> Vector3<f64> {
        self.state.q
    }

    /// Joint velocities (rad/s).
    pub fn dq(&self) -> Vector3<f64> {
        self.state.dq
    }

    /// Pose, handle and pad with their Jacobians.
    pub fn place(&self) -> &Place {
        &self.configuration.place
    }

    /// Mass matrix, Coriolis terms and gravity, with the payload if it is attached.
    pub fn body(&self) -> &RigidBody {
        &self.configuration.body
    }

    /// Position of the handle, base frame (m).
    pub fn p(&self) -> Vector3<f64> {
        self.place().handle.p
    }

    /// Velocity of the handle, base frame (m/s).
    pub fn dp(&self) -> Vector3<f64> {
        self.place().handle.J * self.state.dq
    }

    /// Torques that arrive at the joints (N·m).
    pub fn tau_applied(&self) -> Vector3<f64> {
        self.state.tau
    }

    /// Force of table and wall on the pad, or on the payload that it holds; base frame, mean of the last substep (N).
    pub fn f_e(&self) -> Vector3<f64> {
        self.shown.f_e
    }

    /// Whether a payload hangs at the pad.
    pub fn attached(&self) -> bool {
        self.state.attached
    }

    /// Whether table or wall pushed in the last substep.
    pub fn contact(&self) -> bool {
        self.shown.contact
    }

    /// Upward pull of the pad on the payload, mean of the last substep (N); 0 without payload.
    pub fn tension(&self) -> f64 {
        self.shown.tension
    }

    /// What the last substep showed.
    pub fn shown(&self) -> &Shown {
        &self.shown
    }

    /// Energy balance since the start.
    pub fn energy(&self) -> Energy {
        self.ledger
            .balance(&Stored::of(&self.parameters, &self.state, self.body()))
    }
}

/// An arm as it is saved: without what follows from the rest.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct Saved {
    parameters: Parameters,
    state: State,
    guess: Guess,
    shown: Shown,
    ledger: Ledger,
}

#[cfg(feature = "serde")]
impl From<Arm> for Saved {
    fn from(arm: Arm) -> Self {
        let Arm {
            parameters,
            state,
            configuration: _,
            guess,
            shown,
            ledger,
        } = arm;
        Self {
            parameters,
            state,
            guess,
            shown,
            ledger,
        }
    }
}

#[cfg(feature = "serde")]
impl From<Saved> for Arm {
    fn from(saved: Saved) -> Self {
        let Saved {
            parameters,
            state,
            guess,
            shown,
            ledger,
        } = saved;
        let configuration = Configuration::of(&parameters, &state);
        Self {
            parameters,
            state,
            configuration,
            guess,
            shown,
            ledger,
        }
    }
}
