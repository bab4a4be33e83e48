//! A guess of which forces hold, slide and push.

use super::linear::Linear;
use super::problem::{Problem, Solution};

/// What a joint does, as far as dry friction and stops are concerned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Motion {
    /// Held at rest, by friction or by a stop that it leans on.
    #[default]
    Held,
    /// Slides in the positive direction, friction at its limit.
    Forward,
    /// Slides in the negative direction, friction at its limit.
    Backward,
    /// Arrives at the upper stop.
    High,
    /// Arrives at the lower stop.
    Low,
}

/// Which joints hold and slide, and which surfaces push. Kept from one substep to the next. Whether a surface holds the
/// pad or lets it slide follows from these.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Guess {
    /// The joints.
    pub joint: [Motion; 3],
    /// Which surfaces push: table, wall.
    pub pushes: [bool; 2],
}

impl Guess {
    /// Does a surface push?
    pub(crate) fn touches(&self) -> bool {
        self.pushes[0] || self.pushes[1]
    }

    /// Takes the guess for granted and solves what remains: sliding joints have friction at its limit, held ones a velocity
    /// instead of an equation, surfaces that push are springs with friction.
    pub fn solve(&self, problem: &Problem) -> Solution {
        Linear::of(self, problem).solve(&problem.b)
    }
}
