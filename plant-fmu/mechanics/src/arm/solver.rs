//! The implicit velocity problem, solved directly: guess which forces hold, solve the linear equation, check the guess.
//!
//! From one substep to the next the answer to "who slides, who holds, who pushes" rarely changes, so the last answer is
//! the first guess. A wrong guess is revised where it contradicts its own solution: first everywhere at once, then, should
//! that go in circles, in one place at a time; projected Gauss–Seidel is the last resort. The work is bounded.

use super::gauss_seidel;
use super::guess::{Guess, Motion};
use super::order::{least, most};
use super::problem::{Path, Problem, Solution};
use super::revision::Check;

/// Rounds in which every contradiction is revised.
const TOGETHER: u32 = 10;
/// Rounds after that, in which the first contradiction is revised.
const SINGLY: u32 = 30;

/// Solves `problem`, starting from `guess` and leaving the right one there.
pub fn solve(problem: &Problem, guess: &mut Guess) -> Solution {
    let check = Check::of(problem);
    for round in 0..TOGETHER + SINGLY {
        let mut solution = guess.solve(problem);
        if !check.revise(&solution, guess, round >= TOGETHER) {
            if round > 0 {
                solution.path = Path::Revised(round);
            }
            settle(problem, &mut solution, guess);
            return solution;
        }
    }
    let swept = gauss_seidel::solve(problem, gauss_seidel::SWEEPS);
    *guess = check.seen(&swept);
    let mut solution = guess.solve(problem);
    if check.revise(&solution, &mut guess.clone(), false) {
        return swept; // as good as it got
    }
    solution.path = swept.path;
    settle(problem, &mut solution, guess);
    solution
}

/// Removes what rounding left: no sliding against its sense, no force beyond what its law allows; friction on the surfaces
/// keeps to it already.
fn settle(problem: &Problem, solution: &mut Solution, guess: &Guess) {
    for (i, joint) in problem.joints.iter().enumerate() {
        let (v, impulse) = (&mut solution.v[i], &mut solution.joint[i]);
        match guess.joint[i] {
            Motion::Forward => *v = v.max(0.0).min(joint.high),
            Motion::Backward => *v = v.min(0.0).max(joint.low),
            Motion::Held => *impulse = least(most(*impulse, joint.least()), joint.most()),
            Motion::High => *impulse = least(*impulse, -joint.against[0]),
            Motion::Low => *impulse = most(*impulse, joint.against[1]),
        }
    }
    if guess.touches() {
        for n in &mut solution.normal {
            *n = n.max(0.0);
        }
    }
}
