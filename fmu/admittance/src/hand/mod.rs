//! A hand that is too stiff: seen by its swing, probed, and answered with damping that is given back.
//!
//! A hand that holds the handle like a spring k_h pulls the nominal as well as the robot. Where M_n is far below the robot's
//! own mass, the port (f_h ; dq) is not passive, and from some k_h on the loop swings up (arm, x axis, the paper's gains:
//! from 382 N/m). More damping on the nominal holds it: with D_n + D = 220 N·s/m instead of 20 up to 2762 N/m, and any
//! stiffness with enough of it, at the price of a handle that moves more slowly. So the damping comes only when it is needed.
//!
//! What tells such a swing from a shake that an operator means? Not the energy: a spring gives none over whole periods and a
//! damper takes some, so what feeds the swing is the robot. And no measurement of one steady swing: a force F sin ωt that is
//! meant moves the robot by F/Z(jω), so it has the same fixed ratio to x that a spring and a damper have, at 2 Hz on the arm
//! 750 N/m and 23 N·s/m. But then the ratio is the *robot's*. When the robot changes, it changes, and that of a hand
//! stays. So a suspicion is probed: a little damping on the nominal, and a second look.
//!
//! On each axis:
//! 1. q and f_h pass the same band pass: [`Band`].
//! 2. Each half swing of q is measured: how long, how strong, and which spring and damper f_h would be in it: [`HalfSwing`].
//! 3. Half swings in a row that are of one hand make a [`Run`]. A run is suspected when f_h has grown by `growth` a period in
//!    four half swings, or when it has lasted for `periods` without shrinking; the last one is above `f_min`.
//! 4. Suspected, it is probed with the damping D = `probe`·|k + jωb|/ω for four half swings: [`Probe`]. The same spring and
//!    damper after it, or a swing that ends together with its force: a hand. Anything else is meant: D goes back within
//!    `attack`, and nothing is probed for `pause`, or until the swing has ended or f_h has doubled.
//! 5. A hand is damped with D up to `D_max`, within `attack`; what has ended with no answer, with D of the probe. When no
//!    half swing of it above `f_min` has come for `quiet`, D goes back to 0 within `release`.
//! 6. There is no time to wait for a swing that doubles in a period, and no need to for a hand that was found before and is
//!    back: these are probed with `D_max`.
//!
//! D is added to D_n in the midpoint. It takes (K/alpha) D v_m² T from the stored energy at each tick, so the energy argument
//! of the law holds for any course of D ≥ 0, right or wrong: a false alarm costs ease, not safety.
//!
//! What it costs an operator who shakes the handle evenly in the band for three periods: a probe of two periods, by which
//! the shake becomes about a quarter smaller, every `pause`. What it does not see: a swing outside the band, one that
//! friction keeps below `f_min`, and a hand that changes with the swing. Whoever lets go while being probed passes for a
//! hand, for `quiet`. While a hand stays stiff, the damping is given back after `quiet` and comes again when the swing has
//! grown to `f_min` anew.
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
mod impedance;
mod parameters;
mod probe;
mod run;
mod swing;

pub use band::Band;
pub use impedance::Impedance;
pub use parameters::{StiffHand, Watch};
pub use probe::{Answer, Probe};
pub use run::Run;
pub use swing::{HalfSwing, Swing};

use crate::Real;
use crate::real::{max, min};

/// Half swings in a row that have to grow. An operator's own motion of constant amplitude grows while it sets in, for two
/// half swings and, behind the band pass, a third.
const HALF_SWINGS: u32 = 4;
/// Half swings in a row that must be of one hand, to have a reference for the probe.
const HALF_SWINGS_OF_ONE_HAND: u32 = 3;
/// Half swings in a row that must not shrink with a hand that has been found before: it is likely to be there still.
const HALF_SWINGS_AGAIN: u32 = 2;
/// How far apart, over its magnitude, a hand may be from one that has been found, to be the same.
const THE_SAME: Real = 0.3;
/// Growth of f_h beyond what it was when it was found to be meant, from which on it is looked at again.
const DOUBLED: Real = 2.0;

/// What is made of the swing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum Finding {
    /// Nothing yet.
    #[default]
    None,
    /// It is probed; `at_once`: with all the damping that there is, since it grows too fast to wait.
    Probed { probe: Probe, at_once: bool },
    /// A stiff hand, this one, damped since and not quiet.
    Hand(Impedance),
    /// An operator who means it: left alone `since` so long (s), unless f_h grows from the amplitude `strength` (N).
    Meant { since: Real, strength: Real },
}

/// The detector of one axis between two ticks. Its default has seen nothing yet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Detector {
    q: Band,
    f_h: Band,
    swing: Swing,
    run: Run,
    finding: Finding,
    /// The last stiff hand that was found; magnitude 0: none.
    known: Impedance,
    /// Time since the last half swing that counts, s.
    quiet: Real,
    /// Damping that the finding asks for, N·s/m.
    wanted: Real,
    D: Real,
    k_h: Real,
}

impl Detector {
    /// After a tick with position `q` (m) and human force `f_h` (N) along the axis. A sample that is not finite says
    /// nothing: the measurement begins anew with the next one, while what was found and its damping run on.
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
                q: Band::default(),
                f_h: Band::default(),
                swing: Swing::default(),
                run: Run::default(),
                ..self
            }
        };
        seen.damped(watch)
    }

    /// After a half swing has ended.
    fn judged(self, half: &HalfSwing, watch: &Watch) -> Self {
        let run = self.run.after(half, watch);
        let strong = half.is_of_a_hand(watch) && half.strength >= watch.hand().f_min;
        let next = Self {
            run,
            k_h: if strong { half.hand.k } else { self.k_h },
            ..self
        };
        match next.finding {
            Finding::None if strong => next.suspected(half, watch),
            Finding::None => next,
            Finding::Probed { probe, at_once } => match probe.after(half, watch) {
                Answer::Open(probe) => Self {
                    finding: Finding::Probed { probe, at_once },
                    ..next
                },
                Answer::Ended => next.found(next.wanted, probe.reference()),
                Answer::Hand => next.found(watch.hand().D_max, probe.reference()),
                Answer::Meant => Self {
                    finding: Finding::Meant {
                        since: 0.0,
                        strength: half.strength,
                    },
                    known: Impedance::default(),
                    wanted: 0.0,
                    quiet: 0.0,
                    ..next
                },
            },
            Finding::Hand(hand) => Self {
                quiet: if strong && half.hand.apart(&hand) <= THE_SAME {
                    0.0
                } else {
                    self.quiet
                },
                ..next
            },
            // A swing that goes on to grow may have been covered by what is meant.
            Finding::Meant { strength, .. } if strong && half.strength >= DOUBLED * strength => {
                next.suspected(half, watch)
            }
            Finding::Meant { .. } => Self {
                quiet: if strong { 0.0 } else { self.quiet },
                ..next
            },
        }
    }

    /// After a half swing above `f_min` that nothing is made of yet.
    fn suspected(self, half: &HalfSwing, watch: &Watch) -> Self {
        let (run, hand) = (&self.run, watch.hand());
        let returned =
            run.hand().apart(&self.known) <= THE_SAME && run.rising() >= HALF_SWINGS_AGAIN;
        let at_once = returned || run.grown_fast() >= HALF_SWINGS;
        let grows = run.grown() >= HALF_SWINGS && run.same() >= HALF_SWINGS_OF_ONE_HAND;
        let lasts = run.lasting() >= hand.periods.unsigned_abs().saturating_mul(2);
        if !at_once && !grows && !lasts {
            return self;
        }
        let reference = run.hand();
        let probing = hand.probe * reference.magnitude() / reference.omega;
        Self {
            finding: Finding::Probed {
                probe: Probe::of(*reference, half.strength),
                at_once,
            },
            wanted: if at_once {
                hand.D_max
            } else {
                min(probing, hand.D_max)
            },
            ..self
        }
    }

    /// A stiff `hand` has been found and is answered with the damping `wanted` (N·s/m).
    fn found(self, wanted: Real, hand: &Impedance) -> Self {
        Self {
            finding: Finding::Hand(*hand),
            known: *hand,
            quiet: 0.0,
            wanted,
            ..self
        }
    }

    /// After time and damping have moved on by one tick.
    fn damped(self, watch: &Watch) -> Self {
        let (hand, T) = (watch.hand(), watch.T());
        let quiet = self.quiet + T;
        let (finding, quiet) = match self.finding {
            Finding::Hand(_) if quiet >= hand.quiet => (Finding::None, 0.0),
            Finding::Meant { since, .. } if quiet >= hand.quiet || since >= hand.pause => {
                (Finding::None, 0.0)
            }
            Finding::Meant { since, strength } => {
                let since = since + T;
                (Finding::Meant { since, strength }, quiet)
            }
            finding @ Finding::Hand(_) => (finding, quiet),
            finding => (finding, 0.0),
        };
        // A probe that was answered is taken back as soon as it came, a hand's damping slowly.
        let wanted = if finding == Finding::None {
            0.0
        } else {
            self.wanted
        };
        let down = match finding {
            Finding::Meant { .. } => hand.attack,
            _ => hand.release,
        };
        let D = if self.D <= wanted {
            min(self.D + hand.D_max * T / hand.attack, wanted)
        } else {
            max(self.D - hand.D_max * T / down, wanted)
        };
        Self {
            // What comes after a pause is measured anew.
            run: if finding == Finding::None && matches!(self.finding, Finding::Meant { .. }) {
                Run::default()
            } else {
                self.run
            },
            finding,
            quiet,
            wanted,
            D,
            ..self
        }
    }

    /// Whether a stiff hand has been found, or makes a swing grow so fast that it is damped before that, and has not been
    /// quiet since.
    pub fn detected(&self) -> bool {
        matches!(
            self.finding,
            Finding::Hand(_) | Finding::Probed { at_once: true, .. }
        )
    }

    /// Damping to be added to D_n at this tick, N·s/m, in [0, `D_max`].
    pub fn D(&self) -> Real {
        self.D
    }

    /// Stiffness of the hand in the last half swing above `f_min` that is one of a hand, N/m; 0 before the first one.
    pub fn k_h(&self) -> Real {
        self.k_h
    }
}
