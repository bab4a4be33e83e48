//! What the law of the arm is built from: parameters of ArmController.fmu and of the C library, one row each.

use crate::choices::{FORM, JOINT, POSITION_SERVO, SPACE, TORQUE, TORQUE_LIMITING};
use crate::encoders::EncoderParameters;
use crate::joint_space::{self, JointGains, JointParameters};
use crate::kinematics::Kinematics;
use crate::limits::{Limits, TorqueLimiting};
use crate::nominal::NominalArm;
use crate::singularity::Singularity;
use crate::space::Space;
use crate::supervision;
use crate::workspace::Workspace;
use crate::wrench::Sensor;
use admittance::advice::{Advice, advise};
use admittance::bounds::{boxed, or_none};
use admittance::hand::StiffHand;
use admittance::law::OFFERED_LAW;
use admittance::parameters::{in_range, tunable_in_range};
use admittance::{Bounds, Gains, Law, ParameterError, Reach, Real, Settings};
use fmu_declaration::{Rows, Start};

/// Parameters of the arm's law. Vectors are along x, y, z of the base frame, or by joint. Any bits may come
/// from C: what cannot be used is refused by name.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct ArmParameters {
    /// Admittance law.
    #[parameter(20, items = OFFERED_LAW, start = Law::PassiveBounded.number())]
    pub law: i32,
    /// Nominal mass along x, y, z (eq:nom_dyn in task space).
    #[parameter(21, unit = KILOGRAM, range = POSITIVE, tunable, start = [5.0; 3])]
    pub Lambda_n: [Real; 3],
    /// Nominal damping along x, y, z (eq:nom_dyn in task space).
    #[parameter(22, unit = NEWTON_SECOND_PER_METRE, range = NOT_NEGATIVE, tunable, start = [20.0; 3])]
    pub D_n: [Real; 3],
    /// Control gain along x, y, z, 1/epsilon of the paper (eq:dob_input).
    #[parameter(23, unit = NEWTON_SECOND_PER_METRE, range = POSITIVE, tunable, start = [1000.0; 3])]
    pub K: [Real; 3],
    /// Ratio of the coupling's spring to its damper along x, y, z (eq:dob_input).
    #[parameter(24, unit = PER_SECOND, range = POSITIVE, tunable, start = [20.0; 3])]
    pub K_P: [Real; 3],
    /// Damper between y and the reaction on the nominal; 1 is the unit damper that the paper hides in eq:obs_dyn.
    #[parameter(25, unit = NEWTON_SECOND_PER_METRE, range = NOT_NEGATIVE, start = 1.0)]
    pub alpha: Real,
    /// Largest force of the controller along x, y, z and bound of the coupling spring's force, under passive_bounded;
    /// the other laws have no limit but tau_max.
    #[parameter(26, unit = NEWTON, range = POSITIVE, tunable, start = [400.0; 3])]
    pub f_max: [Real; 3],
    /// Largest absolute value of tau_a.
    #[parameter(27, unit = NEWTON_METRE, range = POSITIVE, start = [153.0, 259.0, 153.0])]
    pub tau_max: [Real; 3],
    /// How joint torques beyond tau_max are brought within; clip under the laws standard and passive only.
    #[parameter(28, items = TORQUE_LIMITING, start = 1)]
    pub torque_limiting: i32,
    /// Sample period.
    #[parameter(29, unit = SECOND, range = POSITIVE, start = 0.001)]
    pub T: Real,
    /// Communication steps by which the importer's wiring delays tau_a, its first value being 0; in the C library samples.
    /// It changes no torque, only from when on the ledger counts a torque's work.
    #[parameter(30, integers = 0..=1)]
    pub delay: i32,
    /// Energy with which the tank starts and above which it does not fill.
    #[parameter(31, name = "energy.E_0", unit = JOULE, range = NOT_NEGATIVE, start = 10.0)]
    pub E_0: Real,
    /// Largest speed of the joints: the energy budget covers every motion within it.
    #[parameter(32, unit = RADIAN_PER_SECOND, range = POSITIVE, start = [6.0; 3])]
    pub dq_max: [Real; 3],
    /// Largest acceleration of the joints: the energy budget covers every motion within it.
    #[parameter(33, unit = RADIAN_PER_SECOND_SQUARED, range = POSITIVE, start = [3e3; 3])]
    pub ddq_max: [Real; 3],
    /// Corner frequency of a first-order low pass on dp; 0 = off.
    #[parameter(34, unit = HERTZ, range = NOT_NEGATIVE)]
    pub dp_cutoff: Real,
    /// Lightest effective mass that the robot shows along an axis, for gain_warning only.
    #[parameter(42, unit = KILOGRAM, range = POSITIVE, start = 14.0)]
    pub M_min: Real,
    /// Time in which changed gains come into force, on a straight line; 0 = at once.
    #[parameter(48, unit = SECOND, range = NOT_NEGATIVE, start = 0.1)]
    pub tuning_time: Real,
    /// Largest speed of the nominal along x, y, z; 0 = no limit.
    #[parameter(49, unit = METRE_PER_SECOND, range = NOT_NEGATIVE)]
    pub dp_n_max: [Real; 3],
    /// Whether the nominal keeps within p_n_min and p_n_max.
    #[parameter(50, boolean)]
    pub p_n_box: i32,
    /// Least position of the nominal handle along x, y, z; base frame.
    #[parameter(51, unit = METRE, start = [-1.0; 3])]
    pub p_n_min: [Real; 3],
    /// Largest position of the nominal handle along x, y, z; base frame.
    #[parameter(52, unit = METRE, start = [1.0; 3])]
    pub p_n_max: [Real; 3],
    /// Largest rate of change of tau_a while the controller is in the loop; 0 = no limit.
    #[parameter(53, unit = NEWTON_METRE_PER_SECOND, range = NOT_NEGATIVE)]
    pub tau_rate_max: [Real; 3],
    /// Where the handle is.
    #[part]
    pub kinematics: Kinematics,
    /// The joints' encoders.
    #[part]
    pub encoder: EncoderParameters,
    /// The hand's force sensor.
    #[part]
    pub ft: Sensor,
    /// Where the nominal may go.
    #[part]
    pub workspace: Workspace,
    /// Slowing before a singularity.
    #[part]
    pub singularity: Singularity,
    /// Damping for a hand too stiff for the gains.
    #[part]
    pub stiff_hand: StiffHand,
    /// Whether supervision decides when the law may act; if not, engage alone does.
    #[parameter(107, boolean)]
    pub supervision: i32,
    /// Its times and thresholds.
    #[part]
    pub supervisor: supervision::Parameters,
    /// Coordinates in which the nominal lives.
    #[parameter(117, items = SPACE, start = 1)]
    pub space: i32,
    /// The form in joint space.
    #[part]
    pub joint: joint_space::JointSettings,
    /// Its nominal arm.
    #[part]
    pub nominal: NominalArm,
    /// What the robot gets from the controller.
    #[parameter(151, items = FORM, start = TORQUE)]
    pub form: i32,
}

/// The law's parts, made of parameters that have been checked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checked {
    /// What all axes share.
    pub settings: Settings,
    /// Gains along x, y, z of the base frame.
    pub gains: [Gains; 3],
    /// Limits of the nominal along x, y, z.
    pub bounds: [Bounds; 3],
    /// How fast the joints can move: the motions for which passivity is promised.
    pub reach: Reach<3>,
    /// What the joints deliver.
    pub limits: Limits,
    /// The coordinates in which the nominal lives.
    pub space: Space,
    /// The form in joint space.
    pub joint: JointParameters,
    /// Where the nominal may go; `None`: anywhere.
    pub workspace: Option<Workspace>,
    /// Supervision; `None`: `engage` alone decides.
    pub supervision: Option<supervision::Parameters>,
}

impl ArmParameters {
    /// The law's parts.
    ///
    /// # Errors
    /// The first parameter out of its range, or a relation between parameters that does not hold.
    pub fn checked(&self) -> Result<Checked, ParameterError> {
        in_range(self)?;
        let limits = self.limits();
        let settings = self.settings()?;
        if self.form == POSITION_SERVO {
            self.check_servo(settings.law)?;
        }
        limits.check_under(settings.law)?;
        self.supervisor.check()?;
        self.nominal.check()?;
        Ok(Checked {
            settings,
            gains: self.gains(settings.law),
            bounds: boxed(
                "p_n_max",
                self.p_n_box != 0,
                &self.p_n_min,
                &self.p_n_max,
                &self.dp_n_max,
            )?,
            reach: Reach {
                v_max: self.dq_max.into(),
                a_max: self.ddq_max.into(),
            },
            limits,
            space: if self.space == JOINT {
                Space::Joint
            } else {
                Space::Task
            },
            joint: JointParameters {
                arm: self.nominal,
                gains: self.joint.gains(&self.tau_max),
                bounds: self.joint.bounds()?,
            },
            workspace: self.workspace.checked(self.T)?,
            supervision: (self.supervision != 0).then_some(self.supervisor),
        })
    }

    /// A drive closes the coupling of its joint, with gains of its own, and its torque is not the law's to limit.
    fn check_servo(&self, law: Law) -> Result<(), ParameterError> {
        if self.space != JOINT {
            let expected = "2 (joint) in servo form: drives close the joints' couplings, not those at the handle";
            let space = self.space as Real; // a small number: exact also in single precision
            return Err(ParameterError::of("space", None, space, expected));
        }
        for (joint, rate) in (1..).zip(&self.tau_rate_max) {
            if *rate != 0.0 {
                let expected = "no limit, which the torque form alone keeps";
                return Err(ParameterError::of(
                    "tau_rate_max",
                    Some(joint),
                    *rate,
                    expected,
                ));
            }
        }
        if law.row().servo || !law.row().offered {
            Ok(())
        } else {
            Err(ParameterError::NoServoForm(law))
        }
    }

    /// The gains at the handle and of the joints.
    ///
    /// # Errors
    /// The first gain out of its range.
    pub fn tuned(&self) -> Result<([Gains; 3], JointGains), ParameterError> {
        tunable_in_range(self)?;
        let law = Law::try_from(self.law)?;
        Ok((self.gains(law), self.joint.gains(&self.tau_max)))
    }

    /// What the gains in task space are advised against; nothing in joint space.
    ///
    /// # Errors
    /// A number that stands for no law.
    pub fn advice(&self) -> Result<Advice, ParameterError> {
        if self.space == JOINT {
            return Ok(Advice::default());
        }
        let settings = self.settings()?;
        let gains = self.gains(settings.law);
        let each = gains
            .iter()
            .map(|gains| advise(&settings, gains, self.M_min));
        Ok(each.fold(Advice::default(), Advice::or))
    }

    fn settings(&self) -> Result<Settings, ParameterError> {
        Ok(Settings {
            law: Law::try_from(self.law)?,
            alpha: self.alpha,
            T: self.T,
            delayed: self.delay != 0,
            dq_cutoff: self.dp_cutoff,
            E_0: self.E_0,
            tuning_time: self.tuning_time,
        })
    }

    /// f_max belongs to the law whose spring slips alone: the other laws ask for what they ask for and live on the joints'
    /// limits.
    fn gains(&self, law: Law) -> [Gains; 3] {
        [0, 1, 2].map(|i| Gains {
            M_n: self.Lambda_n[i],
            D_n: self.D_n[i],
            K: self.K[i],
            K_P: self.K_P[i],
            f_max: if law.row().slips() {
                self.f_max[i]
            } else {
                Real::INFINITY
            },
        })
    }

    fn limits(&self) -> Limits {
        Limits {
            tau_max: self.tau_max.into(),
            tau_rate: self.tau_rate_max.map(or_none).into(),
            limiting: if self.torque_limiting == TorqueLimiting::Clip as i32 {
                TorqueLimiting::Clip
            } else {
                TorqueLimiting::Scale
            },
        }
    }
}
