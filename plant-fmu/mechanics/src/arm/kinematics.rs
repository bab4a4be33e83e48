//! Where points of the arm are and how they move.
//!
//! Base frame: origin at the shoulder, x forward, y to the left, z up. Joints: yaw about z, shoulder pitch and elbow
//! pitch about −y, so that positive pitch lifts. The *yaw frame* is the base frame turned by q₁: the arm always lies in
//! its x-z plane, at y = 0.

use fmu_declaration::{Rows, Start};
use nalgebra::{Matrix3, Vector3};

/// Lengths of the links and the points of link 3 where forces act.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Lengths {
    /// from the yaw axis forward to the shoulder's pitch axis
    #[parameter(0, name = "A1", unit = METRE, range = 0.0..=10.0, start = 0.06)]
    pub A_1: f64,
    /// from the shoulder's pitch axis to the elbow's
    #[parameter(1, name = "L1", unit = METRE, range = 1e-2..=10.0, start = 0.32)]
    pub L_1: f64,
    /// handle, along link 3 from the elbow's axis
    #[parameter(2, name = "handle.x", unit = METRE, range = 1e-2..=10.0, start = 0.36)]
    pub handle_x: f64,
    /// handle, across link 3, up when the link is level
    #[parameter(3, name = "handle.z", unit = METRE, range = -10.0..=10.0)]
    pub handle_z: f64,
    /// pad, along link 3 from the elbow's axis
    #[parameter(4, name = "pad.x", unit = METRE, range = 1e-2..=10.0, start = 0.36)]
    pub pad_x: f64,
    /// pad, across link 3, up when the link is level
    #[parameter(5, name = "pad.z", unit = METRE, range = -10.0..=10.0, start = -0.12)]
    pub pad_z: f64,
}

impl Lengths {
    /// Handle, where f_h acts.
    pub fn handle(&self) -> InPlane {
        InPlane {
            x: self.handle_x,
            z: self.handle_z,
        }
    }

    /// Pad, where contact, payload and f_d act.
    pub fn pad(&self) -> InPlane {
        InPlane {
            x: self.pad_x,
            z: self.pad_z,
        }
    }

    /// Farthest from the yaw axis that the pad can come (m).
    pub fn reach(&self) -> f64 {
        self.A_1 + self.L_1 + libm::hypot(self.pad_x, self.pad_z)
    }
}

/// A point of link 3 in its frame: origin on the elbow's axis, x along the link, z up when the link is level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InPlane {
    /// Along the link (m).
    pub x: f64,
    /// Across the link (m); y = 0.
    pub z: f64,
}

/// Sines and cosines of a pose: the only trigonometry of a substep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// sin q₁ and cos q₁.
    pub yaw: (f64, f64),
    /// sin q₂ and cos q₂: pitch of link 2.
    pub shoulder: (f64, f64),
    /// sin q₃ and cos q₃.
    pub elbow: (f64, f64),
    /// sin(q₂ + q₃) and cos(q₂ + q₃): pitch of link 3.
    pub pitch: (f64, f64),
}

/// A point of link 3 with its Jacobian, base frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Position p (m).
    pub p: Vector3<f64>,
    /// J = ∂p/∂q (m/rad).
    pub J: Matrix3<f64>,
}

/// A point in the yaw frame's x-z plane, seen from the two pitch axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reach {
    /// From the shoulder's pitch axis, forward (m).
    pub(crate) x: f64,
    /// From the shoulder's pitch axis, up (m).
    pub(crate) z: f64,
    /// From the elbow's axis, forward (m).
    pub(crate) r_x: f64,
    /// From the elbow's axis, up (m).
    pub(crate) r_z: f64,
}

impl Pose {
    /// Pose at joint angles `q` (rad).
    pub fn at(q: &Vector3<f64>) -> Self {
        let (s_2, c_2) = libm::sincos(q[1]);
        let (s_3, c_3) = libm::sincos(q[2]);
        Self {
            yaw: libm::sincos(q[0]),
            shoulder: (s_2, c_2),
            elbow: (s_3, c_3),
            pitch: (s_2 * c_3 + c_2 * s_3, c_2 * c_3 - s_2 * s_3),
        }
    }

    /// `vector` of the base frame in the yaw frame: R_z(q₁)ᵀ vector.
    pub fn in_yaw_frame(&self, vector: &Vector3<f64>) -> Vector3<f64> {
        let (s, c) = self.yaw;
        Vector3::new(
            c * vector.x + s * vector.y,
            c * vector.y - s * vector.x,
            vector.z,
        )
    }

    pub(crate) fn reach(&self, L_1: f64, point: InPlane) -> Reach {
        let ((s_2, c_2), (s_b, c_b)) = (self.shoulder, self.pitch);
        let r_x = point.x * c_b - point.z * s_b;
        let r_z = point.x * s_b + point.z * c_b;
        Reach {
            x: L_1 * c_2 + r_x,
            z: L_1 * s_2 + r_z,
            r_x,
            r_z,
        }
    }

    /// Position and Jacobian of a point of link 3, base frame:
    ///
    /// ```text
    /// p = R_z(q₁) (ϱ, 0, z),   ϱ = A₁ + x,   x = L₁ cos q₂ + r_x,   z = L₁ sin q₂ + r_z
    /// J = R_z(q₁) [ 0  −z  −r_z ]
    ///             [ ϱ   0    0  ]
    ///             [ 0   x   r_x ]
    /// ```
    pub fn point(&self, lengths: &Lengths, point: InPlane) -> Point {
        let (s, c) = self.yaw;
        let Reach { x, z, r_x, r_z } = self.reach(lengths.L_1, point);
        let rho = lengths.A_1 + x;
        Point {
            p: Vector3::new(rho * c, rho * s, z),
            J: Matrix3::new(
                -rho * s,
                -z * c,
                -r_z * c, //
                rho * c,
                -z * s,
                -r_z * s, //
                0.0,
                x,
                r_x,
            ),
        }
    }
}
