//! `HumanOperator.fmu`: the human at the handle, who pushes by a plan and holds on like a spring.
//!
//! The force is that of the human *on the robot*, base frame (x forward, y left, z up), positive along the axis.
//!
//! ```
//! use export::{Log, Model, Step};
//! use human_operator::HumanOperator;
//!
//! let mut human = HumanOperator { p: [0.44, 0.0, -0.24], k_h: 200.0, ..HumanOperator::default() };
//! human.segment.axis[0] = 3;
//! human.segment.kind[0] = 2; // constant …
//! human.segment.amplitude[0] = -6.0; // … 6 N down …
//! human.segment.ramp[0] = 0.5; // … within half a second
//! human.initialize(0.0, &mut Log::silent())?;
//! assert_eq!(human.f_h, [0.0; 3]); // at the intended position, the plan not begun
//!
//! human.p[0] += 0.01; // where the handle is at the end of the step
//! human.step(Step { start_time: 0.0, t: 0.0, h: 0.25 }, &mut Log::silent())?;
//! assert!((human.f_h[0] + 2.0).abs() < 1e-12 && human.f_h[2] == -3.0);
//! # Ok::<(), export::Refusal>(())
//! ```
//!
//! | symbol | equation | unit | item |
//! |---|---|---|---|
//! | f_h | f_profile + f_hand | N | [`HumanOperator::f_h`] |
//! | f_profile | Σ A w(t) sin(2π f t + φ), Σ A w(t) | N | [`profile::Segments::force`] |
//! | w | clip((t − t_on)/ramp) − clip((t − t_off)/ramp) | 1 | [`profile::window`] |
//! | f_hand | k_h (p_intended − p(t − delay)) − b_h dp(t − delay), 0 from let_go on | N | [`hand::Hand::force`] |
//!
//! 1. [`initialize`](export::Model::initialize) shows the force at the start time, with the inputs as they are then.
//! 2. [`step`](export::Model::step) from t to t + h shows the force at t + h. The inputs set before it count as those at
//!    t + h: step the arm first, hand its `p` and `dp` over, then step the human.
//!
//! | module | what |
//! |---|---|
//! | [`profile`] | the plan: summed sines and constants, each in a window with ramps |
//! | [`hand`] | the impedance hand, which acts on what it felt a reflex ago |
//! | [`history`] | what it felt: the last second of motion in a fixed amount of memory |
//! | [`variables`] | the interface, one row a variable |
//! | [`model`] | initialize and step |

pub mod hand;
pub mod history;
pub mod model;
pub mod profile;
pub mod variables;

use hand::Hand;
use profile::Segments;
use serde::{Deserialize, Serialize};

/// The model: its variables as fields (units, signs and bounds in [`variables`]) and what the hand felt.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HumanOperator {
    /// Input: position of the handle at the end of the step (m).
    pub p: [f64; 3],
    /// Input: velocity of the handle at the end of the step (m/s).
    pub dp: [f64; 3],

    /// Output: force of the human on the robot (N).
    pub f_h: [f64; 3],
    /// Output: the planned part of it (N).
    pub f_profile: [f64; 3],
    /// Output: the hand's part of it (N).
    pub f_hand: [f64; 3],

    /// Parameters: the plan.
    pub segment: Segments,
    /// Parameter: stiffness of the hand (N/m).
    pub k_h: f64,
    /// Parameter: damping of the hand (N·s/m).
    pub b_h: f64,
    /// Parameter: reflex delay (s).
    pub delay: f64,
    /// Parameter: where the hand wants to be (m), unless `intended_from_start`.
    pub p_intended: [f64; 3],
    /// Parameter: the hand wants to be where the handle is at initialization.
    pub intended_from_start: bool,
    /// Parameter: time from which on the hand holds no more (s).
    pub let_go: f64,

    /// State, not in the interface: the hand, built anew by each initialization.
    pub hand: Hand,
}

impl Default for HumanOperator {
    /// The start values: no force at all.
    fn default() -> Self {
        Self {
            p: [0.0; 3],
            dp: [0.0; 3],
            f_h: [0.0; 3],
            f_profile: [0.0; 3],
            f_hand: [0.0; 3],
            segment: Segments::default(),
            k_h: 0.0,
            b_h: 0.0,
            delay: 0.0,
            p_intended: [0.0; 3],
            intended_from_start: true,
            let_go: 1e9,
            hand: Hand::default(),
        }
    }
}
