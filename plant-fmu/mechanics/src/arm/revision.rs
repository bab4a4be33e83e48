//! Where a guess contradicts the solution that was found from it, and what to guess instead.

use super::guess::{Guess, Motion};
use super::problem::{FACINGS, Problem, Solution};

/// What counts as a contradiction: one that rounding does not explain.
pub(crate) struct Check<'a> {
    problem: &'a Problem,
    /// Impulse (N·m·s, N·s).
    impulse: f64,
}

impl<'a> Check<'a> {
    pub(crate) fn of(problem: &'a Problem) -> Self {
        Self {
            problem,
            impulse: problem.rounding(),
        }
    }

    /// Velocity of joint `i` (rad/s) that counts as rounding, ≥ 0.
    fn v(&self, i: usize) -> f64 {
        self.impulse / self.problem.A[(i, i)]
    }

    /// Revises `guess` where `solution`, found from it, contradicts it: everywhere, or where it does first. Returns
    /// whether it did.
    pub(crate) fn revise(&self, solution: &Solution, guess: &mut Guess, singly: bool) -> bool {
        let mut revised = false;
        let w = self.problem.J * solution.v;
        for (k, facing) in FACINGS.iter().enumerate() {
            let n = self.problem.contacts[k].pressure(*facing, &w);
            if guess.pushes[k] && n < -self.impulse {
                guess.pushes[k] = false;
                revised = true;
            } else if !guess.pushes[k] && n > self.impulse {
                guess.pushes[k] = true;
                revised = true;
            }
            if singly && revised {
                return true;
            }
        }
        for i in 0..3 {
            let next = self.joint(i, guess.joint[i], solution);
            revised |= next != guess.joint[i];
            guess.joint[i] = next;
            if singly && revised {
                return true;
            }
        }
        revised
    }

    /// The motion of joint `i` that follows from its velocity and impulse.
    fn joint(&self, i: usize, motion: Motion, solution: &Solution) -> Motion {
        let joint = &self.problem.joints[i];
        let (v, impulse) = (solution.v[i], solution.joint[i]);
        // Each velocity is first compared without rounding: that it does not pass is the rule, and costs no division.
        match motion {
            Motion::Forward if v < 0.0 && v < -self.v(i) => Motion::Held,
            Motion::Forward if v > joint.high && v > joint.high + self.v(i) => {
                beyond(joint.high, Motion::High)
            }
            Motion::Backward if v > 0.0 && v > self.v(i) => Motion::Held,
            Motion::Backward if v < joint.low && v < joint.low - self.v(i) => {
                beyond(joint.low, Motion::Low)
            }
            Motion::Held if impulse < joint.least() - self.impulse => Motion::Forward,
            Motion::Held if impulse > joint.most() + self.impulse => Motion::Backward,
            Motion::High if impulse > -joint.against[0] + self.impulse => Motion::Forward,
            Motion::Low if impulse < joint.against[1] - self.impulse => Motion::Backward,
            _ => motion,
        }
    }

    /// The guess that a solution of another method amounts to.
    pub(crate) fn seen(&self, solution: &Solution) -> Guess {
        let mut guess = Guess::default();
        for k in 0..FACINGS.len() {
            guess.pushes[k] = solution.normal[k] > self.impulse;
        }
        for i in 0..3 {
            let joint = &self.problem.joints[i];
            let (v, impulse) = (solution.v[i], solution.joint[i]);
            guess.joint[i] = if v >= joint.high && joint.high > 0.0 {
                Motion::High
            } else if v <= joint.low && joint.low < 0.0 {
                Motion::Low
            } else if impulse <= -joint.against[0] || impulse >= joint.against[1] {
                sliding(v, self.v(i))
            } else {
                Motion::Held
            };
        }
        guess
    }
}

/// Sliding in the sense of `velocity`, or held where that is within `rounding`.
fn sliding(velocity: f64, rounding: f64) -> Motion {
    if velocity > rounding {
        Motion::Forward
    } else if velocity < -rounding {
        Motion::Backward
    } else {
        Motion::Held
    }
}

/// A joint that would pass a stop arrives at it, or leans on it if it is there.
fn beyond(velocity: f64, arrives: Motion) -> Motion {
    if velocity == 0.0 {
        Motion::Held
    } else {
        arrives
    }
}
