//! What goes into the arm, where it is, and what it shows.

use fmu_declaration::Rows;
use nalgebra::Vector3;

use super::kinematics::{Point, Pose};
use super::parameters::Parameters;
use super::payload::Hold;
use super::problem::Path;
use super::rigid_body::RigidBody;

/// What acts on the arm, held over a run of substeps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Rows)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Inputs {
    /// torque asked of the drive, on yaw, shoulder and elbow; positive turns left, lifts, lifts
    #[input(0, unit = NEWTON_METRE)]
    pub tau_a: [f64; 3],
    /// force of the human on the arm at the handle, base frame (x forward, y to the left, z up)
    #[input(1, unit = NEWTON)]
    pub f_h: [f64; 3],
    /// force on the arm at the pad that no sensor sees, base frame
    #[input(2, unit = NEWTON)]
    pub f_d: [f64; 3],
    /// whether the cup at the pad sucks: it grips what the pad presses on, and lets go when this is false; a payload that
    /// hangs from the start on (payload.attached) stays until this has been true
    #[input(3)]
    pub vacuum: bool,
}

/// Where the arm is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct State {
    /// Joint angles (rad).
    pub q: Vector3<f64>,
    /// Joint velocities (rad/s).
    pub dq: Vector3<f64>,
    /// Torques τ that arrive at the joints (N·m).
    pub tau: Vector3<f64>,
    /// Deflections of table and wall (m), ≥ 0 and never less than the pad's penetration.
    pub s: [f64; 2],
    /// Whether a payload hangs at the pad.
    pub attached: bool,
}

/// What the last substep showed. Means over it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Shown {
    /// Force of table and wall on the pad, or on the payload that it holds; base frame (N).
    pub f_e: Vector3<f64>,
    /// Torque of dry and viscous friction on the joints (N·m).
    pub tau_f: Vector3<f64>,
    /// What the pad holds the payload with; 0 without.
    pub hold: Hold,
    /// Whether table or wall pushed.
    pub contact: bool,
    /// How the solution was found.
    pub path: Path,
}

/// Pose, handle and pad at one q.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Sines and cosines.
    pub pose: Pose,
    /// Handle.
    pub handle: Point,
    /// Pad.
    pub pad: Point,
}

impl Place {
    /// The arm at joint angles `q` (rad).
    pub fn at(parameters: &Parameters, q: &Vector3<f64>) -> Self {
        Self::of(parameters, Pose::at(q))
    }

    fn of(parameters: &Parameters, pose: Pose) -> Self {
        let lengths = &parameters.lengths;
        Self {
            pose,
            handle: pose.point(lengths, lengths.handle()),
            pad: pose.point(lengths, lengths.pad()),
        }
    }
}

/// What follows from the joint angles and the payload: where the arm is, and the rigid body there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Configuration {
    pub(crate) place: Place,
    pub(crate) body: RigidBody,
}

impl Configuration {
    /// The arm in `state`.
    pub(crate) fn of(parameters: &Parameters, state: &State) -> Self {
        let pose = Pose::at(&state.q);
        Self {
            place: Place::of(parameters, pose),
            body: parameters.body(&pose, state.attached),
        }
    }

    /// Follows the arm to `state`: as [`Configuration::of`], without a copy of the whole.
    pub(crate) fn follow(&mut self, parameters: &Parameters, state: &State) {
        let Self { place, body } = self;
        *place = Place::of(parameters, Pose::at(&state.q));
        parameters.weigh(body, &place.pose, state.attached);
    }
}
