//! An adversary of the energy tank: it searches for motions, forces, gains and commands that empty it.
//!
//! The claim, under `passive_bounded` with alpha > 0 and for every motion within the reach: the tank stays ≥ 0, hence
//! G ≤ E_0, and the energy that left the controller exceeds what came in by no more than E_0. `docs/passivity.md` has the
//! argument.
//!
//! An [`attack`](attack::Attack) is a [`target`](attack::Target) and some [`genes`]. They are read as a [`case`](case::Case):
//! gains, sample time, delay, limits, how the robot moves ([`motions`]), what the force sensor says ([`forces`]), how often
//! what is commanded changes. A [`trial`] runs it and compares the law's ledger with an [`audit`] that looks at the ports only.
//! Whatever is left to chance comes from the case's seed, so that an attack is one line of text, which can be kept
//! ([`regressions`]).

#![allow(
    non_snake_case,
    reason = "the paper's symbols with its capitals: M_n, K_P, T, H, G"
)]

pub mod attack;
pub mod audit;
pub mod case;
pub mod forces;
pub mod genes;
pub mod motions;
pub mod plain;
pub mod plain_servo;
pub mod random;
pub mod regressions;
pub mod servo;
pub mod subject;
pub mod trial;
pub mod tuning;
