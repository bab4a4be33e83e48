//! The energy that one axis of the law holds.
//!
//! H = K(½ M_n v_n²/alpha + ½ K_P e²): the nominal mass and the coupling's spring, as the robot's port sees them.
//!
//! Where the spring is [limited](Spring::Limited), its force is, and its energy is Φ(e) = ∫₀ᵉ sat(K K_P s) ds: with it
//! (sat(K K_P e + K de) − sat(K K_P e))·de ≥ 0 makes the law passive, which ½ K K_P e² does not.

use crate::law::Spring;
use crate::real::{self, sat};
use crate::{Gains, Law, Real};

/// The spring's energy at extension `e` (m), J.
///
/// ½ K K_P e², and from |e| = f_max/(K K_P) on, where it is limited, f_max(|e| − f_max/(2 K K_P)).
pub fn spring(law: Law, gains: &Gains, e: Real) -> Real {
    let k = gains.K * gains.K_P;
    let x = real::abs(e);
    if winds_up(law) && k * x > gains.f_max {
        gains.f_max * (x - gains.f_max / (2.0 * k))
    } else {
        0.5 * k * x * x
    }
}

/// The extension |e| (m) at which the spring holds `energy` (J): the inverse of [`spring`].
pub fn extension(law: Law, gains: &Gains, energy: Real) -> Real {
    let k = gains.K * gains.K_P;
    let quadratic = real::sqrt(2.0 * energy / k);
    if winds_up(law) && k * quadratic > gains.f_max {
        energy / gains.f_max + gains.f_max / (2.0 * k)
    } else {
        quadratic
    }
}

/// Whether the spring's extension may grow at a limited force.
const fn winds_up(law: Law) -> bool {
    match law.row().spring {
        Spring::Limited => true,
        Spring::Free | Spring::Slips => false,
    }
}

/// What is left of the extension `e` (m) of a spring that slips: |K K_P e| ≤ f_max. The others keep theirs.
pub fn slipped(law: Law, gains: &Gains, e: Real) -> Real {
    match law.row().spring {
        Spring::Slips => sat(e, gains.f_max / (gains.K * gains.K_P)),
        Spring::Free | Spring::Limited => e,
    }
}

/// The nominal mass's energy at velocity `v_n` (m/s), J: K ½ M_n v_n²/alpha. Not finite for alpha = 0.
pub fn mass(gains: &Gains, alpha: Real, v_n: Real) -> Real {
    gains.K * (0.5 * gains.M_n * v_n * v_n / alpha)
}

/// H, J, at position error `e` (m) and nominal velocity `v_n` (m/s). Not finite for alpha = 0.
pub fn stored(law: Law, gains: &Gains, alpha: Real, e: Real, v_n: Real) -> Real {
    mass(gains, alpha, v_n) + spring(law, gains, e)
}
