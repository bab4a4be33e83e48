//! Ticks that do not come in time.
//!
//! A tick is due every T. What comes of one that is late or early:
//!
//! | what | how it is counted |
//! |---|---|
//! | the velocity dq | over the time since the last reading ([`motion`](crate::motion)) |
//! | the ledger | with the motion that there was; time does not enter it ([`ledger`](crate::ledger)) |
//! | the reach | of a motion, not of a speed: \|Δq\| ≤ v_max T, however long it took |
//! | where the nominal is | it has moved on at its velocity for the time that has passed, up to 10 T |
//! | how fast it is, ramps, timers, filters of forces | by ticks |

use crate::Real;
use core::fmt::{Display, Formatter};
use fmu_declaration::choices;

choices! { TIMING "Timing" "Whether a tick came in time":
    IN_TIME = 0 "in_time" "within a quarter of T";
    LATE = 1 "late" "by more than a quarter of T: velocities are those over the time that has passed";
    EARLY = 2 "early" "by more than a quarter of T: the motion counts for its part of a T in the velocity";
}

/// The item of [`TIMING`] for a tick that came `after` sample periods.
pub const fn of(after: Real) -> i32 {
    if after > 1.25 {
        LATE
    } else if after < 0.75 {
        EARLY
    } else {
        IN_TIME
    }
}

/// Sample periods (less or more than 0) by which a nominal has moved more than in a tick that came in time, at one that came
/// `after` of them. A longer pause than 10 is one that nobody foresees: it then stays where it was.
pub const fn more(after: Real) -> Real {
    if after <= MOST {
        after - 1.0
    } else {
        MOST - 1.0
    }
}

const MOST: Real = 10.0;

/// What the log is told of tick `number`, which came `after` sample periods, with its item `timing`.
pub fn message(timing: i32, number: u64, after: Real) -> impl Display {
    Message {
        timing,
        number,
        after,
    }
}

struct Message {
    timing: i32,
    number: u64,
    after: Real,
}

impl Display for Message {
    fn fmt(&self, f: &mut Formatter<'_>) -> core::fmt::Result {
        let Self {
            timing,
            number,
            after,
        } = self;
        let found = TIMING.items.iter().find(|item| item.value == *timing);
        let name = found.map_or("", |item| item.name);
        write!(
            f,
            "timing = {timing} ({name}): tick {number} came {after:.3} sample periods after the one before; this is said once"
        )
    }
}
