//! The gains at each tick while they are tuned, found from the definition of a ramp.

use crate::random::Random;
use admittance::Gains;
use fmu_declaration::range::SMALLEST;

/// Gains on their way.
#[derive(Clone, Debug)]
pub struct Tuning<const N: usize> {
    now: [Gains; N],
    wanted: [Gains; N],
    left: u32,
    ticks: u32,
}

impl<const N: usize> Tuning<N> {
    /// Gains at rest, whose changes take `ticks` ticks, one at least.
    pub fn new(gains: [Gains; N], ticks: u32) -> Self {
        Self {
            now: gains,
            wanted: gains,
            left: 0,
            ticks: ticks.max(1),
        }
    }

    /// Other gains within so many decades of `base`, none below what the law accepts.
    pub fn another(&mut self, base: &[Gains; N], decades: f64, random: &mut Random) -> [Gains; N] {
        let most = 10f64.powf(decades);
        self.wanted = base.map(|base| {
            let mut other = |x: f64| x * random.decades(1.0 / most, most);
            Gains {
                M_n: other(base.M_n).max(SMALLEST),
                D_n: other(base.D_n),
                K: other(base.K).max(SMALLEST),
                K_P: other(base.K_P).max(SMALLEST),
                f_max: other(base.f_max).max(SMALLEST),
            }
        });
        self.left = self.ticks;
        self.wanted
    }

    /// The gains of a tick: a law that engages has those wanted at once.
    pub fn at_tick(&mut self, engaged: bool, was_engaged: bool) -> [Gains; N] {
        if !(engaged && was_engaged) || self.left <= 1 {
            self.now = self.wanted;
            self.left = 0;
            return self.now;
        }
        let share = 1.0 / f64::from(self.left);
        for (now, wanted) in self.now.iter_mut().zip(&self.wanted) {
            let way = |from: f64, to: f64| {
                if to.is_finite() {
                    from + (to - from) * share
                } else {
                    to
                }
            };
            now.M_n = way(now.M_n, wanted.M_n);
            now.D_n = way(now.D_n, wanted.D_n);
            now.K = way(now.K, wanted.K);
            now.K_P = way(now.K_P, wanted.K_P);
            now.f_max = way(now.f_max, wanted.f_max);
        }
        self.left -= 1;
        self.now
    }
}
