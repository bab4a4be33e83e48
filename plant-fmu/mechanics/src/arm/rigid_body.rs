//! M(q), C(q, dq) and the torque of gravity, in closed form: the left side of eq:real_dyn.
//!
//! Every centre of mass lies in the arm's plane (y = 0) and the only product of inertia is xz, so the yaw axis does not
//! couple with the pitch plane: M is block diagonal. Rotors count by their inertia about their own axis times the gear
//! ratio squared; the gyroscopic torque of a rotor that is carried by a moving link is left out.

use nalgebra::{Matrix3, Vector3};

use super::kinematics::{InPlane, Lengths, Pose, Reach};

/// A rigid link: centre of mass and inertia about it, in the frame of the link (x along it, z up when it is level).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Link {
    /// Mass (kg).
    pub m: f64,
    /// Centre of mass along the link (m).
    pub x: f64,
    /// Centre of mass across the link (m).
    pub z: f64,
    /// Moment of inertia about x (kg·m²).
    pub I_xx: f64,
    /// Moment of inertia about y (kg·m²).
    pub I_yy: f64,
    /// Moment of inertia about z (kg·m²).
    pub I_zz: f64,
    /// Element xz of the inertia matrix (kg·m²): −∫ x z dm.
    pub I_xz: f64,
}

/// What the dynamics is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Masses {
    /// The three links.
    pub links: [Link; 3],
    /// Inertia of each rotor with its gear about its own axis (kg·m²).
    pub rotor: [f64; 3],
    /// Gear ratio of each joint.
    pub gear: [f64; 3],
    /// Acceleration of gravity, base frame (m/s²).
    pub gravity: [f64; 3],
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
            let InPlane { x, z } = lengths.pad;
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
