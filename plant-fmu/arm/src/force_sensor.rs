//! The force sensor in the handle: it sees the human's force, and the weight of a tool behind it, in its own frame, at its own
//! clock.

use crate::noise::normal;
use fmu_declaration::{Rows, Start, choices};
use fmu_export::Step;
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
    /// rate at which the error of the force sensor grows from the start time on, in the frame ft.frame
    #[parameter(190, name = "ft.drift[i]", unit = NEWTON_PER_SECOND, range = -1e6..=1e6)]
    pub drift: [f64; 3],
    /// largest error that the past of the force leaves, on each axis: after a push the reading stays behind by so much
    #[parameter(191, name = "ft.hysteresis", unit = NEWTON, range = 0.0..=1e6)]
    pub hysteresis: f64,
    /// change of the force over which that error comes, and goes, to 1/e
    #[parameter(192, name = "ft.hysteresis_span", unit = NEWTON, range = 1e-3..=1e6, start = 20.0)]
    pub hysteresis_span: f64,
    /// mass of the tool behind the force sensor, whose weight it reads; its inertia it does not; part of link 3's mass
    #[parameter(193, name = "ft.tool_m", unit = KILOGRAM, range = 0.0..=1e3)]
    pub tool_m: f64,
}

/// What the sensor shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Reading {
    /// Number of the sample: sample k is taken at startTime + k·T.
    pub k: u64,
    /// Its value (N).
    pub f: [f64; 3],
    /// What acted on it (N), in the frame ft.frame.
    pub load: [f64; 3],
    /// By how much it stays behind (N), in that frame.
    pub lag: [f64; 3],
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

    /// What acts on the sensor (base frame, N): the force `f_h` at the handle and the tool's weight under `gravity` (m/s²).
    pub fn load(&self, f_h: &Vector3<f64>, gravity: &Vector3<f64>) -> Vector3<f64> {
        if self.tool_m == 0.0 {
            return *f_h; // and not −0 + 0, which a sum would leave
        }
        f_h + gravity * self.tool_m
    }

    /// Error (N) that is left when the load has changed by `change` (N), after the error `lag` (N) before it.
    ///
    /// ```text
    /// dh/d|f| = −(h + H sgn df)/L,   H = ft.hysteresis, L = ft.hysteresis_span
    /// ```
    ///
    /// Dahl's curve between −H and H, exact over a change of one sign: a rising load is read low, a falling one high. A
    /// change far smaller than L passes almost whole.
    fn lagging(&self, lag: f64, change: f64) -> f64 {
        if self.hysteresis == 0.0 || change == 0.0 {
            return lag;
        }
        let end = -self.hysteresis.copysign(change);
        end + (lag - end) * libm::exp(-change.abs() / self.hysteresis_span)
    }

    /// Sample `k` at `start_time` + k·T of the `load` (base frame, N), after the reading `last`.
    ///
    /// ```text
    /// reading = clip(R load + h + bias + drift k T + noise n_k, ±range),   n_k standard normal, R = 1 or into link 3's frame
    /// ```
    pub fn sample(
        &self,
        k: u64,
        start_time: f64,
        load: &Vector3<f64>,
        pose: &Pose,
        last: Reading,
    ) -> Reading {
        let age = k as f64 * self.T;
        let t = start_time + age;
        let load: [f64; 3] = if self.frame == SENSOR {
            in_sensor_frame(pose, load).into()
        } else {
            (*load).into()
        };
        let lag: [f64; 3] = core::array::from_fn(|i| {
            let before = if k > 0 { last.load[i] } else { load[i] };
            self.lagging(last.lag[i], load[i] - before)
        });
        let sound: [f64; 3] = core::array::from_fn(|i| {
            let noise = if self.noise > 0.0 {
                self.noise * normal(self.seed, k, i as u64)
            } else {
                0.0
            };
            let error = lag[i] + (self.bias[i] + self.drift[i] * age);
            (load[i] + error + noise).clamp(-self.range, self.range)
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
        Reading { k, f, load, lag }
    }
}
