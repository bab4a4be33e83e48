//! The moving target: how far the place where the hand wants to be is from where it took hold, and how fast it moves.

use crate::profile::SAME_INSTANT;
use fmu_declaration::{Brief, Enumeration, Item, Rows, Start};
use serde::{Deserialize, Serialize};

/// Number of points.
pub const POINTS: usize = 16;

/// `target.kind`: the target stays.
pub const STILL: i32 = 1;
/// `target.kind`: A w(t) sin(2π f t + φ) along each axis.
pub const SINE: i32 = 2;
/// `target.kind`: from point to point, at rest in each, with the least jerk.
pub const MINIMUM_JERK: i32 = 3;
/// `target.kind`: from point to point on straight lines in time.
pub const TABLE: i32 = 4;

/// The type of `target.kind`.
pub const KIND: Enumeration = Enumeration {
    name: "TargetKind",
    about: "How the place where the hand wants to be moves",
    items: &[
        Item {
            value: STILL,
            name: "still",
            about: "it stays where the hand took hold, or at p_intended",
        },
        Item {
            value: SINE,
            name: "sine",
            about: "target.amplitude w(t) sin(2 pi target.frequency t + target.phase) along each axis",
        },
        Item {
            value: MINIMUM_JERK,
            name: "minimum_jerk",
            about: "from point to point, at rest in each, with the least jerk",
        },
        Item {
            value: TABLE,
            name: "table",
            about: "from point to point on straight lines in time",
        },
    ],
};

/// Where the target is and how fast it moves, less where the hand took hold.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Displacement (m).
    pub p: [f64; 3],
    /// Velocity (m/s).
    pub dp: [f64; 3],
}

/// How the target moves. At the start it does not.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, Rows, Start)]
pub struct Target {
    /// how the place where the hand wants to be moves, from p_intended or from where the hand took hold
    #[parameter(19, name = "target.kind", items = KIND, start = STILL)]
    pub kind: i32,
    /// amplitude of the sine along each axis
    #[parameter(20, name = "target.amplitude[i]", unit = METRE, range = -1e3..=1e3)]
    pub amplitude: [f64; 3],
    /// frequency of the sine along each axis
    #[parameter(21, name = "target.frequency[i]", unit = HERTZ, range = 0.0..=1e4, start = [1.0; 3])]
    pub frequency: [f64; 3],
    /// phase of the sine along each axis at time 0, whenever the window opens
    #[parameter(22, name = "target.phase[i]", unit = RADIAN, range = -1e6..=1e6)]
    pub phase: [f64; 3],
    /// time at which the window w(t) of the sine begins to open
    #[parameter(23, name = "target.t_on", unit = SECOND, range = -1e9..=1e9)]
    pub t_on: f64,
    /// time at which the window of the sine begins to close, at least t_on + ramp: it opens wholly before it closes
    #[parameter(24, name = "target.t_off", unit = SECOND, range = -1e9..=1e9, start = 1e9)]
    pub t_off: f64,
    /// time that the window takes to open and to close, without a jump of velocity or acceleration; 0: at once
    #[parameter(25, name = "target.ramp", unit = SECOND, range = 0.0..=1e9)]
    pub ramp: f64,
    /// number of points that minimum_jerk and table use, from the first on
    #[parameter(26, name = "target.points", integers = 0..=POINTS as i32)]
    pub used: i32,
    /// The points.
    #[part(each)]
    pub points: [Point; POINTS],
}

/// A place and when the target is there. Before the first point's time it is at the first, after the last at the last.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, Rows)]
pub struct Point {
    /// time at which the target is at the point; each used one later than the one before
    #[parameter(27, name = "target.point[i].t", unit = SECOND, range = -1e9..=1e9)]
    pub t: f64,
    /// displacement along x at the point
    #[parameter(28, name = "target.point[i].x", unit = METRE, range = -1e3..=1e3)]
    pub x: f64,
    /// displacement along y at the point
    #[parameter(29, name = "target.point[i].y", unit = METRE, range = -1e3..=1e3)]
    pub y: f64,
    /// displacement along z at the point
    #[parameter(30, name = "target.point[i].z", unit = METRE, range = -1e3..=1e3)]
    pub z: f64,
}

impl Point {
    fn p(&self) -> [f64; 3] {
        [self.x, self.y, self.z]
    }
}

/// Minimum jerk (Flash and Hogan 1985) from 0 at s = 0 to 1 at s = 1, and its slope; at rest before and after.
///
/// ```text
/// m(s) = 10 s³ − 15 s⁴ + 6 s⁵,   dm/ds = 30 s² (1 − s)²
/// ```
pub fn minimum_jerk(s: f64) -> (f64, f64) {
    let s = s.clamp(0.0, 1.0);
    (
        s * s * s * (10.0 + s * (6.0 * s - 15.0)),
        30.0 * s * s * (1.0 - s) * (1.0 - s),
    )
}

/// An edge of the window and its slope (1/s), `since` (s) after it began.
fn edge(since: f64, ramp: f64) -> (f64, f64) {
    if ramp > 0.0 {
        let (m, slope) = minimum_jerk(since / ramp);
        (m, slope / ramp)
    } else if since >= -SAME_INSTANT {
        (1.0, 0.0)
    } else {
        (0.0, 0.0)
    }
}

impl Target {
    /// The used points.
    fn used(&self) -> &[Point] {
        let n = usize::try_from(self.used).unwrap_or(0);
        self.points.get(..n).unwrap_or(&self.points)
    }

    /// What does not fit, with what was expected.
    pub fn refused(&self) -> Option<String> {
        if self.t_off - self.t_on < self.ramp && self.kind == SINE {
            return Some(format!(
                "target.t_off = {} s, expected at least target.t_on + target.ramp = {} s",
                Brief(self.t_off),
                Brief(self.t_on + self.ramp)
            ));
        }
        if self.kind != MINIMUM_JERK && self.kind != TABLE {
            return None;
        }
        if self.used < 1 {
            return Some(
                "target.points = 0, expected at least 1 for target.kind minimum_jerk or table"
                    .into(),
            );
        }
        let pairs = self.used().iter().zip(self.used().iter().skip(1));
        for (i, (earlier, later)) in (2..).zip(pairs) {
            if later.t <= earlier.t {
                return Some(format!(
                    "target.point[{i}].t = {} s, expected more than target.point[{}].t = {} s",
                    Brief(later.t),
                    i - 1,
                    Brief(earlier.t)
                ));
            }
        }
        None
    }

    /// Displacement and velocity at `t` (s):
    ///
    /// ```text
    /// sine           A w(t) sin(2π f t + φ) along each axis, w(t) = m((t − t_on)/ramp) − m((t − t_off)/ramp)
    /// minimum_jerk   p_i + (p_{i+1} − p_i) m(s),   table   p_i + (p_{i+1} − p_i) s,   s = (t − t_i)/(t_{i+1} − t_i)
    /// ```
    ///
    /// with m of [`minimum_jerk`].
    pub fn at(&self, t: f64) -> Motion {
        match self.kind {
            SINE => self.sine(t),
            MINIMUM_JERK => self.between(t, minimum_jerk),
            TABLE => self.between(t, |s| (s, 1.0)),
            _ => Motion::default(),
        }
    }

    fn sine(&self, t: f64) -> Motion {
        let ((opened, opening), (closed, closing)) = (
            edge(t - self.t_on, self.ramp),
            edge(t - self.t_off, self.ramp),
        );
        let (w, dw) = (opened - closed, opening - closing);
        let mut motion = Motion::default();
        for (i, (p, dp)) in motion.p.iter_mut().zip(&mut motion.dp).enumerate() {
            let omega = 2.0 * core::f64::consts::PI * self.frequency[i];
            let (sin, cos) = libm::sincos(omega * t + self.phase[i]);
            *p = self.amplitude[i] * w * sin;
            *dp = self.amplitude[i] * (dw * sin + w * omega * cos);
        }
        motion
    }

    /// Between the points, `way` being the share of the way and its slope over the share of the time.
    fn between(&self, t: f64, way: impl Fn(f64) -> (f64, f64)) -> Motion {
        let points = self.used();
        let next = points.partition_point(|point| point.t <= t);
        let (Some(a), Some(b)) = (
            points.get(next.saturating_sub(1)),
            points.get(next.min(points.len().saturating_sub(1))),
        ) else {
            return Motion::default();
        };
        if next == 0 || next == points.len() {
            return Motion {
                p: a.p(),
                dp: [0.0; 3],
            };
        }
        let (from, to, lasts) = (a.p(), b.p(), b.t - a.t);
        let (share, slope) = way((t - a.t) / lasts);
        Motion {
            p: core::array::from_fn(|i| from[i] + (to[i] - from[i]) * share),
            dp: core::array::from_fn(|i| (to[i] - from[i]) * slope / lasts),
        }
    }
}
