//! The whole way from a raw sample to the hand's force.

use super::deadband::deadband;
use super::filter::LowPass;
use super::tare::{Progress, Tare, TareSettings};
use super::validity::{Checks, Seen, Validity};
use super::{Fault, Frame, Mount, TareState, Tool, Wrench};
use crate::choices::{FRAME, LINK_3, SOURCE, WRENCH};
use admittance::parameters::in_range;
use admittance::{ParameterError, Real};
use declaration::{Rows, Start};
use nalgebra::{Matrix3, Vector3};

/// What the sensor is like and what is made of its reading: the parameters `ft.*`. At the start a force in the base frame, as
/// it is.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct Sensor {
    /// Where the force of the human is read.
    #[parameter(76, name = "ft.source", items = SOURCE, start = 1)]
    pub source: i32,
    /// Frame in which f_h is given.
    #[parameter(39, name = "ft.frame", items = FRAME, start = 1)]
    pub frame: i32,
    /// Orientation of the sensor in link 3's frame under ft.source 2: roll, pitch, yaw, turns about link 3's fixed axes
    /// x, then y, then z.
    #[parameter(77, name = "ft.mount[i]", unit = RADIAN)]
    pub mount: [Real; 3],
    /// Lever arm: the handle from the sensor's origin; sensor frame.
    #[parameter(78, name = "ft.handle[i]", unit = METRE)]
    pub handle: [Real; 3],
    /// What hangs on it.
    #[part]
    pub tool: Tool,
    /// Length by which every force is shortened, and below which it is 0; 0 = off.
    #[parameter(82, name = "ft.deadband", unit = NEWTON, range = NOT_NEGATIVE)]
    pub deadband: Real,
    /// Corner frequency of a first-order low pass on the force; it costs phase; 0 = off.
    #[parameter(83, name = "ft.cutoff", unit = HERTZ, range = NOT_NEGATIVE)]
    pub cutoff: Real,
    /// How it may fail.
    #[part]
    pub checks: Checks,
    /// How its bias is found.
    #[part]
    pub tare: TareSettings,
}

/// One sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The raw reading: what acts on the tool, about the sensor's origin, sensor frame.
    pub wrench: Wrench,
    /// Orientation of the sensor: turns a vector of its frame into the base frame.
    pub R: Matrix3<Real>,
    /// Joint angles, rad: whether the arm rests during a tare.
    pub q: Vector3<Real>,
    /// The sensor's own word: false = invalid.
    pub valid: bool,
    /// Whether a tare is requested; its change to true starts one.
    pub tare: bool,
}

impl Default for Sample {
    /// Nothing acts, and nothing is asked for.
    fn default() -> Self {
        Self {
            wrench: Wrench::ZERO,
            R: Matrix3::identity(),
            q: Vector3::zeros(),
            valid: true,
            tare: false,
        }
    }
}

/// What is made of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conditioned {
    /// What the hand does to the handle, about the handle, in the sensor's frame: zero while there is a fault or a tare
    /// runs.
    pub hand: Wrench,
    /// What is wrong with the sensor.
    pub fault: Option<Fault>,
    /// How far the tare has come.
    pub tare: TareState,
}

impl Default for Conditioned {
    /// Nothing acts.
    fn default() -> Self {
        Self {
            hand: Wrench::ZERO,
            fault: None,
            tare: TareState::Off,
        }
    }
}

/// The conditioning between two samples.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Conditioner {
    sensor: Sensor,
    validity: Validity,
    tare: Tare,
    filter: LowPass,
}

/// A sample, with what is to be remembered of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Made {
    pub hand: Conditioned,
    seen: Seen,
    requested: bool,
    progress: Option<Progress>,
    /// what the filter has passed; zero where the hand is not known
    passed: Wrench,
}

impl Sensor {
    /// Whether there can be such a sensor.
    ///
    /// # Errors
    /// The first value out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        in_range(self)
    }

    /// Whose axes the reading is along. The values have been checked.
    pub fn sensed_in(&self) -> Frame {
        match (self.source, self.frame) {
            (WRENCH, _) => Frame::Mounted(Mount {
                rpy: self.mount.into(),
            }),
            (_, LINK_3) => Frame::Link3,
            _ => Frame::Base,
        }
    }
}

impl Conditioner {
    /// No sample so far; `T` (s) is the sample period.
    ///
    /// # Errors
    /// The first value of `sensor` out of its range.
    pub fn new(sensor: Sensor, T: Real) -> Result<Self, ParameterError> {
        sensor.check()?;
        Ok(Self {
            sensor,
            validity: Validity::new(sensor.checks, T),
            tare: Tare::new(sensor.tare, T),
            filter: LowPass::new(sensor.cutoff, T),
        })
    }

    /// One sample.
    pub fn step(&mut self, sample: &Sample) -> Conditioned {
        let made = self.sampled(sample);
        self.keep(&made);
        made.hand
    }

    /// What is made of a sample. Nothing is remembered of it until it is [kept](Self::keep).
    #[inline]
    pub(crate) fn sampled(&self, sample: &Sample) -> Made {
        let seen = self.validity.sampled(&sample.wrench, sample.valid);
        let fault = seen.fault;
        let unladen = sample.wrench - self.sensor.tool.weight(&sample.R);
        let progress = self.tare.sampled(sample.tare, &unladen, fault, &sample.q);
        let (tare, bias) = match &progress {
            Some(progress) => (progress.state, &progress.bias),
            None => (self.tare.state(), self.tare.bias()),
        };
        let is_known = fault.is_none() && tare != TareState::Running;
        let (passed, hand) = if is_known {
            let hand = (unladen - *bias).about(&self.sensor.handle.into());
            let passed = self.filter.passed(&hand);
            let force = deadband(&passed.force, self.sensor.deadband);
            let torque = passed.torque;
            (passed, Wrench { force, torque })
        } else {
            (Wrench::ZERO, Wrench::ZERO)
        };
        Made {
            hand: Conditioned { hand, fault, tare },
            seen,
            requested: sample.tare,
            progress,
            passed,
        }
    }

    /// Goes on from what was made of a sample.
    #[inline]
    pub(crate) fn keep(&mut self, made: &Made) {
        self.validity.keep(&made.seen);
        self.tare.keep(made.requested, made.progress.as_ref());
        self.filter.keep(&made.passed);
    }

    /// What the sensor reads when nothing acts on it, as far as a tare has found it; sensor frame.
    pub fn bias(&self) -> Wrench {
        *self.tare.bias()
    }
}
