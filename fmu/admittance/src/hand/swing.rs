//! Half swings, measured.

use super::Watch;
use crate::Real;
use crate::real::{abs, quotient_if, sqrt};

/// Least ρ of a spring-like half swing: f_h within 37° of opposing x. A reflex delay of 30 ms at 3 Hz turns it by 32°.
const LEAST_RHO: Real = 0.8;

/// A half swing that goes on: the position x and the force f, both from the band pass, from zero crossing to zero crossing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Swing {
    /// −1 or 1: the side; 0: not known yet.
    side: Real,
    samples: Real,
    xx: Real,
    ff: Real,
    xf: Real,
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
    /// k_h = −Σxf/Σx², N/m.
    pub k_h: Real,
    /// Whether no zero crossing has come for half a period of `f_low`: what follows has nothing to do with it.
    pub ended_late: bool,
}

impl Swing {
    /// After a sample of x (m) and f (N), and the half swing that ended with it, if one did.
    #[must_use]
    pub fn sampled(self, x: Real, f: Real, watch: &Watch) -> (Self, Option<HalfSwing>) {
        let on = Self {
            samples: self.samples + 1.0,
            xx: self.xx + x * x,
            ff: self.ff + f * f,
            xf: self.xf + x * f,
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
            ..Self::default()
        };
        (next, Some(on.measured(late, watch)))
    }

    fn measured(&self, ended_late: bool, watch: &Watch) -> HalfSwing {
        HalfSwing {
            duration: self.samples * watch.T(),
            strength: sqrt(2.0 * self.ff / self.samples),
            rho: quotient(-self.xf, sqrt(self.xx) * sqrt(self.ff)),
            k_h: quotient(-self.xf, self.xx),
            ended_late,
        }
    }
}

impl HalfSwing {
    /// Whether it lies in the band and f_h opposes x in it as a spring does.
    pub fn is_of_a_spring(&self, watch: &Watch) -> bool {
        !self.ended_late && self.duration >= watch.shortest() && self.rho >= LEAST_RHO
    }
}

/// a/b, 0 where b is 0.
fn quotient(a: Real, b: Real) -> Real {
    quotient_if(abs(b) > 0.0, a, b)
}
