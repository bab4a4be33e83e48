//! The plan: summed segments, each a sine or a constant in a window with ramps.

use fmu_declaration::{Enumeration, Item, Rows, Start};
use serde::{Deserialize, Serialize};

/// Number of segments.
pub const SEGMENTS: usize = 16;

/// `segment.kind`: A w(t) sin(2π f t + φ).
pub const SINE: i32 = 1;
/// `segment.kind`: A w(t).
pub const CONSTANT: i32 = 2;

/// Without a ramp, a window opens and closes at the instant; an importer's time may miss that by its rounding (1e-8 s
/// after 2e5 steps), which must not cost a whole step.
pub(crate) const SAME_INSTANT: f64 = 1e-7;

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

/// A segment; an amplitude of 0 leaves it out. At the start a sine of 1 Hz along x, without amplitude, from 0 s on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Rows, Start)]
pub struct Segment {
    /// axis of the base frame along which the segment pushes: 1 x, 2 y, 3 z
    #[parameter(5, name = "segment[i].axis", integers = 1..=3, start = 1)]
    pub axis: i32,
    /// shape inside the window w(t) = clip((t - t_on)/ramp) - clip((t - t_off)/ramp)
    #[parameter(6, name = "segment[i].kind", items = KIND, start = SINE)]
    pub kind: i32,
    /// time at which the window begins to open
    #[parameter(7, name = "segment[i].t_on", unit = SECOND, range = -1e9..=1e9)]
    pub t_on: f64,
    /// time at which the window begins to close, at least t_on
    #[parameter(8, name = "segment[i].t_off", unit = SECOND, range = -1e9..=1e9, start = 1e9)]
    pub t_off: f64,
    /// time that the window takes to open and to close; 0: at once
    #[parameter(9, name = "segment[i].ramp", unit = SECOND, range = 0.0..=1e9)]
    pub ramp: f64,
    /// amplitude; 0 leaves the segment out
    #[parameter(10, name = "segment[i].amplitude", unit = NEWTON, range = -1e6..=1e6)]
    pub amplitude: f64,
    /// frequency of a sine
    #[parameter(11, name = "segment[i].frequency", unit = HERTZ, range = 0.0..=1e4, start = 1.0)]
    pub frequency: f64,
    /// phase of a sine at time 0, whenever the window opens
    #[parameter(12, name = "segment[i].phase", unit = RADIAN, range = -1e6..=1e6)]
    pub phase: f64,
}

/// Window with ramps; it opens at `t_on` within `ramp` and closes at `t_off` within `ramp` (s). A ramp that `t_off` cuts
/// short closes from where it got to.
///
/// ```text
/// w(t) = clip((t − t_on)/ramp, 0, 1) − clip((t − t_off)/ramp, 0, 1)
/// ```
pub fn window(t: f64, t_on: f64, t_off: f64, ramp: f64) -> f64 {
    edge(t - t_on, ramp) - edge(t - t_off, ramp)
}

fn edge(since: f64, ramp: f64) -> f64 {
    if ramp > 0.0 {
        (since / ramp).clamp(0.0, 1.0)
    } else if since >= -SAME_INSTANT {
        1.0
    } else {
        0.0
    }
}

impl Segment {
    /// Force at time `t` (s) along the segment's axis (N): A w(t) sin(2π f t + φ) (sine), A w(t) (constant).
    fn force(&self, t: f64) -> f64 {
        let w = window(t, self.t_on, self.t_off, self.ramp);
        let shape = if self.kind == SINE {
            let turns = 2.0 * core::f64::consts::PI * self.frequency;
            libm::sin(turns * t + self.phase)
        } else {
            1.0
        };
        self.amplitude * w * shape
    }
}

/// Force of all `segments` at time `t` (s), base frame (N):
///
/// ```text
/// f_profile = Σ A w(t) sin(2π f t + φ)  (sine),   Σ A w(t)  (constant)
/// ```
pub fn force(segments: &[Segment], t: f64) -> [f64; 3] {
    let mut force = [0.0; 3];
    for segment in segments.iter().filter(|segment| segment.amplitude != 0.0) {
        let along = segment.force(t);
        for (axis, force) in (1..).zip(&mut force) {
            if axis == segment.axis {
                *force += along;
            }
        }
    }
    force
}

/// The first segment that closes before it opens, from 0.
pub fn backward(segments: &[Segment]) -> Option<usize> {
    segments
        .iter()
        .position(|segment| segment.t_off < segment.t_on)
}
