//! A case run to its end, and what came of it.

use crate::audit::Sum;
use crate::case::Case;
use crate::forces::Forces;
use crate::motions::Motions;
use crate::random::Random;
use crate::subject::{Order, Setup, Subject, supply};
use crate::tuning::Tuning;
use admittance::{Gains, Request};
use nalgebra::SVector;

/// What a run showed.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// min E, J.
    pub least_tank: f64,
    /// max over the samples of −E in units of what rounding may take.
    pub tank_in_roundings: f64,
    /// max over the samples of (energy out − energy in − E_0), by the audit, in units of what rounding may give.
    pub energy_in_roundings: f64,
    /// max over the samples of |G − H − (energy out − energy in)| in units of rounding.
    pub mismatch_in_roundings: f64,
    /// max over the samples of energy out − energy in, J.
    pub most_energy: f64,
    /// Samples in which the budget left less than was asked for.
    pub limited: u32,
    /// What is wrong, beside numbers: the first such thing, with its tick.
    pub complaint: Option<(u32, &'static str)>,
    /// max H, J.
    pub most_stored: f64,
}

/// Roundings of a sample: the products and sums that ΔG is made of are each rounded once, some forty of them, and the
/// square root by which the spring is given up once more.
const A_SAMPLE: f64 = 64.0 * f64::EPSILON;

impl Outcome {
    /// Whether any claim was broken.
    pub fn is_broken(&self) -> bool {
        self.complaint.is_some()
            || self.tank_in_roundings > 1.0
            || self.energy_in_roundings > 1.0
            || self.mismatch_in_roundings > 1.0
    }

    /// How near the adversary came: what an optimiser makes greater.
    pub fn score(&self, E_0: f64) -> f64 {
        if self.complaint.is_some() {
            return f64::INFINITY;
        }
        let worst = self
            .tank_in_roundings
            .max(self.energy_in_roundings)
            .max(self.mismatch_in_roundings);
        let emptied = if E_0 > 0.0 {
            1.0 - self.least_tank / E_0
        } else {
            0.0
        };
        worst + emptied.min(1.0) + 1e-3 * f64::from(self.limited).sqrt()
    }
}

/// The terms of the energy that passes the couplings in a sample at nominal velocities `dq_n` (m/s), at their sizes, J:
/// K T v² (1 + K_P T/2).
#[allow(non_snake_case, reason = "the paper's symbol")]
fn exchanged<const N: usize>(T: f64, gains: &[Gains; N], dq_n: &SVector<f64, N>) -> f64 {
    let of_axis = |(gains, v): (&Gains, &f64)| gains.K * T * v * v * (1.0 + gains.K_P * T / 2.0);
    gains.iter().zip(dq_n).map(of_axis).sum()
}

/// How near to the bound a motion goes: positions round.
const WITHIN: f64 = 1.0 - 1e-9;

/// The way (m) to where the next force takes over, of the motion `step` (m) of a sample: within the largest speed before and
/// after, as far along the force `gain` (N) that the change takes away as can be.
fn on_the_way<const N: usize>(
    setup: &Setup<N>,
    step: &SVector<f64, N>,
    gain: &SVector<f64, N>,
) -> SVector<f64, N> {
    let lag = setup.lag;
    SVector::from_fn(|i, _| {
        let most = WITHIN * setup.reach.v_max[i] * setup.settings.T;
        let high = f64::min(lag * most, step[i] + (1.0 - lag) * most);
        let low = f64::max(-lag * most, step[i] - (1.0 - lag) * most);
        // A motion at the very bound leaves no choice.
        if gain[i] > 0.0 || low > high {
            high
        } else {
            low
        }
    })
}

/// Runs `case` for `ticks` ticks.
///
/// # Panics
/// When the case has parameters that the law refuses: cases have none.
pub fn run<const N: usize, S: Subject<N>>(case: &Case<N>, ticks: u32) -> Outcome {
    let setup = &case.setup;
    let settings = &setup.settings;
    let mut law = S::build(setup).expect("a case has valid parameters");
    let mut random = Random::new(case.seed);
    let mut motions = Motions::<N>::new(case);
    let mut forces = Forces::<N>::new(case);
    let mut tuning = Tuning::new(setup.gains, settings.tuning_ticks());
    let mut q = S::home();
    let mut request = Request::default();
    let mut engaged = true;
    let mut was_engaged = false;
    let mut said = SVector::zeros();
    let (mut out, mut sum_of_sizes) = (Sum::default(), Sum::default());
    let mut largest = settings.E_0;
    let audited = S::shows_what_is_felt(setup);
    let mut outcome = Outcome {
        least_tank: f64::INFINITY,
        tank_in_roundings: 0.0,
        energy_in_roundings: 0.0,
        mismatch_in_roundings: 0.0,
        most_energy: 0.0,
        limited: 0,
        complaint: None,
        most_stored: 0.0,
    };
    for k in 0..ticks {
        let [rest, hold, authority, damping, tune] = case.events;
        engaged ^= random.chance(rest);
        request.hold ^= random.chance(hold);
        if random.chance(authority) {
            request.authority = [0.0, 1.0, random.unit()][random.index(3)];
        }
        if random.chance(damping) {
            request.damping = SVector::from_fn(|_, _| {
                if random.chance(0.5) {
                    0.0
                } else {
                    case.damping * random.unit()
                }
            });
        }
        if random.chance(tune) {
            let gains = tuning.another(&setup.gains, case.tuning, &mut random);
            law.tune(gains).expect("positive gains");
        }
        request.after = if case.jitter > 0.0 && random.chance(case.jitter) {
            random.decades(1e-3, 20.0)
        } else {
            1.0
        };
        let order = if engaged {
            Order::Run(request)
        } else {
            Order::Rest
        };
        let f_h = forces.next(&q, case, &mut random);
        let gains = tuning.at_tick(engaged, was_engaged);
        let seen = law.tick(&q, &f_h, &order);
        was_engaged = engaged;

        largest = f64::max(largest, seen.H);
        largest = f64::max(largest, exchanged(settings.T, &gains, &seen.dq_n));
        let rounding = A_SAMPLE * largest + f64::MIN_POSITIVE;
        outcome.least_tank = outcome.least_tank.min(seen.tank);
        outcome.most_stored = outcome.most_stored.max(seen.H);
        outcome.tank_in_roundings = outcome.tank_in_roundings.max(-seen.tank / rounding);
        outcome.limited += u32::from(seen.share < 1.0);
        let mut complain = |what| {
            outcome.complaint.get_or_insert((k, what));
        };
        if !(seen.tau.iter().all(|tau| tau.is_finite()) && seen.G.is_finite()) {
            complain("not finite");
            break;
        }
        if seen.outside {
            complain("a motion within the reach is called outside");
        }
        if seen.debt {
            complain("a debt without a motion beyond the reach");
        }
        if audited {
            let rounding = A_SAMPLE * (out.size() + sum_of_sizes.size()) + rounding;
            let energy = out.value();
            outcome.most_energy = outcome.most_energy.max(energy);
            outcome.energy_in_roundings = outcome
                .energy_in_roundings
                .max((energy - settings.E_0) / rounding);
            // H is known to the position's rounding only: e = q_n − q.
            let mismatch = (seen.G - seen.H - energy).abs()
                / (rounding + A_SAMPLE * seen.G.abs() * f64::from(k));
            outcome.mismatch_in_roundings = outcome.mismatch_in_roundings.max(mismatch);
        }

        let acting = if settings.delayed { said } else { seen.tau };
        let before = std::mem::replace(&mut said, seen.tau);
        let step = motions.next(&law, &q, &acting, &f_h, &order, case, &mut random, k == 0);
        let next = q + step;
        let step = next - q; // as the law will see it
        // With a lag the force of this tick begins to act on the way, where that does most work.
        let (work, parts) = if settings.delayed && setup.lag < 1.0 {
            let between = q + on_the_way(setup, &step, &(before - said));
            law.acts(&between);
            let (first, rest) = (between - q, next - between);
            (
                before.dot(&first) + said.dot(&rest),
                before.abs().dot(&first.abs()) + said.abs().dot(&rest.abs()),
            )
        } else {
            (acting.dot(&step), acting.abs().dot(&step.abs()))
        };
        let supplied = supply(setup, &gains, &f_h, &order, &seen);
        largest = f64::max(largest, parts.max(supplied.size));
        out.add(work - supplied.energy, parts + supplied.size);
        sum_of_sizes.add(0.0, seen.H);
        q = next;
    }
    outcome
}
