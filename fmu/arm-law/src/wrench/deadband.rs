//! Forces too small to be meant.

use admittance::rate::part;
use admittance::{Real, real};
use nalgebra::Vector3;

/// `force` (N) shortened by `width` (N, ≥ 0), zero where it is shorter than that.
///
/// ```text
/// f max(0, 1 − d/|f|)
/// ```
///
/// On the length of the vector, so that the direction stays, also near the corners where a band on each axis would turn
/// it. Continuous, with slope 0 inside and 1 far outside: no jump to excite the loop. The price is d newtons on every push.
/// The factor lies in [0, 1]: the law gets less of the same force, never more, never another direction.
pub fn deadband(force: &Vector3<Real>, width: Real) -> Vector3<Real> {
    if width == 0.0 {
        return *force;
    }
    let length = real::hypot(real::hypot(force.x, force.y), force.z);
    force * (1.0 - part(width, length))
}
