//! Finds the impulse between the halves of the payload: two arms' implicit problems and the bond, together.
//!
//! Each arm answers an impulse Λ on its pad with a velocity that [`solver::solve`] finds exactly, friction, stops and
//! surfaces included. This answer is monotone and piecewise smooth, linear unless the pad slides on a surface, so that
//!
//! ```text
//! F(Λ) = Λ − push + κ dt (w_L(Λ) − w_R(Λ)) = 0        push = −dt k g
//! ```
//!
//! has one solution, and Newton's iteration with the derivative of the present piece, I + κ dt (W_L + W_R), ends on it after
//! as many rounds as pieces are crossed: one, as a rule; on a piece that is not straight two or three. A step that goes too far is shortened by the rule of false position.

use nalgebra::{Matrix3, Vector3};

use crate::arm::guess::Guess;
use crate::arm::linear::Linear;
use crate::arm::problem::{Problem, Solution};
use crate::arm::solver;

/// Rounds after which the impulse is taken as it is.
pub const ROUNDS: u32 = 40;
/// The sign with which Λ acts on the left and the right pad.
pub const SIGNS: [f64; 2] = [1.0, -1.0];
/// Converged where F is this many roundings of the arms' problems, times the bond's amplification of them.
const ROUNDINGS: f64 = 1e3;
/// A step may leave this share of the slope it started with, to the other side.
const OVERSHOOT: f64 = 0.5;

/// The bond in one substep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupling {
    /// Impulse on the left pad if the pads did not move apart or together (N·s).
    pub push: Vector3<f64>,
    /// By how much it shrinks per relative velocity: κ dt (kg).
    pub kappa_dt: f64,
}

/// Impulse between the halves and the arms' answers to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupled {
    /// Λ, on the left pad (N·s).
    pub impulse: Vector3<f64>,
    /// Velocities and impulses of the left and the right arm.
    pub solutions: [Solution; 2],
    /// Rounds that it took, at most [`ROUNDS`].
    pub rounds: u32,
}

/// Answer to an impulse that was tried.
#[derive(Clone, Copy)]
struct Tried {
    impulse: Vector3<f64>,
    solutions: [Solution; 2],
    guesses: [Guess; 2],
    F: Vector3<f64>,
}

/// b of `problem` (N·m·s) with the impulse `on_pad` (N·s) on the pad.
fn pushed(problem: &Problem, on_pad: &Vector3<f64>) -> Vector3<f64> {
    problem.b + problem.J.tr_mul(on_pad)
}

/// W = ∂w/∂Λ (1/kg) where `guess` holds and the impulse `on_pad` (N·s) acts on the pad.
fn mobility(problem: &Problem, guess: &Guess, on_pad: &Vector3<f64>) -> Matrix3<f64> {
    Linear::of(guess, problem).mobility(&pushed(problem, on_pad))
}

impl Coupling {
    /// Solves both `problems` with the bond between them, starting from the impulse `last` (N·s) and from `guesses`, and
    /// leaving the right guesses there.
    pub fn solve(
        &self,
        problems: [&Problem; 2],
        guesses: &mut [Guess; 2],
        last: &Vector3<f64>,
    ) -> Coupled {
        let rounding = problems[0].rounding() + problems[1].rounding();
        let mut now = self.tried(problems, *guesses, *last);
        let mut rounds = 0;
        let mut slope = self.slope(problems, &now);
        let mut straight = true; // the slope is that of the present piece
        while rounds < ROUNDS {
            if now.F.amax() <= ROUNDINGS * rounding * slope.amax() {
                break;
            }
            if !straight {
                slope = self.slope(problems, &now);
            }
            // Regular: the identity and, on every piece, what does not pull back.
            let delta = slope.try_inverse().unwrap_or_else(Matrix3::identity) * -now.F;
            let begin = now.F.dot(&delta);
            let mut share = 1.0;
            let next = loop {
                rounds += 1;
                let next = self.tried(problems, now.guesses, now.impulse + delta * share);
                let end = next.F.dot(&delta);
                if end <= -OVERSHOOT * begin || rounds >= ROUNDS {
                    break next;
                }
                share *= begin / (begin - end);
            };
            straight = next.guesses == now.guesses && !next.guesses.iter().any(Guess::touches);
            now = next;
        }
        *guesses = now.guesses;
        Coupled {
            impulse: now.impulse,
            solutions: now.solutions,
            rounds,
        }
    }

    /// ∂F/∂Λ at what was `tried`.
    fn slope(&self, problems: [&Problem; 2], tried: &Tried) -> Matrix3<f64> {
        let W =
            [0, 1].map(|i| mobility(problems[i], &tried.guesses[i], &(tried.impulse * SIGNS[i])));
        Matrix3::identity() + (W[0] + W[1]) * self.kappa_dt
    }

    fn tried(
        &self,
        problems: [&Problem; 2],
        mut guesses: [Guess; 2],
        impulse: Vector3<f64>,
    ) -> Tried {
        let solutions = [0, 1].map(|i| {
            let problem = Problem {
                b: pushed(problems[i], &(impulse * SIGNS[i])),
                ..*problems[i]
            };
            solver::solve(&problem, &mut guesses[i])
        });
        let w = [0, 1].map(|i| problems[i].J * solutions[i].v);
        Tried {
            impulse,
            solutions,
            guesses,
            F: impulse - self.push + (w[0] - w[1]) * self.kappa_dt,
        }
    }
}
