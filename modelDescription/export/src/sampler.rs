//! The samples of a model that reads its inputs at communication points.

use crate::time::Step;
use crate::{Clock, Log, Refusal};
use fmu_declaration::Brief;
use serde::{Deserialize, Serialize};

/// Steps in a period from which on the period is the one that was asked for, whatever the step size: what it is off by is
/// then less than a twentieth.
const MANY: f64 = 20.0;

/// Share of the period by which two communication points may differ from a period and still count as one.
const ONE_PERIOD: f64 = 2e-3;

/// The clock of a sampled controller.
///
/// Its inputs are read where the importer sets them: at communication points. So a sample begins at one, and its period
/// is a whole number of steps: of those the one nearest to the period that was asked for, as the first step's size has it.
/// A step size that divides the period leaves it as it is; a longer step becomes the period. Where step sizes change later,
/// samples begin with the first step in which one is due, at most one a step, and [`Sample::after`] says when.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sampler {
    /// s
    period: f64,
    /// share of the period by which what a sample says reaches the others later if all exchange at once
    exchange: f64,
    /// number of the next sample
    next: u64,
    /// when the last one began, s since the start
    last: Option<f64>,
}

/// A sample that begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Its number: it was due at that many periods after the start.
    pub number: u64,
    /// Periods since the one before began; 1: in time.
    pub after: f64,
}

impl Sampler {
    /// That of an experiment whose first step is `step`, with the period `T` (s) asked for.
    #[allow(non_snake_case, reason = "the sample period of the standard texts")]
    pub fn new(step: &Step, T: f64) -> Self {
        let steps = (T / step.h).round().max(1.0);
        let nearest = steps * step.h;
        let rounding = 2.0 * steps * f64::EPSILON * (step.t.abs() + step.h);
        let whole = (nearest / T).round().max(1.0) * T;
        let period = if steps > MANY {
            T
        } else if (nearest - whole).abs() <= 1e-6 * T + rounding {
            whole // times that round to a microsecond are no other period
        } else {
            nearest
        };
        Self {
            period,
            exchange: (step.h / period).min(1.0),
            next: 0,
            last: None,
        }
    }

    /// The period that the samples have, s.
    pub fn period(&self) -> f64 {
        self.period
    }

    /// The share of the period, in (0, 1], that the first step was: so much later a sample's outputs reach the others where all
    /// exchange at once.
    pub fn exchange(&self) -> f64 {
        if self.exchange > 1.0 - ONE_PERIOD {
            1.0
        } else {
            self.exchange
        }
    }

    /// The same for a model that is made for one period: where it is not `T` (s), `anew` makes it for the one that it is, and
    /// the log is told.
    ///
    /// # Errors
    /// What the model has against its period.
    #[cold]
    #[allow(non_snake_case, reason = "the sample period of the standard texts")]
    pub fn first<E: core::fmt::Display>(
        step: &Step,
        T: f64,
        log: &mut Log<'_>,
        anew: impl FnOnce(f64) -> Result<(), E>,
    ) -> Result<Self, Refusal> {
        let sampler = Self::new(step, T);
        let period = sampler.period;
        if period != T {
            anew(period).map_err(|error| {
                Refusal(format!(
                    "the communication steps do not make up T = {T:?} s, and with a sample period of {period:?} s: {error}"
                ))
            })?;
            log.warning(format_args!(
                "sample_period = {period:?} s: the communication steps do not make up T = {T:?} s; the law is sampled with them"
            ));
        }
        Ok(sampler)
    }

    /// The sample that begins with `step`, if one is due in it; it counts as taken once this returns.
    pub fn sample(&mut self, step: &Step) -> Option<Sample> {
        let same_instant = step.same_instant(self.period);
        let end = (step.elapsed + step.h - same_instant) / self.period;
        if end <= self.next as f64 {
            return None;
        }
        // Those that were due in earlier steps are left out.
        let newest = ((step.elapsed + same_instant) / self.period) as u64;
        let number = self.next.max(newest);
        self.next = number.saturating_add(1);
        let passed = self
            .last
            .map_or(1.0, |last| (step.elapsed - last) / self.period);
        self.last = Some(step.elapsed);
        let same = ONE_PERIOD + 4.0 * f64::EPSILON * (step.t.abs() + step.h) / self.period;
        Some(Sample {
            number,
            after: if (passed - 1.0).abs() <= same {
                1.0
            } else {
                passed
            },
        })
    }

    /// Refuses a sampler that does not belong to the time of `clock`.
    ///
    /// # Errors
    /// A [`Refusal`] with the value and what was expected.
    pub fn check(&self, clock: &Clock) -> Result<(), Refusal> {
        let Self {
            period,
            exchange,
            next,
            last,
        } = *self;
        if !(period.is_normal() && period > 0.0) {
            return Err(Refusal(format!(
                "sample period = {period:?} s, expected a number above 0"
            )));
        }
        if !(exchange > 0.0 && exchange <= 1.0) {
            return Err(Refusal(format!(
                "share of a step in the period = {exchange:?}, expected 0 to 1"
            )));
        }
        let elapsed = clock.elapsed();
        let Some(last) = last else {
            return clock.counted("number of ticks", next, period);
        };
        if !(0.0..=elapsed).contains(&last) {
            return Err(Refusal(format!(
                "beginning of the last sample = {last:?} s, expected a time in the {elapsed:?} s since the start"
            )));
        }
        let expected = last / period + 1.0;
        if (next as f64 - expected).abs() > 2.0 + f64::EPSILON * expected {
            let expected = Brief(expected.round());
            return Err(Refusal(format!(
                "number of ticks = {next}, expected {expected} periods of {period:?} s"
            )));
        }
        Ok(())
    }
}
