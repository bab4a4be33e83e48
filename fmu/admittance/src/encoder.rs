//! Whether a sensed position can be, and what the law is told where it cannot.
//!
//! The law differentiates positions. One sample that is wrong by half a radian is a speed of 500 rad/s to it, and the
//! largest force that it may exert. Each check has a name:
//!
//! | fault | when |
//! |---|---|
//! | `not_finite` | a position is NaN or infinite; always on |
//! | `over_range` | a position lies beyond ±range, where the robot cannot be |
//! | `jump` | a position has moved by more than v_max T in a sample, and by more than a_max T² otherwise than in the one before |
//! | `stuck` | a position is bit for bit the same while its force has changed by the force that would move it |
//! | `invalid` | the encoder's own word |
//!
//! In the loop a jump or a position over range is doubted first: the law goes on at the last believed velocity. It lasts
//! `samples` samples until it is a fault. A single wrong sample so costs no force and causes none. Out of the loop a jump
//! moves nothing: it is named and taken over.
//!
//! A fault lasts until `samples` samples in a row have followed one another; `not_finite` and `invalid` last as long as
//! they are seen.

mod fault;

pub use fault::{FAULT, Fault, message};

use crate::real::{abs, min};
use crate::{Reach, Real};
use nalgebra::SVector;

/// What is checked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Checks<const N: usize> {
    /// Largest absolute position, m or rad.
    pub range: SVector<Real, N>,
    /// Change of a force, N or N·m, with which its position must change, too; 0 = any may stand still.
    pub stuck: SVector<Real, N>,
    /// Samples in a row after which a doubt is a fault, and a fault is over; 0 = jumps are believed.
    pub samples: u32,
}

impl<const N: usize> Checks<N> {
    /// Whether no position is watched for standing still.
    fn watches_nothing(&self) -> bool {
        self.stuck.iter().all(|stuck| *stuck <= 0.0)
    }
}

/// A reading of all encoders.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Positions<const N: usize> {
    /// Positions, m or rad.
    pub q: SVector<f64, N>,
    /// The encoders' own word.
    pub valid: bool,
    /// Sample periods since the reading before this one; 1: it is in time.
    pub after: Real,
}

impl<const N: usize> Positions<N> {
    /// What the law is told of them where nothing is wrong.
    #[inline]
    pub const fn believed(&self) -> Believed<N> {
        Believed {
            q: Some(self.q),
            doubted: false,
            fault: None,
        }
    }
}

/// What the law is told of a reading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Believed<const N: usize> {
    /// Where the robot is, m or rad; `None` where nobody knows.
    pub q: Option<SVector<f64, N>>,
    /// Whether `q` goes on from earlier readings, in place of this one.
    pub doubted: bool,
    /// What is wrong with the reading.
    pub fault: Option<Fault>,
}

/// The checks between two samples.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Encoders<const N: usize> {
    checks: Checks<N>,
    /// v_max T, m or rad, with the rounding that the reach allows for; infinite where jumps are believed
    step: SVector<Real, N>,
    /// the change of a step that no robot makes, m or rad: a_max T², and at most v_max T
    change: SVector<Real, N>,
    /// the last reading that was a number, where the law was told otherwise, m or rad
    read: Option<SVector<f64, N>>,
    /// the last position that the law was told
    told: Option<SVector<f64, N>>,
    /// where it was `ticks` sample periods before
    before: SVector<f64, N>,
    ticks: Real,
    /// doubtful readings in a row, or sound ones during a fault
    count: u32,
    fault: Option<Fault>,
    /// why the last reading was doubted
    doubt: Option<Fault>,
    /// the force when the position last changed, N or N·m
    moved_at: SVector<Real, N>,
    /// which position is stuck
    stuck: usize,
    /// whether nothing is wrong and no position may be stuck
    is_quiet: bool,
}

/// As many sample periods, or one where it was less: what a clock says of a part of one is not what a jump is judged by.
#[inline]
fn at_least_one(periods: Real) -> Real {
    if periods > 1.0 { periods } else { 1.0 }
}

impl<const N: usize> Encoders<N> {
    /// `checks` of a robot with this `reach` at a sample period of `T` (s); no reading so far.
    #[allow(non_snake_case, reason = "the paper's symbol")]
    pub fn new(checks: Checks<N>, reach: &Reach<N>, T: Real) -> Self {
        Self {
            checks,
            // Where jumps are believed no step is too long.
            step: if checks.samples > 0 {
                reach.steps(T)
            } else {
                SVector::repeat(Real::INFINITY)
            },
            change: reach
                .steps(T)
                .zip_map(&reach.a_max, |step, a_max| min(step, a_max * T * T)),
            read: None,
            told: None,
            before: SVector::zeros(),
            ticks: 1.0,
            count: 0,
            fault: None,
            doubt: None,
            moved_at: SVector::zeros(),
            stuck: 0,
            is_quiet: checks.watches_nothing(),
        }
    }

    /// Whether nothing is wrong with a reading, nor was with the one before: it is believed, and then [kept](Self::keep).
    /// What is not sound is [read](Self::read).
    #[inline]
    pub fn is_sound(&self, reading: &Positions<N>) -> bool {
        let Positions { q, valid, after } = reading;
        *valid
            && self.is_quiet
            && (0..N).all(|i| abs(q[i] as Real) <= self.checks.range[i]) // no NaN either
            && !self.jumps(self.told.as_ref(), q, *after)
    }

    /// Goes on from a reading that is sound.
    #[inline]
    pub fn keep(&mut self, reading: &Positions<N>) {
        (self.before, self.ticks) = (self.told.unwrap_or(reading.q), reading.after);
        self.told = Some(reading.q);
    }

    /// What to believe of a `reading`, with the law in the loop or not, while it exerts `force` (N or N·m).
    #[cold]
    pub fn read(
        &mut self,
        reading: &Positions<N>,
        in_loop: bool,
        force: &SVector<Real, N>,
    ) -> Believed<N> {
        let believed = self.judged(reading, in_loop, force);
        let is_sound = self.fault.is_none() && self.doubt.is_none();
        self.is_quiet = is_sound && self.checks.watches_nothing();
        believed
    }

    fn judged(
        &mut self,
        reading: &Positions<N>,
        in_loop: bool,
        force: &SVector<Real, N>,
    ) -> Believed<N> {
        let Positions { q, valid, after } = *reading;
        if !valid {
            return self.lost(Fault::Invalid);
        }
        if !q.iter().all(|q| q.is_finite()) {
            return self.lost(Fault::NotFinite);
        }
        let over = (0..N).any(|i| abs(q[i] as Real) > self.checks.range[i]);
        let stuck = self.is_stuck(&q, force);
        let found = if over {
            Some(Fault::OverRange)
        } else if stuck {
            Some(Fault::Stuck)
        } else {
            None
        };
        if let Some(fault) = self.fault.filter(|fault| fault.lasts()) {
            return self.recovering(fault, found, &q, after);
        }
        let jumped = self.jumps(self.told.as_ref(), &q, after);
        self.read = Some(q);
        match found.or(jumped.then_some(Fault::Jump)) {
            None => {
                self.follow(q, after);
                self.believed()
            }
            Some(Fault::Jump) if !in_loop => {
                self.start(q);
                Believed {
                    fault: Some(Fault::Jump),
                    ..self.believed()
                }
            }
            Some(fault) => self.doubt(fault, in_loop, after),
        }
    }

    /// The last reading that was a number.
    fn last(&self) -> Option<SVector<f64, N>> {
        self.read.or(self.told)
    }

    /// Nothing is known as long as this is seen.
    #[cold]
    fn lost(&mut self, fault: Fault) -> Believed<N> {
        (self.read, self.told, self.count) = (None, None, 0);
        self.failed(fault)
    }

    /// One more reading after a fault that lasts.
    #[cold]
    fn recovering(
        &mut self,
        fault: Fault,
        found: Option<Fault>,
        q: &SVector<f64, N>,
        after: Real,
    ) -> Believed<N> {
        let stuck = |read: SVector<f64, N>| (0..N).any(|i| i == self.stuck && read[i] == q[i]);
        let stands = fault == Fault::Stuck && self.last().is_some_and(stuck);
        let sound = found.is_none()
            && !stands
            && !self.last().is_some_and(|last| self.is_far(&last, q, after));
        self.count = if sound { self.count + 1 } else { 0 };
        self.read = Some(*q);
        if self.count >= self.checks.samples.max(1) {
            self.start(*q);
            self.believed()
        } else {
            self.failed(found.unwrap_or(fault))
        }
    }

    /// One more reading that cannot be.
    #[cold]
    fn doubt(&mut self, fault: Fault, in_loop: bool, after: Real) -> Believed<N> {
        self.count += 1;
        let lasting = fault == Fault::Stuck || !in_loop || self.count >= self.checks.samples;
        match self.told {
            Some(told) if !lasting => {
                let way = (told - self.before) * self.ahead(after);
                (self.before, self.ticks) = (told, after);
                (self.told, self.doubt) = (Some(told + way), Some(fault));
                Believed {
                    q: self.told,
                    doubted: true,
                    fault: self.doubt,
                }
            }
            _ => {
                (self.told, self.count) = (None, 0);
                self.failed(fault)
            }
        }
    }

    fn failed(&mut self, fault: Fault) -> Believed<N> {
        (self.fault, self.doubt) = (Some(fault), None);
        Believed {
            q: None,
            doubted: false,
            fault: self.fault,
        }
    }

    /// What the law is told of a position that is believed.
    fn believed(&self) -> Believed<N> {
        Believed {
            q: self.told,
            doubted: false,
            fault: None,
        }
    }

    /// Believes `q`, to which the robot has moved in this many sample periods.
    fn follow(&mut self, q: SVector<f64, N>, after: Real) {
        (self.before, self.ticks) = (self.told.unwrap_or(q), after);
        (self.told, self.read, self.count) = (Some(q), None, 0);
        (self.fault, self.doubt) = (None, None);
    }

    /// Believes `q`, of whose motion nothing is known.
    fn start(&mut self, q: SVector<f64, N>) {
        self.told = None;
        self.follow(q, 1.0);
    }

    /// Whether the robot can be at `q` within a sample of where the law was last told that it is.
    pub fn is_near(&self, q: &SVector<f64, N>) -> bool {
        let told = self.told.filter(|_| self.doubt.is_none());
        q.iter().all(|q| q.is_finite()) && told.is_some_and(|told| !self.is_far(&told, q, 1.0))
    }

    /// The last motion's part of the one in `after` sample periods, if it goes on alike.
    fn ahead(&self, after: Real) -> f64 {
        (after / at_least_one(self.ticks)) as f64
    }

    /// Whether the robot cannot have come from where it was told to be to `q` in this many sample periods: faster than it can, and
    /// not as it has moved.
    #[inline]
    fn jumps(&self, from: Option<&SVector<f64, N>>, q: &SVector<f64, N>, after: Real) -> bool {
        from.is_some_and(|from| self.is_far(from, q, after) && self.is_other(from, q, after))
    }

    /// Whether a position has moved faster than it can.
    #[inline]
    fn is_far(&self, from: &SVector<f64, N>, q: &SVector<f64, N>, after: Real) -> bool {
        let periods = at_least_one(after);
        let is_far = |i: usize| abs((q[i] - from[i]) as Real) > periods * self.step[i];
        (0..N).any(is_far)
    }

    /// Whether one that has moved faster than it can has moved otherwise than before.
    #[cold]
    fn is_other(&self, from: &SVector<f64, N>, q: &SVector<f64, N>, after: Real) -> bool {
        let periods = at_least_one(after);
        (0..N).any(|i| {
            let way = q[i] - from[i];
            let foretold = (from[i] - self.before[i]) * self.ahead(after);
            abs(way as Real) > periods * self.step[i]
                && abs((way - foretold) as Real) > periods * self.change[i]
        })
    }

    /// Whether a position stands still while its force changes.
    fn is_stuck(&mut self, q: &SVector<f64, N>, force: &SVector<Real, N>) -> bool {
        let last = self.last();
        let mut found = false;
        for i in 0..N {
            if self.checks.stuck[i] <= 0.0 {
                continue;
            }
            if last.is_none_or(|last| last[i] != q[i]) {
                self.moved_at[i] = force[i];
            } else if abs(force[i] - self.moved_at[i]) >= self.checks.stuck[i] {
                (found, self.stuck) = (true, i);
            }
        }
        found
    }
}
