//! The force sensor in the handle: it sees the human's force alone, in its own frame, at its own clock.

use crate::noise::normal;
use declaration::{Rows, Start, choices};
use export::Step;
use mechanics::arm::kinematics::Pose;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

choices! { FRAME "Frame" "Frame in which the force sensor's components are given":
    BASE = 1 "base" "base frame: x forward, y to the left, z up";
    SENSOR = 2 "sensor" "link 3's frame: x along the link, z up when the link is level; it turns with the link";
}

choices! { FAILURE "ForceSensorFailure" "How the force sensor fails":
    NONE = 1 "none" "it does not";
    STUCK = 2 "stuck" "shows its last sound reading for ever";
    NAN = 3 "nan" "shows NaN on all axes";
    OVER_RANGE = 4 "over_range" "shows the end of its range on all axes, on the side of the force";
    DROPOUT = 5 "dropout" "shows 0 on all axes";
}

/// The sensor fails from the first sample on that is not earlier by more than this share of the period: times round.
const SAME_INSTANT: f64 = 1e-3;

/// What the sensor is like. At the start perfect, sampled at 1 kHz.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Rows, Start)]
pub struct ForceSensor {
    /// frame of f_h_measured, ft.bias and the noise
    #[parameter(76, name = "ft.frame", items = FRAME, start = BASE)]
    pub frame: i32,
    /// constant error of the force sensor, in the frame ft.frame
    #[parameter(77, name = "ft.bias[i]", unit = NEWTON, range = -1e6..=1e6)]
    pub bias: [f64; 3],
    /// standard deviation of the force sensor's white noise, on each axis and sample
    #[parameter(78, name = "ft.noise", unit = NEWTON, range = 0.0..=1e6)]
    pub noise: f64,
    /// which noise: the same seed gives the same noise, whatever the steps
    #[parameter(79, name = "ft.seed", start = 1)]
    pub seed: i32,
    /// sample period of the force sensor; sample k is taken at startTime + k ft.T
    #[parameter(80, name = "ft.T", unit = SECOND, range = 1e-6..=1e3, start = 1e-3)]
    pub T: f64,
    /// largest reading of the force sensor, on each axis
    #[parameter(81, name = "ft.range", unit = NEWTON, range = 1e-3..=1e9, start = 500.0)]
    pub range: f64,
    /// how the force sensor fails
    #[parameter(82, name = "ft.failure", items = FAILURE, start = NONE)]
    pub failure: i32,
    /// when the force sensor fails: from the first sample on that is not earlier
    #[parameter(83, name = "ft.t_failure", unit = SECOND, range = -1e9..=1e9)]
    pub t_failure: f64,
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
        let k = ((step.elapsed + step.h + step.same_instant(self.T)) / self.T).floor();
        (k > last as f64).then(|| (k as u64, (k * self.T - step.elapsed).clamp(0.0, step.h)))
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
