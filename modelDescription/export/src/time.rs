//! Communication steps.

use crate::Refusal;

/// Share of the sample period within which a step's end and a tick count as the same instant: far above what step sizes
/// that are no whole numbers of periods by a rounding sum up to (1e-8 periods after 1e8 steps), far below what matters.
const SAME_INSTANT: f64 = 1e-3;

/// One communication step, in the importer's time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Start time of the experiment (s).
    pub start_time: f64,
    /// Beginning of the step (s).
    pub t: f64,
    /// Length of the step (s), finite and positive.
    pub h: f64,
    /// From the start of the experiment to the beginning of the step (s): the sum of the step sizes so far. It is what
    /// samples and ticks are counted in, because `t` rounds.
    pub elapsed: f64,
}

/// Most periods that one step may take: more would seem to hang (1e8 substeps take from seconds to minutes).
const MOST_PERIODS: f64 = 1e8;

impl Step {
    /// The step from `t` of `h` (s) of an experiment that starts at 0, with times that did not round.
    pub const fn at(t: f64, h: f64) -> Self {
        Self {
            start_time: 0.0,
            t,
            h,
            elapsed: t,
        }
    }

    /// How far from the step's end (s) an instant on a grid of `period` (s) still counts as that end: a thousandth of the
    /// period, or what the importer's time cannot tell apart, but less than the step. An importer may give as step size
    /// the difference of two times.
    pub fn same_instant(&self, period: f64) -> f64 {
        let resolution = f64::EPSILON * (self.t.abs() + self.h);
        let (part, half) = (SAME_INSTANT * period, 0.5 * self.h);
        let longer = if part > resolution { part } else { resolution }; // no NaN among them
        if longer < half { longer } else { half }
    }

    /// Refuses a step of more than 1e8 periods, where `period` (s) is what the model calls `name`: a sample period, a
    /// substep.
    ///
    /// # Errors
    /// A [`Refusal`] with the step size and the longest one.
    pub fn at_most(&self, name: &str, period: f64) -> Result<(), Refusal> {
        let longest = MOST_PERIODS * period;
        if self.h <= longest {
            return Ok(());
        }
        let h = self.h;
        Err(Refusal(format!(
            "communicationStepSize = {h:?} s, expected at most {longest:?} s (1e8 times {name})"
        )))
    }

    /// Splits the step into equal substeps no longer than `longest` (s): their number and their length (s). The last
    /// one ends exactly at `t + h`; no time is accumulated.
    ///
    /// A step of more than 2³² − 1 substeps gets longer ones. A model whose [`accepts`](crate::Model::accepts) calls
    /// [`at_most`](Self::at_most) never sees one.
    pub fn substeps(&self, longest: f64) -> (u32, f64) {
        // A step of 25.000000001 substeps is one of 25: the excess is the importer's rounding.
        let n = (self.h / longest - 1e-6)
            .ceil()
            .clamp(1.0, f64::from(u32::MAX));
        (n as u32, self.h / n)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn substeps_are_equal_and_end_at_the_end() {
        let step = |h| Step::at(0.1, h);
        assert_eq!(step(0.002).substeps(8e-5), (25, 0.002 / 25.0));
        assert_eq!(step(0.002_000_000_000_000_002).substeps(8e-5).0, 25);
        assert_eq!(step(1e-7).substeps(8e-5), (1, 1e-7));
    }
}
