//! The arm as a plant: built, run, read.

use nalgebra::Vector3;

use super::drive::Drive;
use super::energy::{Energy, Ledger, Stored};
use super::flow::Flow;
use super::guess::Guess;
use super::parameters::{Parameters, Start};
use super::problem::FACINGS;
use super::rigid_body::RigidBody;
use super::servo::{Command, Drives};
use super::solver;
use super::state::{Configuration, Inputs, Place, Shown, State};
use super::surface::TooStiff;
use crate::ParameterError;

/// The 3-DoF geared exoskeleton arm with its payload, table and wall.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "Saved", into = "Saved"))]
pub struct Arm {
    pub(super) parameters: Parameters,
    pub(super) state: State,
    /// Follows from `parameters` and `state`.
    pub(super) configuration: Configuration,
    pub(crate) guess: Guess,
    pub(crate) shown: Shown,
    pub(super) ledger: Ledger,
    /// A payload hangs from the start on, and the vacuum has not been on yet.
    pub(super) kept: bool,
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
        Self {
            kept: state.attached,
            ..Self::of(parameters, state)
        }
    }

    /// The arm in `state`, where its energy balance begins; nothing is checked.
    pub fn of(parameters: Parameters, state: State) -> Self {
        let configuration = Configuration::of(&parameters, &state);
        Self {
            parameters,
            state,
            configuration,
            guess: Guess::default(),
            shown: Shown::default(),
            ledger: Ledger::open(&Stored::of(&parameters, &state, &configuration.body)),
            kept: false,
        }
    }

    /// Runs `n` substeps of `dt` (s) with `inputs` held. Returns the sum of the torques (N·m) that arrived at the joints in
    /// each.
    pub fn advance(&mut self, inputs: &Inputs, n: u32, dt: f64) -> Vector3<f64> {
        let lag = Drive::new(self.parameters.drive_cutoff, dt);
        let mut sum = Vector3::zeros();
        for _ in 0..n {
            self.substep(&lag, inputs, dt);
            sum += self.state.tau;
        }
        sum
    }

    /// The same; each substep is a cycle of the `drives`, and what they ask for takes the place of `inputs.tau_a`.
    #[cold]
    pub fn advance_driven(
        &mut self,
        drives: &Drives,
        inputs: &Inputs,
        n: u32,
        dt: f64,
    ) -> Vector3<f64> {
        let mut sum = Vector3::zeros();
        for _ in 0..n {
            let tau_a = drives.torque(&self.state.q, &self.state.dq);
            sum += self.advance(&Inputs { tau_a, ..*inputs }, 1, dt);
        }
        sum
    }

    /// The drives with their `command` in a step that begins now; `None`: they take torques.
    pub fn drives(&self, command: &Command) -> Option<Drives> {
        self.parameters.drives(command, &self.state.q)
    }

    /// One substep of `dt` (s), for which `drive` is made. Returns the energy that it moved.
    #[inline]
    pub fn substep(&mut self, drive: &Drive, inputs: &Inputs, dt: f64) -> Flow {
        let equation = self.equation(drive, inputs, dt);
        let solution = solver::solve(&equation.problem, &mut self.guess);
        let moved = self.take(&equation, &solution);
        let on = self.sucks(inputs.vacuum);
        let event = self.parameters.vacuum.event(
            self.state.attached,
            on,
            self.parameters.vacuum.breaks(&self.shown.hold),
            moved.pressure,
        );
        self.finish(moved.flow, event)
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
        self.shown.hold.tension()
    }

    /// Level force of the pad on the payload, its size, mean of the last substep (N); 0 without payload.
    pub fn shear(&self) -> f64 {
        self.shown.hold.shear()
    }

    /// Whether a payload hangs from the start on and waits for the vacuum to be on for the first time.
    pub fn kept(&self) -> bool {
        self.kept
    }

    /// The first surface in reach from which the pad, as heavy as it is here, rebounds with more than the share `lost` of its
    /// speed missing if a substep is `dt` (s).
    pub fn too_stiff(&self, dt: f64, lost: f64) -> Option<TooStiff> {
        let Configuration { place, body } = &self.configuration;
        let inverse = body.M.try_inverse()?;
        let mobility = (place.pad.J * inverse * place.pad.J.transpose()).diagonal();
        let Parameters { lengths, .. } = &self.parameters;
        let reach = lengths.reach();
        let surfaces = self.parameters.surfaces();
        ["table.k", "wall.k"]
            .into_iter()
            .enumerate()
            .find_map(|(i, name)| {
                let (surface, moves) = (&surfaces[i], mobility[FACINGS[i].axis()]);
                if surface.position.abs() > reach || moves <= 0.0 {
                    return None;
                }
                let (wall, m) = (surface.wall(), 1.0 / moves);
                let longest = wall.longest_substep(m, lost);
                (dt > longest).then(|| TooStiff {
                    name,
                    k: surface.k,
                    lost: wall.rebound_lost(m, dt),
                    longest,
                })
            })
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
    kept: bool,
}

#[cfg(feature = "serde")]
impl From<Arm> for Saved {
    fn from(arm: Arm) -> Self {
        Self {
            parameters: arm.parameters,
            state: arm.state,
            guess: arm.guess,
            shown: arm.shown,
            ledger: arm.ledger,
            kept: arm.kept,
        }
    }
}

#[cfg(feature = "serde")]
impl From<Saved> for Arm {
    fn from(saved: Saved) -> Self {
        Self {
            guess: saved.guess,
            shown: saved.shown,
            ledger: saved.ledger,
            kept: saved.kept,
            ..Self::of(saved.parameters, saved.state)
        }
    }
}
