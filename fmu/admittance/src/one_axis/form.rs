//! The law of one axis in either form: torque, or position servo.

use super::AxisParameters;
use super::parameters::Checked;
use crate::servo::{self, Command, Fault, Servo};
use crate::tick::{Refused, Tick};
use crate::{Admittance, Axes, Bounds, Gains, Ledger, ParameterError, Real, Request};
use fmu_declaration::choices;
use nalgebra::Vector1;

choices! { FORM "Form" "What the robot gets from the controller":
    TORQUE = 1 "torque" "the force, or torques, tau_a";
    POSITION_SERVO = 2 "position_servo" "q_d and dq_d, for drives that close the loop with K and K_P themselves; needs tau_a_measured; an arm in joint space only";
}

/// The law between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[allow(
    clippy::large_enum_variant,
    reason = "one of them, once, without a heap"
)]
pub(super) enum InForm {
    /// It gives a force.
    Torque(Admittance<1>),
    /// It commands a drive.
    Servo(Servo<Axes<1>, 1>),
}

/// What is sensed at a tick in the loop, beside the position.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sensed {
    pub tau_h: Vector1<Real>,
    pub tau_m: Vector1<Real>,
}

/// What a tick comes to: the tick, and the position (m) and velocity (m/s) that a drive is told.
pub(super) type Came<'a> = (&'a Tick<1>, Real, Real);

impl InForm {
    /// Out of the loop.
    pub fn new(checked: &Checked, parameters: &AxisParameters) -> Result<Self, ParameterError> {
        let Checked {
            settings,
            gains,
            bounds,
            reach,
            f_rate,
            ..
        } = *checked;
        if parameters.form == POSITION_SERVO {
            return Self::servo(checked);
        }
        let mut law = Admittance::new(settings, [gains])?
            .reaching(reach)?
            .rated(Vector1::new(f_rate))?;
        law.bound([bounds])?;
        Ok(Self::Torque(law))
    }

    /// It commands a drive.
    #[inline(never)]
    fn servo(checked: &Checked) -> Result<Self, ParameterError> {
        let mut law = Servo::new(checked.settings, [checked.gains], &checked.reach)?;
        law.bound([checked.bounds])?;
        Ok(Self::Servo(law))
    }

    /// Other gains: [`Admittance::tune`], [`Servo::tune`].
    pub fn tune(&mut self, gains: Gains) -> Result<(), ParameterError> {
        match self {
            Self::Torque(law) => law.tune([gains]),
            Self::Servo(law) => law.tune([gains], ["K", "K_P", "tau_max"]),
        }
    }

    /// One tick in the loop.
    #[inline]
    pub fn tick(
        &mut self,
        q: &Vector1<Real>,
        sensed: &Sensed,
        request: &Request<1>,
        accept: impl FnOnce(Came<'_>, Real) -> bool,
    ) -> Result<(), Refused> {
        match self {
            Self::Torque(law) => law.tick_if(q, &sensed.tau_h, request, |tick: &Tick<1>, G| {
                accept((tick, tick.q_n.x, tick.dq_n.x), G)
            }),
            Self::Servo(law) => Self::tick_of_a_drive(law, q, sensed, request, accept),
        }
    }

    /// Apart, so that the stack of the torque form is not the deeper for it.
    #[inline(never)]
    fn tick_of_a_drive(
        law: &mut Servo<Axes<1>, 1>,
        q: &Vector1<Real>,
        sensed: &Sensed,
        request: &Request<1>,
        accept: impl FnOnce(Came<'_>, Real) -> bool,
    ) -> Result<(), Refused> {
        let inputs = servo::Inputs {
            place: q,
            q,
            f_h: &sensed.tau_h,
            tau_m: &sensed.tau_m,
            request,
            after: request.after,
        };
        law.tick(&inputs, |command: &Command<1>, G| {
            accept((&command.tick, command.q_d.x, command.dq_d.x), G)
        })
    }

    /// One tick out of the loop, if `accept` says yes to the energy G (J).
    pub fn rest(
        &mut self,
        q: &Vector1<Real>,
        sensed: &Sensed,
        accept: impl FnOnce(Real) -> bool,
    ) -> Result<Tick<1>, Refused> {
        match self {
            Self::Torque(law) => law.rest_if(q, accept),
            Self::Servo(law) => Ok(Tick {
                outside_bounds: law.rest(q, &sensed.tau_m, accept)?,
                ..Tick::at_rest(q)
            }),
        }
    }

    /// The same where the position is not known; it shows the position `last` (m), where a drive is to stand still.
    pub fn abandon(&mut self, last: &Vector1<Real>, sensed: &Sensed) -> Tick<1> {
        match self {
            Self::Torque(law) => law.abandon(last),
            Self::Servo(law) => Tick {
                outside_bounds: law.abandon(&sensed.tau_m),
                ..Tick::at_rest(last)
            },
        }
    }

    /// Counts positions from a place that is further on by `by` (m), and keeps to `bounds`, counted from there.
    pub fn count_from(
        &mut self,
        by: &Vector1<Real>,
        bounds: [Bounds; 1],
    ) -> Result<(), ParameterError> {
        match self {
            Self::Torque(law) => law.count_from(by, bounds),
            Self::Servo(law) => {
                law.bound(bounds)?;
                law.count_from(by);
                Ok(())
            }
        }
    }

    /// Sample period, s.
    pub fn T(&self) -> Real {
        match self {
            Self::Torque(law) => law.T(),
            Self::Servo(law) => law.T(),
        }
    }

    /// A force begins to act this `part` of a sample after its tick; that of a drive is measured as it acts.
    pub fn lag(&mut self, part: Real) {
        match self {
            Self::Torque(law) => law.lag(part),
            Self::Servo(_) => {}
        }
    }

    /// The force of the last tick begins to act at the position `q` (m); `None` where it is not known.
    pub fn acts(&mut self, q: Option<&Vector1<Real>>) {
        match self {
            Self::Torque(law) => law.acts(q),
            Self::Servo(_) => {}
        }
    }

    /// The force that last acted, as far as it is known, N.
    #[inline]
    pub fn f(&self) -> &Vector1<Real> {
        match self {
            Self::Torque(law) => law.f(),
            Self::Servo(law) => law.tau_m(),
        }
    }

    /// What is wrong with the force that a drive measures.
    #[inline]
    pub fn drive_fault(&self) -> Option<Fault> {
        match self {
            Self::Torque(_) => None,
            Self::Servo(law) => law.feedback().fault().map(|(fault, _)| fault),
        }
    }

    /// Energy stored and created, as of the last tick.
    #[inline]
    pub fn ledger(&self) -> &Ledger<1> {
        match self {
            Self::Torque(law) => law.ledger(),
            Self::Servo(law) => law.ledger(),
        }
    }
}
