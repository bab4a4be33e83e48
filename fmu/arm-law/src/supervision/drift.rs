//! Whether somebody guides the nominal, or a force that nobody varies.
//!
//! A sensor's drift, what its hysteresis leaves after a push, and a tool's weight that is wrong are forces that stay or change
//! slowly. A hand's force varies. So the nominal is free only for so far after each sign of a hand:
//!
//! ```text
//! sign        |r| > drift_band within drift_time,   r = Δf − m Δg,  |m| ≤ drift_mass
//! attended    the nominal has moved by less than drift_distance since the last sign, its braking included
//! ```
//!
//! Δf and Δg are the changes of force and gravity in the sensor's frame since a first sample, which is taken anew after each sign
//! and after `drift_time`; m is what explains most of Δf, so that a wrong tool, turned by the motion that it causes, is no hand.
//! The force is smoothed over [`SMOOTHING`]: noise may have a deviation of a fifth of the band and more.
//!
//! A force that changes by less than `drift_band`/`drift_time` newtons a second is never a sign, however far it goes. One that
//! changes by twice the band within half of the time always is.

use super::parameters::{Durations, Parameters};
use super::watch::Lasting;
use admittance::real::{self, hypot};
use admittance::{Real, real::sat};
use nalgebra::Vector3;

/// Time constant with which the watch smooths the force, s: of white noise √(T/(2·0.01 s)) is left, 0.22 at 1 kHz. The end of a
/// push of F is a sign for 0.01 s·ln(F/drift_band) longer.
pub const SMOOTHING: Real = 0.01;

/// Beyond it, in N or m/s², no sensor reads; squares stay finite in single precision.
const LARGEST: Real = 1e6;

/// Share of a steady force that a wrong tool may leave unexplained where it is named.
const UNEXPLAINED: Real = 0.25;

/// What is felt of the hand; sensor frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Felt {
    /// Force on the handle, less tool and bias, before deadband and filter, N.
    pub force: Vector3<Real>,
    /// The bias that has been taken off, N: its change says that a tare was done.
    pub bias: Vector3<Real>,
    /// Acceleration of gravity, m/s².
    pub gravity: Vector3<Real>,
    /// Whether the force is known: the sensor has no fault, no tare runs.
    pub known: bool,
}

impl Default for Felt {
    /// Nothing.
    fn default() -> Self {
        Self {
            force: Vector3::zeros(),
            bias: Vector3::zeros(),
            gravity: Vector3::zeros(),
            known: true,
        }
    }
}

/// What a steady force is taken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Cause {
    /// A drift, hysteresis, or a hand that keeps still.
    Steady,
    /// It is the weight that a wrong tool mass leaves in this pose.
    Tool,
}

/// What the watch says at a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Seen {
    /// Whether nobody guides the nominal: it is to stand still.
    pub unattended: bool,
    /// A steady force has moved the nominal by half of `drift_distance`, or would for `drift_time` now.
    pub warning: Option<Cause>,
    /// Whether that has lasted for `drift_stop_time`.
    pub lasting: bool,
}

/// The sample with which later ones are compared.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct First {
    force: Vector3<Real>,
    gravity: Vector3<Real>,
    /// Ticks since.
    age: u32,
}

/// The watch with its memory.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DriftWatch {
    T: Real,
    distance: Real,
    band: Real,
    mass: Real,
    /// the force above which an unattended nominal would move, N
    threshold: Real,
    /// drift_time and drift_stop_time in ticks
    time: u32,
    stop: u32,
    /// the time that a nominal of some speed takes to cover its way to rest, s
    braking: Real,
    /// share of a sample in the smoothed force
    weight: Real,

    smooth: Option<Vector3<Real>>,
    first: Option<First>,
    /// ticks since the last sign of a hand
    since: u32,
    /// the nominal's way since, m
    moved: Real,
    /// its speed at the last tick, m/s
    speed: Real,
    attended: bool,
    driven: Lasting,
    bias: Vector3<Real>,
    /// gravity in the sensor's frame at the last tare; zero before the first
    gravity: Vector3<Real>,
    mass_error: Real,
}

impl DriftWatch {
    /// One that has seen no hand; none where `drift_distance` is 0. The parameters have been checked.
    pub fn new(parameters: &Parameters, durations: &Durations, T: Real) -> Option<Self> {
        (parameters.drift_distance > 0.0).then(|| Self {
            T,
            distance: parameters.drift_distance,
            band: parameters.drift_band,
            mass: parameters.drift_mass,
            threshold: real::max(parameters.hold_leave, parameters.drift_band),
            time: durations.drift,
            stop: durations.drift_stop,
            braking: (0.5 * durations.brake as Real + 1.0) * T,
            weight: -real::exp_m1(-T / SMOOTHING),
            smooth: None,
            first: None,
            since: u32::MAX,
            moved: 0.0,
            speed: 0.0,
            attended: false,
            driven: Lasting::default(),
            bias: Vector3::zeros(),
            gravity: Vector3::zeros(),
            mass_error: 0.0,
        })
    }

    /// A tick begins with what is `felt`; the law uses |f_h| = `force` (N) of it. `acts`: whether the law has run; `rests`:
    /// whether the hand rests.
    pub fn step(&mut self, felt: &Felt, force: Real, acts: bool, rests: bool) -> Seen {
        let gravity = felt.gravity.map(|x| sat(x, LARGEST));
        if felt.bias != self.bias {
            (self.bias, self.gravity) = (felt.bias, gravity);
            (self.smooth, self.first) = (None, None);
        }
        self.since = self.since.saturating_add(1);
        if !felt.known {
            (self.smooth, self.first) = (None, None);
            (self.since, self.attended) = (u32::MAX, false);
        } else if self.varied(&felt.force, &gravity) {
            (self.since, self.moved, self.attended) = (0, 0.0, true);
        }
        if !acts {
            (self.moved, self.speed) = (0.0, 0.0);
        }
        let long_ago = self.since > self.time;
        let too_far = self.moved + self.speed * self.braking >= self.distance;
        if too_far || ((rests || !acts) && long_ago) {
            self.attended = false;
        }
        let driven = acts && !self.attended && force > self.threshold;
        let ticks = self.driven.count(driven);
        let is_far = acts && self.moved >= 0.5 * self.distance;
        let warns = ticks >= self.time || (is_far && (self.attended || driven));
        Seen {
            unattended: !self.attended,
            warning: warns.then(|| self.cause(&gravity)),
            lasting: self.stop > 0 && ticks >= self.stop,
        }
    }

    /// The tick ends, with a nominal of `speed` (m/s) at the handle.
    pub fn moves(&mut self, speed: Real) {
        self.speed = real::min(speed, LARGEST);
        self.moved = real::min(self.moved + self.speed * self.T, LARGEST);
    }

    /// Way of the nominal's handle since the last sign of a hand, m.
    pub const fn moved(&self) -> Real {
        self.moved
    }

    /// By how much the tool is heavier than it was said to be, when it was last named, kg; 0 before.
    pub const fn mass_error(&self) -> Real {
        self.mass_error
    }

    /// Whether `force` shows a hand.
    fn varied(&mut self, force: &Vector3<Real>, gravity: &Vector3<Real>) -> bool {
        let force = force.map(|x| sat(x, LARGEST));
        let before = self.smooth.unwrap_or(force);
        let smooth = before + (force - before) * self.weight;
        self.smooth = Some(smooth);
        if let Some(first) = &mut self.first {
            first.age = first.age.saturating_add(1);
            let (changed, turned) = (smooth - first.force, gravity - first.gravity);
            let tool = turned * fitted(&changed, &turned, self.mass);
            let varied = length(&(changed - tool)) > self.band;
            if varied || first.age >= self.time {
                self.first = Some(First::new(smooth, *gravity));
            }
            return varied;
        }
        self.first = Some(First::new(smooth, *gravity));
        false
    }

    /// What the steady force of this tick is taken for.
    #[cold]
    fn cause(&mut self, gravity: &Vector3<Real>) -> Cause {
        let turned = gravity - self.gravity;
        let force = self.smooth.unwrap_or_default();
        let m = fitted(&force, &turned, self.mass);
        let left = length(&(force - turned * m));
        if m != 0.0 && left <= UNEXPLAINED * length(&force) {
            self.mass_error = m;
            return Cause::Tool;
        }
        Cause::Steady
    }
}

impl First {
    const fn new(force: Vector3<Real>, gravity: Vector3<Real>) -> Self {
        Self {
            force,
            gravity,
            age: 0,
        }
    }
}

/// The mass (kg), of ±`most` at most, whose weight under `gravity` (m/s²) explains most of `force` (N).
fn fitted(force: &Vector3<Real>, gravity: &Vector3<Real>, most: Real) -> Real {
    let square = gravity.norm_squared();
    let turns = most > 0.0 && square > 1e-6;
    sat(real::quotient_if(turns, force.dot(gravity), square), most)
}

fn length(x: &Vector3<Real>) -> Real {
    hypot(hypot(x.x, x.y), x.z)
}
