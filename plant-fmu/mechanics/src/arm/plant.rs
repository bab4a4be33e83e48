//! The arm as a plant: built, run, read.

use nalgebra::Vector3;

use super::drive::Drive;
use super::energy::{Energy, Ledger, Stored};
use super::guess::Guess;
use super::parameters::{Parameters, Start};
use super::state::{Inputs, Place, Shown, State};
use super::substep::substep;
use crate::ParameterError;

/// The 3-DoF geared exoskeleton arm with its payload, table and wall.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Arm {
    parameters: Parameters,
    state: State,
    guess: Guess,
    shown: Shown,
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

    fn start(parameters: Parameters, start: &Start) -> Self {
        let mut arm = Self {
            parameters,
            state: State {
                q: Vector3::from(start.q),
                dq: Vector3::from(start.dq),
                tau: Vector3::zeros(),
                s: [0.0; 2],
                attached: start.attached && parameters.payload_m > 0.0,
            },
            guess: Guess::default(),
            shown: Shown::default(),
            ledger: Ledger::default(),
        };
        arm.ledger = Ledger::open(&arm.stored());
        arm
    }

    /// Runs `n` substeps of `dt` (s) with `inputs` held.
    pub fn advance(&mut self, inputs: &Inputs, n: u32, dt: f64) {
        let drive = Drive::new(self.parameters.drive_cutoff, dt);
        let mut place = self.place();
        for _ in 0..n {
            let (shown, flow) = substep(
                &self.parameters,
                &drive,
                &mut self.state,
                &mut place,
                &mut self.guess,
                inputs,
                dt,
            );
            self.shown = shown;
            self.ledger.book(&flow);
        }
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
    pub fn place(&self) -> Place {
        Place::at(&self.parameters, &self.state.q)
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
        self.ledger.balance(&self.stored())
    }

    fn stored(&self) -> Stored {
        Stored::of(&self.parameters, &self.state, &self.place())
    }
}
