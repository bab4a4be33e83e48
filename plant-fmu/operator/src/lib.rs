//! `HumanOperator.fmu`: the human at the handle, who pushes by a plan and holds on like a spring.
//!
//! The force is that of the human *on the robot*, base frame (x forward, y left, z up), positive along the axis.
//!
//! ```
//! use fmu_export::{Log, Model, Step};
//! use human_operator::HumanOperator;
//!
//! let mut human = HumanOperator { k_h: 200.0, ..HumanOperator::default() };
//! human.inputs.p = [0.44, 0.0, -0.24];
//! human.segments[0].axis = 3;
//! human.segments[0].kind = 2; // constant …
//! human.segments[0].amplitude = -6.0; // … 6 N down …
//! human.segments[0].ramp = 0.5; // … within half a second
//! human.initialize(0.0, &mut Log::silent())?;
//! assert_eq!(human.outputs.f_h, [0.0; 3]); // at the intended position, the plan not begun
//!
//! human.inputs.p[0] += 0.01; // where the handle is at the end of the step
//! human.step(Step::at(0.0, 0.25), &mut Log::silent())?;
//! assert!((human.outputs.f_h[0] + 2.0).abs() < 1e-12 && human.outputs.f_h[2] == -3.0);
//! # Ok::<(), fmu_export::Refusal>(())
//! ```
//!
//! | symbol | equation | unit | item |
//! |---|---|---|---|
//! | f_h | f_profile + f_hand | N | [`rows::Outputs::f_h`] |
//! | f_profile | Σ A w(t) sin(2π f t + φ), Σ A w(t) | N | [`profile::force`] |
//! | w | clip((t − t_on)/ramp) − clip((t − t_off)/ramp) | 1 | [`profile::window`] |
//! | f_hand | k_h (p_target − p(t − delay)) − b_h (dp(t − delay) − dp_target), 0 from let_go on | N | [`hand::Hand::force`] |
//! | p_target | p_intended + a sine, a minimum jerk from point to point, or a table | m | [`target::Target::at`] |
//!
//! 1. [`initialize`](fmu_export::Model::initialize) shows the force at the start time, with the inputs as they are then.
//!    p = 0 on all axes counts as not there yet, as in an importer that exchanges nothing during initialization: the hand
//!    then takes hold at the first step. From the shoulder, where 0 is, it would pull with 50 N at k_h = 100 N/m.
//! 2. [`step`](fmu_export::Model::step) from t to t + h shows the force at t + h. The inputs set before it count as those at
//!    t + h: step the arm first, hand its `p` and `dp` over, then step the human.
//!
//! | module | what |
//! |---|---|
//! | [`profile`] | the plan: summed sines and constants, each in a window with ramps |
//! | [`hand`] | the impedance hand, which acts on what it felt a reflex ago |
//! | [`target`] | where the hand wants to be: still, a sine, from point to point |
//! | [`history`] | what it felt: the last second of motion in a fixed amount of memory |
//! | [`rows`] | the variables, one row each, with their start values |
//! | [`model`] | what initialize and step do |

pub mod hand;
pub mod history;
pub mod model;
pub mod profile;
pub mod rows;
pub mod target;

pub use rows::HumanOperator;
