//! Half swings in a row that are of one hand.

use super::{HalfSwing, Impedance, Watch};
use crate::Real;
use crate::real::min;

/// Growth of f_h in a period beyond which there is no time to probe: a force that is meant and sets in on a straight line
/// grows by 5, 2.3 and then 1.8 between half swings that are a period apart.
const FAST: Real = 2.0;
/// Least ratio of f_h to that of a period before in a swing that lasts.
const LASTING: Real = 0.9;
/// How far apart, over their magnitude, the impedances of one hand may be: they are measured with the friction and the
/// noise that half a swing has.
const SAME: Real = 0.3;
/// Half swings that the mean impedance remembers.
const MEAN_OVER: Real = 4.0;

/// Half swings in a row that count and are of one hand.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Run {
    /// Amplitude of f_h in the last half swing and in the one before, N; 0: not known.
    strength: [Real; 2],
    /// Mean impedance of the run.
    hand: Impedance,
    /// Half swings that are of one hand.
    same: u32,
    /// … each with no less force than the one before it.
    rising: u32,
    /// … that are above `f_min` and last or grow.
    lasting: u32,
    /// … in which f_h has grown by `growth` since a period before.
    grown: u32,
    /// … by [`FAST`].
    grown_fast: u32,
}

impl Run {
    /// After a half swing.
    #[must_use]
    pub fn after(&self, half: &HalfSwing, watch: &Watch) -> Self {
        if half.is_too_short(watch) {
            return *self;
        }
        let [last, before] = self.strength;
        let strength = if half.ended_late {
            [0.0; 2]
        } else {
            [half.strength, last]
        };
        if !half.is_of_a_hand(watch) {
            return Self {
                strength,
                ..Self::default()
            };
        }
        let of_one_hand = self.same > 0 && half.hand.apart(&self.hand) <= SAME;
        let (hand, same) = if of_one_hand {
            let same = self.same.saturating_add(1);
            let share = 1.0 / min(same as Real, MEAN_OVER);
            (self.hand.towards(&half.hand, share), same)
        } else {
            (half.hand, 1)
        };
        let since = |factor: Real| before > 0.0 && half.strength >= factor * before;
        let counted = |holds: bool, n: u32| if holds { n.saturating_add(1) } else { 0 };
        Self {
            strength,
            hand,
            same,
            rising: if of_one_hand && half.strength >= last {
                self.rising.saturating_add(1)
            } else {
                1
            },
            lasting: counted(
                since(LASTING) && half.strength >= watch.hand().f_min,
                if of_one_hand { self.lasting } else { 0 },
            ),
            grown: counted(since(watch.hand().growth), self.grown),
            grown_fast: counted(since(FAST), self.grown_fast),
        }
    }

    /// Mean impedance of its half swings, the last four above all.
    pub fn hand(&self) -> &Impedance {
        &self.hand
    }

    /// Half swings in a row that are of one hand.
    pub fn same(&self) -> u32 {
        self.same
    }

    /// Half swings in a row that are of one hand, each with no less force than the one before it.
    pub fn rising(&self) -> u32 {
        self.rising
    }

    /// Half swings in a row that have grown.
    pub fn grown(&self) -> u32 {
        self.grown
    }

    /// Half swings in a row that have grown by more than twice a period.
    pub fn grown_fast(&self) -> u32 {
        self.grown_fast
    }

    /// Half swings in a row that are of one hand, above `f_min`, and have not shrunk.
    pub fn lasting(&self) -> u32 {
        self.lasting
    }
}
