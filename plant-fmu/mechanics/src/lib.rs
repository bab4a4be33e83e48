//! Physics of the plants: friction that sticks, walls that only push, an energy balance that closes.
//!
//! Parameters, inputs and energies are the rows of the FMUs: what they are, their units, ranges and start values stand here
//! alone.
//!
//! No I/O, no clock, no allocation, no panic: numbers in, numbers out, the same bits on every machine. The integrator is
//! backward Euler in the velocity. Friction and contact are set-valued and enter implicitly, so that neither creeps nor
//! chatters at any substep. On one axis the implicit equation is monotone and piecewise linear, and is solved exactly.
//!
//! ```
//! use mechanics::testbed::{Forces, Parameters, Testbed};
//!
//! let mut plant = Testbed::new(Parameters::default(), 0.0, 0.0)?; // 6 kg, wall at q = 0.3 m
//! let push = |tau_h| Forces { tau_a: 0.0, tau_h, tau_d: 0.0 };
//!
//! plant.advance(&push(0.6), 25, 8e-5); // 25 substeps of 80 µs; stiction holds up to F_c = 0.64 N …
//! assert_eq!((plant.q(), plant.tau_f()), (0.0, -0.6)); // … exactly
//!
//! plant.advance(&push(5.0), 50_000, 8e-5); // 4 s: flies to the wall, bounces, leans on it
//! assert!(plant.q() > 0.3 && plant.tau_e() < -4.0);
//! assert!(plant.energy().residual.abs() < 1e-12);
//! # Ok::<(), mechanics::ParameterError>(())
//! ```
//!
//! # The testbed (motivating example of the paper, `fig:1dof_testbed`)
//!
//! Every force acts on the mass and is positive along +q, away from the start and toward the wall.
//!
//! | symbol | equation | unit | item |
//! |---|---|---|---|
//! | q, dq | M ddq = τ_a + τ_h + τ_d + τ_f + τ_e | m, m/s | [`testbed::Testbed`] |
//! | M | moving mass | kg | [`testbed::Parameters::M`](testbed::Parameters#structfield.M) |
//! | τ_a, τ_h, τ_d | actuator, human, disturbance | N | [`testbed::Forces`] |
//! | τ_f | −τ_f ∈ F_c Sgn(dq) + b dq, Sgn(0) = \[−1, 1\] | N | [`friction::Friction`] |
//! | τ_e | −τ_e = λ, 0 ≤ λ ⟂ s − (q − q_wall) ≥ 0 | N | [`wall::Wall`] |
//! | s | λ = k s + c ds/dt | m | [`testbed::State::s`] |
//! | E | ½ M dq² + ½ k s² | J | [`energy::Energy`] |
//! | residual | Σ work − Σ loss − (E − E(0)), zero up to rounding | J | [`energy::Energy::residual`] |
//!
//! # Modules
//!
//! | module | what |
//! |---|---|
//! | [`friction`] | Coulomb and viscous friction, reusable on any axis |
//! | [`wall`] | unilateral Kelvin–Voigt contact with its own surface, reusable along any normal |
//! | [`arm`] | the powered upper limb: a geared 3-DoF arm with payload, table and wall; see its page |
//! | [`pair`] | two such arms that share one payload rigidly |
//! | [`testbed`] | the 1-DoF plant: parameters, state, start, run |
//! | [`drive`] | an actuator with a position loop of its own, in place of a force |
//! | [`substep`] | its implicit equation, solved in closed form |
//! | [`energy`] | works, losses and stores, each by its own formula |
//! | [`sum`] | a number that many small additions do not wear down |
//! | [`parameter`] | the bounds that rows say, and the error that names variable, value and bounds |
//!
//! With the feature `serde` every parameter and state can be saved and restored.
#![no_std]
#![forbid(unsafe_code)]
#![allow(
    non_snake_case,
    reason = "the paper's symbols with its capitals: M, F_c"
)]

pub mod arm;
pub mod drive;
pub mod energy;
pub mod friction;
pub mod pair;
pub mod parameter;
pub mod substep;
pub mod sum;
pub mod testbed;
pub mod wall;

pub use energy::Energy;
pub use parameter::{Bounds, ParameterError};
pub use sum::Sum;
pub use testbed::Testbed;

/// Decaying states below this (SI units) become zero: denormal numbers would make a step ten times slower. Squares of
/// it stay normal, and what it drops (1e-280 J) is far below the rounding of any energy that is not itself that small.
const FLOOR: f64 = 1e-140;
