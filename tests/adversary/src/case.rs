//! A case: what is attacked, and how.

use crate::genes::{Genes, Reader};
use crate::random::Random;
use crate::subject::Setup;
use admittance::{Bounds, Gains, Law, Reach, Settings};
use fmu_declaration::range::SMALLEST;
use nalgebra::SVector;

/// How the robot is moved for a while.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// Anywhere within the reach.
    Random,
    /// Where the acting force does most work, at the edge of the reach.
    Pull,
    /// Where the law creates most in this sample.
    Greedy,
    /// Where the law creates most in this sample and the next.
    TwoSteps,
    /// First what stores most, then where most is created.
    StretchThenPull,
    /// To the other end of the reach at every sample.
    Alternate,
    /// Still, then as far as it goes.
    StickThenJump,
    /// A mass with friction between a wall and what pushes it.
    Plant,
}

/// All ways to move.
pub const MOTIONS: [Motion; 8] = [
    Motion::Random,
    Motion::Pull,
    Motion::Greedy,
    Motion::TwoSteps,
    Motion::StretchThenPull,
    Motion::Alternate,
    Motion::StickThenJump,
    Motion::Plant,
];

/// What the force sensor says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Force {
    /// Nothing.
    Zero,
    /// A constant.
    Constant,
    /// A sine.
    Sine,
    /// Either sign, at random.
    Telegraph,
    /// A sine that drops out.
    Dropout,
    /// Quiet with spikes a thousand times as large.
    Spikes,
    /// A spring to a delayed position.
    Hand,
}

/// All force signals.
pub const FORCES: [Force; 7] = [
    Force::Zero,
    Force::Constant,
    Force::Sine,
    Force::Telegraph,
    Force::Dropout,
    Force::Spikes,
    Force::Hand,
];

/// How the case goes on, beside what is attacked.
#[derive(Clone, Debug, PartialEq)]
pub struct Case<const N: usize> {
    /// What is attacked.
    pub setup: Setup<N>,
    /// Seed of the random choices.
    pub seed: u64,
    /// How often each way to move is chosen, relative.
    pub motions: [f64; MOTIONS.len()],
    /// How often each force signal is chosen, relative.
    pub forces: [f64; FORCES.len()],
    /// Ticks that a way to move and a force last on average.
    pub phase: f64,
    /// Size of the force, N.
    pub force: f64,
    /// Stiffness of hand and wall, N/m, and mass, kg.
    pub plant: [f64; 3],
    /// Position sensor's step as a share of v_max T; 0 = none.
    pub quantum: f64,
    /// Probabilities per tick: engage or rest, hold or go, other authority, other damping, other gains.
    pub events: [f64; 5],
    /// Decades by which gains change.
    pub tuning: f64,
    /// Largest damping on top, N·s/m.
    pub damping: f64,
    /// Probability that a tick is late or early, as the law is told.
    pub jitter: f64,
}

impl<const N: usize> Case<N> {
    /// The case of these numbers. Where a law accepts no smaller number the case has the smallest.
    pub fn new(genes: &Genes) -> Self {
        let mut g = Reader::new(genes);
        let T = g.decades(1e-4, 0.1);
        let settings = Settings {
            law: Law::PassiveBounded,
            alpha: g.or_decades(0.4, 1.0, 1e-3, 1e3),
            T,
            delayed: g.chance(0.5),
            dq_cutoff: g.or_decades(0.6, 0.0, 0.01 / T, 1.0 / T),
            E_0: g.or_decades(0.1, 0.0, 1e-9, 1e3),
            tuning_time: T * g.or_decades(0.3, 0.0, 1.0, 300.0),
        };
        let v_max = g.decades(1e-3, 1e2);
        let a_max = g.or_decades(0.3, f64::INFINITY, 1e-3 * v_max / T, 10.0 * v_max / T);
        let [M_n, D_n, K, K_P, f_max] = [
            g.decades(1e-4, 1e3),
            g.or_decades(0.2, 0.0, 1e-3, 1e3),
            g.decades(0.1, 1e5),
            g.decades(1e-3, 10.0) / T, // from soft to K_P T = 10
            g.or_decades(0.2, f64::INFINITY, 1e-2, 1e5),
        ];
        // Each axis is a variation of the first one; which, is left to the seed.
        let mut random = Random::new(genes.seed() ^ 0xA5A5);
        let spread = g.decades(1.0, 100.0);
        let mut of_axis = |i: usize, x: f64| {
            let factor = random.decades(1.0 / spread, spread);
            if i == 0 { x } else { x * factor }
        };
        let gains = core::array::from_fn(|i| Gains {
            M_n: of_axis(i, M_n).max(SMALLEST),
            D_n: of_axis(i, D_n),
            K: of_axis(i, K).max(SMALLEST),
            K_P: of_axis(i, K_P).max(SMALLEST),
            f_max: of_axis(i, f_max).max(SMALLEST),
        });
        let reach = Reach {
            v_max: SVector::from_fn(|i, _| of_axis(i, v_max).max(SMALLEST)),
            a_max: SVector::from_fn(|i, _| of_axis(i, a_max).max(SMALLEST)),
        };
        let speed = g.or_decades(0.7, f64::INFINITY, 1e-3 * v_max, 10.0 * v_max);
        let half = g.or_decades(0.7, f64::INFINITY, v_max * T, 1e3 * v_max * T);
        let bounds = [Bounds {
            speed: speed.max(SMALLEST),
            q_min: -half,
            q_max: half,
        }; N];
        let typical = if f_max.is_finite() { f_max } else { K * v_max };
        let rate = g.or_decades(0.6, f64::INFINITY, 1e-3 * typical / T, typical / T);
        let tau_max = g.decades(1e-2, 1e2) * typical;
        let setup = Setup {
            settings,
            gains,
            bounds,
            reach,
            rate: rate.max(SMALLEST),
            tau_max: tau_max.max(SMALLEST),
            clip: g.chance(0.3),
            lag: 1.0,
        };
        let mut case = Self {
            setup,
            seed: genes.seed(),
            motions: core::array::from_fn(|_| g.unit().powi(4)),
            forces: core::array::from_fn(|_| g.unit().powi(4)),
            phase: g.decades(1.0, 300.0),
            force: g.decades(1e-6, 1e3) * typical,
            plant: [
                g.decades(1.0, 1e6),
                g.decades(10.0, 1e6),
                g.decades(0.1, 100.0),
            ],
            quantum: g.or_decades(0.7, 0.0, 1e-4, 1.0),
            events: core::array::from_fn(|_| g.or_decades(0.6, 0.0, 1e-3, 0.5)),
            tuning: g.decades(0.01, 3.0),
            damping: g.decades(1e-2, 1e4),
            jitter: 0.0,
        };
        case.setup.lag = g.or_decades(0.5, 1.0, 0.03, 1.0);
        case.jitter = g.or_decades(0.5, 0.0, 1e-2, 1.0);
        case
    }
}
