//! Whose axes a sensor's components are along.

use super::Mount;
use crate::kinematics::Pose;
use admittance::{ParameterError, Real};
use nalgebra::{Matrix3, Vector3};

/// The frame of a sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Frame {
    /// The base frame: x forward, y to the left, z up. Somebody else has turned the reading into it.
    Base,
    /// Link 3's: x along the link, z up when the link is level; it turns with the link.
    Link3,
    /// Its own, on link 3.
    Mounted(Mount),
}

/// A frame, with what is known of it before the arm moves.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum FixedFrame {
    Base,
    Link3,
    /// Turned by this matrix on link 3.
    Mounted(Matrix3<Real>),
}

/// A frame at some joint angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Turn {
    /// Turns a vector of the frame into the base frame; `None`: it is the base frame.
    R: Option<Matrix3<Real>>,
}

impl Frame {
    /// What is known of it before the arm moves.
    pub(crate) fn fixed(&self) -> FixedFrame {
        match self {
            Self::Base => FixedFrame::Base,
            Self::Link3 => FixedFrame::Link3,
            Self::Mounted(mount) => FixedFrame::Mounted(mount.R()),
        }
    }

    /// Whether there can be such a frame.
    ///
    /// # Errors
    /// The first angle of the mounting that is not finite.
    pub fn check(&self) -> Result<(), ParameterError> {
        match self {
            Self::Mounted(mount) => mount.check(),
            Self::Base | Self::Link3 => Ok(()),
        }
    }
}

impl FixedFrame {
    /// Where it is when the arm is at `pose`.
    #[inline]
    pub fn at(&self, pose: &Pose) -> Turn {
        Turn {
            R: match self {
                Self::Base => None,
                Self::Link3 => Some(pose.R()),
                Self::Mounted(R) => Some(pose.R() * R),
            },
        }
    }
}

impl Turn {
    /// Turns a vector of the frame into the base frame.
    pub fn R(&self) -> Matrix3<Real> {
        self.R.unwrap_or_else(Matrix3::identity)
    }

    /// `vector` in the base frame: bit for bit what it was if that is its frame.
    pub fn in_base(&self, vector: &Vector3<Real>) -> Vector3<Real> {
        self.R.map_or(*vector, |R| R * vector)
    }
}
