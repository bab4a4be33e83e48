//! What a sensor shows: random orientations and white noise from a fixed seed.

use arm_law::wrench::Wrench;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3, Vector4};

/// Numbers from a seed (SplitMix64).
pub struct Random(pub u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform between −`half` and `half`.
    pub fn within(&mut self, half: f64) -> f64 {
        ((self.bits() >> 11) as f64 / (1u64 << 53) as f64 * 2.0 - 1.0) * half
    }

    /// Standard normal, as the sum of twelve uniform numbers.
    pub fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.within(0.5)).sum()
    }

    /// Uniform in a cube.
    pub fn vector(&mut self, half: f64) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.within(half))
    }

    /// Any orientation, all alike: the direction of a normal vector in four dimensions as a quaternion.
    pub fn orientation(&mut self) -> Matrix3<f64> {
        let q = Vector4::from_fn(|_, _| self.normal());
        *Rotation3::from(UnitQuaternion::from_quaternion(q.into())).matrix()
    }
}

/// A sensor with its tool as they really are.
pub struct Truth {
    pub mass: f64,
    pub cog: Vector3<f64>,
    pub gravity: Vector3<f64>,
    pub bias: Wrench,
    /// Standard deviations, N and N·m.
    pub noise: (f64, f64),
}

impl Truth {
    /// What it shows in orientation `R` when the hand does `hand` to the handle, which is `handle` away (both in the base
    /// frame). From Newton's and Euler's law of the tool, point by point in the base frame: not the code's way.
    pub fn shows(
        &self,
        R: &Matrix3<f64>,
        hand: &Wrench,
        handle: &Vector3<f64>,
        random: &mut Random,
    ) -> Wrench {
        let weight = self.gravity * self.mass;
        let force = weight + hand.force;
        let torque = (R * self.cog).cross(&weight) + handle.cross(&hand.force) + hand.torque;
        let (sigma_f, sigma_n) = self.noise;
        Wrench {
            force: R.transpose() * force
                + self.bias.force
                + Vector3::from_fn(|_, _| sigma_f * random.normal()),
            torque: R.transpose() * torque
                + self.bias.torque
                + Vector3::from_fn(|_, _| sigma_n * random.normal()),
        }
    }
}
