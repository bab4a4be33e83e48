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
//! | y | de_nr + K_P e_nr | m/s | [`Rule::coupled`](midpoint::Rule::coupled) |
//! | tau_a, f_a | K y (eq:dob_input), limited | N | [`Tick::f`] |
//! | alpha | the unit damper that the paper hides | N·s/m | [`Settings::alpha`] |
//! | M_n, D_n, K, K_P, f_max | | kg, N·s/m, N·s/m, 1/s, N | [`Gains`] |
//! | H | K(½ M_n v_n²/alpha + ½ K_P e²) | J | [`Coordinates::stored`](tick::Coordinates::stored) |
//! | G, E | ΔG = ΔH + f·Δq − (K/alpha) f_h v_m T, E ← min(E_0, E − ΔG) | J | [`Ledger`] |
//!
//! On a rotary axis read rad for m, N·m for N, kg·m² for kg. Forces act on the robot and are positive along the axis; q,
//! q_n and f_h are components along the same axis, in whatever frame the caller uses.
//!
//! # A tick
//!
//! [`Sampled::tick`](tick::Sampled::tick) is all of it:
//! 1. **Settle**: what the last sample created is known now, and the tank pays for it.
//! 2. **Propose**: nominal and coupling are solved together, within the [`Bounds`].
//! 3. **Deliver**: what the actuators give of that.
//! 4. **Share**: what the tank covers of that.
//! 5. **Commit**: the nominal moves on, feeling what its [`Law`] says, and the sample that begins is booked.
//!
//! Steps 1 to 4 change nothing; a tick that is refused leaves the law as it was. [`Admittance`] is the law where the axes are
//! the robot's own; a task space delivers at the joints.
//!
//! # Words
//!
//! | word | meaning |
//! |---|---|
//! | demand | K y, what the coupling asks for before any limit |
//! | authority | the part of its force that the law may exert, in [0, 1]: it fades in and out. Whoever calls decides it |
//! | deliver | what the actuators give of the force that they are asked for, within their limits |
//! | share | the part of the delivered force that the tank covers, in [0, 1]: 1 unless something is wrong. The law decides it |
//! | reach | how fast the robot can move: the motions for which passivity is promised |
//! | slip | the spring gives up what alone would exceed f_max, and q_n goes along |
//! | reset | v_n⁺ is replaced by a velocity of less energy, where a limit acts |
//! | stored energy, H | what is in the nominal mass and the spring |
//! | created energy, G | what the sampled law gave out and nobody brought; negative: dissipated |
//! | supplied energy | what the human's port brings in a sample |
//! | taken energy | the least energy that the law absorbs in the sample that begins, whatever the robot does |
//! | need | the most work that the force can do in the sample that begins, within the reach, less the taken energy |
//! | tank, E | E_0 less what was created, refilled by dissipation up to E_0 |
//! | ledger | the accounts of H, G and E, exact to rounding |
//! | settle | to account for the sample that ended, and to give up stored energy where the tank cannot pay otherwise |
//! | settlement | the account of that sample, before it is booked |
//! | book | to take a settlement over and open the sample that begins |
//! | budget | settling and sharing together: what keeps the tank ≥ 0 |
//! | debt | a tank below zero, after a motion beyond the reach |
//! | reserved | the work that may still come of a force which has been said and, with a delay, acts only now |
//! | alpha | the paper's hidden unit damper, N·s/m. Not the α of the paper's definition of passivity |
//!
//! # Modules
//!
//! | module | what |
//! |---|---|
//! | [`law`] | the laws, one row each: number, name, what the nominal feels, how the spring behaves |
//! | [`tick`] | one tick, whatever the coordinates and the actuators |
//! | [`admittance`] | N axes under one ledger |
//! | [`axes`], [`axis`] | N axes without a ledger; one axis: slip, midpoint, clamp, reset |
//! | [`midpoint`] | the implicit midpoint rule: the law's arithmetic |
//! | [`bounds`], [`rate`] | limits inside the law: speed, position box, hold; the rate of its force |
//! | [`storage`] | the energy that an axis holds; the spring's slip |
//! | [`ledger`], [`settling`] | what the sampled law created, and the tank; the sample that ended |
//! | [`budget`] | what a force may cost at most, and what share of it the tank covers |
//! | [`parameters`] | [`Settings`], [`Gains`], their checks and the error that names the culprit |
//! | [`retune`] | live gain changes that do not raise the stored energy |
//! | [`motion`] | backward difference, low pass |
//! | [`timing`] | ticks that come late or early |
//! | [`encoder`] | whether a sensed position can be, and what the law is told where it cannot |
//! | [`real`] | the number: double or single precision, and its functions |
//! | [`one_axis`] | the complete law of one axis: its parameters, inputs and outputs, as the FMU and the C library show them |
//! | [`notices`] | what a log is told of a tick |
//! | [`origin`] | the position from which single precision counts |
//! | [`listed`] | laws as messages list them |
//! | [`advice`] | gains that are accepted, but probably not meant |
//! | [`hand`] | a hand too stiff for the gains: seen by its growing swing, answered with damping |
//! | [`servo`] | the law for a drive that takes positions and velocities, one axis |
//! | [`comparator`], [`natural`], [`sliding_mode`] | two other admittance controllers, to compare with, one axis |
//!
//! No heap, no clock, no I/O, no unsafe, no panic; it depends on `nalgebra`, `libm` and the rows of `declaration`. The
//! feature `serde` makes the state storable.

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
pub mod edges;
pub mod encoder;
pub mod hand;
pub mod law;
pub mod ledger;
pub mod listed;
pub mod midpoint;
pub mod motion;
pub mod natural;
pub mod notices;
pub mod one_axis;
pub mod origin;
pub mod parameters;
pub mod rate;
pub mod real;
pub mod retune;
pub mod servo;
pub mod settling;
pub mod sliding_mode;
pub mod storage;
pub mod tick;
pub mod timing;

pub use admittance::Admittance;
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
pub use tick::Tick;
