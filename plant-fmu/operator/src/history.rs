//! What the hand felt: motion of the handle during the last reflex delay.

use fmu_export::Refusal;
use serde::{Deserialize, Serialize};

/// Position and velocity at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Instant (s).
    pub t: f64,
    /// Position (m).
    pub p: [f64; 3],
    /// Velocity (m/s).
    pub dp: [f64; 3],
}

/// Samples kept. With steps of 1 ms each of them is kept at every delay in [`DELAY_MAX`].
pub const CAPACITY: usize = 1024;
/// Longest reflex delay (s).
pub const DELAY_MAX: f64 = 1.0;

/// Samples kept for a delay (s).
fn kept(delay: f64) -> usize {
    if delay > 0.0 { CAPACITY } else { 1 }
}

/// A ring of samples that reaches back by the delay, whatever the steps: samples closer than `spacing` to their
/// predecessor give way to the next, so that the ring spans the delay and never runs over. Its memory is reserved when it
/// is built, none if the delay is 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct History {
    delay: f64,
    ring: Vec<Sample>,
    newest: usize,
    len: usize,
}

impl History {
    /// Everything until now was as in `first`.
    pub fn new(delay: f64, first: Sample) -> Self {
        Self {
            delay,
            ring: vec![first; kept(delay)],
            newest: 0,
            len: 1,
        }
    }

    /// Everything until now was as in `first`, again; in the memory that is there.
    pub fn restart(&mut self, first: Sample) {
        self.ring.fill(first);
        (self.newest, self.len) = (0, 1);
    }

    /// Refuses a history that came as bytes and is not one of this `delay` (s): its places must lie within its ring.
    ///
    /// # Errors
    /// A [`Refusal`] with the numbers and what was expected.
    pub fn check(&self, delay: f64) -> Result<(), Refusal> {
        let (kept, Self { newest, len, .. }) = (kept(delay), self);
        if self.delay == delay
            && self.ring.len() == kept
            && *newest < kept
            && (1..=kept).contains(len)
        {
            return Ok(());
        }
        Err(Refusal(format!(
            "what the hand felt: {len} of {} samples, the newest at place {newest}, over {:?} s, \
             expected 1 to {kept} of {kept} samples over delay = {delay:?} s",
            self.ring.len(),
            self.delay
        )))
    }

    /// The newest sample's `back`-th predecessor, for `back` < `len`.
    fn before(&self, back: usize) -> Sample {
        self.ring[(self.newest + self.ring.len() - back) % self.ring.len()]
    }

    /// Takes `sample`, which must be later than all others.
    pub fn take(&mut self, sample: Sample) {
        // Between the oldest and the second newest sample lie CAPACITY − 2 gaps: together at least the delay.
        let spacing = self.delay / (CAPACITY - 2) as f64;
        if self.ring.len() > 1 && (self.len == 1 || self.before(0).t - self.before(1).t >= spacing)
        {
            self.newest = (self.newest + 1) % self.ring.len();
            self.len = (self.len + 1).min(self.ring.len());
        }
        if let Some(newest) = self.ring.get_mut(self.newest) {
            *newest = sample;
        }
    }

    /// Motion one delay before the newest sample: on the line between the samples around it, which errs by
    /// ddp δ²/8 in position for samples δ apart. Before the first sample it was as in the first.
    pub fn felt(&self) -> Sample {
        let newest = self.before(0);
        let t = newest.t - self.delay;
        // Search back, by halves, for the latest sample that is not later than t.
        let (mut later, mut back) = (0, self.len - 1);
        if self.before(back).t >= t {
            return self.before(back);
        }
        while back - later > 1 {
            let middle = later + (back - later) / 2;
            if self.before(middle).t <= t {
                back = middle;
            } else {
                later = middle;
            }
        }
        let (a, b) = (self.before(back), self.before(later));
        let share = if b.t > a.t {
            (t - a.t) / (b.t - a.t)
        } else {
            0.0
        };
        let between = |a: [f64; 3], b: [f64; 3]| {
            core::array::from_fn(|i| a[i] + share.clamp(0.0, 1.0) * (b[i] - a[i]))
        };
        Sample {
            t,
            p: between(a.p, b.p),
            dp: between(a.dp, b.dp),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Position t² along x, t along y.
    fn at(t: f64) -> Sample {
        Sample {
            t,
            p: [t * t, t, 0.0],
            dp: [2.0 * t, 1.0, 0.0],
        }
    }

    #[test]
    fn the_past_is_found_at_any_step_size_and_delay() {
        for (delay, h) in [
            (0.2, 1e-3),
            (1.0, 1e-3),
            (1.0, 1e-5),
            (0.05, 7e-4),
            (0.3, 0.1),
            (1e-3, 0.05),
            (1e-9, 1e-3),
        ] {
            let mut history = History::new(delay, at(0.0));
            let mut worst: f64 = 0.0;
            for k in 1..=(2.5 / h) as u32 {
                let t = f64::from(k) * h;
                history.take(at(t));
                let felt = history.felt();
                let then = (t - delay).max(0.0);
                worst = worst.max((felt.p[0] - then * then).abs());
                assert!(
                    (felt.p[1] - then).abs() < 1e-12,
                    "{delay} {h} {t}: {felt:?}"
                );
            }
            // ddp δ²/8 = δ²/4, with samples a step apart, or at most a step more than the spacing.
            let apart = h.max(delay / 1022.0 + h);
            assert!(
                worst <= apart * apart / 4.0 + 1e-12,
                "{delay} {h}: {worst:e}"
            );
        }
    }

    #[test]
    fn without_delay_the_newest_sample_is_felt() {
        let mut history = History::new(0.0, at(0.0));
        for k in 1..5 {
            history.take(at(f64::from(k)));
            assert_eq!(history.felt(), at(f64::from(k)));
        }
        assert_eq!(history.ring.len(), 1);
    }
}
