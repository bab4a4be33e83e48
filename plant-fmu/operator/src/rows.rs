//! The variables, one row each. A row's number decides its value reference: new ones take the next.

use crate::hand::Hand;
use crate::history::DELAY_MAX;
use crate::profile::{SEGMENTS, Segment};
use crate::target::Target;
use fmu_declaration::{Declare, Description, Experiment, Rows, Start, Stepping};
use serde::{Deserialize, Serialize};

/// What the planned force depends on.
macro_rules! plan {
    ($($more:literal),*) => {
        &[
            "segment[i].axis", "segment[i].kind", "segment[i].t_on", "segment[i].t_off", "segment[i].ramp",
            "segment[i].amplitude", "segment[i].frequency", "segment[i].phase" $(, $more)*
        ]
    };
}

/// What the moving target depends on, handed to `$list`, which adds what it lists.
macro_rules! with_target {
    ($list:ident; $($more:literal),*) => {
        $list!(
            $($more,)* "p_intended[i]", "intended_from_start", "target.kind", "target.amplitude[i]",
            "target.frequency[i]", "target.phase[i]", "target.t_on", "target.t_off", "target.ramp", "target.points",
            "target.point[i].t", "target.point[i].x", "target.point[i].y", "target.point[i].z"
        )
    };
}

/// A list of names.
macro_rules! names {
    ($($name:literal),*) => { &[$($name),*] };
}

/// The human: the variables, and what the hand felt.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, Rows, Start)]
pub struct HumanOperator {
    /// What the human feels.
    #[part]
    pub inputs: Inputs,
    /// What the human does.
    #[part]
    pub outputs: Outputs,

    /// The plan.
    #[part(each)]
    pub segments: [Segment; SEGMENTS],
    /// stiffness of the hand; times k_h_factor along each axis
    #[parameter(13, unit = NEWTON_PER_METRE, range = 0.0..=1e6)]
    pub k_h: f64,
    /// damping of the hand; times b_h_factor along each axis
    #[parameter(14, unit = NEWTON_SECOND_PER_METRE, range = 0.0..=1e6)]
    pub b_h: f64,
    /// reflex delay: the hand acts on where and how fast the handle was this long ago
    #[parameter(15, unit = SECOND, range = 0.0..=DELAY_MAX)]
    pub delay: f64,
    /// where the hand wants to be, base frame, unless intended_from_start; a moving target starts from here
    #[parameter(16, unit = METRE, range = -1e3..=1e3)]
    pub p_intended: [f64; 3],
    /// the hand wants to be where p is at initialization, p_intended is not used; if p is 0 on all axes then, as in an
    /// importer that exchanges nothing during initialization: where p is at the first step
    #[parameter(17, start = true)]
    pub intended_from_start: bool,
    /// time from which on the hand holds no more and f_hand is 0; 1e9: never
    #[parameter(18, unit = SECOND, range = -1e9..=1e9, start = 1e9)]
    pub let_go: f64,
    /// How the place where the hand wants to be moves.
    #[part]
    pub target: Target,
    /// stiffness of the hand along each axis of the base frame, in units of k_h
    #[parameter(31, range = 0.0..=1e6, start = [1.0; 3])]
    pub k_h_factor: [f64; 3],
    /// damping of the hand along each axis of the base frame, in units of b_h
    #[parameter(32, range = 0.0..=1e6, start = [1.0; 3])]
    pub b_h_factor: [f64; 3],

    /// State, not in the interface: the hand, built anew by each initialization.
    pub hand: Hand,
    /// State, not in the interface: whether the hand has felt where the handle is.
    pub has_felt: bool,
}

/// What the human feels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, Rows)]
pub struct Inputs {
    /// position of the handle, base frame; set before a step it counts as the one at the step's end
    #[input(0, unit = METRE)]
    pub p: [f64; 3],
    /// velocity of the handle, base frame; set before a step it counts as the one at the step's end
    #[input(1, unit = METRE_PER_SECOND)]
    pub dp: [f64; 3],
}

/// What the human does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, Rows)]
pub struct Outputs {
    /// force of the human on the robot at the handle, base frame: f_profile + f_hand
    #[output(2, unit = NEWTON, from = with_target!(plan; "p[i]", "dp[i]", "k_h", "b_h", "k_h_factor[i]", "b_h_factor[i]", "let_go"))]
    pub f_h: [f64; 3],
    /// planned part of f_h: the sum of the segments
    #[output(3, unit = NEWTON, from = plan!())]
    pub f_profile: [f64; 3],
    /// part of f_h by which the hand pulls: k_h (p_target - p) - b_h (dp - dp_target), p and dp as they were a delay ago
    #[output(4, unit = NEWTON, from = with_target!(names; "p[i]", "dp[i]", "k_h", "b_h", "k_h_factor[i]", "b_h_factor[i]", "let_go"))]
    pub f_hand: [f64; 3],
    /// where the hand wants to be, base frame: p_intended, or where it took hold, displaced by the moving target
    #[output(33, unit = METRE, from = with_target!(names; "p[i]"))]
    pub p_target: [f64; 3],
}

impl Declare for HumanOperator {
    const DESCRIPTION: Description<Self> = Description {
        name: "HumanOperator",
        about: "The human at the handle: force profiles of up to 16 segments, and an impedance hand with reflex delay and a moving target",
        stepping: Stepping::Exact,
        experiment: Experiment {
            start: 0.0,
            stop: 60.0,
            tolerance: 1e-6,
            step: 0.001,
        },
        variables: Self::ROWS,
    };
}
