//! The energy that the sampled laws create, for any motion of the robot and any human force: what is left of eq:passivity_PI.
#![allow(non_snake_case, reason = "the paper's symbols")]

mod robot;
use admittance::{Admittance, Gains, Law, Reach, Real, Settings};
use nalgebra::Vector1;
use proptest::prelude::*;
use robot::{tick, unlimited};

const T: f64 = 0.002;

fn gains() -> impl Strategy<Value = Gains> {
    (0.1..20.0, 0.0..20.0, 1.0..1000.0, 1.0..50.0)
        .prop_map(|(M_n, D_n, K, K_P)| unlimited(M_n, D_n, K, K_P))
}

/// A motion (m) and a force (N) without bounds on acceleration: jumps at every sample.
fn jumps() -> impl Strategy<Value = Vec<(f64, f64)>> {
    prop::collection::vec((-0.02..0.02, -50.0..50.0), 40..80)
}

/// A motion (m) that starts at rest, of at most 2.1 m/s and 63 m/s², and a force (N): three sines each, 8 s.
fn smooth() -> impl Strategy<Value = Vec<(f64, f64)>> {
    let sines = |most: f64| prop::collection::vec((0.0..most, 0.1..30.0, 0.0..6.3), 3);
    (sines(0.7), sines(20.0)).prop_map(|(speeds, forces): (Vec<_>, Vec<_>)| {
        let q = |t: f64| {
            speeds
                .iter()
                .map(|&(v, w, _): &(f64, f64, f64)| v / w * (1.0 - (w * t).cos()))
                .sum()
        };
        let f_h = |t: f64| {
            forces
                .iter()
                .map(|&(a, w, p): &(f64, f64, f64)| a * (w * t + p).sin())
                .sum()
        };
        (0..4000)
            .map(|k| T * f64::from(k))
            .map(|t| (q(t), f_h(t)))
            .collect()
    })
}

/// Gains with a force limit that those motions and forces exceed most of the time.
fn limited_gains() -> impl Strategy<Value = Gains> {
    (gains(), 1.0..30.0).prop_map(|(gains, f_max)| Gains {
        f_max,
        K: gains.K / 10.0,
        ..gains
    })
}

/// Largest ΔG of an unlimited sample: completing the square in the formula, K δ² ((1 − K_P T/2)²/(4T) + ½ K_P).
fn most(gains: &Gains, delta: f64) -> f64 {
    let Gains { K, K_P, .. } = *gains;
    K * delta * delta * ((1.0 - K_P * T / 2.0).powi(2) / (4.0 * T) + 0.5 * K_P)
}

/// What a run showed.
struct Run {
    /// max over all ticks of G − Σ most(δ), J
    beyond: f64,
    /// largest |K K_P e_nr|/f_max
    spring: f64,
    /// max over all ticks of what G were with ½ K K_P e² for the spring, J
    with_quadratic_spring: f64,
    saturated: bool,
}

fn run(which: Law, gains: Gains, motion: &[(f64, f64)]) -> Run {
    let mut law = robot::law(which, T, gains);
    let mut run = Run {
        beyond: f64::MIN,
        spring: 0.0,
        with_quadratic_spring: f64::MIN,
        saturated: false,
    };
    let (mut allowed, mut q_before, mut dq) = (0.0, motion[0].0, 0.0);
    for &(q, f_h) in motion {
        allowed += most(&gains, q - q_before - T * dq);
        let tick = tick(&mut law, q, f_h);
        let (G, e, v_n) = (law.ledger().G(), tick.e_nr.x, tick.dq_n.x);
        let quadratic = gains.K * 0.5 * (gains.M_n * v_n * v_n + gains.K_P * e * e);
        run.beyond = run.beyond.max(G - allowed);
        run.spring = run
            .spring
            .max((gains.K * gains.K_P * e).abs() / gains.f_max);
        run.with_quadratic_spring = run
            .with_quadratic_spring
            .max(G - law.ledger().H() + quadratic);
        run.saturated |= tick.saturated;
        (q_before, dq) = (q, tick.dq.x);
    }
    run
}

proptest! {
    /// For the unlimited law, with w = v_m − dq and δ = Δq − T dq (what the last difference did not foretell),
    ///
    /// ΔG = −(K/alpha) D_n v_m² T − K T w² + K w δ (1 − K_P T/2) + ½ K K_P δ²
    ///
    /// from the definition, by e⁺ = e + T w − δ and y = w + K_P(e + T w/2). Over 40 to 80 samples each.
    #[test]
    fn every_sample_creates_what_the_formula_says(gains in gains(), alpha in 0.2..5.0_f64, motion in jumps()) {
        let settings = Settings { law: Law::Passive, alpha, T, ..Settings::default() };
        let mut law = Admittance::new(settings, [gains]).unwrap();
        let Gains { D_n, K, K_P, .. } = gains;
        let mut before: Option<[f64; 6]> = None;
        for (q, f_h) in motion {
            let G = law.ledger().G();
            let tick = tick(&mut law, q, f_h);
            if let Some([q_before, f_h, dq, v_n, H, f]) = before {
                let (v_m, moved) = (0.5 * (v_n + tick.dq_n.x), q - q_before);
                let (w, delta) = (v_m - dq, moved - T * dq);
                let formula = -K / alpha * D_n * v_m * v_m * T - K * T * w * w
                    + K * w * delta * (1.0 - K_P * T / 2.0)
                    + 0.5 * K * K_P * delta * delta;
                // Rounding of the sums that ΔG is the difference of.
                let scale = H + law.ledger().H() + (f * moved).abs() + (K / alpha * f_h * v_m * T).abs() + G.abs();
                prop_assert!((law.ledger().G() - G - formula).abs() < 1e-12 * scale);
            }
            before = Some([q, f_h, tick.dq.x, tick.dq_n.x, law.ledger().H(), tick.f.x]);
        }
    }

    /// Hence the only source is δ, and its square bounds what a sample creates.
    #[test]
    fn jumps_create_no_more_than_their_square(gains in gains(), motion in jumps()) {
        let mut law = robot::law(Law::Passive, T, gains);
        let (mut q_before, mut dq) = (motion[0].0, 0.0);
        for (q, f_h) in motion {
            let G = law.ledger().G();
            let allowed = most(&gains, q - q_before - T * dq);
            dq = tick(&mut law, q, f_h).dq.x;
            let rounding = 1e-12 * (1.0 + G.abs() + law.ledger().H());
            prop_assert!(law.ledger().G() - G <= allowed + rounding);
            q_before = q;
        }
    }

}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))] // of 4000 ticks each

    /// Smooth motion hence creates next to nothing (K a²T³/4 a sample), also at the limit, and the spring keeps its bound.
    #[test]
    fn the_bounded_law_creates_nothing_and_keeps_its_bound(gains in limited_gains(), motion in smooth()) {
        let run = run(Law::PassiveBounded, gains, &motion);
        prop_assert!(run.beyond <= 1e-12, "{} J", run.beyond);
        prop_assert!(run.spring <= 1.0 + 4.0 * f64::EPSILON, "{} of the limit", run.spring);
    }

    #[test]
    fn the_law_that_feels_the_applied_force_creates_nothing_with_its_own_storage(
        gains in limited_gains(), motion in smooth(),
    ) {
        let run = run(Law::PassiveApplied, gains, &motion);
        prop_assert!(run.beyond <= 1e-12, "{} J", run.beyond);
    }
}

/// Pushed past the limit at 0.8 Hz, 0.4 m there and back, while the human presses: 16 s.
fn press() -> Vec<(f64, f64)> {
    let f_h = |t: f64| 8.0 * (0.5 * t).sin();
    (0..8000)
        .map(|k| T * f64::from(k))
        .map(|t| (0.2 * (1.0 - (5.0 * t).cos()), f_h(t)))
        .collect()
}

/// Negative controls: the same bound fails for the paper's law once it is saturated, and for `passive_applied` with the
/// spring's energy taken as ½ K K_P e².
#[test]
fn the_bound_is_not_met_by_the_saturated_paper_law_nor_by_the_wrong_storage() {
    let gains = Gains {
        f_max: 5.0,
        ..unlimited(5.0, 0.5, 30.0, 10.0)
    };
    let paper = run(Law::Passive, gains, &press());
    assert!(paper.saturated && paper.beyond > 10.0, "{} J", paper.beyond);
    let applied = run(Law::PassiveApplied, gains, &press());
    assert!(
        applied.saturated && applied.beyond <= 1e-12,
        "{} J",
        applied.beyond
    );
    assert!(
        applied.with_quadratic_spring > 1.0,
        "{} J",
        applied.with_quadratic_spring
    );
    let bounded = run(Law::PassiveBounded, gains, &press());
    assert!(
        bounded.saturated && bounded.beyond <= 1e-12,
        "{} J",
        bounded.beyond
    );
}

/// The tank falls with what is created, rises with what is dissipated, and is never fuller than E_0.
#[test]
fn the_tank_follows_the_ledger_and_overflows() {
    let settings = Settings {
        law: Law::Passive,
        T,
        E_0: 3.0,
        ..Settings::default()
    };
    let gains = Gains {
        f_max: 5.0,
        ..unlimited(5.0, 0.5, 30.0, 10.0)
    };
    let mut law = Admittance::new(settings, [gains]).expect("valid parameters");
    let mut expected = 3.0_f64;
    let (mut fell, mut full) = (false, 0);
    for (q, f_h) in press() {
        let G = law.ledger().G();
        tick(&mut law, q, f_h);
        expected = (expected - (law.ledger().G() - G)).min(3.0);
        assert!((law.ledger().tank() - expected).abs() < 1e-9); // G's rounding over 8000 ticks
        fell |= expected < 2.0;
        full += u32::from(law.ledger().tank() == 3.0);
    }
    assert!(fell && full > 100, "full for {full} ticks, fell: {fell}");
}

#[test]
fn a_delayed_force_works_one_sample_later() {
    let run = |delayed| {
        let settings = Settings {
            law: Law::PassiveBounded,
            T,
            delayed,
            ..Settings::default()
        };
        let mut law =
            Admittance::new(settings, [unlimited(5.0, 0.5, 30.0, 10.0)]).expect("valid parameters");
        let motion: Vec<f64> = (0..200)
            .map(|k| 0.01 * (0.05 * f64::from(k)).sin())
            .collect();
        let forces: Vec<f64> = motion.iter().map(|&q| tick(&mut law, q, 3.0).f.x).collect();
        (motion, forces, law.ledger().G())
    };
    let ((q, f, direct), (_, _, delayed)) = (run(false), run(true));
    let moved: Vec<f64> = q.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let work: f64 = moved.iter().zip(&f).map(|(dq, f)| dq * f).sum();
    let late_work: f64 = moved.iter().skip(1).zip(&f).map(|(dq, f)| dq * f).sum();
    assert!((work - late_work).abs() > 1e-3);
    assert!((direct - delayed - (work - late_work)).abs() < 1e-12); // rounding of sums of some 1e-2 J
}

#[test]
fn with_alpha_zero_there_is_no_ledger() {
    let settings = Settings {
        law: Law::Passive,
        alpha: 0.0,
        ..Settings::default()
    };
    let mut law =
        Admittance::new(settings, [unlimited(5.0, 0.5, 30.0, 10.0)]).expect("valid parameters");
    for (q, f_h) in press() {
        assert!(tick(&mut law, q, f_h).f.x.is_finite());
        let ledger = law.ledger();
        assert_eq!(
            (ledger.is_defined(), ledger.H(), ledger.G(), ledger.tank()),
            (false, 0.0, 0.0, 0.0)
        );
    }
}

/// Gains over decades, most of them of no use, all of them accepted.
fn any_gains() -> impl Strategy<Value = (Gains, Settings)> {
    let decade = |low: f64, high: f64| (low..high).prop_map(|x| 10_f64.powf(x));
    (
        decade(-5.9, 3.0),
        decade(-3.0, 3.0),
        decade(-1.0, 10.0),
        decade(-1.0, 9.0),
        decade(0.0, 12.0),
        decade(-3.0, 9.0),
        decade(-4.0, -1.0),
    )
        .prop_map(|(M_n, D_n, K, K_P, f_max, alpha, period)| {
            let gains = Gains {
                M_n,
                D_n: if D_n < 1.0 { 0.0 } else { D_n },
                K,
                K_P,
                f_max,
            };
            let settings = Settings {
                law: Law::PassiveBounded,
                alpha,
                T: period,
                E_0: 0.0,
                ..Settings::default()
            };
            (gains, settings)
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, ..ProptestConfig::default() })]
    /// docs/passivity.md: −E ≤ 64 ε S. Beyond it the law would call rounding a debt and give no force.
    #[test]
    fn rounding_is_never_called_a_debt(
        (gains, settings) in any_gains(),
        motion in prop::collection::vec((-1.0..1.0, -1.0..1.0), 60),
        most in prop::sample::select(vec![0.0, 1e-6, 50.0]),
        unsteady in prop::sample::select(vec![0.0, 1e-12, 1e-6, 1.0]),
    ) {
        let reach = Reach { v_max: Vector1::new(10.0), a_max: Vector1::new(Real::INFINITY) };
        let mut law = Admittance::new(settings, [gains])
            .and_then(|law| law.reaching(reach))
            .expect("accepted");
        let mut q = 0.0;
        for (share, f_h) in motion {
            let tick = law.step(&Vector1::new(q), &Vector1::new(most * f_h));
            prop_assert!(!tick.outside_bounds);
            prop_assert!(!law.ledger().is_in_debt(), "{} J", law.ledger().tank());
            q += (unsteady * share + 1.0 - unsteady) * 9.9 * settings.T;
        }
    }
}
