//! The two arms as a plant: built, run, read.

use nalgebra::Vector3;

use super::bond::{Bond, Ledger as BondLedger};
use super::coupling::{Coupled, Coupling, SIGNS};
use super::energy::{self, Balance};
use crate::ParameterError;
use crate::arm::drive::Drive;
use crate::arm::energy::{Ledger, Stored};
use crate::arm::guess::Guess;
use crate::arm::payload::Event;
use crate::arm::state::{Place, Shown};
use crate::arm::substep::{Arrived, Posed};
use crate::arm::{self, Inputs, Start, State, solver};

/// What the two arms are made of.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Parameters {
    /// Each arm, with its table and wall; its `payload_m` is the whole payload, its `vacuum` one cup.
    pub arm: arm::Parameters,
    /// What the payload ties together.
    pub bond: Bond,
}

/// One of the arms, in coordinates of its own shoulder.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Half {
    /// With half the payload.
    parameters: arm::Parameters,
    state: State,
    guess: Guess,
    shown: Shown,
    ledger: Ledger,
}

impl Half {
    fn start(parameters: arm::Parameters, start: &Start) -> Self {
        let state = State {
            q: Vector3::from(start.q),
            dq: Vector3::from(start.dq),
            tau: Vector3::zeros(),
            s: [0.0; 2],
            attached: start.attached && parameters.payload_m > 0.0,
        };
        let place = Place::at(&parameters, &state.q);
        Self {
            parameters,
            state,
            guess: Guess::default(),
            shown: Shown::default(),
            ledger: Ledger::open(&Stored::of(&parameters, &state, &place)),
        }
    }

    /// Joint angles and velocities, torques, deflections, payload.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Joint angles (rad).
    pub fn q(&self) -> Vector3<f64> {
        self.state.q
    }

    /// Pose, handle and pad with their Jacobians; origin at this arm's shoulder.
    pub fn place(&self) -> Place {
        Place::at(&self.parameters, &self.state.q)
    }

    /// What the last substep showed. `tension` is what this cup bears: the weight and inertia of its half, less what
    /// surfaces and the other half bear.
    pub fn shown(&self) -> &Shown {
        &self.shown
    }

    /// This arm's own balance: the work of the other one, through λ, is missing from it and makes up its residual.
    pub fn energy(&self) -> arm::Energy {
        self.ledger
            .balance(&Stored::of(&self.parameters, &self.state, &self.place()))
    }
}

/// Two arms, left and right, and the payload that they share.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pair {
    bond: Bond,
    arms: [Half; 2],
    /// p_L − p_R at the grip, each from its own shoulder (m).
    offset: Vector3<f64>,
    /// Λ of the last substep (N·s): where the next one starts to search.
    impulse: Vector3<f64>,
    lambda: Vector3<f64>,
    rounds: u32,
    ledger: BondLedger,
}

impl Default for Pair {
    /// Both arms at rest in their start pose, nothing to touch or to carry.
    fn default() -> Self {
        Self::start(Parameters::default(), &Start::default())
    }
}

impl Pair {
    /// Both arms at `start`: no torque, the surfaces undeflected.
    ///
    /// # Errors
    /// A parameter outside its range; a start beyond a stop or inside a surface.
    pub fn new(parameters: Parameters, start: &Start) -> Result<Self, ParameterError> {
        parameters.arm.check(start)?;
        parameters.bond.check()?;
        Ok(Self::start(parameters, start))
    }

    fn start(parameters: Parameters, start: &Start) -> Self {
        let mut arm = parameters.arm;
        arm.payload_m *= 0.5;
        Self {
            bond: parameters.bond,
            arms: [Half::start(arm, start); 2],
            offset: Vector3::zeros(),
            impulse: Vector3::zeros(),
            lambda: Vector3::zeros(),
            rounds: 0,
            ledger: BondLedger::default(),
        }
    }

    /// Runs `n` substeps of `dt` (s) with the `inputs` of the left and the right arm held.
    pub fn advance(&mut self, inputs: &[Inputs; 2], n: u32, dt: f64) {
        let drive = Drive::new(self.arms[0].parameters.drive_cutoff, dt);
        let mut places = [self.arms[0].place(), self.arms[1].place()];
        for _ in 0..n {
            self.substep(&drive, inputs, &mut places, dt);
        }
    }

    fn substep(&mut self, drive: &Drive, inputs: &[Inputs; 2], places: &mut [Place; 2], dt: f64) {
        let attached = self.attached();
        let g = self.gap_at(places);
        let posed = [0, 1].map(|i| {
            let half = &self.arms[i];
            let (parameters, state) = (&half.parameters, &half.state);
            Posed::at(parameters, drive, state, &places[i], &inputs[i], dt)
        });
        let mut guesses = [self.arms[0].guess, self.arms[1].guess];
        let coupled = if attached {
            Coupling {
                push: g * (-dt * self.bond.k),
                kappa_dt: self.bond.impedance(dt) * dt,
            }
            .solve(
                [&posed[0].problem, &posed[1].problem],
                &mut guesses,
                &self.impulse,
            )
        } else {
            Coupled {
                impulse: Vector3::zeros(),
                solutions: [0, 1].map(|i| solver::solve(&posed[i].problem, &mut guesses[i])),
                rounds: 0,
            }
        };
        let mut arrived = [0, 1].map(|i| posed[i].take(&coupled.solutions[i]));
        let lambda = coupled.impulse / dt;
        if attached {
            for (arrived, sign) in arrived.iter_mut().zip(SIGNS) {
                arrived.shown.tension -= sign * lambda.z;
            }
        }
        let event = self.event(inputs, &arrived);
        for arrived in &mut arrived {
            arrived.exchange(&self.arms[0].parameters, event);
        }
        *places = [arrived[0].place, arrived[1].place];
        if attached {
            let after = self.gap_at(places);
            self.ledger.book(&self.bond, &g, &after, dt);
            if event != Event::Stays {
                self.ledger.release(&self.bond, &after);
            }
        }
        for ((half, arrived), guess) in self.arms.iter_mut().zip(&arrived).zip(guesses) {
            (half.state, half.shown, half.guess) = (arrived.state, arrived.shown, guess);
            half.ledger.book(&arrived.flow);
        }
        if event == Event::Attaches {
            self.offset = places[0].pad.p - places[1].pad.p;
        }
        self.impulse = coupled.impulse;
        (self.lambda, self.rounds) = (lambda, coupled.rounds);
    }

    /// What happens to the payload: gripped by both cups or by none, held by both or by none.
    fn event(&self, inputs: &[Inputs; 2], arrived: &[Arrived; 2]) -> Event {
        let [left, right] = arrived;
        self.arms[0].parameters.vacuum.event(
            self.attached(),
            inputs[0].vacuum && inputs[1].vacuum,
            left.shown.tension.max(right.shown.tension),
            left.pressure.min(right.pressure),
        )
    }

    fn gap_at(&self, places: &[Place; 2]) -> Vector3<f64> {
        if self.attached() {
            places[0].pad.p - places[1].pad.p - self.offset
        } else {
            Vector3::zeros()
        }
    }

    /// The left and the right arm.
    pub fn arms(&self) -> &[Half; 2] {
        &self.arms
    }

    /// Whether the payload hangs at both pads.
    pub fn attached(&self) -> bool {
        self.arms[0].state.attached
    }

    /// By how much the pads have left the offset that they had at the grip (m): |p_L − p_R − r|; 0 without payload.
    pub fn gap(&self) -> f64 {
        self.gap_at(&[self.arms[0].place(), self.arms[1].place()])
            .norm()
    }

    /// Force λ of the right half of the payload on the left one, base frame, mean of the last substep (N); 0 without.
    pub fn lambda(&self) -> Vector3<f64> {
        self.lambda
    }

    /// Rounds that λ took in the last substep, at most [`super::coupling::ROUNDS`].
    pub fn rounds(&self) -> u32 {
        self.rounds
    }

    /// Energy balance since the start.
    pub fn energy(&self) -> Balance {
        let g = self.gap_at(&[self.arms[0].place(), self.arms[1].place()]);
        let bond = self.bond.energy(&g);
        let loss_bond = self.ledger.loss.value();
        let (loss_step, left) = (self.ledger.loss_step.value(), self.ledger.left.value());
        let arms = energy::sum(&self.arms[0].energy(), &self.arms[1].energy());
        Balance {
            arms: arm::Energy {
                loss_step: arms.loss_step + loss_step,
                payload: arms.payload - left,
                residual: arms.residual - loss_step - left - loss_bond - bond,
                ..arms
            },
            bond,
            loss_bond,
        }
    }
}
