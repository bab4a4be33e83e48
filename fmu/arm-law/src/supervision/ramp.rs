//! What changes gradually between states.

use super::parameters::Durations;
use super::state::State;
use admittance::Real;

/// The authority of the law and the freedom of its nominal, both in [0, 1].
///
/// ```text
/// engaging    authority = min(1, k/n_engage)          k = 0, 1, … since it engaged
/// stopping    authority = a (1 − j/n_soft_stop)       j = 0, 1, … since the stop began, a = what it was then
/// held        freedom   = max(0, 1 − (i + 1)/n_brake) i = 0, 1, … since it was first held
/// ```
///
/// Counted in whole ticks, so that 0 and 1 are met exactly.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ramp {
    engaged: u32,
    stopping: u32,
    held: u32,
    authority: Real,
    stopped_from: Real,
    freedom: Real,
}

impl Ramp {
    /// One tick further: the state was `before` and is now `now`.
    pub fn advance(&mut self, before: State, now: State, durations: &Durations) {
        if !now.acts() {
            *self = Self::default();
            return;
        }
        if !before.acts() {
            *self = Self::default();
        } else if before != State::SoftStop {
            self.engaged = self.engaged.saturating_add(1);
        }

        if now == State::SoftStop {
            if before == State::SoftStop {
                self.stopping = self.stopping.saturating_add(1);
            } else {
                (self.stopping, self.stopped_from) = (0, self.authority);
            }
            self.authority = self.stopped_from * (1.0 - share(self.stopping, durations.soft_stop));
        } else {
            self.authority = share(self.engaged, durations.engage);
        }

        self.held = if now.holds() {
            self.held.saturating_add(1)
        } else {
            0
        };
        self.freedom = 1.0 - share(self.held, durations.brake);
    }

    /// Share of its force that the law may exert.
    pub const fn authority(&self) -> Real {
        self.authority
    }

    /// Share of the velocity that the nominal had when it was first held that it may still have; 1 while it is free.
    pub const fn freedom(&self) -> Real {
        self.freedom
    }

    /// Whether a soft stop has brought the authority down to 0.
    pub const fn stopped(&self, durations: &Durations) -> bool {
        self.stopping >= durations.soft_stop
    }
}

/// min(1, k/n), exactly 0 and 1 at the ends.
fn share(k: u32, n: u32) -> Real {
    if k >= n { 1.0 } else { k as Real / n as Real }
}
