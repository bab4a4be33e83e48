//! The time of an instance: where the importer says it is, and the sum of the steps that it made.

use crate::Refusal;
use crate::time::Step;
use fmu_declaration::Brief;
use serde::{Deserialize, Serialize};

/// A communication point may differ from the expected one by this share of the step: importers carry `i·h`, a running
/// sum, or whole nanoseconds.
const SAME_POINT: f64 = 1e-3;

/// And by as many times 2⁻⁵² of the time: an importer that rounds each time is off by one or two of them.
const ROUNDINGS: f64 = 4.0;

/// How far, in step sizes, one step may lead the importer's time away from the sum of the steps: a step that moves the
/// time at all is at least a quarter of 2⁻⁵² of it, so that [`ROUNDINGS`] are at most 16 of its sizes; the rest is the
/// time's own rounding and [`SAME_POINT`].
const DRIFT: f64 = 20.0;

/// The clock of an instance.
///
/// An importer's time rounds: 2⁻²² s at 1.7e9 s. An importer that sums it drifts by up to half of that in each step, one
/// that multiplies does not; neither says when a sample is due. So each step is compared with the importer's last one
/// alone, and what the model counts in is the sum of the step sizes, without rounding. A plant moves by the step sizes
/// too.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Clock {
    start_time: f64,
    time: f64,
    elapsed: Sum,
}

impl Clock {
    /// A clock at the start of the experiment (s).
    pub fn at_start(start_time: f64) -> Self {
        Self {
            start_time,
            time: start_time,
            elapsed: Sum::default(),
        }
    }

    /// Start time of the experiment (s).
    pub fn start_time(&self) -> f64 {
        self.start_time
    }

    /// End of the last step in the importer's time (s).
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Sum of the step sizes (s).
    pub fn elapsed(&self) -> f64 {
        self.elapsed.high
    }

    /// The step from `t` of `h` (s), if it can follow.
    ///
    /// # Errors
    /// A sentence with the name of the argument, its value and what was expected.
    pub fn step(&self, t: f64, h: f64) -> Result<Step, String> {
        self.next(t, h).map_err(|why| self.sentence(why, t, h))
    }

    /// The same, without words.
    #[inline]
    pub(crate) fn next(&self, t: f64, h: f64) -> Result<Step, NotNext> {
        if !(h.is_normal() && h > 0.0) {
            return Err(NotNext::Size);
        }
        let tolerance = SAME_POINT * h + ROUNDINGS * f64::EPSILON * self.time.abs();
        if !(t.is_finite() && (t - self.time).abs() <= tolerance) {
            return Err(NotNext::Point);
        }
        if t + h <= t || !(t + h).is_finite() || !(self.elapsed() + h).is_finite() {
            return Err(NotNext::End);
        }
        Ok(Step {
            start_time: self.start_time,
            t,
            h,
            elapsed: self.elapsed(),
        })
    }

    /// What is wrong with a step, in the words of fmi2DoStep and fmi3DoStep.
    #[cold]
    pub(crate) fn sentence(&self, why: NotNext, t: f64, h: f64) -> String {
        match why {
            NotNext::Size => {
                format!("communicationStepSize = {h:?} s, expected a finite normal number above 0")
            }
            NotNext::Point => {
                let (expected, t) = (Brief(self.time), Brief(t));
                format!("expected currentCommunicationPoint {expected} s, got {t} s")
            }
            NotNext::End => {
                let (h, t) = (Brief(h), Brief(t));
                format!(
                    "communicationStepSize = {h} s does not advance the time {t} s to a later finite time"
                )
            }
        }
    }

    /// Counts a step that was made.
    pub fn advance(&mut self, step: &Step) {
        self.time = step.t + step.h;
        self.elapsed.add(step.h);
    }

    /// Refuses times that no sequence of steps leads to; of an instance that made no step yet if not `stepped`.
    ///
    /// # Errors
    /// A sentence with their values and what was expected.
    pub(crate) fn check(&self, stepped: bool) -> Result<(), String> {
        let Self {
            start_time,
            time,
            elapsed: Sum { high, low },
        } = *self;
        for (name, value) in [("start_time", start_time), ("time", time)] {
            if !value.is_finite() {
                return Err(format!("{name} = {value:?} s, expected a finite time"));
            }
        }
        if !(high.is_finite() && high >= 0.0 && low.abs() <= f64::EPSILON * high) {
            return Err(format!(
                "elapsed = {high:?} s and {low:?} s, expected a finite time not less than 0 and its rounding"
            ));
        }
        if !stepped && high > 0.0 {
            return Err(format!(
                "elapsed = {high:?} s, expected 0 s before the first step"
            ));
        }
        let rounding = 2.0 * ROUNDINGS * f64::EPSILON * start_time.abs().max(time.abs());
        if (start_time + high - time).abs() > DRIFT * high + if high > 0.0 { rounding } else { 0.0 }
        {
            return Err(format!(
                "start_time = {start_time:?} s and time = {time:?} s, expected {high:?} s of steps between them"
            ));
        }
        Ok(())
    }

    /// Refuses a `count` of periods of `period` (s) since the start that the clock did not make: it would run up to where
    /// the clock is in one step, or never again.
    ///
    /// # Errors
    /// A [`Refusal`] with `name`, the count and what was expected.
    pub fn counted(&self, name: &str, count: u64, period: f64) -> Result<(), Refusal> {
        let expected = self.elapsed() / period;
        // One before or behind, and what times and counts round.
        let slack = 2.0 + 2.0 * f64::EPSILON * (self.time.abs() / period + expected);
        if (count as f64 - expected).abs() <= slack {
            return Ok(());
        }
        let (elapsed, expected) = (self.elapsed(), Brief(expected.round()));
        Err(Refusal(format!(
            "{name} = {count}, expected {expected} periods of {period:?} s in the {elapsed:?} s since the start"
        )))
    }
}

/// Why a step cannot follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NotNext {
    /// Its size is none.
    Size,
    /// It begins elsewhere.
    Point,
    /// It ends nowhere later.
    End,
}

/// Compensated sum: `low` is what rounding took from `high`, so that a hundred million steps are off by less than one
/// rounding of their sum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Sum {
    high: f64,
    low: f64,
}

impl Sum {
    /// Adds `term`.
    fn add(&mut self, term: f64) {
        let (sum, lost) = two_sum(self.high, term);
        (self.high, self.low) = two_sum(sum, self.low + lost);
    }
}

/// a + b, rounded, and what the rounding took (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let seen = sum - a;
    (sum, (a - (sum - seen)) + (b - seen))
}

#[cfg(test)]
#[path = "clock/tests.rs"]
mod tests;
