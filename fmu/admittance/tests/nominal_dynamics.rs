//! The two equations of the law, from its inputs and outputs alone.
//!
//! ```text
//! tau_a = K (de_nr + K_P e_nr)                        eq:adm_ctrl_1dof, eq:dob_input
//! M_n ddq_n + D_n dq_n = f_h − alpha y,  y = tau_a/K  eq:obs_dyn; without the reaction under `standard`
//! ```
//!
//! In the sampled law they hold at the middle of each sample, exactly; and its course over time is that of the
//! continuous equations, to second order in T.
#![allow(non_snake_case, reason = "the paper's symbols")]

mod robot;
use admittance::{Admittance, Gains, Law, Settings, Tick};
use proptest::prelude::*;
use robot::{tick, unlimited};

const T: f64 = 0.002;
/// Human force of the closed forms, N.
const F: f64 = 5.0;
/// Velocity of the robot in the closed forms, m/s.
const V: f64 = 0.2;

fn gains() -> impl Strategy<Value = Gains> {
    (0.1..20.0, 0.0..20.0, 1.0..1000.0, 1.0..50.0)
        .prop_map(|(M_n, D_n, K, K_P)| unlimited(M_n, D_n, K, K_P))
}

fn law(law: Law, alpha: f64, period: f64, gains: Gains) -> Admittance<1> {
    let settings = Settings {
        law,
        alpha,
        T: period,
        ..Settings::default()
    };
    Admittance::new(settings, [gains]).expect("valid parameters")
}

/// One sample as it is seen from outside: a tick, the next one, and the velocity of the robot until the first of them.
struct Seen {
    tick: Tick<1>,
    next: Tick<1>,
    dq: f64,
}

impl Seen {
    /// The nominal's mean velocity over the sample, m/s.
    fn v_m(&self) -> f64 {
        (self.next.q_n.x - self.tick.q_n.x) / T
    }
}

/// What the law says to a robot that jumps and a human force that jumps.
fn seen(law: &mut Admittance<1>, world: &[(f64, f64)]) -> Vec<Seen> {
    let ticks: Vec<_> = world.iter().map(|&(q, f_h)| tick(law, q, f_h)).collect();
    (1..world.len() - 1)
        .map(|k| Seen {
            tick: ticks[k],
            next: ticks[k + 1],
            dq: (world[k].0 - world[k - 1].0) / T,
        })
        .collect()
}

/// Positions (m) and forces (N).
fn world() -> impl Strategy<Value = Vec<(f64, f64)>> {
    prop::collection::vec((-0.02..0.02, -50.0..50.0), 10..30)
}

proptest! {
    /// eq:dob_input at the middle of a sample: de_nr = v_m − dq, and e_nr has grown by T de_nr/2.
    #[test]
    fn the_force_is_K_times_the_error_of_velocity_and_K_P_times_that_of_position(
        gains in gains(), alpha in 0.1..2.0_f64, world in world(),
    ) {
        for (which, alpha) in [(Law::Standard, 0.0), (Law::Passive, alpha)] {
            for seen in seen(&mut law(which, alpha, T, gains), &world) {
                let de = seen.v_m() - seen.dq;
                let e = seen.tick.e_nr.x + T * de / 2.0;
                let expected = gains.K * (de + gains.K_P * e);
                // v_m is a difference of positions: their rounding over T, times K.
                let scale = gains.K * (1.0 + seen.tick.q_n.x.abs()) / T;
                prop_assert!((seen.tick.f.x - expected).abs() < 1e-13 * scale, "{which:?}: {expected}");
            }
        }
    }

    /// eq:obs_dyn at the middle of a sample: what accelerates the nominal is the human, its damper, and the reaction.
    #[test]
    fn the_nominal_feels_the_human_its_damper_and_alpha_tau_a_by_K(
        gains in gains(), alpha in 0.1..2.0_f64, world in world(),
    ) {
        let Gains { M_n, D_n, K, .. } = gains;
        for (which, reaction) in [(Law::Standard, 0.0), (Law::Passive, alpha)] {
            for (seen, &(_, f_h)) in seen(&mut law(which, alpha, T, gains), &world).iter().zip(&world[1..]) {
                let acceleration = (seen.next.dq_n.x - seen.tick.dq_n.x) / T;
                let left = M_n * acceleration + D_n * seen.v_m();
                let right = f_h - reaction * seen.tick.f.x / K;
                // Differences of velocities and of positions over T.
                let scale = M_n * (1.0 + seen.tick.dq_n.x.abs()) / T + D_n * (1.0 + seen.tick.q_n.x.abs()) / T;
                prop_assert!((left - right).abs() < 1e-13 * scale, "{which:?}: {left} {right}");
            }
        }
    }
}

/// Largest difference of (e, force) to the closed form over 20 s, relative to their largest values. The robot moves with
/// `V` whatever it is told; what is known from the second tick on, e and dq_n, are the initial conditions.
fn errors(
    which: Law,
    alpha: f64,
    period: f64,
    gains: Gains,
    closed_form: impl Fn(f64, f64, f64) -> (f64, f64),
) -> [f64; 2] {
    let mut law = law(which, alpha, period, gains);
    let mut initial = None;
    let (mut difference, mut largest) = ([0.0_f64; 2], [0.0_f64; 2]);
    for k in 0..(20.0 / period) as u32 {
        let tick = tick(&mut law, V * period * f64::from(k), F);
        if k == 0 {
            continue;
        }
        let (e_1, de_1) = *initial.get_or_insert((tick.e_nr.x, tick.dq_n.x - V));
        let since = period * f64::from(k - 1);
        let (e, _) = closed_form(since, e_1, de_1);
        // The force of a sample is that of its middle.
        let (e_middle, de_middle) = closed_form(since + period / 2.0, e_1, de_1);
        let force = gains.K * (de_middle + gains.K_P * e_middle);
        for (i, (found, expected)) in [(tick.e_nr.x, e), (tick.f.x, force)]
            .into_iter()
            .enumerate()
        {
            difference[i] = difference[i].max((found - expected).abs());
            largest[i] = largest[i].max(expected.abs());
        }
    }
    [0, 1].map(|i| difference[i] / largest[i])
}

fn converges(
    which: Law,
    alpha: f64,
    gains: Gains,
    closed_form: impl Fn(f64, f64, f64) -> (f64, f64),
) {
    let [coarse, fine] =
        [2.0 * T, T].map(|period| errors(which, alpha, period, gains, &closed_form));
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        assert!(fine < 1e-5, "{gains:?}: {fine}");
        // The two runs start a sample apart, which is up to 0.4 % of M_n/D_n.
        assert!(
            (coarse / fine - 4.0).abs() < 0.03,
            "{gains:?}: {coarse} then {fine}"
        );
    }
}

/// eq:adm_ctrl_1dof behind a nominal that feels nothing of the robot (`standard`):
///
/// M_n dv_n + D_n v_n = F,  e = e_1 + (F/D_n − V) t − (F/D_n − v_1)(M_n/D_n)(1 − exp(−t D_n/M_n))
#[test]
fn the_standard_law_follows_a_nominal_of_first_order() {
    for gains in [
        unlimited(5.0, 0.5, 30.0, 10.0),
        unlimited(2.0, 2.0, 7.5, 20.0),
    ] {
        let Gains { M_n, D_n, .. } = gains;
        converges(Law::Standard, 1.0, gains, |t, e_1, de_1| {
            let (fading, end) = ((-t * D_n / M_n).exp(), F / D_n);
            let missing = end - (de_1 + V);
            let e = e_1 + (end - V) * t - missing * M_n / D_n * (1.0 - fading);
            (e, end - missing * fading - V)
        });
    }
}

/// eq:obs_dyn with eq:dob_input, beside a robot that moves with V: a mass on the coupling's spring and damper.
///
/// M_n dde + (D_n + alpha) de + alpha K_P e = F − D_n V
#[test]
fn the_passive_law_is_a_nominal_on_a_spring_and_a_damper() {
    for (gains, alpha) in [
        (unlimited(10.0, 0.5, 30.0, 10.0), 1.0),
        (unlimited(5.0, 0.5, 30.0, 10.0), 1.0),
        (unlimited(5.0, 2.0, 60.0, 5.0), 0.5),
    ] {
        let Gains { M_n, D_n, K_P, .. } = gains;
        let omega = (alpha * K_P / M_n).sqrt();
        let decay = (D_n + alpha) / (2.0 * M_n);
        let damped = (omega * omega - decay * decay).sqrt();
        converges(Law::Passive, alpha, gains, |t, e_1, de_1| {
            let end = (F - D_n * V) / (alpha * K_P);
            let (a, b) = (e_1 - end, (de_1 + decay * (e_1 - end)) / damped);
            let (sin, cos) = (damped * t).sin_cos();
            let fading = (-decay * t).exp();
            let e = end + fading * (a * cos + b * sin);
            let de = fading * ((b * damped - decay * a) * cos - (a * damped + decay * b) * sin);
            (e, de)
        });
    }
}
