//! The complete law of the arm: from what is sensed at a tick to the torques on the joints.
//!
//! It knows no FMI: the FMU ArmController and the C library are shells around it.

use crate::kinematics::{Kinematics, Pose};
use crate::limits::Limits;
use crate::singularity::Singularity;
use crate::stiff_hand::Detectors;
use crate::task_space::{Outcome, TaskSpace};
use crate::wrench::{Conditioned, Conditioner, Frame, Sample, Sensor, Wrench};
use admittance::hand::StiffHand;
use admittance::{Bounds, Gains, Ledger, ParameterError, Reach, Real, Request, Settings};
use nalgebra::Vector3;

/// What stays fixed while the law is in use, but for the gains.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Parameters {
    /// What all axes share.
    pub settings: Settings,
    /// Gains along x, y, z of the base frame.
    pub gains: [Gains; 3],
    /// Limits of the nominal along x, y, z.
    pub bounds: [Bounds; 3],
    /// How fast the joints can move: the motions for which passivity is promised, rad/s and rad/s².
    pub reach: Reach<3>,
    /// Where the handle is.
    pub kinematics: Kinematics,
    /// What the joints deliver.
    pub limits: Limits,
    /// Slowing before a singularity.
    pub singularity: Singularity,
    /// Damping for a hand too stiff for the gains.
    pub stiff_hand: StiffHand,
    /// The frame of the hand's force sensor.
    pub frame: Frame,
    /// What is made of its reading.
    pub sensor: Sensor,
}

/// What is sensed and asked for at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs {
    /// Joint angles, rad.
    pub q: Vector3<Real>,
    /// What the hand's force sensor reads: about its origin, in [`Parameters::frame`]. No moment if it has none.
    pub hand: Wrench,
    /// The sensor's own word: false = invalid.
    pub ft_valid: bool,
    /// Whether a tare of the sensor is requested; its change to true starts one.
    pub tare: bool,
    /// Whether the law is to be in the loop.
    pub engage: bool,
    /// Whether the nominal is to stay where it is.
    pub hold: bool,
}

/// What came of a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs {
    /// Where the handle is.
    pub pose: Pose,
    /// What the law did.
    pub outcome: Outcome,
    /// Whether the nominal is slowed before a singularity.
    pub slowed: bool,
    /// What is known of a stiff hand, after this tick.
    pub stiff_hand: Detectors,
    /// What the law knows of the hand: about the handle, in the base frame.
    pub ft: Conditioned,
}

/// A tick whose result is not finite: an input was not, or numbers overflow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotFinite;

/// The law between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ArmLaw {
    kinematics: Kinematics,
    singularity: Singularity,
    stiff_hand: Detectors,
    frame: Frame,
    conditioner: Conditioner,
    task_space: TaskSpace,
}

impl ArmLaw {
    /// A law out of the loop.
    ///
    /// # Errors
    /// The first parameter out of its range, or a law that is not offered.
    pub fn new(parameters: &Parameters) -> Result<Self, ParameterError> {
        parameters.limits.check()?;
        parameters.kinematics.check()?;
        parameters.singularity.check()?;
        parameters.frame.check()?;
        Ok(Self {
            kinematics: parameters.kinematics,
            singularity: parameters.singularity,
            stiff_hand: Detectors::new(parameters.stiff_hand, parameters.settings.T)?,
            frame: parameters.frame,
            conditioner: Conditioner::new(parameters.sensor, parameters.settings.T)?,
            task_space: TaskSpace::new(
                parameters.settings,
                parameters.gains,
                parameters.bounds,
                parameters.reach,
                parameters.limits,
            )?,
        })
    }

    /// Other gains: on a straight line over the tuning time, each step taken over so that the stored energy does not rise.
    ///
    /// # Errors
    /// The first gain out of its range; the gains stay as they were.
    pub fn tune(&mut self, gains: [Gains; 3]) -> Result<(), ParameterError> {
        self.task_space.tune(gains)
    }

    /// One tick.
    ///
    /// # Errors
    /// [`NotFinite`]; the law stays as it was before the tick.
    pub fn tick(&mut self, inputs: &Inputs) -> Result<Outputs, NotFinite> {
        let before = *self;
        let pose = self.kinematics.at(&inputs.q);
        let damping = self.singularity.damping(pose.sigma_min);
        let ft = self.sensed(&pose, inputs);
        let outcome = if inputs.engage {
            self.stiff_hand = self.stiff_hand.sensed(&pose.p, &ft.hand.force);
            let request = Request {
                hold: inputs.hold,
                damping: Vector3::repeat(damping) + self.stiff_hand.D(),
                ..Request::default()
            };
            self.task_space
                .step(&pose, &inputs.q, &ft.hand.force, &request)
        } else {
            self.stiff_hand = self.stiff_hand.at_rest();
            self.task_space.rest(&pose, &inputs.q)
        };
        if outcome.is_finite() && self.ledger().G().is_finite() {
            Ok(Outputs {
                pose,
                outcome,
                slowed: inputs.engage && damping > 0.0,
                stiff_hand: self.stiff_hand,
                ft,
            })
        } else {
            *self = before;
            Err(NotFinite)
        }
    }

    /// What the hand does, in the base frame.
    fn sensed(&mut self, pose: &Pose, inputs: &Inputs) -> Conditioned {
        let turn = self.frame.at(pose);
        let ft = self.conditioner.step(&Sample {
            wrench: inputs.hand,
            R: turn.R(),
            q: inputs.q,
            valid: inputs.ft_valid,
            tare: inputs.tare,
        });
        Conditioned {
            hand: Wrench {
                force: turn.to_base(&ft.hand.force),
                torque: turn.to_base(&ft.hand.torque),
            },
            ..ft
        }
    }

    /// What the hand's force sensor reads when nothing acts on it, as far as a tare has found it; sensor frame.
    pub fn bias(&self) -> Wrench {
        self.conditioner.bias()
    }

    /// Energy stored and created, as of the last tick; the work is that at the joints.
    pub fn ledger(&self) -> &Ledger<3> {
        self.task_space.ledger()
    }
}
