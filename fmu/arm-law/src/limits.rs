//! What the joints deliver of the torque that they are asked for.

use admittance::law::Felt;
use admittance::listed::{Text, laws};
use admittance::parameters::{check, limit};
use admittance::rate::part;
use admittance::tick::{Actuators, Delivered};
use admittance::{Law, ParameterError, Real, real};
use fmu_declaration::check::Expected;
use fmu_declaration::range::POSITIVE;
use nalgebra::{Matrix3, Vector3};

/// How torques beyond ±tau_max are brought within.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(i32)]
pub enum TorqueLimiting {
    /// All joints by one factor s = min(1, tau_max_i/|tau_i|): the force at the handle keeps its direction.
    Scale = 1,
    /// Each joint by itself: the force at the handle turns, and no factor says what the nominal should feel.
    Clip = 2,
}

/// The limits of the three joints.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Limits {
    /// Largest absolute torque of each joint, N·m, > 0.
    pub tau_max: Vector3<Real>,
    /// Largest rate of change of each joint's torque, N·m/s, > 0, infinite for no limit. The energy budget and leaving the
    /// loop may take a torque away faster.
    pub tau_rate: Vector3<Real>,
    /// How they act.
    pub limiting: TorqueLimiting,
}

/// What the joints deliver of a torque.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limited {
    /// Torques, N·m, within ±tau_max.
    pub tau: Vector3<Real>,
    /// Factor of the force that this amounts to, in [0, 1]; 1 when clipped, which no factor describes.
    pub s: Real,
    /// Whether any joint delivers less than it was asked for.
    pub limited: bool,
}

impl TorqueLimiting {
    /// The one with this number, if there is one.
    pub fn from_number(number: i32) -> Option<Self> {
        [Self::Scale, Self::Clip]
            .into_iter()
            .find(|limiting| *limiting as i32 == number)
    }
}

/// Why some laws do not clip.
const SCALE_ONLY: &str = const {
    &Text::new("1 (scale) under the laws ")
        .and_names(&laws!(row if row.feels_what_is_delivered()))
        .and(": their nominal feels one share of the force")
}
.as_str();

impl Limits {
    /// Whether these can be used.
    ///
    /// # Errors
    /// The first limit out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        for (joint, (tau_max, tau_rate)) in (1..).zip(self.tau_max.iter().zip(&self.tau_rate)) {
            check(
                Some(joint),
                &[
                    ("tau_max", *tau_max, POSITIVE),
                    ("tau_rate_max", limit(*tau_rate), POSITIVE),
                ],
            )?;
        }
        Ok(())
    }

    /// Whether these suit a law. Where the nominal feels what the robot gets, it feels what the robot was to get times one
    /// factor; no factor describes joints that are clipped one by one.
    ///
    /// # Errors
    /// Clipping under such a law.
    pub fn check_under(&self, law: Law) -> Result<(), ParameterError> {
        match (self.limiting, law.row().felt) {
            (TorqueLimiting::Clip, Felt::Delivered) => Err(ParameterError::OutOfRange {
                name: "torque_limiting",
                axis: None,
                value: self.limiting as i32 as Real,
                expected: Expected::Text(SCALE_ONLY),
            }),
            (TorqueLimiting::Clip, Felt::Nothing | Felt::Coupling) | (TorqueLimiting::Scale, _) => {
                Ok(())
            }
        }
    }

    /// What is delivered of `tau` (N·m), which is finite.
    #[inline]
    pub fn deliver(&self, tau: &Vector3<Real>) -> Limited {
        // tau_max/|tau| rounds to 1 or more exactly where |tau| ≤ tau_max.
        if (0..3).all(|i| real::abs(tau[i]) <= self.tau_max[i]) {
            return Limited {
                tau: *tau,
                s: 1.0,
                limited: false,
            };
        }
        self.limited(tau)
    }

    /// The same where a joint delivers less.
    fn limited(&self, tau: &Vector3<Real>) -> Limited {
        let within = |tau: Real, tau_max: Real| tau.min(tau_max).max(-tau_max);
        let s = tau
            .zip_map(&self.tau_max, |tau, tau_max| part(tau_max, real::abs(tau)))
            .fold(1.0, Real::min);
        match self.limiting {
            TorqueLimiting::Scale => Limited {
                tau: (tau * s).zip_map(&self.tau_max, within), // the product's rounding may exceed tau_max
                s,
                limited: s < 1.0,
            },
            TorqueLimiting::Clip => Limited {
                tau: tau.zip_map(&self.tau_max, within),
                s: 1.0,
                limited: s < 1.0,
            },
        }
    }
}

/// The joints as what brings a force at the handle to the robot: tau = Jᵀ f, within the limits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AtTheHandle<'a> {
    pub limits: &'a Limits,
    pub J: &'a Matrix3<Real>,
}

impl Actuators<3> for AtTheHandle<'_> {
    #[inline]
    fn deliver(&self, f: &Vector3<Real>) -> Delivered<3> {
        let Limited { tau, s, limited } = self.limits.deliver(&self.J.tr_mul(f));
        Delivered {
            f: f * s,
            tau,
            limited,
        }
    }
}

/// The joints as what brings torques to the robot, within the limits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AtTheJoints<'a>(pub &'a Limits);

impl Actuators<3> for AtTheJoints<'_> {
    #[inline]
    fn deliver(&self, asked: &Vector3<Real>) -> Delivered<3> {
        let Limited { tau, .. } = self.0.deliver(asked);
        Delivered {
            f: tau,
            tau,
            limited: false, // the torques show it
        }
    }
}
