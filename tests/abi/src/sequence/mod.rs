//! Random calls in random order on two instances that share their FMU states, checked against what should come of them.
//!
//! After every call: the status is the one that the standard's table, the rights and the rows' bounds forecast
//! ([`expected`]); a refusal is one message under its function's name if logging is on, and none if it is off; nothing
//! else is logged as an error. A restored state is the saved one, bit for bit. Before an instance is reset, replaced or
//! given a state, and at the end, its accepted calls are repeated on a new instance that is alone: both must be equal bit
//! for bit ([`journal`]). So neither the other instance nor a refused call has left a trace.
//!
//! | module | what |
//! |---|---|
//! | [`subject`] | the FMU, values for its variables |
//! | [`call`] | the calls, and the number that stands for each |
//! | [`expected`] | what should come of a call |
//! | [`journal`] | the accepted calls, repeated alone |
//! | [`player`] | one instance, its calls and its checks |
//! | [`slot`] | saved FMU states |
//! | [`search`] | many sequences from a seed; the shortest one that fails |

pub mod call;
pub mod expected;
pub mod journal;
pub mod player;
pub mod search;
pub mod slot;
pub mod subject;

pub use call::{Call, decode};
pub use subject::Subject;

use call::SLOTS;
use player::Player;
use slot::Slot;

/// What happened in a sequence, or in many.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Calls.
    pub calls: u64,
    /// Calls that ended with fmi2OK.
    pub accepted: u64,
    /// Legal calls to which the model had an objection.
    pub objected: u64,
    /// Steps that failed.
    pub broken: u64,
    /// States restored.
    pub restored: u64,
    /// Calls after which the instance was in each [`Phase`](crate::Phase).
    pub phases: [u64; 5],
}

impl Tally {
    /// Adds another one.
    pub fn add(&mut self, other: &Self) {
        self.calls += other.calls;
        self.accepted += other.accepted;
        self.objected += other.objected;
        self.broken += other.broken;
        self.restored += other.restored;
        for (sum, n) in self.phases.iter_mut().zip(other.phases) {
            *sum += n;
        }
    }
}

/// Plays one sequence.
///
/// # Errors
/// Which call did not do what it should, and what it did.
pub fn play(subject: &Subject, numbers: &[u32]) -> Result<Tally, String> {
    let mut players = [Player::new(subject), Player::new(subject)];
    let mut slots: [Option<Slot>; SLOTS] = [None, None, None];
    let mut tally = Tally::default();
    for (k, &number) in numbers.iter().enumerate() {
        let (i, call) = decode(number, subject);
        players[i]
            .play(call, &mut slots, &mut tally)
            .map_err(|what| format!("call {k}, instance {i}, {call:?}: {what}"))?;
        tally.calls += 1;
        tally.phases[players[i].expected.phase as usize] += 1;
    }
    for (i, player) in players.iter_mut().enumerate() {
        player
            .settle()
            .map_err(|what| format!("at the end, instance {i}: {what}"))?;
    }
    for slot in slots.into_iter().flatten() {
        slot.free(players[0].instance())?;
    }
    Ok(tally)
}
