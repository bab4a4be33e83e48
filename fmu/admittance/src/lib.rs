//! The passivity-based admittance laws, sampled, with their energy ledger.
//!
//! A nominal mass that the human pushes, and a PI velocity coupling between it and the robot, in both directions. The
//! robot's model does not appear: the law sees the position q and the human's force f_h at each tick and says a force.
//! One axis is [`Axis`]; a testbed is one of them, a task space with diagonal gains is several of them under one
//! ledger: [`Admittance`].
//!
//! ```
//! use admittance::{Admittance, Gains, Law, Settings};
//! use nalgebra::Vector1;
//!
//! let settings = Settings { law: Law::PassiveBounded, T: 0.002, ..Settings::default() };
//! let gains = Gains { M_n: 5.0, D_n: 0.5, K: 30.0, K_P: 10.0, f_max: 12.5 };
//! let mut law = Admittance::new(settings, [gains])?;
//!
//! // One tick a sample: the first one engages with q_n = q and v_n = 0.
//! let first = law.step(&Vector1::new(0.3), &Vector1::new(5.0));
//! assert_eq!((first.q_n.x, first.e_nr.x), (0.3, 0.0));
//!
//! // Pushed for 20 s against something that does not give way, the force stays within its limit.
//! let tick = (1..10_000).map(|_| law.step(&Vector1::new(0.3), &Vector1::new(5.0))).last().unwrap();
//! assert_eq!(tick.f.x, 12.5);
//! assert!((30.0 * 10.0 * tick.e_nr.x).abs() <= 12.5 * (1.0 + 1e-15)); // the product's rounding
//! assert!(law.ledger().G() <= 0.0);
//! # Ok::<(), admittance::ParameterError>(())
//! ```
//!
//! | symbol | equation | unit (linear axis) | item |
//! |---|---|---|---|
//! | q_n, dq_n | M_n ddq_n + D_n dq_n = f_h − alpha y (eq:obs_dyn) | m, m/s | [`Axis`] |
//! | e_nr | q_n − q | m | [`Tick::e_nr`] |
//! | dq | (q_k − q_{k−1})/T, low pass optional | m/s | [`Motion`] |
//! | y | de_nr + K_P e_nr | m/s | [`midpoint::coupled`] |
//! | tau_a, f_a | K y (eq:dob_input), limited | N | [`Tick::f`] |
//! | alpha | the unit damper that the paper hides | N·s/m | [`Settings::alpha`] |
//! | M_n, D_n, K, K_P, f_max | | kg, N·s/m, N·s/m, 1/s, N | [`Gains`] |
//! | H | K(½ M_n v_n²/alpha + ½ K_P e²) | J | [`storage::stored`] |
//! | G, E | ΔG = ΔH + f·Δq − (K/alpha) f_h v_m T, E ← min(E_0, E − ΔG) | J | [`Ledger`] |
//!
//! On a rotary axis read rad for m, N·m for N, kg·m² for kg. Forces act on the robot and are positive along the axis; q,
//! q_n and f_h are components along the same axis, in whatever frame the caller uses.
//!
//! A tick, in this order:
//! 1. [`sense`](Axes::sense): gains on their way take over, the spring slips.
//! 2. [`settle`](Ledger::settle): what the last sample created is booked; the tank stays ≥ 0.
//! 3. [`propose`](axes::Sensed::propose): nominal and coupling are solved together, within the [`Bounds`].
//! 4. What the actuators deliver of it, then [`share`](Ledger::share): what the tank covers of that.
//! 5. [`commit`](Axes::commit): the nominal moves on, feeling what its [`Law`] says.
//!
//! [`Admittance`] does all of it where the axes are the robot's own; a task space does step 4 at the joints.
//!
//! | module | what |
//! |---|---|
//! | [`law`] | the laws, one row each: number, name, what the nominal feels, how the spring behaves |
//! | [`listed`] | laws as messages list them |
//! | [`parameters`] | [`Settings`], [`Gains`], their checks and the error that names the culprit |
//! | [`real`] | the number: double or single precision, and its functions |
//! | [`motion`] | backward difference, low pass |
//! | [`midpoint`] | the implicit midpoint rule: the law's arithmetic |
//! | [`axis`] | one axis: slip, midpoint, clamp, reset |
//! | [`bounds`] | limits inside the law: speed, position box, hold |
//! | [`axes`] | N axes, without a ledger |
//! | [`storage`] | the energy that an axis holds |
//! | [`retune`] | live gain changes that do not raise it |
//! | [`ledger`] | what the sampled law created, and the tank |
//! | [`budget`] | what a force may cost at most, and what share of it the tank covers |
//! | [`admittance`] | N axes under one ledger |
//! | [`advice`] | gains that are accepted, but probably not meant |
//! | [`hand`] | a hand too stiff for the gains: seen by its growing swing, answered with damping |
//! | [`servo`] | the law for a drive that takes positions and velocities, one axis |
//! | [`comparator`], [`natural`], [`sliding_mode`] | two other admittance controllers, to compare with, one axis |
//!
//! No heap, no clock, no I/O, no unsafe, no panic; it depends on `nalgebra` and `libm`. The feature `serde` makes the
//! state storable.

#![no_std]
#![forbid(unsafe_code)]
#![allow(
    non_snake_case,
    reason = "the paper's symbols with its capitals: M_n, K_P, T, H, G"
)]

pub mod admittance;
pub mod advice;
pub mod axes;
pub mod axis;
pub mod bounds;
pub mod budget;
pub mod comparator;
pub mod hand;
pub mod law;
pub mod ledger;
pub mod listed;
pub mod midpoint;
pub mod motion;
pub mod natural;
pub mod one_axis;
pub mod origin;
pub mod parameters;
pub mod real;
pub mod retune;
pub mod servo;
pub mod sliding_mode;
pub mod storage;

pub use admittance::{Admittance, Tick};
pub use axes::{Axes, Request};
pub use axis::Axis;
pub use bounds::Bounds;
pub use budget::Reach;
pub use law::Law;
pub use ledger::Ledger;
pub use motion::Motion;
pub use natural::Natural;
pub use parameters::{Gains, ParameterError, Settings};
pub use real::Real;
pub use servo::Servo;
pub use sliding_mode::SlidingMode;
