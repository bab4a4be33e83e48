//! What the force sensor says, of whatever origin.

use crate::case::{Case, FORCES, Force};
use crate::motions::weighted;
use crate::random::Random;
use nalgebra::SVector;

/// The signals' state.
#[derive(Clone, Debug)]
pub struct Forces<const N: usize> {
    kind: Force,
    left: u32,
    tick: u32,
    direction: SVector<f64, N>,
    frequency: f64,
    past: Vec<SVector<f64, N>>,
    delay: usize,
}

impl<const N: usize> Forces<N> {
    /// Before the first tick.
    pub fn new(case: &Case<N>) -> Self {
        let mut random = Random::new(case.seed ^ 0x5EED);
        Self {
            kind: Force::Zero,
            left: 0,
            tick: 0,
            direction: SVector::zeros(),
            frequency: 0.0,
            past: Vec::new(),
            delay: random.index(20),
        }
    }

    /// The force at the next tick, N, with the robot at `q`.
    pub fn next(
        &mut self,
        q: &SVector<f64, N>,
        case: &Case<N>,
        random: &mut Random,
    ) -> SVector<f64, N> {
        if self.left == 0 {
            self.kind = FORCES[weighted(&case.forces, random)];
            self.left = 1 + (random.unit() * 2.0 * case.phase) as u32;
            self.direction = SVector::from_fn(|_, _| random.within(-1.0, 1.0));
            self.frequency = random.decades(1e-3, core::f64::consts::PI);
        }
        self.left -= 1;
        self.tick += 1;
        self.past.push(*q);
        let sine = (self.frequency * f64::from(self.tick)).sin();
        let flip = if random.chance(0.5) { 1.0 } else { -1.0 };
        let [k_h, ..] = case.plant;
        match self.kind {
            Force::Zero => SVector::zeros(),
            Force::Constant => self.direction * case.force,
            Force::Sine => self.direction * case.force * sine,
            Force::Telegraph => self.direction * case.force * flip,
            Force::Dropout => self.direction * case.force * sine * f64::from(u8::from(flip > 0.0)),
            Force::Spikes => {
                self.direction
                    * case.force
                    * if random.chance(0.02) {
                        1e3 * flip
                    } else {
                        1e-3
                    }
            }
            Force::Hand => {
                let then = self.past.len().saturating_sub(1 + self.delay);
                let reach = case.setup.reach.v_max * case.setup.settings.T * 10.0;
                let wanted = self.direction.component_mul(&reach);
                (wanted - (self.past[then] - self.past[0])) * k_h
            }
        }
    }
}
