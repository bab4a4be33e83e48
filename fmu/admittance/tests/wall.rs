//! Against something that does not give way: dq = 0, whatever the law asks for.
//!
//! The nominal (eq:obs_dyn) then is a mass on the coupling's spring and damper, alpha being the damper the paper hides:
//!
//! ```text
//! M_n ddq_n + (D_n + alpha) dq_n + alpha K_P (q_n − q) = f_h
//! ω² = alpha K_P/M_n,   2ζω = (D_n + alpha)/M_n,   e → f_h/(alpha K_P),   tau_a → K f_h/alpha
//! ```
#![allow(non_snake_case, reason = "the paper's symbols")]

mod robot;
use admittance::{Admittance, Gains, Law, Settings};
use nalgebra::Vector1;
use robot::{tick, unlimited};

const T: f64 = 0.002;
const F: f64 = 5.0;

/// e(t) of the underdamped equation above, from rest at 0, under the constant force `F`.
fn analytic(gains: &Gains, alpha: f64, t: f64) -> f64 {
    let Gains { M_n, D_n, K_P, .. } = *gains;
    let omega = (alpha * K_P / M_n).sqrt();
    let zeta = (D_n + alpha) / (2.0 * M_n * omega);
    let damped = omega * (1.0 - zeta * zeta).sqrt();
    let ring = (damped * t).cos() + zeta * omega / damped * (damped * t).sin();
    F / (alpha * K_P) * (1.0 - (-zeta * omega * t).exp() * ring)
}

/// Largest difference to the analytic curve over 20 s, relative to where it settles.
fn error(gains: Gains, alpha: f64, period: f64) -> f64 {
    let settings = Settings {
        law: Law::Passive,
        alpha,
        T: period,
        ..Settings::default()
    };
    let mut law = Admittance::new(settings, [gains]).expect("valid parameters");
    (0..(20.0 / period) as u32)
        .map(|k| {
            let e = tick(&mut law, 0.3, F).e_nr.x;
            (e - analytic(&gains, alpha, f64::from(k) * period)).abs() / (F / (alpha * gains.K_P))
        })
        .fold(0.0, f64::max)
}

/// The midpoint rule is of second order: (ωT)²/12 of a phase error, over 20 s of ringing.
#[test]
fn the_whole_transient_is_the_analytic_one_to_second_order() {
    for (gains, alpha) in [
        (unlimited(10.0, 0.5, 30.0, 10.0), 1.0),
        (unlimited(5.0, 0.5, 30.0, 10.0), 1.0),
        (unlimited(5.0, 0.5, 30.0, 10.0), 0.5),
    ] {
        let (coarse, fine) = (error(gains, alpha, 2.0 * T), error(gains, alpha, T));
        assert!(fine < 1e-5, "{gains:?}: {fine}");
        assert!(
            (coarse / fine - 4.0).abs() < 0.01,
            "{gains:?}: {coarse} then {fine}"
        );
    }
}

/// The curve that the case M_n = 10 kg is judged by: far from settled after 20 s.
#[test]
fn ten_kilograms_at_the_wall_ring_with_damping_ratio_0_075_and_13_3_seconds() {
    let (M_n, D_n, alpha, K_P) = (10.0_f64, 0.5, 1.0, 10.0);
    let zeta = (D_n + alpha) / (2.0 * (alpha * K_P * M_n).sqrt());
    assert!((zeta - 0.075).abs() < 1e-12);
    // Peaks of e at every half period beyond the equilibrium: each is exp(−πζ/√(1−ζ²)) of the one before.
    let mut law = robot::law(Law::Passive, T, unlimited(M_n, D_n, 30.0, K_P));
    let e: Vec<f64> = (0..10_000)
        .map(|_| tick(&mut law, 0.3, F).e_nr.x - 0.5)
        .collect();
    let peaks: Vec<f64> = e
        .windows(3)
        .filter(|w| w[1] > 0.0 && w[1] >= w[0] && w[1] > w[2])
        .map(|w| w[1])
        .collect();
    let expected = (-2.0 * core::f64::consts::PI * zeta / (1.0 - zeta * zeta).sqrt()).exp();
    assert!(peaks.len() >= 3);
    for pair in peaks.windows(2) {
        assert!((pair[1] / pair[0] - expected).abs() < 1e-4, "{pair:?}"); // a peak lies between two samples
    }
    // 13.3 s is what the envelope exp(−ζωt) says.
    assert!((2.0 * M_n / (D_n + alpha) - 13.3).abs() < 0.05);
}

#[test]
fn the_error_settles_at_f_h_over_alpha_K_P_and_the_force_at_K_f_h_over_alpha() {
    for alpha in [0.5, 1.0, 2.0] {
        let settings = Settings {
            law: Law::Passive,
            alpha,
            T,
            ..Settings::default()
        };
        let mut law =
            Admittance::new(settings, [unlimited(0.1, 0.5, 30.0, 10.0)]).expect("valid parameters");
        let settled = (0..10_000)
            .map(|_| tick(&mut law, 0.3, F))
            .last()
            .expect("ticks");
        // Overdamped: after 20 s nothing but rounding is left.
        assert!((settled.e_nr.x - F / (alpha * 10.0)).abs() < 1e-12);
        assert!((settled.f.x - 30.0 * F / alpha).abs() < 1e-9);
    }
}

/// The standard nominal knows nothing of the wall: it runs at F/D_n, and the error with it.
#[test]
fn the_error_of_the_standard_law_grows_without_bound_where_the_passive_one_settles() {
    let gains = unlimited(1.0, 0.5, 30.0, 10.0);
    let error_after = |which, seconds: f64| {
        let mut law = robot::law(which, T, gains);
        (0..(seconds / T) as u32)
            .map(|_| tick(&mut law, 0.3, F).e_nr.x)
            .last()
            .expect("ticks")
    };
    // e = F/D_n (t − M_n/D_n), once exp(−t D_n/M_n) is gone
    let rate = (error_after(Law::Standard, 200.0) - error_after(Law::Standard, 100.0)) / 100.0;
    assert!((rate - F / 0.5).abs() < 1e-9, "{rate}");
    let drift = error_after(Law::Passive, 200.0) - error_after(Law::Passive, 100.0);
    assert!(drift.abs() < 1e-12, "{drift}");
}

/// After the press, the force reverses: how long the laws keep pushing against the wall.
#[test]
fn the_bounded_law_lets_go_first_and_the_standard_law_last() {
    let release = |which| {
        let gains = Gains {
            f_max: 12.5,
            ..unlimited(5.0, 0.5, 30.0, 10.0)
        };
        let mut law = robot::law(which, T, gains);
        let at_the_wall = Vector1::new(0.3);
        for _ in 0..5000 {
            law.step(&at_the_wall, &Vector1::new(F));
        }
        // The robot is held as long as law and human together still push.
        (0..20_000)
            .take_while(|_| law.step(&at_the_wall, &Vector1::new(-F)).f.x - F > 0.0)
            .count()
    };
    let [standard, passive, applied, bounded] = [
        Law::Standard,
        Law::Passive,
        Law::PassiveApplied,
        Law::PassiveBounded,
    ]
    .map(release);
    assert!(bounded < passive && passive < applied && applied < standard);
    assert!(f64::from(bounded as u32) * T < 0.5, "{bounded}");
    assert!(f64::from(applied as u32) * T > 5.0, "{applied}");
}
