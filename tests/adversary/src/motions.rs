//! How the robot moves: whatever hurts, within the reach.

use crate::case::{Case, MOTIONS, Motion};
use crate::random::Random;
use crate::subject::{Order, Subject};
use nalgebra::SVector;

/// One of the weights' places, by their size.
pub fn weighted(weights: &[f64], random: &mut Random) -> usize {
    let mut left = random.unit() * weights.iter().sum::<f64>();
    for (i, weight) in weights.iter().enumerate() {
        left -= weight;
        if left < 0.0 {
            return i;
        }
    }
    0
}

/// The mover's state.
#[derive(Clone, Debug)]
pub struct Motions<const N: usize> {
    kind: Motion,
    left: u32,
    last: Option<SVector<f64, N>>,
    side: f64,
    v: SVector<f64, N>,
    origin: Option<SVector<f64, N>>,
}

impl<const N: usize> Motions<N> {
    /// At rest.
    pub fn new(_case: &Case<N>) -> Self {
        Self {
            kind: Motion::Random,
            left: 0,
            last: None,
            side: 1.0,
            v: SVector::zeros(),
            origin: None,
        }
    }

    /// The motion of the sample that begins, within the reach.
    #[allow(clippy::too_many_arguments, reason = "an adversary knows everything")]
    pub fn next<S: Subject<N>>(
        &mut self,
        law: &S,
        q: &SVector<f64, N>,
        acting: &SVector<f64, N>,
        f_h: &SVector<f64, N>,
        order: &Order<N>,
        case: &Case<N>,
        random: &mut Random,
        first: bool,
    ) -> SVector<f64, N> {
        if self.left == 0 {
            self.kind = MOTIONS[weighted(&case.motions, random)];
            self.left = 1 + (random.unit() * 2.0 * case.phase) as u32;
        }
        self.left -= 1;
        self.side = -self.side;
        let last = if first { None } else { self.last };
        let range = Range::of(case, q, last.as_ref());
        let origin = *self.origin.get_or_insert(*q);
        let step = match self.kind {
            Motion::Random => range.pick(|_| random.unit()),
            Motion::Pull => range.toward(acting),
            Motion::Greedy => self.best(law, q, f_h, order, &range, case, random, 1, 1.0),
            Motion::TwoSteps => self.best(law, q, f_h, order, &range, case, random, 2, 1.0),
            Motion::StretchThenPull => {
                if self.left % 8 < 2 {
                    range.toward(acting)
                } else {
                    self.best(law, q, f_h, order, &range, case, random, 1, -1.0)
                }
            }
            Motion::Alternate => range.pick(|i| {
                let flip = if i % 2 == 0 { self.side } else { -self.side };
                f64::from(u8::from(flip > 0.0))
            }),
            Motion::StickThenJump => {
                if self.left % 7 == 0 {
                    range.pick(|_| f64::from(u8::from(random.chance(0.5))))
                } else {
                    range.kept(&SVector::zeros())
                }
            }
            Motion::Plant => {
                let [_, k, M] = case.plant;
                let T = case.setup.settings.T;
                let wall = (q - origin).map(|x| -k * x.max(0.0));
                let friction = self.v.map(|v| -0.1 * case.force * v.signum());
                self.v += (acting + f_h + wall + friction) * (T / M);
                range.kept(&(self.v * T))
            }
        };
        let step = if case.quantum > 0.0 {
            range.quantised(&step, case)
        } else {
            step
        };
        self.v = step / case.setup.settings.T;
        self.last = Some(step);
        step
    }

    /// The corner of the reach, or the standstill, after which `sign`·(created, or stored) is most after `depth` samples.
    #[allow(clippy::too_many_arguments, reason = "an adversary knows everything")]
    fn best<S: Subject<N>>(
        &self,
        law: &S,
        q: &SVector<f64, N>,
        f_h: &SVector<f64, N>,
        order: &Order<N>,
        range: &Range<N>,
        case: &Case<N>,
        random: &mut Random,
        depth: u32,
        sign: f64,
    ) -> SVector<f64, N> {
        let mut best = (f64::NEG_INFINITY, SVector::zeros());
        for step in range.corners() {
            let mut trial = law.clone();
            let next = q + step;
            let seen = trial.tick(&next, f_h, order);
            // Created so far, and what the stored energy is worth: all of it when stretching, nothing when pulling.
            let mut value = if sign > 0.0 { seen.G } else { seen.H };
            if depth > 1 {
                let ahead = Range::of(case, &next, Some(&step));
                for second in ahead.corners() {
                    let seen = trial.clone().tick(&(next + second), f_h, order);
                    value = value.max(seen.G);
                }
            }
            if value > best.0 || (value == best.0 && random.chance(0.5)) {
                best = (value, step);
            }
        }
        best.1
    }
}

/// Motions of a sample, each coordinate from `low` to `high`.
#[derive(Clone, Copy, Debug)]
struct Range<const N: usize> {
    low: SVector<f64, N>,
    high: SVector<f64, N>,
}

/// What is left to the position's own rounding: q + Δq − q is Δq to an epsilon of q.
const WITHIN: f64 = 1.0 - 1e-9;

impl<const N: usize> Range<N> {
    fn of(case: &Case<N>, q: &SVector<f64, N>, last: Option<&SVector<f64, N>>) -> Self {
        let (reach, T) = (&case.setup.reach, case.setup.settings.T);
        let less = |most: f64, q: f64| (most * WITHIN - 4.0 * f64::EPSILON * q.abs()).max(0.0);
        let by_speed = SVector::<f64, N>::from_fn(|i, _| less(reach.v_max[i] * T, q[i]));
        let change = SVector::<f64, N>::from_fn(|i, _| less(reach.a_max[i] * T * T, q[i]));
        Self {
            low: SVector::from_fn(|i, _| {
                last.map_or(-by_speed[i], |last| (last[i] - change[i]).max(-by_speed[i]))
            }),
            high: SVector::from_fn(|i, _| {
                last.map_or(by_speed[i], |last| (last[i] + change[i]).min(by_speed[i]))
            }),
        }
    }

    fn pick(&self, mut share: impl FnMut(usize) -> f64) -> SVector<f64, N> {
        SVector::from_fn(|i, _| {
            let share = share(i);
            self.low[i] * (1.0 - share) + self.high[i] * share
        })
    }

    fn kept(&self, step: &SVector<f64, N>) -> SVector<f64, N> {
        SVector::from_fn(|i, _| step[i].max(self.low[i]).min(self.high[i]))
    }

    fn toward(&self, force: &SVector<f64, N>) -> SVector<f64, N> {
        self.pick(|i| f64::from(u8::from(force[i] > 0.0)))
    }

    fn corners(self) -> impl Iterator<Item = SVector<f64, N>> {
        let still = core::iter::once(self.kept(&SVector::zeros()));
        still.chain((0..1usize << N).map(move |corner| self.pick(|i| (corner >> i & 1) as f64)))
    }

    /// The same motion in whole steps of the sensor, where the reach has one.
    fn quantised(&self, step: &SVector<f64, N>, case: &Case<N>) -> SVector<f64, N> {
        SVector::from_fn(|i, _| {
            let quantum = case.quantum * case.setup.reach.v_max[i] * case.setup.settings.T;
            let whole = (step[i] / quantum).trunc() * quantum;
            if (self.low[i]..=self.high[i]).contains(&whole) {
                whole
            } else {
                step[i]
            }
        })
    }
}
