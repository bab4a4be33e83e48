//! The interface, one row a variable. Append, never reorder: a row's position is its value reference.

use crate::HumanOperator;
use crate::history::DELAY_MAX;
use crate::profile::{CONSTANT, SINE};
use declaration::Variability::{Continuous, Fixed};
use declaration::{
    Declare, Description, Enumeration, Experiment, Item, Stepping, boolean, enumeration, integer,
    real, unit,
};

/// The type of `segment[i].kind`.
pub const KIND: Enumeration = Enumeration {
    name: "SegmentKind",
    about: "Shape of a segment of the force profile inside its window",
    items: &[
        Item {
            value: SINE,
            name: "sine",
            about: "amplitude w(t) sin(2 pi frequency t + phase)",
        },
        Item {
            value: CONSTANT,
            name: "constant",
            about: "amplitude w(t)",
        },
    ],
};

/// What the planned force depends on.
macro_rules! plan {
    ($($more:literal),*) => {
        &[
            "segment[i].axis", "segment[i].kind", "segment[i].t_on", "segment[i].t_off", "segment[i].ramp",
            "segment[i].amplitude", "segment[i].frequency", "segment[i].phase" $(, $more)*
        ]
    };
}

impl Declare for HumanOperator {
    #[rustfmt::skip] // a table: one row a variable
    const DESCRIPTION: Description<Self> = Description {
        name: "HumanOperator",
        about: "The human at the handle: force profiles of up to 16 segments, and an impedance hand with reflex delay",
        stepping: Stepping::Exact,
        experiment: Experiment { start: 0.0, stop: 60.0, tolerance: 1e-6, step: 0.001 },
        variables: &[
            real!(p[3], unit::METRE).input(Continuous)
                .about("position of the handle, base frame; set before a step it counts as the one at the step's end"),
            real!(dp[3], unit::METRE_PER_SECOND).input(Continuous)
                .about("velocity of the handle, base frame; set before a step it counts as the one at the step's end"),
            real!(f_h[3], unit::NEWTON).output(Continuous)
                .initially_from(plan!("p[i]", "dp[i]", "k_h", "b_h", "p_intended[i]", "intended_from_start", "let_go"))
                .about("force of the human on the robot at the handle, base frame: f_profile + f_hand"),
            real!(f_profile[3], unit::NEWTON).output(Continuous).initially_from(plan!())
                .about("planned part of f_h: the sum of the segments"),
            real!(f_hand[3], unit::NEWTON).output(Continuous)
                .initially_from(&["p[i]", "dp[i]", "k_h", "b_h", "p_intended[i]", "intended_from_start", "let_go"])
                .about("part of f_h by which the hand pulls: k_h (p_intended - p) - b_h dp, p and dp as they were a delay ago"),
            integer!("segment[i].axis" => segment.axis[16]).parameter(Fixed).within_integers(1, 3)
                .about("axis of the base frame along which the segment pushes: 1 x, 2 y, 3 z"),
            enumeration!("segment[i].kind" => segment.kind[16], &KIND).parameter(Fixed)
                .about("shape inside the window w(t) = clip((t - t_on)/ramp) - clip((t - t_off)/ramp)"),
            real!("segment[i].t_on" => segment.t_on[16], unit::SECOND).parameter(Fixed).within(-1e9, 1e9)
                .about("time at which the window begins to open"),
            real!("segment[i].t_off" => segment.t_off[16], unit::SECOND).parameter(Fixed).within(-1e9, 1e9)
                .about("time at which the window begins to close, at least t_on"),
            real!("segment[i].ramp" => segment.ramp[16], unit::SECOND).parameter(Fixed).within(0.0, 1e9)
                .about("time that the window takes to open and to close; 0: at once"),
            real!("segment[i].amplitude" => segment.amplitude[16], unit::NEWTON).parameter(Fixed).within(-1e6, 1e6)
                .about("amplitude; 0 leaves the segment out"),
            real!("segment[i].frequency" => segment.frequency[16], unit::HERTZ).parameter(Fixed).within(0.0, 1e4)
                .about("frequency of a sine"),
            real!("segment[i].phase" => segment.phase[16], unit::RADIAN).parameter(Fixed).within(-1e6, 1e6)
                .about("phase of a sine at time 0, whenever the window opens"),
            real!(k_h, unit::NEWTON_PER_METRE).parameter(Fixed).within(0.0, 1e6)
                .about("stiffness of the hand"),
            real!(b_h, unit::NEWTON_SECOND_PER_METRE).parameter(Fixed).within(0.0, 1e6)
                .about("damping of the hand"),
            real!(delay, unit::SECOND).parameter(Fixed).within(0.0, DELAY_MAX)
                .about("reflex delay: the hand acts on where and how fast the handle was this long ago"),
            real!(p_intended[3], unit::METRE).parameter(Fixed).within(-1e3, 1e3)
                .about("where the hand wants to be, base frame, unless intended_from_start"),
            boolean!(intended_from_start).parameter(Fixed)
                .about("the hand wants to be where p is at initialization; p_intended is not used"),
            real!(let_go, unit::SECOND).parameter(Fixed).within(-1e9, 1e9)
                .about("time from which on the hand holds no more and f_hand is 0; 1e9: never"),
        ],
    };
}
