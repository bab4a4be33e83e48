//! A tick of the law as it shows at the handle and at the joints.

use admittance::tick::Refused;
use admittance::{Real, real};
use nalgebra::Vector3;

/// What happened at a tick; every value is the one at t_k, vectors at the handle in the base frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HandleTick {
    /// Force at the handle that tau amounts to, N: J⁻ᵀ tau. Clipped where J cannot be inverted: what was asked for.
    pub f_a: Vector3<Real>,
    /// Torques on the joints, N·m.
    pub tau: Vector3<Real>,
    /// Jᵀ K y before any limit, N·m.
    pub tau_demand: Vector3<Real>,
    /// Nominal position, m.
    pub p_n: Vector3<Real>,
    /// Nominal velocity, m/s.
    pub dp_n: Vector3<Real>,
    /// p_n − p after the slip, m.
    pub e_nr: Vector3<Real>,
    /// The handle's velocity as the law used it, m/s.
    pub dp: Vector3<Real>,
    /// Whether a limit leaves less than tau_demand.
    pub saturated: bool,
    /// Whether a bound, or hold, kept the nominal back.
    pub held: bool,
    /// Share of the torques that the energy budget left, in [0, 1]: 1 unless something is wrong.
    pub share: Real,
    /// Whether the joints' motion since the last tick exceeded their reach, to which the passivity argument is restricted.
    pub outside_bounds: bool,
    /// Whether the law is in the loop.
    pub engaged: bool,
}

/// A tick whose result is not finite: an input was not, or numbers overflow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotFinite;

impl From<Refused> for NotFinite {
    fn from(_: Refused) -> Self {
        Self
    }
}

impl HandleTick {
    /// Out of the loop, with the handle at `p` (m), after a motion that was `outside` the reach or not.
    pub fn at_rest(p: &Vector3<Real>, outside: bool) -> Self {
        let zeros = Vector3::zeros();
        Self {
            f_a: zeros,
            tau: zeros,
            tau_demand: zeros,
            p_n: *p,
            dp_n: zeros,
            e_nr: zeros,
            dp: zeros,
            saturated: false,
            held: false,
            share: 1.0,
            outside_bounds: outside,
            engaged: false,
        }
    }

    /// Whether all that follows from the tick is: a torque that is not a number must not reach the robot.
    #[inline]
    pub fn is_finite(&self) -> bool {
        let Self {
            f_a,
            tau,
            tau_demand,
            p_n,
            dp_n,
            ..
        } = self;
        real::are_finite([f_a, tau, tau_demand, p_n, dp_n])
    }
}
