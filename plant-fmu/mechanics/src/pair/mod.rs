//! Two arms that carry one payload: a closed chain through the table, the arms and what they hold.
//!
//! ```
//! use mechanics::arm::{Inputs, Start};
//! use mechanics::pair::{Pair, Parameters};
//!
//! let mut parameters = Parameters::default();
//! parameters.arm.payload_m = 35.0; // shared by both
//! let mut pair = Pair::new(parameters, &Start { attached: true, ..Start::default() })?;
//!
//! let rest = Inputs { vacuum: true, ..Inputs::default() };
//! let pull = Inputs { tau_a: [20.0, 100.0, 60.0], ..rest };
//! pair.advance(&[pull, rest], 5_000, 1e-4); // the left drives work, the right ones do not …
//! assert!((pair.arms()[0].q() - pair.arms()[1].q()).amax() < 1e-3); // … yet both arms move as one
//! assert!(pair.gap() < 1e-5 && pair.lambda().norm() > 50.0);
//! # Ok::<(), mechanics::ParameterError>(())
//! ```
//!
//! Each arm is a [`crate::arm`], with shoulder, table and wall of its own, and carries half the payload as a point mass at
//! its pad. The payload is rigid and keeps its direction: the wrists of the suction pads are stiff, and bear whatever moment
//! that takes. So the pads keep the offset r that they had at the grip, and what one half does to the other is a force λ on
//! the left pad and −λ on the right one. The bases stand side by side; where exactly changes the pads' distance, and with it
//! the wrists' moment, and nothing else. That moment acts between the payload and the wrists; the arms' joints do not feel it.
//! A moment on link 3 that a real stiff wrist would pass on to them is not modelled.
//!
//! | symbol | equation | unit | item |
//! |---|---|---|---|
//! | gap g | g = p_L − p_R − r, r = p_L − p_R at the grip | m | [`Pair::gap`] |
//! | λ | λ = −k g − c dg/dt, both at the end of a substep | N | [`bond::Bond`], [`Pair::lambda`] |
//! | Λ = dt λ | Λ + κ dt (w_L(Λ) − w_R(Λ)) = −dt k g, κ = k dt + c | N·s | [`coupling`] |
//! | w_L, w_R | velocity of a pad that the arm's own problem answers to an impulse on it | m/s | [`crate::arm::problem::Problem`] |
//! | hold | ½ m (a − g) − f_e ∓ λ: tension, shear | N | [`Pair::arms`] |
//! | wrist | (p_L − p_R) × λ, about the middle of the payload | N·m | [`Pair::wrist`] |
//! | residual | Σ of both arms − Δ ½ k g² − losses of the bond | J | [`energy::Balance`] |
//!
//! The bond is stiff (1e8 N/m: 1 µm at 100 N) rather than rigid, so that λ is determined also where stiction holds both
//! arms. It acts on positions: the gap does not drift. Being implicit, it is stable at every substep.
//!
//! # What happens to the payload
//!
//! * It is gripped when both cups suck and both pads press on their table beyond `F_attach`, in the same substep.
//! * It is released when either cup lets go, and lost when the tension of either exceeds `F_max`, or its shear `F_shear`: one cup alone would
//!   have to hold it by a corner. Both pads are free at once.
//! * At the grip each half is an inelastic impact, as with one arm; whatever relative velocity of the pads is left, the
//!   bond damps.

pub mod bond;
pub mod coupling;
pub mod energy;
pub mod plant;

pub use bond::Bond;
pub use energy::Balance;
pub use plant::{Pair, Parameters};
