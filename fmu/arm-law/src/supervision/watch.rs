//! Conditions that need a memory.

use admittance::Real;

/// A counter that a living partner keeps changing, whatever its steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Heartbeat {
    last: Option<i32>,
    /// Ticks since it changed; as many as can be as long as it never did.
    age: u32,
}

impl Heartbeat {
    /// Nothing heard yet.
    pub const fn new() -> Self {
        Self {
            last: None,
            age: u32::MAX,
        }
    }

    /// Takes note of the counter at a tick. The first value is no change.
    pub fn hear(&mut self, counter: i32) {
        let changed = self.last.is_some_and(|last| last != counter);
        self.age = if changed {
            0
        } else {
            self.age.saturating_add(1)
        };
        self.last = Some(counter);
    }

    /// Whether it has not changed for `timeout` ticks; never with a timeout of 0.
    pub const fn lost(&self, timeout: u32) -> bool {
        timeout > 0 && self.age >= timeout
    }
}

impl Default for Heartbeat {
    fn default() -> Self {
        Self::new()
    }
}

/// A Boolean of which the rising edge counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Edge {
    was: bool,
}

impl Edge {
    /// As if it had been true before: a first value of true is no edge.
    pub const fn new() -> Self {
        Self { was: true }
    }

    /// Whether it rises at this tick.
    pub fn rises(&mut self, is: bool) -> bool {
        let rises = is && !self.was;
        self.was = is;
        rises
    }
}

impl Default for Edge {
    fn default() -> Self {
        Self::new()
    }
}

/// Whether the human's hand is at rest, with hysteresis: |f_h| < enter for a while, until |f_h| > leave.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hand {
    /// Ticks in a row with |f_h| < enter.
    calm: u32,
    rests: bool,
}

impl Hand {
    /// Whether it rests after |f_h| = `force` (N) at a tick; `hold` is the number of calm ticks that it takes.
    pub fn rests(&mut self, force: Real, enter: Real, leave: Real, hold: u32) -> bool {
        self.calm = if force < enter {
            self.calm.saturating_add(1)
        } else {
            0
        };
        if force > leave || enter <= 0.0 {
            self.rests = false;
        } else if self.calm > hold {
            self.rests = true;
        }
        self.rests
    }
}

/// For how many ticks in a row something has held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Lasting {
    ticks: u32,
}

impl Lasting {
    /// The number of ticks in a row, this one included.
    pub fn count(&mut self, holds: bool) -> u32 {
        self.ticks = if holds {
            self.ticks.saturating_add(1)
        } else {
            0
        };
        self.ticks
    }
}
