//! Where the handle is and how it moves, as the controller knows it.
//!
//! Base frame: origin at the shoulder, x forward, y to the left, z up. Joints: yaw about z, shoulder pitch and elbow
//! pitch about −y, so that positive pitch lifts. Link 3's frame has its origin on the elbow's axis, x along the link, z
//! up when the link is level; the handle lies in its x-z plane.

use admittance::parameters::in_range;
use admittance::{ParameterError, Real, real};
use fmu_declaration::{Rows, Start};
use nalgebra::{Matrix3, Vector3};

/// The lengths that place the handle. The start values are the exoskeleton arm's.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct Kinematics {
    /// Length from the yaw axis forward to the shoulder's pitch axis.
    #[parameter(35, name = "kinematics.A1", unit = METRE, range = NOT_NEGATIVE, start = 0.06)]
    pub A1: Real,
    /// Length from the shoulder's pitch axis to the elbow's.
    #[parameter(36, name = "kinematics.L1", unit = METRE, range = POSITIVE, start = 0.32)]
    pub L1: Real,
    /// Handle in link 3's frame: from the elbow's axis along the link, L2 of the arm.
    #[parameter(37, name = "kinematics.handle_x", unit = METRE, range = POSITIVE, start = 0.36)]
    pub handle_x: Real,
    /// Handle in link 3's frame: across the link, upwards when it is level.
    #[parameter(38, name = "kinematics.handle_z", unit = METRE)]
    pub handle_z: Real,
}

/// The handle at some joint angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Position p of the handle, base frame, m.
    pub p: Vector3<Real>,
    /// J = ∂p/∂q, base frame, m/rad.
    pub J: Matrix3<Real>,
    /// Smallest singular value of J, m/rad: the least that the handle moves for a unit of joint motion.
    pub sigma_min: Real,
    /// Sine and cosine of the joint angles.
    pub sin_cos: SinCos,
}

impl Pose {
    /// Link 3's axes in the base frame, as columns: turns a vector of link 3's frame into the base frame.
    pub fn R(&self) -> Matrix3<Real> {
        let [(s_1, c_1), ..] = self.sin_cos;
        let (s_b, c_b) = beta(&self.sin_cos);
        #[rustfmt::skip]
        let R = Matrix3::new(
            c_1 * c_b, -s_1, -c_1 * s_b,
            s_1 * c_b,  c_1, -s_1 * s_b,
            s_b,        0.0,  c_b,
        );
        R
    }
}

/// How joint angles and the distance from the yaw axis change with the handle's position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slopes {
    /// ∂qᵢ/∂p, base frame, each times its scale: finite at singularities, too.
    pub joints: [Vector3<Real>; 3],
    /// ϱ for the yaw axis (m), D = L₁(h_x sin q₃ + h_z cos q₃) for the pitch axes (m²).
    pub scales: [Real; 3],
    /// ϱ, m.
    pub radius: Real,
}

/// Sine and cosine of three angles: elementary functions are called once an angle.
pub type SinCos = [(Real, Real); 3];

/// Sine and cosine of the angles `q` (rad).
#[inline]
pub fn sin_cos(q: &Vector3<Real>) -> SinCos {
    [
        real::sin_cos(q[0]),
        real::sin_cos(q[1]),
        real::sin_cos(q[2]),
    ]
}

/// The handle in the arm's plane, forward and up, m: from the shoulder's pitch axis and from the elbow's.
struct InPlane {
    x: Real,
    z: Real,
    r_x: Real,
    r_z: Real,
}

/// Sine and cosine of β = q₂ + q₃.
#[inline]
pub(crate) fn beta(&[_, (s_2, c_2), (s_3, c_3)]: &SinCos) -> (Real, Real) {
    (s_2 * c_3 + c_2 * s_3, c_2 * c_3 - s_2 * s_3)
}

impl Kinematics {
    /// The handle at joint angles `q` (rad).
    ///
    /// ```text
    /// r = (h_x cos β − h_z sin β, h_x sin β + h_z cos β),   β = q₂ + q₃        from the elbow's axis
    /// p = R_z(q₁) (ϱ, 0, z),   ϱ = A₁ + x,   x = L₁ cos q₂ + r_x,   z = L₁ sin q₂ + r_z
    /// J = R_z(q₁) [ 0  −z  −r_z ]
    ///             [ ϱ   0    0  ]
    ///             [ 0   x   r_x ]
    /// ```
    ///
    /// The singular values of J are |ϱ| (the handle on the yaw axis) and those of its pitch block, whose smaller one is
    /// |det|/σ_max with det = L₁(h_x sin q₃ + h_z cos q₃): no iteration, and exact where it matters, near zero.
    pub fn at(&self, q: &Vector3<Real>) -> Pose {
        self.turned(&sin_cos(q))
    }

    /// The handle at joint angles given by sine and cosine.
    #[inline(always)]
    pub(crate) fn turned(&self, sin_cos: &SinCos) -> Pose {
        let [_, _, (s_3, c_3)] = *sin_cos;
        let InPlane { x, z, r_x, r_z } = self.in_plane(sin_cos);
        let det = self.L1 * (self.handle_x * s_3 + self.handle_z * c_3);
        Pose {
            p: self.p(sin_cos),
            J: self.J(sin_cos),
            sigma_min: real::at_most(
                real::abs(det) / largest_singular_value([[-z, -r_z], [x, r_x]]),
                real::abs(self.A1 + x),
            ),
            sin_cos: *sin_cos,
        }
    }

    /// Position of the handle, m.
    #[inline]
    pub(crate) fn p(&self, sin_cos: &SinCos) -> Vector3<Real> {
        let (s_1, c_1) = sin_cos[0];
        let InPlane { x, z, .. } = self.in_plane(sin_cos);
        let rho = self.A1 + x;
        Vector3::new(rho * c_1, rho * s_1, z)
    }

    /// J = ∂p/∂q, m/rad.
    #[inline]
    pub(crate) fn J(&self, sin_cos: &SinCos) -> Matrix3<Real> {
        let (s_1, c_1) = sin_cos[0];
        let InPlane { x, z, r_x, r_z } = self.in_plane(sin_cos);
        let rho = self.A1 + x;
        #[rustfmt::skip]
        let J = Matrix3::new(
            -rho * s_1, -z * c_1, -r_z * c_1,
             rho * c_1, -z * s_1, -r_z * s_1,
             0.0,        x,        r_x,
        );
        J
    }

    /// The rows of J⁻¹ = [ −s₁/ϱ  c₁/ϱ  0;  r_x c₁/D  r_x s₁/D  r_z/D;  −x c₁/D  −x s₁/D  −z/D ], each times what it is
    /// divided by.
    pub(crate) fn slopes(&self, sin_cos: &SinCos) -> Slopes {
        let [(s_1, c_1), _, (s_3, c_3)] = *sin_cos;
        let InPlane { x, z, r_x, r_z } = self.in_plane(sin_cos);
        let (radius, D) = (
            self.A1 + x,
            self.L1 * (self.handle_x * s_3 + self.handle_z * c_3),
        );
        Slopes {
            joints: [
                Vector3::new(-s_1, c_1, 0.0),
                Vector3::new(r_x * c_1, r_x * s_1, r_z),
                Vector3::new(-x * c_1, -x * s_1, -z),
            ],
            scales: [radius, D, D],
            radius,
        }
    }

    #[inline]
    fn in_plane(&self, sin_cos: &SinCos) -> InPlane {
        let [_, (s_2, c_2), _] = *sin_cos;
        let Self {
            L1,
            handle_x: h_x,
            handle_z: h_z,
            ..
        } = *self;
        let (s_b, c_b) = beta(sin_cos);
        let (r_x, r_z) = (h_x * c_b - h_z * s_b, h_x * s_b + h_z * c_b);
        InPlane {
            x: L1 * c_2 + r_x,
            z: L1 * s_2 + r_z,
            r_x,
            r_z,
        }
    }

    /// Whether an arm can have these lengths.
    ///
    /// # Errors
    /// The first length out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        in_range(self)
    }
}

/// Of [[a, b], [c, d]]: σ₁ + σ₂ = √((a + d)² + (b − c)²) and σ₁ − σ₂ = √((a − d)² + (b + c)²), up to the sign of det.
fn largest_singular_value([[a, b], [c, d]]: [[Real; 2]; 2]) -> Real {
    let size = real::abs(a) + real::abs(b) + real::abs(c) + real::abs(d);
    let (sum, difference) = if size > 1e-15 && size < 1e15 {
        // Squares neither overflow nor vanish beside the other pair's: √ is one instruction.
        let square = |x: Real, y: Real| x * x + y * y;
        (
            real::sqrt(square(a + d, b - c)),
            real::sqrt(square(a - d, b + c)),
        )
    } else {
        (real::hypot(a + d, b - c), real::hypot(a - d, b + c))
    };
    0.5 * (sum + difference)
}
