//! Half swings, measured.

use super::{Impedance, Watch};
use crate::Real;
use crate::real::{abs, consts::PI, quotient_if, sqrt};

/// Least ρ of a hand that gives energy: f_h within 37° of opposing x. A reflex delay of 30 ms at 3 Hz turns it by 32°.
const LEAST_RHO_GIVING: Real = 0.8;
/// Least ρ of a hand that takes energy: within 60°. A damper of 80 N·s/m at 1000 N/m turns it by 52° at 2.6 Hz.
const LEAST_RHO_TAKING: Real = 0.5;
/// Largest share of f_h² that is not of a spring and a damper. Dry friction makes harmonics of 1 % in x, and 1 mm of noise
/// in x, in the band a tenth of a swing of 2 mm, 1 %.
const LARGEST_RESIDUAL: Real = 0.1;

/// A half swing that goes on: the position x and the force f, both from the band pass, from zero crossing to zero crossing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Swing {
    /// −1 or 1: the side; 0: not known yet.
    side: Real,
    samples: Real,
    /// The last sample.
    x: Real,
    f: Real,
    xx: Real,
    ff: Real,
    xf: Real,
    /// ∫ f dx, J.
    work: Real,
}

/// A half swing that has ended; sums over its samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSwing {
    /// How long it was, s.
    pub duration: Real,
    /// Amplitude of f_h in the band, N: √(2 Σf²/n), that of a sine with this mean square.
    pub strength: Real,
    /// ρ = −Σxf/√(Σx² Σf²): 1 for a spring, 0 for a damper or a mere push in step with the velocity, −1 for a mass less spring.
    pub rho: Real,
    /// Stiffness k = −Σxf/Σx² and damping b = −∫f dx/(ω² Σx² T) with ω = π/duration: of a sine, the regression of f on x and
    /// dx, which are orthogonal between zero crossings of x.
    pub hand: Impedance,
    /// Share of f² that this hand leaves: 1 − |k + jωb|² Σx²/Σf² = 1 − ρ² − (∫f dx/(ωT))²/(Σx² Σf²).
    pub residual: Real,
    /// Whether no zero crossing has come for half a period of `f_low`: what follows has nothing to do with it.
    pub ended_late: bool,
}

impl Swing {
    /// After a sample of x (m) and f (N), and the half swing that ended with it, if one did.
    #[must_use]
    pub fn sampled(self, x: Real, f: Real, watch: &Watch) -> (Self, Option<HalfSwing>) {
        // Before the first sample of a measurement nothing has moved.
        let moved = if self.samples > 0.0 || self.side != 0.0 {
            x - self.x
        } else {
            0.0
        };
        let on = Self {
            samples: self.samples + 1.0,
            x,
            f,
            xx: self.xx + x * x,
            ff: self.ff + f * f,
            xf: self.xf + x * f,
            work: self.work + 0.5 * (f + self.f) * moved,
            ..self
        };
        let crossed = self.side * x < 0.0 || (self.side == 0.0 && x != 0.0);
        let late = on.samples > watch.longest();
        if !crossed && !late {
            return (on, None);
        }
        let next = Self {
            side: match crossed {
                true if x > 0.0 => 1.0,
                true => -1.0,
                false => 0.0,
            },
            x,
            f,
            ..Self::default()
        };
        (next, Some(on.measured(late, watch)))
    }

    fn measured(&self, ended_late: bool, watch: &Watch) -> HalfSwing {
        let duration = self.samples * watch.T();
        let omega = PI / duration;
        let hand = Impedance {
            k: quotient(-self.xf, self.xx),
            b: quotient(-self.work, omega * omega * watch.T() * self.xx),
            omega,
        };
        let both = sqrt(self.xx) * sqrt(self.ff);
        let rho = quotient(-self.xf, both);
        let of_velocity = quotient(self.work, omega * watch.T() * both);
        HalfSwing {
            duration,
            strength: sqrt(2.0 * self.ff / self.samples),
            rho,
            hand,
            residual: 1.0 - rho * rho - of_velocity * of_velocity,
            ended_late,
        }
    }
}

impl HalfSwing {
    /// Whether it is shorter than half a period of `f_high`: noise at a crossing of zero, which says nothing.
    pub fn is_too_short(&self, watch: &Watch) -> bool {
        self.duration < watch.shortest()
    }

    /// Whether it lies in the band and f_h in it is that of a hand that holds on: a spring, and a damper or a reflex that is
    /// late.
    pub fn is_of_a_hand(&self, watch: &Watch) -> bool {
        let least = if self.hand.b < 0.0 {
            LEAST_RHO_GIVING
        } else {
            LEAST_RHO_TAKING
        };
        !self.ended_late
            && !self.is_too_short(watch)
            && self.rho >= least
            && abs(self.residual) <= LARGEST_RESIDUAL
    }
}

/// a/b, 0 where b is 0.
fn quotient(a: Real, b: Real) -> Real {
    quotient_if(abs(b) > 0.0, a, b)
}
