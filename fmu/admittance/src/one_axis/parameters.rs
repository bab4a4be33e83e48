//! What the law of one axis is built from: parameters of TestbedController.fmu and of the C library, one row each.

use crate::advice::{Advice, advise};
use crate::bounds::{boxed, or_none};
use crate::encoder::{Checks, Encoders};
use crate::law::LAW;
use crate::one_axis::form::{FORM, POSITION_SERVO, TORQUE};
use crate::parameters::{in_range, tunable_in_range};
use crate::{Bounds, Gains, Law, ParameterError, Reach, Real, Settings};
use fmu_declaration::{Rows, Start};
use nalgebra::Vector1;

/// Parameters of the law of one axis. Any bits may come from C: what cannot be used is refused by name.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct AxisParameters {
    /// Admittance law.
    #[parameter(16, items = LAW, start = Law::PassiveBounded.number())]
    pub law: i32,
    /// Nominal mass (eq:nom_dyn).
    #[parameter(17, unit = KILOGRAM, range = POSITIVE, tunable, start = 5.0)]
    pub M_n: Real,
    /// Nominal damping (eq:nom_dyn).
    #[parameter(18, unit = NEWTON_SECOND_PER_METRE, range = NOT_NEGATIVE, tunable, start = 0.5)]
    pub D_n: Real,
    /// Control gain, 1/epsilon of the paper (eq:dob_input).
    #[parameter(19, unit = NEWTON_SECOND_PER_METRE, range = POSITIVE, tunable, start = 30.0)]
    pub K: Real,
    /// Ratio of the coupling's spring to its damper (eq:dob_input).
    #[parameter(20, unit = PER_SECOND, range = POSITIVE, tunable, start = 10.0)]
    pub K_P: Real,
    /// Damper between y and the reaction on the nominal; 1 is the unit damper that the paper hides in eq:obs_dyn.
    #[parameter(21, unit = NEWTON_SECOND_PER_METRE, range = NOT_NEGATIVE, start = 1.0)]
    pub alpha: Real,
    /// Largest absolute value of tau_a; also the bound of the coupling spring's force under passive_bounded.
    #[parameter(22, unit = NEWTON, range = POSITIVE, tunable, start = 12.5)]
    pub tau_max: Real,
    /// Sample period.
    #[parameter(23, unit = SECOND, range = POSITIVE, start = 0.002)]
    pub T: Real,
    /// Communication steps by which the importer's wiring delays tau_a, its first value being 0; in the C library samples.
    /// It changes no force, only from when on the ledger counts a force's work.
    #[parameter(24, integers = 0..=1)]
    pub delay: i32,
    /// Energy with which the tank starts and above which it does not fill.
    #[parameter(25, name = "energy.E_0", unit = JOULE, range = NOT_NEGATIVE, start = 10.0)]
    pub E_0: Real,
    /// Largest speed of the robot: the energy budget covers every motion within it.
    #[parameter(26, unit = METRE_PER_SECOND, range = POSITIVE, start = 10.0)]
    pub v_max: Real,
    /// Largest acceleration of the robot: the energy budget covers every motion within it.
    #[parameter(27, unit = METRE_PER_SECOND_SQUARED, range = POSITIVE, start = 1e4)]
    pub a_max: Real,
    /// Corner frequency of a first-order low pass on dq; 0 = off.
    #[parameter(28, unit = HERTZ, range = NOT_NEGATIVE)]
    pub dq_cutoff: Real,
    /// Lightest effective mass that the robot shows, for gain_warning only.
    #[parameter(29, unit = KILOGRAM, range = POSITIVE, start = 6.0)]
    pub M_min: Real,
    /// Time in which changed gains come into force, on a straight line; 0 = at once.
    #[parameter(41, unit = SECOND, range = NOT_NEGATIVE, start = 0.1)]
    pub tuning_time: Real,
    /// Largest speed of the nominal; 0 = no limit.
    #[parameter(42, unit = METRE_PER_SECOND, range = NOT_NEGATIVE)]
    pub dq_n_max: Real,
    /// Whether the nominal keeps within q_n_min and q_n_max.
    #[parameter(43, boolean)]
    pub q_n_box: i32,
    /// Least position of the nominal.
    #[parameter(44, unit = METRE, start = -1.0)]
    pub q_n_min: Real,
    /// Largest position of the nominal.
    #[parameter(45, unit = METRE, start = 1.0)]
    pub q_n_max: Real,
    /// Largest rate of change of tau_a while the controller is in the loop; 0 = no limit.
    #[parameter(46, unit = NEWTON_PER_SECOND, range = NOT_NEGATIVE)]
    pub tau_rate_max: Real,
    /// Largest absolute position: a reading beyond it cannot be.
    #[parameter(49, name = "encoder.range", unit = METRE, range = POSITIVE, start = 1e4)]
    pub encoder_range: Real,
    /// Change of tau_a in which q must change, too, in its last bit at least; 0 = off. Above what friction holds.
    #[parameter(50, name = "encoder.stuck_force", unit = NEWTON, range = NOT_NEGATIVE)]
    pub encoder_stuck_force: Real,
    /// Readings in a row after which a jump beyond v_max or encoder.range is a fault, and after which a fault is over; 0 =
    /// jumps are believed.
    #[parameter(51, name = "encoder.samples", integers = 0.., start = 5)]
    pub encoder_samples: i32,
    /// What the robot gets from the controller.
    #[parameter(34, items = FORM, start = TORQUE)]
    pub form: i32,
}

/// The law's parts, made of parameters that have been checked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checked {
    /// What stays fixed.
    pub settings: Settings,
    /// What may be tuned.
    pub gains: Gains,
    /// Limits of the nominal.
    pub bounds: Bounds,
    /// How fast the robot can move: the motions for which passivity is promised.
    pub reach: Reach<1>,
    /// Largest rate of change of the force, N/s, infinite for no limit.
    pub f_rate: Real,
    /// The checks of the position.
    pub encoder: Encoders<1>,
}

impl AxisParameters {
    /// The law's parts.
    ///
    /// # Errors
    /// The first parameter out of its range, or a relation between parameters that does not hold.
    pub fn checked(&self) -> Result<Checked, ParameterError> {
        in_range(self)?;
        if self.form == POSITION_SERVO {
            self.check_servo()?;
        }
        let [bounds] = boxed(
            "q_n_max",
            self.q_n_box != 0,
            &[self.q_n_min],
            &[self.q_n_max],
            &[self.dq_n_max],
        )?;
        let reach = Reach {
            v_max: Vector1::new(self.v_max),
            a_max: Vector1::new(self.a_max),
        };
        let checks = Checks {
            range: Vector1::new(self.encoder_range),
            stuck: Vector1::new(self.encoder_stuck_force),
            samples: self.encoder_samples.unsigned_abs(),
        };
        Ok(Checked {
            settings: self.settings()?,
            gains: self.gains(),
            bounds,
            reach,
            f_rate: or_none(self.tau_rate_max),
            encoder: Encoders::new(checks, &reach, self.T),
        })
    }

    /// The drive's force is not the law's to limit, and not every law can be a drive's.
    fn check_servo(&self) -> Result<(), ParameterError> {
        if self.tau_rate_max != 0.0 {
            let expected = "no limit, which the laws 1 to 4 in torque form alone keep";
            return Err(ParameterError::of(
                "tau_rate_max",
                None,
                self.tau_rate_max,
                expected,
            ));
        }
        let law = Law::try_from(self.law)?;
        if law.row().servo {
            Ok(())
        } else {
            Err(ParameterError::NoServoForm(law))
        }
    }

    /// The gains.
    ///
    /// # Errors
    /// The first gain out of its range.
    pub fn tuned(&self) -> Result<Gains, ParameterError> {
        tunable_in_range(self)?;
        Ok(self.gains())
    }

    /// What the gains are advised against.
    ///
    /// # Errors
    /// A number that stands for no law.
    pub fn advice(&self) -> Result<Advice, ParameterError> {
        Ok(advise(&self.settings()?, &self.gains(), self.M_min))
    }

    fn settings(&self) -> Result<Settings, ParameterError> {
        Ok(Settings {
            law: Law::try_from(self.law)?,
            alpha: self.alpha,
            T: self.T,
            delayed: self.delay != 0,
            dq_cutoff: self.dq_cutoff,
            E_0: self.E_0,
            tuning_time: self.tuning_time,
        })
    }

    fn gains(&self) -> Gains {
        Gains {
            M_n: self.M_n,
            D_n: self.D_n,
            K: self.K,
            K_P: self.K_P,
            f_max: self.tau_max,
        }
    }
}
