//! M(q), C(q, dq) and the torque of gravity, in closed form: the left side of eq:real_dyn.
//!
//! Every centre of mass lies in the arm's plane (y = 0) and the only product of inertia is xz, so the yaw axis does not
//! couple with the pitch plane: M is block diagonal. Rotors count by their inertia about their own axis times the gear
//! ratio squared; the gyroscopic torque of a rotor that is carried by a moving link is left out.

use fmu_declaration::{Rows, Start};
use nalgebra::{Matrix3, Vector3};

use super::kinematics::{InPlane, Lengths, Pose, Reach};

/// A rigid link: centre of mass and inertia about it, in the frame of the link (x along it, z up when it is level).
#[derive(Clone, Copy, Debug, PartialEq, Rows)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Link {
    /// mass of the link
    #[parameter(6, name = "link.m[i]", unit = KILOGRAM, range = 1e-3..=1e4)]
    pub m: f64,
    /// centre of mass along the link from its joint
    #[parameter(7, name = "link.x[i]", unit = METRE, range = -10.0..=10.0)]
    pub x: f64,
    /// centre of mass across the link, up when the link is level
    #[parameter(8, name = "link.z[i]", unit = METRE, range = -10.0..=10.0)]
    pub z: f64,
    /// moment of inertia about the centre of mass, axis along the link
    #[parameter(9, name = "link.I_xx[i]", unit = KILOGRAM_SQUARE_METRE, range = 1e-9..=1e4)]
    pub I_xx: f64,
    /// moment of inertia about the centre of mass, axis of the pitch
    #[parameter(10, name = "link.I_yy[i]", unit = KILOGRAM_SQUARE_METRE, range = 1e-9..=1e4)]
    pub I_yy: f64,
    /// moment of inertia about the centre of mass, axis across the link
    #[parameter(11, name = "link.I_zz[i]", unit = KILOGRAM_SQUARE_METRE, range = 1e-9..=1e4)]
    pub I_zz: f64,
    // −∫ x z dm
    /// element xz of the inertia matrix about the centre of mass
    #[parameter(12, name = "link.I_xz[i]", unit = KILOGRAM_SQUARE_METRE, range = -1e4..=1e4)]
    pub I_xz: f64,
}

/// What the dynamics is made of.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Masses {
    /// The three links.
    #[part(each)]
    #[start([
        link(4.0, (0.03, 0.02), [0.012, 0.012, 0.010, 0.0]),
        link(3.5, (0.20, 0.01), [0.006, 0.035, 0.034, 0.001]),
        link(2.5, (0.18, -0.03), [0.004, 0.028, 0.027, -0.001]),
    ])]
    pub links: [Link; 3],
    /// inertia of rotor and gear about the rotor axis; at the joint it counts times gear^2
    #[parameter(13, name = "rotor.I[i]", unit = KILOGRAM_SQUARE_METRE, range = 0.0..=1.0, start = [2.0e-5; 3])]
    pub rotor: [f64; 3],
    /// gear ratio
    #[parameter(14, range = 1.0..=1e4, start = [354.0, 600.0, 354.0])]
    pub gear: [f64; 3],
    /// acceleration of gravity, base frame
    #[parameter(15, unit = METRE_PER_SECOND_SQUARED, range = -1e3..=1e3, start = [0.0, 0.0, -9.81])]
    pub gravity: [f64; 3],
}

const fn link(m: f64, (x, z): (f64, f64), [I_xx, I_yy, I_zz, I_xz]: [f64; 4]) -> Link {
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

/// M dv/dt + C v + g = τ at one pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidBody {
    /// Mass matrix M(q) (kg·m²), M₁₂ = M₁₃ = 0.
    pub M: Matrix3<f64>,
    /// Torque g(q) that holds the arm against gravity (N·m).
    pub g: Vector3<f64>,
    /// Potential energy in the field of gravity, 0 for a mass at the origin (J).
    pub potential: f64,
    /// ½ ∂M₁₁/∂q₂ (kg·m²).
    D_2: f64,
    /// ½ ∂M₁₁/∂q₃ (kg·m²).
    D_3: f64,
    /// ∂M₂₃/∂q₃ = ½ ∂M₂₂/∂q₃ (kg·m²).
    H: f64,
}

impl RigidBody {
    /// The arm at `pose`, with a point mass `payload` (kg) at the pad.
    #[inline(always)]
    pub fn at(pose: &Pose, lengths: &Lengths, masses: &Masses, payload: f64) -> Self {
        let gravity = pose.in_yaw_frame(&Vector3::from(masses.gravity));
        let [one, two, three] = &masses.links;
        let reflected = |i: usize| masses.rotor[i] * masses.gear[i] * masses.gear[i];

        let mut sum = Self {
            M: Matrix3::from_diagonal(&Vector3::new(
                reflected(0) + one.I_zz + one.m * one.x * one.x,
                reflected(1),
                reflected(2),
            )),
            g: Vector3::new(-one.m * one.x * gravity.y, 0.0, 0.0),
            potential: -one.m * (one.x * gravity.x + one.z * gravity.z),
            D_2: 0.0,
            D_3: 0.0,
            H: 0.0,
        };
        sum.add_upper(two, pose, lengths.A_1, &gravity);
        sum.add_fore(three, pose, lengths, &gravity);
        if payload > 0.0 {
            let InPlane { x, z } = lengths.pad();
            let (m, I_xx, I_yy, I_zz, I_xz) = (payload, 0.0, 0.0, 0.0, 0.0);
            let point = Link {
                m,
                x,
                z,
                I_xx,
                I_yy,
                I_zz,
                I_xz,
            };
            sum.add_fore(&point, pose, lengths, &gravity);
        }
        sum
    }

    /// Link 2, pitched by q₂.
    fn add_upper(&mut self, link: &Link, pose: &Pose, A_1: f64, gravity: &Vector3<f64>) {
        let (s, c) = pose.shoulder;
        let x = link.x * c - link.z * s;
        let z = link.x * s + link.z * c;
        let (about_z, slope) = link.about_vertical(s, c);
        let rho = A_1 + x;
        self.M.m11 += link.m * rho * rho + about_z;
        self.D_2 += slope - link.m * rho * z;
        self.M.m22 += link.I_yy + link.m * (x * x + z * z);
        self.g[0] -= link.m * rho * gravity.y;
        self.g[1] -= link.m * (x * gravity.z - z * gravity.x);
        self.potential -= link.m * (rho * gravity.x + z * gravity.z);
    }

    /// Link 3 or a mass fixed to it, pitched by q₂ + q₃.
    fn add_fore(&mut self, link: &Link, pose: &Pose, lengths: &Lengths, gravity: &Vector3<f64>) {
        let ((s, c), (s_3, c_3)) = (pose.pitch, pose.elbow);
        let InPlane { x: x_3, z: z_3 } = link.centre();
        let Reach { x, z, r_x, r_z } = pose.reach(lengths.L_1, link.centre());
        let (about_z, slope) = link.about_vertical(s, c);
        let rho = lengths.A_1 + x;
        self.M.m11 += link.m * rho * rho + about_z;
        self.D_2 += slope - link.m * rho * z;
        self.D_3 += slope - link.m * rho * r_z;
        let about_elbow = link.I_yy + link.m * (x_3 * x_3 + z_3 * z_3);
        let coupling = about_elbow + link.m * lengths.L_1 * (x_3 * c_3 - z_3 * s_3);
        self.M.m22 += link.I_yy + link.m * (x * x + z * z);
        self.M.m23 += coupling;
        self.M.m32 += coupling;
        self.M.m33 += about_elbow;
        self.H -= link.m * lengths.L_1 * (x_3 * s_3 + z_3 * c_3);
        self.g[0] -= link.m * rho * gravity.y;
        self.g[1] -= link.m * (x * gravity.z - z * gravity.x);
        self.g[2] -= link.m * (r_x * gravity.z - r_z * gravity.x);
        self.potential -= link.m * (rho * gravity.x + z * gravity.z);
    }

    /// C(q, dq) of the Christoffel symbols (kg·m²/s): dM/dt − 2C is skew-symmetric.
    ///
    /// ```text
    /// C = [  D₂ v₂ + D₃ v₃   D₂ v₁       D₃ v₁      ]    D₂ = ½ ∂M₁₁/∂q₂,  D₃ = ½ ∂M₁₁/∂q₃
    ///     [ −D₂ v₁           H v₃    H (v₂ + v₃)    ]    H = ∂M₂₃/∂q₃ = ½ ∂M₂₂/∂q₃
    ///     [ −D₃ v₁          −H v₂        0          ]
    /// ```
    pub fn C(&self, v: &Vector3<f64>) -> Matrix3<f64> {
        let Self { D_2, D_3, H, .. } = *self;
        Matrix3::new(
            D_2 * v[1] + D_3 * v[2],
            D_2 * v[0],
            D_3 * v[0], //
            -D_2 * v[0],
            H * v[2],
            H * (v[1] + v[2]), //
            -D_3 * v[0],
            -H * v[1],
            0.0,
        )
    }

    /// Kinetic energy ½ vᵀ M v (J).
    pub fn kinetic(&self, v: &Vector3<f64>) -> f64 {
        0.5 * v.dot(&(self.M * v))
    }
}

impl Link {
    /// Centre of mass.
    pub fn centre(&self) -> InPlane {
        InPlane {
            x: self.x,
            z: self.z,
        }
    }

    /// Inertia about the vertical through the centre of mass at a pitch of sine `s` and cosine `c`, and half its
    /// derivative by the pitch (kg·m²).
    fn about_vertical(&self, s: f64, c: f64) -> (f64, f64) {
        (
            self.I_xx * s * s + self.I_zz * c * c + 2.0 * self.I_xz * s * c,
            (self.I_xx - self.I_zz) * s * c + self.I_xz * (c * c - s * s),
        )
    }
}
