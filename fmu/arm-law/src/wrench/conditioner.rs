//! The whole way from a raw sample to the hand's force.

use super::deadband::deadband;
use super::filter::LowPass;
use super::tare::{Progress, Tare, TareSettings};
use super::validity::{Checks, Seen, Validity};
use super::{Fault, Frame, Mount, TareState, Tool, Wrench};
use crate::choices::{FRAME, LINK_3, SOURCE, WRENCH};
use admittance::parameters::in_range;
use admittance::{ParameterError, Real, real};
use fmu_declaration::{Rows, Start};
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

/// The sensor's part of a sample.
pub(crate) struct Reading<'a> {
    pub wrench: &'a Wrench,
    pub valid: bool,
    pub tare: bool,
}

/// What is to be remembered of a sample; by default nothing. Much of it is seldom there: it is written where it stays, and
/// not handed on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Made {
    /// whether there is anything to be remembered
    any: bool,
    seen: Seen,
    requested: bool,
    progress: Option<Progress>,
    /// what the filter has passed, if there is one; zero where the hand is not known
    passed: Option<Wrench>,
}

impl Sensor {
    /// Whether there can be such a sensor.
    ///
    /// # Errors
    /// The first value out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        in_range(self)
    }

    /// Whether nothing but the lever arm and a bias is made of a reading, which is one in the base frame: at the start values.
    pub(crate) fn is_plain(&self) -> bool {
        self.sensed_in() == Frame::Base
            && self.tool.mass == 0.0
            && self.deadband == 0.0
            && self.cutoff == 0.0
            && !self.checks.any()
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
        let reading = Reading {
            wrench: &sample.wrench,
            valid: sample.valid,
            tare: sample.tare,
        };
        let mut made = Made::default();
        let hand = self.sampled(&reading, || sample.R, || sample.q, &mut made);
        self.keep(&made);
        hand
    }

    /// What is made of a `reading` of a sensor that [is plain](Sensor::is_plain), where nothing is to be remembered: it has no
    /// fault, and no tare runs. All else goes by [`sampled`](Self::sampled), with the same result.
    #[inline]
    pub(crate) fn plainly(&self, reading: &Reading<'_>) -> Option<Conditioned> {
        let is_quiet = self.validity.is_sound() && self.tare.is_quiet();
        if !(is_quiet && reading.valid) || reading.tare {
            return None;
        }
        let hand = (*reading.wrench - *self.tare.bias()).about(&self.sensor.handle.into());
        // Where the reading is not finite, this is not, either.
        real::are_finite([&hand.force, &hand.torque]).then_some(Conditioned {
            hand,
            fault: None,
            tare: self.tare.state(),
        })
    }

    /// What is made of a `reading`; what is to be remembered of it, once it is [kept](Self::keep), is written into `made`, which
    /// is the default. The sensor's orientation `R` and the joint angles `q` (rad) are asked for where they matter.
    #[inline]
    pub(crate) fn sampled(
        &self,
        reading: &Reading<'_>,
        R: impl FnOnce() -> Matrix3<Real>,
        q: impl FnOnce() -> Vector3<Real>,
        made: &mut Made,
    ) -> Conditioned {
        made.any = true;
        let (validity, tare) = (&self.validity, &self.tare);
        validity.sampled(reading.wrench, reading.valid, &mut made.seen);
        let mut fault = made.seen.fault();
        let unladen = match &self.sensor.tool {
            tool if tool.mass == 0.0 => *reading.wrench,
            tool => *reading.wrench - tool.weight(&R()),
        };
        tare.sampled(reading.tare, &unladen, fault, q, &mut made.progress);
        made.requested = reading.tare;
        let (tare, bias) = match &made.progress {
            Some(progress) => (progress.state, &progress.bias),
            None => (tare.state(), tare.bias()),
        };
        let is_known = fault.is_none() && tare != TareState::Running;
        let mut hand = Wrench::ZERO;
        made.passed = self.filter.at_rest();
        if is_known {
            hand = (unladen - *bias).about(&self.sensor.handle.into());
            if made.passed.is_some() {
                hand = self.filter.passed(&hand);
                made.passed = Some(hand);
            }
            hand.force = deadband(&hand.force, self.sensor.deadband);
            // A tool of 1e308 kg, say: what is left of the reading is no number, and no force is known.
            if !real::are_finite([&hand.force, &hand.torque]) {
                (hand, fault) = (Wrench::ZERO, Some(Fault::NotFinite));
                made.passed = self.filter.at_rest();
            }
        }
        Conditioned { hand, fault, tare }
    }

    /// Goes on from what is to be remembered of a sample.
    #[inline]
    pub(crate) fn keep(&mut self, made: &Made) {
        if !made.any {
            return;
        }
        self.validity.keep(&made.seen);
        self.tare.keep(made.requested, made.progress.as_ref());
        self.filter.keep(made.passed.as_ref());
    }

    /// What is left of the raw `force` (N) without tool and bias, before filter and deadband, in an orientation `R` of the
    /// sensor.
    pub fn unladen(&self, force: &Vector3<Real>, R: &Matrix3<Real>) -> Vector3<Real> {
        force - self.sensor.tool.weight(R).force - self.bias().force
    }

    /// Acceleration of gravity in the sensor's frame, m/s², in an orientation `R` of the sensor.
    pub fn gravity(&self, R: &Matrix3<Real>) -> Vector3<Real> {
        R.tr_mul(&self.sensor.tool.gravity.into())
    }

    /// What the sensor reads when nothing acts on it, as far as a tare has found it; sensor frame.
    pub fn bias(&self) -> Wrench {
        *self.tare.bias()
    }
}
