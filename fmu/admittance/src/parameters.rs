//! Parameters, checked when a law is built.

use crate::law::Felt;
use crate::retune::Gradual;
use crate::{Law, Real, real};
use core::fmt;
use fmu_declaration::check::{self, Expected, Objection};
use fmu_declaration::range::{NOT_NEGATIVE, POSITIVE, Range};
use fmu_declaration::{Brief, Causality, Rows};

/// What all axes share and what stays fixed during a run.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Settings {
    /// The law.
    pub law: Law,
    /// Damper between y (a velocity) and the reaction on the nominal (a force), N·s/m, ≥ 0. The paper adds K⁻¹tau_a to
    /// a force (eq:obs_dyn), which hides a unit damper: 1 is the paper. It does not matter where the nominal feels nothing.
    pub alpha: Real,
    /// Sample period, s.
    pub T: Real,
    /// Whether the force of a tick reaches the robot one sample later (the first one being 0). It changes no force: it
    /// tells the ledger in which interval a force did its work.
    pub delayed: bool,
    /// Corner frequency of a first-order low pass on dq, Hz; 0 = off.
    pub dq_cutoff: Real,
    /// Energy with which the tank starts and above which it does not fill, J.
    pub E_0: Real,
    /// Time that changed gains take to come into force, on a straight line, s; 0 = at once.
    pub tuning_time: Real,
}

impl Default for Settings {
    /// The testbed's: 500 Hz, `passive_bounded`, alpha = 1 N·s/m, no delay, no low pass.
    fn default() -> Self {
        Self {
            law: Law::PassiveBounded,
            alpha: 1.0,
            T: 0.002,
            delayed: false,
            dq_cutoff: 0.0,
            E_0: 10.0,
            tuning_time: 0.1,
        }
    }
}

/// What each axis has of its own and what may be changed during a run.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Gains {
    /// Nominal mass, kg, > 0.
    pub M_n: Real,
    /// Nominal damping, N·s/m, ≥ 0.
    pub D_n: Real,
    /// Control gain, N·s/m, > 0.
    pub K: Real,
    /// Ratio of the coupling's spring to its damper, 1/s, > 0.
    pub K_P: Real,
    /// Largest force of this axis on the robot, N, > 0. Infinite where nothing but the caller's factor limits.
    pub f_max: Real,
}

/// A parameter that a law cannot be built with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParameterError {
    /// A value out of its range.
    OutOfRange {
        /// The parameter.
        name: &'static str,
        /// The axis it belongs to, from 1; `None` if all share it or there is one axis only.
        axis: Option<usize>,
        /// The value.
        value: Real,
        /// What was expected.
        expected: Expected,
    },
    /// A law of [`Law`] that [`Admittance`](crate::Admittance) does not compute: a comparator, which has one axis.
    NotOffered(Law),
    /// A law of [`Law`] that cannot be run through a position drive, see [`servo`](crate::servo).
    NoServoForm(Law),
    /// A number that stands for no law.
    UnknownLaw(i32),
}

impl ParameterError {
    /// A value out of its range, with what was expected in words. The axis counts from 1.
    pub const fn of(
        name: &'static str,
        axis: Option<usize>,
        value: Real,
        expected: &'static str,
    ) -> Self {
        Self::OutOfRange {
            name,
            axis,
            value,
            expected: Expected::Text(expected),
        }
    }
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::OutOfRange {
                name,
                axis,
                value,
                expected,
            } => {
                f.write_str(name)?;
                if let Some(axis) = axis {
                    write!(f, "[{axis}]")?;
                }
                write!(f, " = {}: expected {expected}", Brief(value))
            }
            Self::NotOffered(law) => {
                write!(
                    f,
                    "law = {} ({}) is a comparator, for one axis, and not offered here: expected {}",
                    law.number(),
                    law.name(),
                    Law::OFFERED
                )
            }
            Self::NoServoForm(law) => {
                write!(
                    f,
                    "law = {} ({}) has no servo form: expected {}",
                    law.number(),
                    law.name(),
                    Law::WITH_SERVO_FORM
                )
            }
            Self::UnknownLaw(number) => {
                write!(f, "law = {number}: expected {}", Law::OFFERED)
            }
        }
    }
}

impl core::error::Error for ParameterError {}

/// A limit that may be infinite, as one that a [`Range`] accepts; NaN stays what it is.
pub fn limit(limit: Real) -> Real {
    if limit == Real::INFINITY {
        Real::MAX
    } else {
        limit
    }
}

/// Whether every parameter of `of` lies in the range that its row says, under the row's name.
///
/// # Errors
/// The first value out of its range.
pub fn in_range<P: Rows>(of: &P) -> Result<(), ParameterError> {
    Ok(check::first(of, P::ROWS, Causality::Parameter, false)?)
}

/// The same for what may be changed during a run.
///
/// # Errors
/// The first value out of its range.
pub fn tunable_in_range<P: Rows>(of: &P) -> Result<(), ParameterError> {
    Ok(check::first(of, P::ROWS, Causality::Parameter, true)?)
}

impl From<Objection> for ParameterError {
    fn from(objection: Objection) -> Self {
        Self::OutOfRange {
            name: objection.name,
            axis: objection.element,
            value: objection.value as Real,
            expected: objection.expected,
        }
    }
}

/// Whether every value lies in its range: the name, value and range of the first that does not. `axis`, from 1, is for the
/// message.
///
/// # Errors
/// The first value out of its range.
#[allow(
    clippy::useless_conversion,
    reason = "in single precision a Real is not an f64"
)]
pub fn check(
    axis: Option<usize>,
    list: &[(&'static str, Real, Range)],
) -> Result<(), ParameterError> {
    for &(name, value, range) in list {
        let range = if cfg!(feature = "f32") {
            range.single()
        } else {
            range
        };
        if !range.contains(value.into()) {
            return Err(ParameterError::of(name, axis, value, range.expected));
        }
    }
    Ok(())
}

impl Settings {
    /// Whether a law can be built with them.
    ///
    /// # Errors
    /// The first parameter out of its range, or a law that is not offered.
    pub fn check(&self) -> Result<(), ParameterError> {
        if !self.law.row().offered {
            return Err(ParameterError::NotOffered(self.law));
        }
        check(
            None,
            &[
                ("alpha", self.alpha, NOT_NEGATIVE),
                ("T", self.T, POSITIVE),
                ("dq_cutoff", self.dq_cutoff, NOT_NEGATIVE),
                ("E_0", self.E_0, NOT_NEGATIVE),
                ("tuning_time", self.tuning_time, NOT_NEGATIVE),
            ],
        )
    }

    /// Ticks that changed gains take to come into force.
    pub fn tuning_ticks(&self) -> u32 {
        // The conversion saturates: 4e9 ticks are for ever.
        (self.tuning_time / self.T + 0.5) as u32
    }

    /// `x`/alpha; 0 for alpha = 0, for which no energy is defined.
    pub fn over_alpha(&self, x: Real) -> Real {
        real::quotient_if(self.alpha > 0.0, x, self.alpha)
    }

    /// The damper through which the nominal feels y, N·s/m: alpha, or 0 where it feels nothing.
    pub const fn reaction(&self) -> Real {
        match self.law.row().felt {
            Felt::Nothing => 0.0,
            Felt::Coupling | Felt::Delivered => self.alpha,
        }
    }
}

impl Gradual for Gains {
    /// A gain that is infinite, or is to be, changes at once.
    fn toward(&self, wanted: &Self, remaining: u32) -> Self {
        let next = |from: Real, to: Real| {
            let step = (to - from) / remaining as Real;
            if remaining > 1 && step.is_finite() {
                from + step
            } else {
                to
            }
        };
        Self {
            M_n: next(self.M_n, wanted.M_n),
            D_n: next(self.D_n, wanted.D_n),
            K: next(self.K, wanted.K),
            K_P: next(self.K_P, wanted.K_P),
            f_max: next(self.f_max, wanted.f_max),
        }
    }
}

impl Gains {
    /// Whether an axis can be built with them; `axis` (from 1) is for the message.
    ///
    /// # Errors
    /// The first parameter out of its range.
    pub fn check(&self, axis: Option<usize>) -> Result<(), ParameterError> {
        check(
            axis,
            &[
                ("M_n", self.M_n, POSITIVE),
                ("D_n", self.D_n, NOT_NEGATIVE),
                ("K", self.K, POSITIVE),
                ("K_P", self.K_P, POSITIVE),
                ("f_max", limit(self.f_max), POSITIVE),
            ],
        )
    }
}
