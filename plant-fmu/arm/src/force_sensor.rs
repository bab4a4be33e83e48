//! The force sensor in the handle: it sees the human's force alone, in its own frame, at its own clock.

use crate::noise::normal;
use export::Step;
use mechanics::arm::kinematics::Pose;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// `ft.frame`: the reading is given in the base frame.
pub const BASE: i32 = 1;
/// `ft.frame`: the reading is given in link 3's frame.
pub const SENSOR: i32 = 2;

/// `ft.failure`: none.
pub const NONE: i32 = 1;
/// `ft.failure`: shows its last sound reading for ever.
pub const STUCK: i32 = 2;
/// `ft.failure`: shows NaN.
pub const NAN: i32 = 3;
/// `ft.failure`: shows the end of its range, on the side of the force.
pub const OVER_RANGE: i32 = 4;
/// `ft.failure`: shows zero.
pub const DROPOUT: i32 = 5;

/// A sample within this share of the period of a step's end belongs to the step: importers' times carry rounding.
const SAME_INSTANT: f64 = 1e-3;

/// What the sensor is like.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ForceSensor {
    /// Frame of the reading, bias and noise: [`BASE`] or [`SENSOR`].
    pub frame: i32,
    /// Constant error (N).
    pub bias: [f64; 3],
    /// Standard deviation of the white noise, on each axis (N).
    pub noise: f64,
    /// Which noise.
    pub seed: i32,
    /// Sample period (s).
    pub T: f64,
    /// Largest reading, on each axis (N).
    pub range: f64,
    /// How it fails: [`NONE`], [`STUCK`], [`NAN`], [`OVER_RANGE`] or [`DROPOUT`].
    pub failure: i32,
    /// When it fails (s): from the first sample on that is not earlier.
    pub t_failure: f64,
}

impl Default for ForceSensor {
    /// A perfect sensor, sampled at 1 kHz.
    fn default() -> Self {
        Self {
            frame: BASE,
            bias: [0.0; 3],
            noise: 0.0,
            seed: 1,
            T: 1e-3,
            range: 500.0,
            failure: NONE,
            t_failure: 0.0,
        }
    }
}

/// What the sensor shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Reading {
    /// Number of the sample: sample k is taken at startTime + k·T.
    pub k: u64,
    /// Its value (N).
    pub f: [f64; 3],
}

/// `vector` of the base frame in link 3's frame: x along the link, z up when the link is level.
pub fn in_sensor_frame(pose: &Pose, vector: &Vector3<f64>) -> Vector3<f64> {
    let v = pose.in_yaw_frame(vector);
    let (s, c) = pose.pitch;
    Vector3::new(c * v.x + s * v.z, v.y, c * v.z - s * v.x)
}

impl ForceSensor {
    /// The last sample in (t, t + h], if there is one after sample `last`: its number and its time after the begin of
    /// the step (s).
    pub fn due(&self, step: &Step, last: u64) -> Option<(u64, f64)> {
        let begin = step.t - step.start_time;
        let same = (SAME_INSTANT * self.T).min(0.5 * step.h);
        let k = ((begin + step.h + same) / self.T).floor();
        (k > last as f64).then(|| (k as u64, (k * self.T - begin).clamp(0.0, step.h)))
    }

    /// Sample `k` at `start_time` + k·T of the force `f_h` at the handle (base frame, N), after the reading `last`.
    ///
    /// ```text
    /// reading = clip(R f_h + bias + noise · n_k, ±range),   n_k standard normal, R = 1 or into link 3's frame
    /// ```
    pub fn sample(
        &self,
        k: u64,
        start_time: f64,
        f_h: &Vector3<f64>,
        pose: &Pose,
        last: Reading,
    ) -> Reading {
        let t = start_time + k as f64 * self.T;
        let f = if self.frame == SENSOR {
            in_sensor_frame(pose, f_h)
        } else {
            *f_h
        };
        let sound: [f64; 3] = core::array::from_fn(|i| {
            let noise = if self.noise > 0.0 {
                self.noise * normal(self.seed, k, i as u64)
            } else {
                0.0
            };
            (f[i] + self.bias[i] + noise).clamp(-self.range, self.range)
        });
        // A first sample that is stuck already shows what it sees.
        let failed = t >= self.t_failure - SAME_INSTANT * self.T;
        let f = match self.failure {
            STUCK if failed && k > 0 => last.f,
            NAN if failed => [f64::NAN; 3],
            OVER_RANGE if failed => sound.map(|f| self.range.copysign(f)),
            DROPOUT if failed => [0.0; 3],
            _ => sound,
        };
        Reading { k, f }
    }
}
