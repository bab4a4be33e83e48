//! The two arms as a plant: built, run, read.

use fmu_declaration::Rows;
use nalgebra::Vector3;

use super::bond::{Bond, Ledger as BondLedger};
use super::coupling::{Coupled, Coupling, SIGNS};
use super::energy::{self, Balance};
use crate::arm::drive::Drive;
use crate::arm::payload::Event;
use crate::arm::servo::Drives;
use crate::arm::substep::Moved;
use crate::arm::{self, Arm, Inputs, Start, solver};
use crate::parameter::{ParameterError, in_range};

/// What the two arms are made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Rows)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Parameters {
    /// Each arm, with its table and wall; its `payload_m` is the whole payload, its `vacuum` one cup.
    #[part]
    pub arm: arm::Parameters,
    /// What the payload ties together.
    #[part(from = 37)]
    pub bond: Bond,
}

/// Two arms, left and right, and the payload that they share.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pair {
    bond: Bond,
    /// Each with half the payload, in coordinates of its own shoulder.
    arms: [Arm; 2],
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
        in_range(&parameters.bond)?;
        Ok(Self::start(parameters, start))
    }

    fn start(parameters: Parameters, start: &Start) -> Self {
        let mut arm = parameters.arm;
        arm.payload_m *= 0.5;
        Self {
            bond: parameters.bond,
            arms: [Arm::start(arm, start); 2],
            offset: Vector3::zeros(),
            impulse: Vector3::zeros(),
            lambda: Vector3::zeros(),
            rounds: 0,
            ledger: BondLedger::default(),
        }
    }

    /// Runs `n` substeps of `dt` (s) with the `inputs` of the left and the right arm held. Returns the sums of the torques
    /// (N·m) that arrived at their joints in each.
    pub fn advance(&mut self, inputs: &[Inputs; 2], n: u32, dt: f64) -> [Vector3<f64>; 2] {
        self.advance_driven([None, None], inputs, n, dt)
    }

    /// The same; where an arm has `drives`, each substep is a cycle of theirs, and what they ask for takes the place of its
    /// `tau_a`.
    pub fn advance_driven(
        &mut self,
        drives: [Option<&Drives>; 2],
        inputs: &[Inputs; 2],
        n: u32,
        dt: f64,
    ) -> [Vector3<f64>; 2] {
        let lag = Drive::new(self.arms[0].parameters().drive_cutoff, dt);
        let mut inputs = *inputs;
        let mut sums = [Vector3::zeros(); 2];
        for _ in 0..n {
            for (i, arm) in self.arms.iter().enumerate() {
                if let Some(drives) = drives[i] {
                    inputs[i].tau_a = drives.torque(&arm.q(), &arm.dq());
                }
            }
            self.substep(&lag, &inputs, dt);
            for (sum, arm) in sums.iter_mut().zip(&self.arms) {
                *sum += arm.tau_applied();
            }
        }
        sums
    }

    fn substep(&mut self, drive: &Drive, inputs: &[Inputs; 2], dt: f64) {
        let attached = self.attached();
        let g = self.g();
        let [left, right] = &mut self.arms;
        let of_left = left.equation(drive, &inputs[0], dt);
        let of_right = right.equation(drive, &inputs[1], dt);
        let mut guesses = [left.guess, right.guess];
        let coupled = if attached {
            Coupling {
                push: g * (-dt * self.bond.k),
                kappa_dt: self.bond.impedance(dt) * dt,
            }
            .solve(
                [&of_left.problem, &of_right.problem],
                &mut guesses,
                &self.impulse,
            )
        } else {
            Coupled {
                impulse: Vector3::zeros(),
                solutions: [
                    solver::solve(&of_left.problem, &mut guesses[0]),
                    solver::solve(&of_right.problem, &mut guesses[1]),
                ],
                rounds: 0,
            }
        };
        (left.guess, right.guess) = (guesses[0], guesses[1]);
        let moved = [
            left.take(&of_left, &coupled.solutions[0]),
            right.take(&of_right, &coupled.solutions[1]),
        ];
        let lambda = coupled.impulse / dt;
        if attached {
            for (arm, sign) in self.arms.iter_mut().zip(SIGNS) {
                arm.shown.hold.0 -= lambda * sign;
            }
        }
        let event = self.event(inputs, &moved);
        for (arm, moved) in self.arms.iter_mut().zip(moved) {
            arm.finish(moved.flow, event);
        }
        if attached {
            let after = self.offset_now() - self.offset;
            self.ledger.book(&self.bond, &g, &after, dt);
            if event != Event::Stays {
                self.ledger.release(&self.bond, &after);
            }
        }
        if event == Event::Attaches {
            self.offset = self.offset_now();
        }
        self.impulse = coupled.impulse;
        (self.lambda, self.rounds) = (lambda, coupled.rounds);
    }

    /// What happens to the payload: gripped by both cups or by none, held by both or by none.
    fn event(&mut self, inputs: &[Inputs; 2], moved: &[Moved; 2]) -> Event {
        let attached = self.attached();
        let [left, right] = &mut self.arms;
        let suck = [left.sucks(inputs[0].vacuum), right.sucks(inputs[1].vacuum)];
        let vacuum = &left.parameters().vacuum;
        vacuum.event(
            attached,
            suck[0] && suck[1],
            vacuum.breaks(&left.shown.hold) || vacuum.breaks(&right.shown.hold),
            moved[0].pressure.min(moved[1].pressure),
        )
    }

    /// p_L − p_R, each from its own shoulder (m).
    fn offset_now(&self) -> Vector3<f64> {
        self.arms[0].place().pad.p - self.arms[1].place().pad.p
    }

    /// g (m); 0 without payload.
    fn g(&self) -> Vector3<f64> {
        if self.attached() {
            self.offset_now() - self.offset
        } else {
            Vector3::zeros()
        }
    }

    /// The left and the right arm, each in coordinates of its own shoulder and with half the payload. Its `tension` is what
    /// its cup bears: the weight and inertia of its half, less what surfaces and the other half bear. The work of the other
    /// arm, through λ, is missing from its energy balance and makes up the residual there.
    pub fn arms(&self) -> &[Arm; 2] {
        &self.arms
    }

    /// Whether the payload hangs at both pads.
    pub fn attached(&self) -> bool {
        self.arms[0].attached()
    }

    /// By how much the pads have left the offset that they had at the grip (m): |p_L − p_R − r|; 0 without payload.
    pub fn gap(&self) -> f64 {
        self.g().norm()
    }

    /// Force λ of the right half of the payload on the left one, base frame, mean of the last substep (N); 0 without.
    pub fn lambda(&self) -> Vector3<f64> {
        self.lambda
    }

    /// Moment of both wrists together on the payload, base frame, mean of the last substep (N·m); 0 without. Each pad holds its
    /// half with a force, and these forces have a moment about the payload's middle, as they stand `shoulders` apart (m, of the
    /// left one from the right one). Nothing but wrists can bear it where the payload keeps its direction:
    ///
    /// ```text
    /// wrist = (p_L − p_R) × λ
    /// ```
    pub fn wrist(&self, shoulders: &Vector3<f64>) -> Vector3<f64> {
        (self.offset_now() + shoulders).cross(&self.lambda)
    }

    /// Rounds that λ took in the last substep, at most [`super::coupling::ROUNDS`].
    pub fn rounds(&self) -> u32 {
        self.rounds
    }

    /// Energy balance since the start.
    pub fn energy(&self) -> Balance {
        let bond = self.bond.energy(&self.g());
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
