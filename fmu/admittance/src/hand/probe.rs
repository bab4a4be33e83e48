//! A probe: is it a hand that holds on, or is the swing meant?

use super::{HalfSwing, Impedance, THE_SAME, Watch};
use crate::Real;
use crate::real::max;

/// Half swings under the probe: two in which the robot settles to the damping, two that are compared.
const HALF_SWINGS: u32 = 4;
/// How far the impedance of a hand may move under the probe, over its magnitude. Measured on the arm with
/// `stiff_hand.probe` = 0.5: hands up to 0.13 while they still pull by a tenth, forces that are meant 0.28 and more.
const SAME_HAND: Real = 0.2;
/// Share of the force before the probe below which the swing has ended. One that is meant keeps 0.55 and more.
const ENDED: Real = 0.25;

/// A probe that goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Probe {
    /// The hand before it.
    reference: Impedance,
    /// Amplitude of f_h before it, N.
    strength: Real,
    half_swings: u32,
    /// Time since it began, s.
    elapsed: Real,
    /// The hand in the last half swing.
    last: Impedance,
}

/// What a probe says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer {
    /// Nothing yet.
    Open(Probe),
    /// It is a hand: the swing is the same, as that of a spring would be, whatever the robot does.
    Hand,
    /// It passes for a hand: the swing has ended, and the force with it, before there was an answer.
    Ended,
    /// It is meant: the force goes on, and is not that of a spring any more.
    Meant,
}

impl Probe {
    /// A probe of a swing with this `reference`, whose f_h has the amplitude `strength` (N).
    pub fn of(reference: Impedance, strength: Real) -> Self {
        Self {
            reference,
            strength,
            half_swings: 0,
            elapsed: 0.0,
            last: reference,
        }
    }

    /// The hand before the probe.
    pub fn reference(&self) -> &Impedance {
        &self.reference
    }

    /// After a half swing under the probe.
    pub fn after(self, half: &HalfSwing, watch: &Watch) -> Answer {
        let elapsed = self.elapsed + half.duration;
        if half.is_too_short(watch) {
            // Noise at a crossing of zero. Where there is nothing else in all the time of a probe, x does not swing any more.
            let on = Self { elapsed, ..self };
            return if elapsed < HALF_SWINGS as Real * watch.longest() * watch.T() {
                Answer::Open(on)
            } else {
                Answer::Meant
            };
        }
        let next = Self {
            half_swings: self.half_swings.saturating_add(1),
            elapsed,
            last: half.hand,
            ..self
        };
        let mean = self.last.towards(&half.hand, 0.5);
        let is_the_same = half.hand.apart(&self.reference) <= THE_SAME;
        if half.strength < max(ENDED * self.strength, watch.hand().f_min) {
            if is_the_same {
                Answer::Hand
            } else {
                Answer::Ended
            }
        } else if half.ended_late {
            // What swings too slowly for the band now is a hand that the damping holds, or a force that holds the robot.
            answer(is_the_same)
        } else if next.half_swings < HALF_SWINGS {
            Answer::Open(next)
        } else {
            answer(half.is_of_a_hand(watch) && mean.apart(&self.reference) <= SAME_HAND)
        }
    }
}

fn answer(is_a_hand: bool) -> Answer {
    if is_a_hand {
        Answer::Hand
    } else {
        Answer::Meant
    }
}
