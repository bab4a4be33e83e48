//! A hand that is too stiff: seen by the swing that grows, answered with damping that is given back.
//!
//! A hand that holds the handle like a spring k_h pulls the nominal as well as the robot. Where M_n is far below the robot's
//! own mass, the port (f_h ; dq) is not passive, and from some k_h on the loop swings up (arm, x axis, the paper's gains:
//! from 382 N/m). More damping on the nominal holds it: with D_n + D = 220 N·s/m instead of 20 up to 2762 N/m, and any
//! stiffness with enough of it, at the price of a handle that moves more slowly. So the damping comes only when it is needed.
//!
//! On each axis:
//! 1. q and f_h pass the same band pass: [`Band`].
//! 2. Each half swing of q is measured: how long, how strong, and how far f_h is in it the force of a spring, ρ and k_h
//!    of [`HalfSwing`].
//! 3. A half swing *grows* if it is spring-like and in the band, and f_h is stronger in it than in the one a period
//!    before by the factor `growth`. Four in a row, the last of them above `f_min`, are detected as a stiff hand; two
//!    while damping is still being given back.
//! 4. The damping D goes up to `D_max` within `attack`. When no spring-like half swing above `f_min` has come for `quiet`,
//!    it goes back to 0 within `release`.
//!
//! D is added to D_n in the midpoint. It takes (K/alpha) D v_m² T from the stored energy at each tick, so the energy argument
//! of the law holds for any course of D ≥ 0, right or wrong: a false alarm costs ease, not safety.
//!
//! What it does not see: a swing that neither grows nor shrinks (dry friction can keep one alive below the limit), one that
//! grows by less than `growth` in a period (from 382 to about 400 N/m), and one outside the band. What it may take for
//! a stiff hand: an operator who shakes the handle in the band, harder with each of three periods. While the hand stays
//! stiff, the damping is given back after `quiet` and comes again when the swing has grown to `f_min` anew.
//!
//! ```
//! use admittance::hand::{Detector, StiffHand, Watch};
//!
//! let watch = Watch::new(StiffHand { active: 1, ..StiffHand::default() }, 0.001)?;
//! let mut detector = Detector::default();
//! // A swing of 2 Hz that doubles in 0.5 s, at a hand of 600 N/m.
//! for k in 0..3000 {
//!     let t = 0.001 * f64::from(k);
//!     let q = 1e-4 * (1.4 * t).exp() * (12.566 * t).sin();
//!     detector = detector.sensed(q, -600.0 * q, &watch);
//! }
//! assert!(detector.detected() && detector.D() == 200.0);
//! assert!((detector.k_h() - 600.0).abs() < 1e-6); // both signals pass the same filter
//! # Ok::<(), admittance::ParameterError>(())
//! ```

mod band;
mod parameters;
mod swing;

pub use band::Band;
pub use parameters::{StiffHand, Watch};
pub use swing::{HalfSwing, Swing};

use crate::Real;
use crate::real::{max, min};

/// Half swings in a row that have to grow. An operator's own motion of constant amplitude grows while it sets in, for two
/// half swings and, behind the band pass, a third.
const HALF_SWINGS: u32 = 4;
/// The same while the damping is being given back: the hand that it came for is likely to be there still.
const HALF_SWINGS_AGAIN: u32 = 2;

/// The detector of one axis between two ticks. Its default has seen nothing yet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Detector {
    q: Band,
    f_h: Band,
    swing: Swing,
    /// Strength of f_h in the last half swing and in the one before, N; 0: not known.
    strength: [Real; 2],
    grown: u32,
    detected: bool,
    /// Time since the last half swing that counts, s.
    quiet: Real,
    D: Real,
    k_h: Real,
}

impl Detector {
    /// After a tick with position `q` (m) and human force `f_h` (N) along the axis. A sample that is not finite says
    /// nothing: the measurement begins anew with the next one, while a detection and its damping run on.
    #[must_use]
    pub fn sensed(self, q: Real, f_h: Real, watch: &Watch) -> Self {
        if watch.hand().active == 0 {
            return Self::default();
        }
        let seen = if q.is_finite() && f_h.is_finite() {
            let (q, x) = self.q.passed(q, watch);
            let (f_h, f) = self.f_h.passed(f_h, watch);
            let (swing, ended) = self.swing.sampled(x, f, watch);
            let next = Self {
                q,
                f_h,
                swing,
                ..self
            };
            ended.map_or(next, |half| next.judged(&half, watch))
        } else {
            Self {
                detected: self.detected,
                quiet: self.quiet,
                D: self.D,
                k_h: self.k_h,
                ..Self::default()
            }
        };
        seen.damped(watch)
    }

    /// After a half swing has ended.
    fn judged(self, half: &HalfSwing, watch: &Watch) -> Self {
        let hand = watch.hand();
        let [last, before] = self.strength;
        let counts = half.is_of_a_spring(watch);
        let strong = counts && half.strength >= hand.f_min;
        let grown = if counts && before > 0.0 && half.strength >= hand.growth * before {
            self.grown.saturating_add(1)
        } else {
            0
        };
        let needed = if self.D > 0.0 {
            HALF_SWINGS_AGAIN
        } else {
            HALF_SWINGS
        };
        let detected = self.detected || (strong && grown >= needed);
        Self {
            strength: if half.ended_late {
                [0.0; 2]
            } else {
                [half.strength, last]
            },
            grown,
            detected,
            quiet: if strong { 0.0 } else { self.quiet },
            k_h: if strong { half.k_h } else { self.k_h },
            ..self
        }
    }

    /// After the damping has moved on by one tick.
    fn damped(self, watch: &Watch) -> Self {
        let hand = watch.hand();
        let quiet = if self.detected {
            self.quiet + watch.T()
        } else {
            0.0
        };
        let detected = self.detected && quiet < hand.quiet;
        let D = if detected {
            min(self.D + hand.D_max * watch.T() / hand.attack, hand.D_max)
        } else {
            max(self.D - hand.D_max * watch.T() / hand.release, 0.0)
        };
        Self {
            detected,
            quiet,
            D,
            ..self
        }
    }

    /// Whether a stiff hand has been seen and has not been quiet since.
    pub fn detected(&self) -> bool {
        self.detected
    }

    /// Damping to be added to D_n at this tick, N·s/m, in [0, `D_max`].
    pub fn D(&self) -> Real {
        self.D
    }

    /// Stiffness of the hand in the last spring-like half swing above `f_min`, N/m; 0 before the first one.
    pub fn k_h(&self) -> Real {
        self.k_h
    }
}
