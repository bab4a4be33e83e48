//! The workspace: where the nominal may go.
//!
//! A hand that pulls the elbow straight, or pushes a joint into its stop, leads the arm to where the same hand does not
//! bring it back: at the straight elbow f_max has no lever against friction, and a stop is hit. So the nominal keeps to
//! joint limits that leave room before both, and to a distance from the yaw axis. They are on at the start, with the limits
//! of the exoskeleton arm; another arm has others.
//!
//! ```text
//! dq_n,i ≤ (q_max,i − q_n,i)/t_s,   dq_n,i ≥ (q_min,i − q_n,i)/t_s,   dϱ_n ≥ (ϱ_min − ϱ_n)/t_s
//! ```
//!
//! Towards a limit the nominal so slows as exp(−t/t_s) and comes to rest there; away from it nothing is slowed. A nominal
//! that is beyond, because the arm was or the spring has slipped, may only come back.
//!
//! A law that winds up, 1 or 3, or 2 beyond its torques, so also keeps its nominal where the arm can go, to first order. The
//! paper has no such limits: its experiments are repeated without.
//!
//! In joint space these are intervals of v_m, like its other bounds. In task space they lie across the handle's axes:
//! [`admittance::edges`] holds the nominal back along the limit alone, so that it slides on along it. With
//! q_n = q + J⁻¹ e_nr to first order and each line times det J's factor, nothing is divided by what vanishes at a singularity:
//!
//! ```text
//! ϱ dq_1 = (−s₁, c₁, 0)·dp,   D dq_2 = (r_x c₁, r_x s₁, r_z)·dp,   D dq_3 = −(x c₁, x s₁, z)·dp,   dϱ = (c₁, s₁, 0)·dp
//! ```
//!
//! with D = L₁(h_x sin q₃ + h_z cos q₃) and the other symbols of [`Kinematics::at`](crate::kinematics::Kinematics::at).
//!
//! | module | what |
//! |---|---|
//! | [`edges`] | the limits as edges of the handle's velocity |
//! | [`handle`] | the axes of the handle within them |

pub mod edges;
pub mod handle;

use admittance::parameters::in_range;
use admittance::{ParameterError, Real};
use fmu_declaration::{Rows, Start};

pub use edges::Near;
pub use handle::HandleAxes;

/// What is expected of a largest angle.
const GREATER: &str = "a value greater than workspace.q_min";
/// What is expected of the time of slowing.
const AT_LEAST_T: &str = "a value of at least T";

/// Where the nominal may go. The start values leave 0.1 rad before the stops of the exoskeleton arm; and 0.4 rad where the
/// elbow would become straight, so that f_max still bends it with twice its stiction.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct Workspace {
    /// 1: the nominal keeps within the workspace, which is the exoskeleton arm's: workspace.q_min to workspace.q_max, and
    /// in task space workspace.radius_min; an arm that engages beyond may only come back. 0: it may go anywhere. An
    /// Integer, because fmpy takes a false in a parameter set for true.
    #[parameter(170, name = "workspace.limited", integers = 0..=1, start = 1)]
    pub limited: i32,
    /// Least angle of each joint of the nominal, with room before the arm's stop or before a straight elbow.
    #[parameter(171, name = "workspace.q_min[i]", unit = RADIAN, start = [-1.1, -1.9, 0.5])]
    pub q_min: [Real; 3],
    /// Largest angle of each joint of the nominal, with room before the arm's stop.
    #[parameter(172, name = "workspace.q_max[i]", unit = RADIAN, start = [1.1, 0.9, 2.5])]
    pub q_max: [Real; 3],
    /// Least distance of the nominal handle from the yaw axis, in task space, where the axis is a singularity.
    #[parameter(173, name = "workspace.radius_min", unit = METRE, range = NOT_NEGATIVE, start = 0.1)]
    pub radius_min: Real,
    /// Slowing: a limit is approached no faster than the distance that is left over this time, at least T.
    #[parameter(174, name = "workspace.slowing_time", unit = SECOND, range = POSITIVE, start = 0.2)]
    pub slowing_time: Real,
}

impl Workspace {
    /// The limits, `None` where there are none; `T` (s) is the sample period.
    ///
    /// # Errors
    /// A value out of its range; a largest angle that does not exceed the least one; a time below T.
    pub fn checked(&self, T: Real) -> Result<Option<Self>, ParameterError> {
        in_range(self)?;
        if self.limited == 0 {
            return Ok(None);
        }
        for (joint, (q_min, q_max)) in (1..).zip(self.q_min.iter().zip(&self.q_max)) {
            if q_min >= q_max {
                let name = "workspace.q_max";
                return Err(ParameterError::of(name, Some(joint), *q_max, GREATER));
            }
        }
        if self.slowing_time < T {
            let (name, time) = ("workspace.slowing_time", self.slowing_time);
            return Err(ParameterError::of(name, None, time, AT_LEAST_T));
        }
        Ok(Some(*self))
    }
}
