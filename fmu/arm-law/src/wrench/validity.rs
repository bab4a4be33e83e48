//! What a broken sensor shows, named.
//!
//! Each check is found at the onset or one sample later and is off at 0, but for the first:
//!
//! | fault | when |
//! |---|---|
//! | `not_finite` | a component is NaN or infinite; always on |
//! | `over_range` | a component has reached the end of the range, where the sensor clips |
//! | `rate` | a component has changed by rate·T or more in a sample: faster than a hand can push |
//! | `stuck` | all components are bit for bit what they were, `stuck_samples` times in a row |
//! | `dropout` | all components are exactly 0, `dropout_samples` times in a row, or the sensor itself says that it is invalid |
//!
//! Noise moves a sound sensor's last bits at every sample, which is what the last two checks rely on: choose 2, or more for
//! a coarse converter or a sensor that is slower than the controller. A sensor that computes without noise, such as a
//! simulated one, is *stuck* whenever nobody pushes.
//!
//! Where several apply the most telling one is named: not finite, the sensor's own word, over range, dropout, stuck, rate.
//! A fault lasts until the signal has been sound for `recovery_time`: a jump is seen at one sample only, and what comes
//! after it is not to be trusted at once. It bears the name of the last one found, but that a jump renames nothing: the way
//! back from a dropout is one.

use super::Wrench;
use admittance::{Real, real};
use fmu_declaration::{Rows, Start};

/// What is wrong with the sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(i32)]
pub enum Fault {
    /// A component is NaN or infinite.
    NotFinite = 1,
    /// A component has reached the end of the range.
    OverRange = 2,
    /// A component changes too fast.
    Rate = 3,
    /// The reading no longer changes.
    Stuck = 4,
    /// The reading is exactly 0, or the sensor says that it is invalid.
    Dropout = 5,
}

/// The checks. At the start all are off but for NaN and infinity.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct Checks {
    /// Absolute value at which a force component is over range; 0 = off.
    #[parameter(84, name = "ft.range_force", unit = NEWTON, range = NOT_NEGATIVE)]
    pub range_force: Real,
    /// Absolute value at which a moment component is over range; 0 = off.
    #[parameter(85, name = "ft.range_torque", unit = NEWTON_METRE, range = NOT_NEGATIVE)]
    pub range_torque: Real,
    /// Rate at which a force component is a fault; 0 = off.
    #[parameter(86, name = "ft.rate_force", unit = NEWTON_PER_SECOND, range = NOT_NEGATIVE)]
    pub rate_force: Real,
    /// Rate at which a moment component is a fault; 0 = off.
    #[parameter(87, name = "ft.rate_torque", unit = NEWTON_METRE_PER_SECOND, range = NOT_NEGATIVE)]
    pub rate_torque: Real,
    /// Repetitions of a reading, bit for bit, after which the sensor is stuck; 0 = off. For sensors with noise that are
    /// read at every tick.
    #[parameter(88, name = "ft.stuck_samples", integers = 0..)]
    pub stuck_samples: i32,
    /// Readings of exactly 0 on all axes after which the sensor has dropped out; 0 = off. For sensors with noise.
    #[parameter(89, name = "ft.dropout_samples", integers = 0..)]
    pub dropout_samples: i32,
    /// Time for which the signal must be sound before a fault is over.
    #[parameter(90, name = "ft.recovery_time", unit = SECOND, range = NOT_NEGATIVE, start = 0.1)]
    pub recovery_time: Real,
}

/// The checks between two samples.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Validity {
    checks: Checks,
    T: Real,
    /// what some checks remember
    past: Past,
    fault: Option<Fault>,
    /// for how long the signal has been sound since the fault, s
    sound: Real,
}

/// The samples so far, as the checks for steps and repetitions see them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Past {
    /// The last reading, if it was finite.
    last: Option<Wrench>,
    repetitions: u32,
    zeros: u32,
}

/// What is seen with a sample; by default nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Seen {
    /// none where no check looks back
    past: Option<Past>,
    fault: Option<Fault>,
    sound: Real,
}

impl Fault {
    /// All, by number.
    pub const ALL: [Self; 5] = [
        Self::NotFinite,
        Self::OverRange,
        Self::Rate,
        Self::Stuck,
        Self::Dropout,
    ];

    /// The number by which the interface knows it; 0 stands for none.
    pub fn number(self) -> i32 {
        self as i32
    }

    /// The name by which the interface knows it.
    pub fn name(self) -> &'static str {
        match self {
            Self::NotFinite => "not_finite",
            Self::OverRange => "over_range",
            Self::Rate => "rate",
            Self::Stuck => "stuck",
            Self::Dropout => "dropout",
        }
    }
}

impl Checks {
    /// Whether one of them is on, but for that on NaN and infinity.
    pub(super) fn any(&self) -> bool {
        self.look_back() || self.range_force > 0.0 || self.range_torque > 0.0
    }

    /// Whether one of them compares a sample with those before.
    fn look_back(&self) -> bool {
        self.rate_force > 0.0
            || self.rate_torque > 0.0
            || self.stuck_samples > 0
            || self.dropout_samples > 0
    }
}

impl Validity {
    /// `checks` at sample period `T` (s); no sample so far.
    pub fn new(checks: Checks, T: Real) -> Self {
        Self {
            checks,
            T,
            past: Past::default(),
            fault: None,
            sound: 0.0,
        }
    }

    /// Whether nothing is wrong, as of the last sample.
    #[inline]
    pub(super) fn is_sound(&self) -> bool {
        self.fault.is_none()
    }

    /// What is `seen` with the sample `raw`, and with it the fault, if there is one. `flag` is the sensor's own word: false =
    /// invalid.
    #[inline]
    pub(super) fn sampled(&self, raw: &Wrench, flag: bool, seen: &mut Seen) {
        let finite = real::are_finite([&raw.force, &raw.torque]);
        if self.checks.look_back() {
            seen.past = Some(self.past.with(raw, finite));
        }
        let found = if !finite {
            Some(Fault::NotFinite)
        } else if !flag {
            Some(Fault::Dropout)
        } else if reaches(raw, self.checks.range_force, self.checks.range_torque) {
            Some(Fault::OverRange)
        } else {
            let past = seen.past.as_ref();
            past.and_then(|now| self.found(raw, now))
        };
        (seen.fault, seen.sound) = match (found, self.fault) {
            (None, None) => (None, self.sound),
            (None, Some(fault)) => self.recovering(fault),
            (Some(Fault::Rate), Some(fault)) => (Some(fault), 0.0),
            (Some(found), _) => (Some(found), 0.0),
        };
    }

    /// Goes on from what was `seen` with a sample.
    #[inline]
    pub(super) fn keep(&mut self, seen: &Seen) {
        if let Some(past) = &seen.past {
            self.past = *past;
        }
        (self.fault, self.sound) = (seen.fault, seen.sound);
    }

    /// After one more sound sample since `fault`.
    fn recovering(&self, fault: Fault) -> (Option<Fault>, Real) {
        let sound = self.sound + self.T;
        // Half a sample: sums of T carry rounding.
        let recovered = sound > self.checks.recovery_time - 0.5 * self.T;
        ((!recovered).then_some(fault), sound)
    }

    /// What is wrong with the sample `raw`, compared with those before; with it they are `now`.
    fn found(&self, raw: &Wrench, now: &Past) -> Option<Fault> {
        let Checks {
            rate_force,
            rate_torque,
            stuck_samples,
            dropout_samples,
            ..
        } = self.checks;
        let change = self.past.last.map_or(Wrench::ZERO, |last| *raw - last);
        if reached(now.zeros, dropout_samples) {
            Some(Fault::Dropout)
        } else if reached(now.repetitions, stuck_samples) {
            Some(Fault::Stuck)
        } else if reaches(&change, rate_force * self.T, rate_torque * self.T) {
            Some(Fault::Rate)
        } else {
            None
        }
    }
}

impl Past {
    /// With one more sample.
    fn with(&self, raw: &Wrench, finite: bool) -> Self {
        Self {
            last: finite.then_some(*raw), // no rate across a gap
            repetitions: counted(self.repetitions, self.last == Some(*raw)),
            zeros: counted(self.zeros, *raw == Wrench::ZERO),
        }
    }
}

impl Seen {
    /// The fault, if there is one.
    pub fn fault(&self) -> Option<Fault> {
        self.fault
    }
}

/// One more if it happened `again`, else from 0.
fn counted(count: u32, again: bool) -> u32 {
    if again { count.saturating_add(1) } else { 0 }
}

/// Whether a component of `wrench` reaches its limit; a limit of 0 is none.
fn reaches(wrench: &Wrench, force: Real, torque: Real) -> bool {
    let beyond = |x: &Real, limit: Real| limit > 0.0 && real::abs(*x) >= limit;
    wrench.force.iter().any(|x| beyond(x, force)) || wrench.torque.iter().any(|x| beyond(x, torque))
}

/// Whether there are as many samples as are `needed`; 0 is none.
fn reached(count: u32, needed: i32) -> bool {
    u32::try_from(needed).is_ok_and(|needed| needed > 0 && count >= needed)
}
