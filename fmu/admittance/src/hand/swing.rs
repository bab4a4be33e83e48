//! Half swings, measured.

use super::{Impedance, Watch};
use crate::Real;
use crate::real::{abs, consts::PI, max, quotient_if, sqrt};

/// Least ρ of a hand that gives energy: f_h within 37° of opposing x. A reflex delay of 30 ms at 3 Hz turns it by 32°.
const LEAST_RHO_GIVING: Real = 0.8;
/// Least ρ of a hand that takes energy: within 60°. A damper of 80 N·s/m at 1000 N/m turns it by 52° at 2.6 Hz.
const LEAST_RHO_TAKING: Real = 0.5;
/// Largest share of f_h² that is not of a spring and a damper. Dry friction makes harmonics of 1 % in x, and 1 mm of noise
/// in x, in the band a tenth of a swing of 2 mm, 1 %.
const LARGEST_RESIDUAL: Real = 0.1;

/// A swing that goes on: the position x and the force f, both from the band pass, from zero crossing to zero crossing of x.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Swing {
    /// −1 or 1: the side; 0: not known yet.
    side: Real,
    /// The last sample.
    x: Real,
    f: Real,
    half: Sums,
    /// The half swing before; without samples where there is none.
    before: Sums,
}

/// Sums over samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Sums {
    n: Real,
    x: Real,
    f: Real,
    xx: Real,
    ff: Real,
    xf: Real,
    /// ∫ f dx, J.
    work: Real,
}

/// A half swing that has ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSwing {
    /// How long it was, s.
    pub duration: Real,
    /// Amplitude of f_h in the band, N: √(2 Σf²/n), that of a sine with this mean square.
    pub strength: Real,
    /// Whether no zero crossing has come for half a period of `f_low`: what follows has nothing to do with it.
    pub ended_late: bool,
    /// What f_h opposes x with, in this half swing and the one before it: in a whole period, over which a slower motion is a
    /// constant that the means take out. x̃ and f̃ are x and f less their means.
    ///
    /// Stiffness k = −Σx̃f̃/Σx̃² and damping b = −∫f dx/(ω² Σx̃² T), ω = π over the mean duration: of a sine, the
    /// regression of f on x and dx, which are orthogonal between zero crossings of x.
    pub hand: Impedance,
    /// ρ = −Σx̃f̃/√(Σx̃² Σf̃²): 1 for a spring, 0 for a damper or a mere push in step with the velocity, −1 for a mass less
    /// spring.
    pub rho: Real,
    /// Share of f̃² that this hand leaves: 1 − ρ² − (∫f dx/(ωT))²/(Σx̃² Σf̃²).
    pub residual: Real,
}

impl Swing {
    /// After a sample of x (m) and f (N), and the half swing that ended with it, if one did.
    #[must_use]
    pub fn sampled(self, x: Real, f: Real, watch: &Watch) -> (Self, Option<HalfSwing>) {
        let on = Self {
            x,
            f,
            half: self.half.with(x, f, 0.5 * (f + self.f) * (x - self.x)),
            ..self
        };
        let crossed = self.side * x < 0.0 || (self.side == 0.0 && x != 0.0);
        let late = on.half.n > watch.longest();
        if !crossed && !late {
            return (on, None);
        }
        let ended = on.measured(late, watch);
        let next = Self {
            side: match crossed {
                true if x > 0.0 => 1.0,
                true => -1.0,
                false => 0.0,
            },
            half: Sums::default(),
            before: if late || ended.is_too_short(watch) {
                Sums::default()
            } else {
                on.half
            },
            ..on
        };
        (next, Some(ended))
    }

    fn measured(&self, ended_late: bool, watch: &Watch) -> HalfSwing {
        let (half, T) = (&self.half, watch.T());
        let duration = half.n * T;
        let (halves, period) = if self.before.n > 0.0 {
            (2.0, half.and(&self.before).centred())
        } else {
            (1.0, *half)
        };
        let omega = halves * PI / (period.n * T);
        let both = sqrt(period.xx) * sqrt(period.ff);
        let rho = quotient(-period.xf, both);
        let of_velocity = quotient(period.work, omega * T * both);
        HalfSwing {
            duration,
            strength: sqrt(2.0 * half.ff / half.n),
            ended_late,
            hand: Impedance {
                k: quotient(-period.xf, period.xx),
                b: quotient(-period.work, omega * omega * T * period.xx),
                omega,
            },
            rho,
            residual: 1.0 - rho * rho - of_velocity * of_velocity,
        }
    }
}

impl Sums {
    /// With one more sample, and the `work` (J) since the one before it.
    fn with(&self, x: Real, f: Real, work: Real) -> Self {
        self.and(&Self {
            n: 1.0,
            x,
            f,
            xx: x * x,
            ff: f * f,
            xf: x * f,
            work,
        })
    }

    fn and(&self, other: &Self) -> Self {
        Self {
            n: self.n + other.n,
            x: self.x + other.x,
            f: self.f + other.f,
            xx: self.xx + other.xx,
            ff: self.ff + other.ff,
            xf: self.xf + other.xf,
            work: self.work + other.work,
        }
    }

    /// Of x and f less their means.
    fn centred(&self) -> Self {
        let (x, f) = (self.x / self.n, self.f / self.n);
        Self {
            x: 0.0,
            f: 0.0,
            xx: max(self.xx - x * self.x, 0.0),
            ff: max(self.ff - f * self.f, 0.0),
            xf: self.xf - x * self.f,
            ..*self
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
