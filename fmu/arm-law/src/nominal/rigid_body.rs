//! M_n(q) and C_n(q, dq) in closed form.
//!
//! Every centre of mass lies in the arm's plane (y = 0 in the link's frame) and the only product of inertia is xz, so
//! that the yaw axis does not couple with the two pitch axes: M_n is block diagonal, 1 + 2, and depends on q₂, q₃ only.

use crate::kinematics::{Kinematics, SinCos, beta, sin_cos};
use admittance::parameters::in_range;
use admittance::{ParameterError, Real};
use fmu_declaration::{Rows, Start};
use nalgebra::{Matrix3, Vector3};

/// A link of the nominal arm, in the link's frame: origin on its joint's axis, x along it, z up when it is level.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct Link {
    /// Mass of each link of the nominal arm, which has the lengths kinematics.* and no weight.
    #[parameter(125, name = "nominal.m[i]", unit = KILOGRAM, range = NOT_NEGATIVE)]
    pub m: Real,
    /// Centre of mass of each nominal link along it, from its joint's axis.
    #[parameter(126, name = "nominal.x[i]", unit = METRE)]
    pub x: Real,
    /// Centre of mass of each nominal link across it, upwards when it is level.
    #[parameter(127, name = "nominal.z[i]", unit = METRE)]
    pub z: Real,
    /// Moment of inertia of each nominal link about x through its centre of mass.
    #[parameter(128, name = "nominal.I_xx[i]", unit = KILOGRAM_SQUARE_METRE, range = NOT_NEGATIVE)]
    pub I_xx: Real,
    /// Moment of inertia of each nominal link about y through its centre of mass.
    #[parameter(129, name = "nominal.I_yy[i]", unit = KILOGRAM_SQUARE_METRE, range = NOT_NEGATIVE)]
    pub I_yy: Real,
    /// Moment of inertia of each nominal link about z through its centre of mass.
    #[parameter(130, name = "nominal.I_zz[i]", unit = KILOGRAM_SQUARE_METRE, range = NOT_NEGATIVE)]
    pub I_zz: Real,
    /// Element xz of each nominal link's inertia matrix, the negative product of inertia.
    #[parameter(131, name = "nominal.I_xz[i]", unit = KILOGRAM_SQUARE_METRE)]
    pub I_xz: Real,
}

/// What the nominal arm is made of. Its lengths are those of the kinematics. The start values: half the mass of the
/// exoskeleton arm's links and 0.4 kg·m² at each joint. At the start pose M_n is 0.53 and [0.68 0.06; 0.06 0.46] kg·m²; the
/// robot's, with its reflected rotors, is 3 to 8 kg·m².
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct NominalArm {
    /// The three links.
    #[part(each)]
    #[start([
        link(2.0, (0.03, 0.02), [0.006, 0.006, 0.005, 0.0]),
        link(1.75, (0.20, 0.01), [0.003, 0.0175, 0.017, 0.0005]),
        link(1.25, (0.18, -0.03), [0.002, 0.014, 0.0135, -0.0005]),
    ])]
    pub links: [Link; 3],
    /// Inertia of each nominal joint about its own axis, as the joint feels it.
    #[parameter(132, name = "nominal.rotor[i]", unit = KILOGRAM_SQUARE_METRE, range = POSITIVE, start = [0.4; 3])]
    pub rotor: [Real; 3],
}

const fn link(m: Real, (x, z): (Real, Real), [I_xx, I_yy, I_zz, I_xz]: [Real; 4]) -> Link {
    Link {
        m,
        x,
        z,
        I_xx,
        I_yy,
        I_zz,
        I_xz,
    }
}

/// The nominal arm at one pose.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RigidBody {
    /// M_n(q), kg·m², M₁₂ = M₁₃ = 0.
    pub M: Matrix3<Real>,
    /// ½ ∂M₁₁/∂q₂, kg·m².
    D_2: Real,
    /// ½ ∂M₁₁/∂q₃, kg·m².
    D_3: Real,
    /// ∂M₂₃/∂q₃ = ½ ∂M₂₂/∂q₃, kg·m².
    H: Real,
}

impl NominalArm {
    /// The nominal arm at joint angles `q` (rad), with the lengths of `kinematics`.
    ///
    /// With link i's centre of mass at (x_i, z_i) from the shoulder's pitch axis, r from its own joint, ϱ_i = A₁ + x_i:
    ///
    /// ```text
    /// M₁₁ = Σ (m ϱ² + I_v)             I_v: about the vertical through the centre of mass
    /// M₂₂ = Σ₂₃ (m (x² + z²) + I_yy)   M₂₃ = m₃ (r² + L₁(x₃ cos q₃ − z₃ sin q₃)) + I_yy,₃
    /// M₃₃ = m₃ r² + I_yy,₃             and the rotors on the diagonal
    /// ```
    pub fn at(&self, kinematics: &Kinematics, q: &Vector3<Real>) -> RigidBody {
        self.turned(kinematics, &sin_cos(q))
    }

    /// The nominal arm at joint angles given by sine and cosine.
    pub(crate) fn turned(&self, kinematics: &Kinematics, sin_cos: &SinCos) -> RigidBody {
        let (A1, L1) = (kinematics.A1, kinematics.L1);
        let [one, two, three] = &self.links;
        let [_, (s_2, c_2), (s_3, c_3)] = *sin_cos;
        let (s_b, c_b) = beta(sin_cos);

        let (x_2, z_2) = two.turned(s_2, c_2);
        let (v_2, slope_2) = two.about_vertical(s_2, c_2);
        let rho_2 = A1 + x_2;

        let (r_x, r_z) = three.turned(s_b, c_b);
        let (x_3, z_3) = (L1 * c_2 + r_x, L1 * s_2 + r_z);
        let (v_3, slope_3) = three.about_vertical(s_b, c_b);
        let rho_3 = A1 + x_3;
        let about_elbow = three.I_yy + three.m * (three.x * three.x + three.z * three.z);

        let m11 = one.m * one.x * one.x
            + one.I_zz
            + (two.m * rho_2 * rho_2 + v_2)
            + (three.m * rho_3 * rho_3 + v_3);
        let m22 = (two.m * (x_2 * x_2 + z_2 * z_2) + two.I_yy)
            + (three.m * (x_3 * x_3 + z_3 * z_3) + three.I_yy);
        let m23 = about_elbow + three.m * L1 * (three.x * c_3 - three.z * s_3);
        RigidBody {
            #[rustfmt::skip]
            M: Matrix3::new(
                m11 + self.rotor[0], 0.0,                 0.0,
                0.0,                 m22 + self.rotor[1], m23,
                0.0,                 m23,                 about_elbow + self.rotor[2],
            ),
            D_2: (slope_2 - two.m * rho_2 * z_2) + (slope_3 - three.m * rho_3 * z_3),
            D_3: slope_3 - three.m * rho_3 * r_z,
            H: -three.m * L1 * (three.x * s_3 + three.z * c_3),
        }
    }

    /// Whether this is a body: no negative mass or moment of inertia, and rotors that keep M_n positive definite.
    ///
    /// # Errors
    /// The first value out of its range, with the link's number.
    pub fn check(&self) -> Result<(), ParameterError> {
        in_range(self)?;
        for (i, link) in (1..).zip(&self.links) {
            if link.I_xz * link.I_xz > link.I_xx * link.I_zz {
                let expected = "at most sqrt(I_xx I_zz) in absolute value";
                return Err(ParameterError::of(
                    "nominal.I_xz",
                    Some(i),
                    link.I_xz,
                    expected,
                ));
            }
        }
        Ok(())
    }
}

impl Link {
    /// The centre of mass, turned by a pitch of sine `s` and cosine `c`: forward and up from the joint's axis, m.
    fn turned(&self, s: Real, c: Real) -> (Real, Real) {
        (self.x * c - self.z * s, self.x * s + self.z * c)
    }

    /// Inertia about the vertical through the centre of mass at a pitch of sine `s` and cosine `c`, and half its
    /// derivative by the pitch, kg·m².
    fn about_vertical(&self, s: Real, c: Real) -> (Real, Real) {
        (
            self.I_xx * s * s + self.I_zz * c * c + 2.0 * self.I_xz * s * c,
            (self.I_xx - self.I_zz) * s * c + self.I_xz * (c * c - s * s),
        )
    }
}

impl RigidBody {
    /// C_n(q, dq) of the Christoffel symbols at joint velocities `dq` (rad/s), kg·m²/s. Times any v it is symmetric in
    /// dq and v: C_n(q, dq) v = C_n(q, v) dq.
    ///
    /// ```text
    /// C_n = [  D₂ dq₂ + D₃ dq₃    D₂ dq₁       D₃ dq₁      ]    D₂ = ½ ∂M₁₁/∂q₂,  D₃ = ½ ∂M₁₁/∂q₃
    ///       [ −D₂ dq₁             H dq₃    H (dq₂ + dq₃)   ]    H = ∂M₂₃/∂q₃ = ½ ∂M₂₂/∂q₃
    ///       [ −D₃ dq₁            −H dq₂        0           ]
    /// ```
    pub fn C(&self, dq: &Vector3<Real>) -> Matrix3<Real> {
        self.half_rate(dq) + self.S(dq)
    }

    /// ½ dM_n/dt at joint velocities `dq` (rad/s), kg·m²/s: the symmetric part of C_n.
    pub fn half_rate(&self, dq: &Vector3<Real>) -> Matrix3<Real> {
        let Self { D_2, D_3, H, .. } = *self;
        #[rustfmt::skip]
        let rate = Matrix3::new(
            D_2 * dq[1] + D_3 * dq[2], 0.0,             0.0,
            0.0,                       H * dq[2],       0.5 * H * dq[2],
            0.0,                       0.5 * H * dq[2], 0.0,
        );
        rate
    }

    /// S = C_n − ½ dM_n/dt at joint velocities `dq` (rad/s), kg·m²/s: skew-symmetric, so that it does no work on v_n.
    pub fn S(&self, dq: &Vector3<Real>) -> Matrix3<Real> {
        let Self { D_2, D_3, H, .. } = *self;
        let (a, b, c) = (D_2 * dq[0], D_3 * dq[0], H * (dq[1] + 0.5 * dq[2]));
        #[rustfmt::skip]
        let S = Matrix3::new(
            0.0,  a,   b,
            -a,  0.0,  c,
            -b,  -c,  0.0,
        );
        S
    }

    /// ½ vᵀ M_n v at velocities `v` (rad/s), J.
    pub fn kinetic(&self, v: &Vector3<Real>) -> Real {
        0.5 * v.dot(&(self.M * v))
    }
}
