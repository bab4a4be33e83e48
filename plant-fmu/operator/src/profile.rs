//! The plan: summed segments, each a sine or a constant in a window with ramps.

use serde::{Deserialize, Serialize};

/// Number of segments.
pub const SEGMENTS: usize = 16;

/// `segment.kind`: A w(t) sin(2π f t + φ).
pub const SINE: i32 = 1;
/// `segment.kind`: A w(t).
pub const CONSTANT: i32 = 2;

/// Without a ramp, a window opens and closes at the instant; an importer's time may miss that by its rounding (1e-8 s
/// after 2e5 steps), which must not cost a whole step.
const SAME_INSTANT: f64 = 1e-7;

/// The segments, element i of each field one segment; an amplitude of 0 leaves it out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Segments {
    /// Axis along which it pushes: 1 x, 2 y, 3 z.
    pub axis: [i32; SEGMENTS],
    /// [`SINE`] or [`CONSTANT`].
    pub kind: [i32; SEGMENTS],
    /// When the window begins to open (s).
    pub t_on: [f64; SEGMENTS],
    /// When the window begins to close (s).
    pub t_off: [f64; SEGMENTS],
    /// How long opening and closing take (s); 0: at once.
    pub ramp: [f64; SEGMENTS],
    /// A (N).
    pub amplitude: [f64; SEGMENTS],
    /// f (Hz); of a sine.
    pub frequency: [f64; SEGMENTS],
    /// φ (rad), at t = 0, whenever the window opens; of a sine.
    pub phase: [f64; SEGMENTS],
}

impl Default for Segments {
    /// Sixteen sines of 1 Hz along x, without amplitude, from 0 s on.
    fn default() -> Self {
        Self {
            axis: [1; SEGMENTS],
            kind: [SINE; SEGMENTS],
            t_on: [0.0; SEGMENTS],
            t_off: [1e9; SEGMENTS],
            ramp: [0.0; SEGMENTS],
            amplitude: [0.0; SEGMENTS],
            frequency: [1.0; SEGMENTS],
            phase: [0.0; SEGMENTS],
        }
    }
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

impl Segments {
    /// Force at time `t` (s), base frame (N):
    ///
    /// ```text
    /// f_profile = Σ A w(t) sin(2π f t + φ)  (sine),   Σ A w(t)  (constant)
    /// ```
    pub fn force(&self, t: f64) -> [f64; 3] {
        let mut force = [0.0; 3];
        for i in (0..SEGMENTS).filter(|&i| self.amplitude[i] != 0.0) {
            let w = window(t, self.t_on[i], self.t_off[i], self.ramp[i]);
            let shape = if self.kind[i] == SINE {
                let turns = 2.0 * core::f64::consts::PI * self.frequency[i];
                libm::sin(turns * t + self.phase[i])
            } else {
                1.0
            };
            for (axis, force) in (1..).zip(&mut force) {
                if axis == self.axis[i] {
                    *force += self.amplitude[i] * w * shape;
                }
            }
        }
        force
    }

    /// The first segment that closes before it opens, from 0.
    pub fn backward(&self) -> Option<usize> {
        (0..SEGMENTS).find(|&i| self.t_off[i] < self.t_on[i])
    }
}
