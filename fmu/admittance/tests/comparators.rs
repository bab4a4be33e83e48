//! The comparators against their closed forms, and what they leave open.
#![allow(non_snake_case, reason = "the paper's symbols")]

mod robot;

use admittance::natural::{self, Natural};
use admittance::{Gains, Settings, SlidingMode};
use robot::{Mass, unlimited};

const T: f64 = 0.002;

fn settings() -> Settings {
    Settings {
        T,
        ..Settings::default()
    }
}

/// Re f_h/dq of the port under `natural`, at ω.
fn real_part(D_n: f64, M: f64, K: f64, K_P: f64, b: f64, omega: f64) -> f64 {
    let x = K * K_P - M * omega * omega;
    D_n - b * M * omega * omega * x / (x * x + K * K * omega * omega)
}

#[test]
fn the_tuning_rule_of_natural_is_the_exact_edge_of_passivity() {
    for (M, K, K_P, b) in [
        (6.0, 30.0, 10.0, 0.35), // r = ½: the paper's gains
        (6.0, 300.0, 10.0, 2.0), // r = 5
        (1.0, 40.0, 10.0, 1.0),  // r = 4, where the quadratic's leading coefficient vanishes
        (2.0, 4.0, 20.0, 5.0),
    ] {
        let least = natural::least_damping(M, K, K_P, b);
        let lowest = |D_n| {
            (1..400_000)
                .map(|i| real_part(D_n, M, K, K_P, b, 1e-3 * f64::from(i)))
                .fold(f64::INFINITY, f64::min)
        };
        // A grid of 1e-3 rad/s is up to 5e-4 from a minimum K/M ≥ 2 rad/s wide: (2.5e-4)² of at most 2 b.
        assert!(lowest(least).abs() < 1e-6 * b, "{M} {K} {K_P} {b}");
        assert!(lowest(0.99 * least) < 0.0);
    }
}

#[test]
fn natural_leaves_mass_and_damper_and_removes_friction() {
    // Under a constant force the robot ends at f_h/D_n whatever its friction b, where without a controller it would end at
    // f_h/(D_n + b). The model's damper acts on the robot, so the integral of the velocity error carries all of b dq.
    let (M, b, f_h) = (6.0, 4.0, 2.0);
    let gains = unlimited(1e3, 0.5, 30.0, 10.0); // M_n is not used
    let mut controller = Natural::new(settings(), gains, M).expect("valid");
    let mut mass = Mass::new(M);
    for _ in 0..60_000 {
        let tick = controller.step(mass.q, f_h);
        mass.hold(tick.f + f_h - b * mass.dq, T);
    }
    // exp(−120 s · D_n/M) = 4.5e-5 of 4 m/s is left.
    assert!((mass.dq - f_h / 0.5).abs() < 3e-4, "{}", mass.dq);
}

#[test]
fn without_friction_natural_is_the_robot_with_a_damper() {
    // q and q_d obey the same equation, so the velocity loop has nothing to do: dq = f_h/D_n (1 − exp(−D_n t/M)).
    let (M, D_n, f_h) = (6.0, 3.0, 2.0);
    let mut controller =
        Natural::new(settings(), unlimited(5.0, D_n, 30.0, 10.0), M).expect("valid");
    let mut mass = Mass::new(M);
    for k in 1..=2000 {
        let tick = controller.step(mass.q, f_h);
        mass.hold(tick.f + f_h, T);
        let exact = f_h / D_n * (1.0 - (-D_n / M * T * f64::from(k)).exp());
        // dq is late by T/2 and more: D_n T/M = 1e-3 of f_h/D_n.
        assert!((mass.dq - exact).abs() < 1.5e-3 * f_h / D_n);
    }
}

/// The inclusion that a tick of `sliding_mode` solves, by other means: bisection on b⁺.
fn bisected(gains: &Gains, H: f64, e: f64, de: f64, b: f64) -> f64 {
    let force = |b_next: f64| gains.K * ((b_next - b) / T + gains.K_P * b_next);
    let argument = |b_next: f64| e + H * de - b_next - H * (b_next - b) / T;
    let sgn = |x: f64| if x > 0.0 { gains.f_max } else { -gains.f_max };
    let (mut low, mut high) = (-1e3, 1e3);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if force(middle) < sgn(argument(middle)) {
            low = middle;
        } else {
            high = middle;
        }
    }
    force(0.5 * (low + high))
}

#[test]
fn sliding_mode_solves_its_set_valued_equation() {
    let gains = Gains {
        f_max: 12.5,
        ..unlimited(5.0, 0.5, 30.0, 10.0)
    };
    let (mut limited, mut free) = (0, 0);
    for H in [0.0, 0.05, 0.7] {
        let mut controller = SlidingMode::new(settings(), gains, H).expect("valid");
        let (mut q, mut q_n, mut v_n) = (0.2, 0.2, 0.0);
        for k in 0..3000 {
            let b = controller.b();
            let f_h = 2.0 * (0.05 * f64::from(k)).sin();
            let tick = controller.step(q, f_h);
            let v_m = (2.0 * gains.M_n * v_n / T + f_h) / (2.0 * gains.M_n / T + gains.D_n);
            let de = v_m - tick.dq;
            let expected = bisected(&gains, H, q_n - q + T * de / 2.0, de, b);
            // The bisection ends at 1e3·2⁻²⁰⁰, below the spacing of b⁺: its 1e-16, times K/T.
            assert!((tick.f - expected).abs() < 1e-8, "{} {expected}", tick.f);
            if tick.is_saturated() {
                limited += 1;
            } else {
                free += 1;
            }
            (q_n, v_n) = (q_n + T * v_m, 2.0 * v_m - v_n);
            q += 1e-3 * (0.003 * f64::from(k)).cos();
        }
    }
    assert!(limited > 500 && free > 500, "{limited} {free}");
}

/// Largest overshoot (m) of a mass that returns under 12.5 N from `away` (m) to a proxy at 0.
fn overshoot(mut force: impl FnMut(f64) -> f64, away: f64) -> f64 {
    let mut mass = Mass::new(6.0);
    mass.q = 0.0;
    force(0.0); // engages at 0
    mass.q = away;
    let mut least = f64::INFINITY;
    for _ in 0..10_000 {
        let f = force(mass.q);
        mass.hold(f, T);
        least = least.min(mass.q);
    }
    assert!(mass.q.abs() < 1e-3, "it arrives: {}", mass.q);
    -least
}

#[test]
fn sliding_mode_returns_from_saturation_without_overshoot_and_a_saturated_pi_loop_does_not() {
    // From 1 m; braking along q = −H dq needs at most M q/H² = 12.2 N.
    let gains = Gains {
        f_max: 12.5,
        ..unlimited(5.0, 0.5, 30.0, 10.0)
    };
    let mut sliding = SlidingMode::new(settings(), gains, 0.7).expect("valid");
    let mut standard = robot::law(admittance::Law::Standard, T, gains);
    let bounded = overshoot(|q| sliding.step(q, 0.0).f, 1.0);
    let plain = overshoot(|q| robot::tick(&mut standard, q, 0.0).f.x, 1.0);
    // The coupling between inner proxy and mass is a swing of its own, of damping ratio .35: it is excited by the jump in
    // force with which the saturation ends, some millimetres.
    assert!(bounded < 0.01, "{bounded}");
    assert!(plain > 0.3, "{plain}");
}

#[test]
fn sliding_mode_does_not_chatter_at_rest() {
    // Held by friction with an error left, a discontinuous sgn would switch at every sample. Here the force converges.
    let gains = Gains {
        f_max: 12.5,
        ..unlimited(5.0, 0.5, 30.0, 10.0)
    };
    let mut controller = SlidingMode::new(settings(), gains, 0.1).expect("valid");
    controller.step(0.0, 0.0);
    let forces: Vec<f64> = (0..5000).map(|_| controller.step(-0.01, 0.0).f).collect();
    assert!((forces[4999] - 30.0 * 10.0 * 0.01).abs() < 1e-9); // K K_P e
    assert!(
        forces
            .windows(2)
            .skip(1)
            .all(|pair| (pair[1] - pair[0]).abs() < 0.1)
    );
}

#[test]
fn at_a_wall_both_proxies_run_away() {
    // ½ f_h t²/M for natural; f_h/D_n t for the other one, once exp(−t D_n/M_n) is gone.
    let gains = Gains {
        f_max: 12.5,
        ..unlimited(5.0, 5.0, 30.0, 10.0)
    };
    let mut natural = Natural::new(settings(), gains, 6.0).expect("valid");
    let mut sliding = SlidingMode::new(settings(), gains, 0.7).expect("valid");
    let (mut e_natural, mut e_sliding) = (0.0, 0.0);
    for _ in 0..=5000 {
        e_natural = natural.step(0.3, 5.0).e_nr;
        e_sliding = sliding.step(0.3, 5.0).e_nr;
    }
    assert!((e_natural - 0.5 * 5.0 / 6.0 * 100.0).abs() < 1e-9); // the midpoint rule is exact for a constant force
    assert!((e_sliding - (10.0 - 1.0)).abs() < 1e-3); // 1 s of time constant; exp(−10) = 5e-5 m
    assert!(sliding.b() <= 12.5 / 300.0 * (1.0 + 1e-12)); // while the inner proxy stays by the robot
}

#[test]
fn out_of_the_loop_they_give_no_force_and_engage_anew() {
    let gains = unlimited(5.0, 0.5, 30.0, 10.0);
    let mut natural = Natural::new(settings(), gains, 6.0).expect("valid");
    let mut sliding = SlidingMode::new(settings(), gains, 0.1).expect("valid");
    let fresh = (natural, sliding);
    for q in [0.0, 0.1, 0.2] {
        natural.step(q, 3.0);
        sliding.step(q, 3.0);
    }
    assert_eq!((natural.rest(0.4).f, sliding.rest(0.4).f), (0.0, 0.0));
    assert_eq!((natural, sliding), fresh);
    assert_eq!(natural.step(0.4, 0.0).e_nr, 0.0);
}
