//! Live gain changes do not raise the stored energy, whatever changes and however stretched the spring is.
#![allow(non_snake_case, reason = "the paper's symbols")]

mod robot;
use admittance::midpoint::Rule;
use admittance::retune::taken_over;
use admittance::storage::Spring;
use admittance::{Admittance, Gains, Law, Settings};
use proptest::prelude::*;
use robot::{tick, unlimited};

const LAWS: [Law; 4] = [
    Law::Standard,
    Law::Passive,
    Law::PassiveApplied,
    Law::PassiveBounded,
];

/// Energy stored with alpha = 1, J.
fn stored(law: Law, gains: &Gains, e: f64, v_n: f64) -> f64 {
    let settings = Settings {
        law,
        ..Settings::default()
    };
    let Rule { spring, mass, .. } = Rule::new(&settings, gains);
    mass.energy(v_n) + spring.energy(e)
}

fn gains() -> impl Strategy<Value = Gains> {
    (0.1..20.0, 0.0..20.0, 1.0..1000.0, 1.0..50.0, 1.0..400.0).prop_map(
        |(M_n, D_n, K, K_P, f_max)| Gains {
            M_n,
            D_n,
            K,
            K_P,
            f_max,
        },
    )
}

proptest! {
    #[test]
    fn no_change_raises_the_stored_energy(
        law in prop::sample::select(&LAWS[..]), from in gains(), to in gains(), e in -2.0..2.0_f64, v_n in -5.0..5.0_f64,
    ) {
        let (e_new, v_new) = taken_over(law, &from, &to, e, v_n);
        let (before, after) = (stored(law, &from, e, v_n), stored(law, &to, e_new, v_new));
        prop_assert!(after <= before * (1.0 + 1e-14)); // a square root, a product
        // Nor does a change turn anything round.
        prop_assert!(e_new * e >= 0.0 && v_new * v_n >= 0.0);
    }

    #[test]
    fn the_extension_is_the_inverse_of_the_spring(
        law in prop::sample::select(&LAWS[..]), gains in gains(), e in -2.0..2.0_f64,
    ) {
        let spring = Spring::new(law, &gains);
        let back = spring.extension(spring.energy(e));
        prop_assert!((back - e.abs()).abs() <= 1e-14 * (e.abs() + gains.f_max / (gains.K * gains.K_P)));
    }
}

/// Raising keeps the spring's force, lowering its extension: what a hand feels does not jump up.
#[test]
fn raising_keeps_the_springs_force_and_lowering_its_extension() {
    let (soft, stiff) = (
        unlimited(5.0, 0.5, 30.0, 10.0),
        unlimited(5.0, 0.5, 60.0, 20.0),
    );
    let (e, _) = taken_over(Law::Passive, &soft, &stiff, 0.04, 0.0);
    assert!((e - 0.01).abs() < 1e-16); // 0.04·(30·10)/(60·20)
    let (e, _) = taken_over(Law::Passive, &stiff, &soft, 0.04, 0.0);
    assert_eq!(e, 0.04);
}

/// Φ beyond its limit is f_max|e| − f_max²/(2 K K_P), and its slope the limited force.
#[test]
fn the_storage_of_the_applied_law_is_the_integral_of_the_limited_force() {
    let gains = Gains {
        M_n: 5.0,
        D_n: 0.5,
        K: 30.0,
        K_P: 10.0,
        f_max: 12.5,
    };
    let n = 100_000;
    for end in [0.02, 0.3] {
        let h = end / f64::from(n);
        let force = |s: f64| (300.0 * s).min(12.5);
        let integral: f64 = (0..n).map(|i| h * force(h * (f64::from(i) + 0.5))).sum();
        // One cell of the sum holds the kink: 300 h²/8 at most, beside the rounding of 1e5 terms.
        assert!(
            (Spring::new(Law::PassiveApplied, &gains).energy(end) - integral).abs()
                < 300.0 * h * h + 1e-12
        );
    }
    assert!(
        Spring::new(Law::Passive, &gains).energy(0.3)
            > 3.0 * Spring::new(Law::PassiveApplied, &gains).energy(0.3)
    );
}

/// The same within the loop: tuned at every tick to other gains, nothing is created at a robot that stands still.
#[test]
fn tuning_at_every_tick_creates_nothing() {
    for which in LAWS.into_iter().skip(1) {
        let base = Gains {
            M_n: 5.0,
            D_n: 0.5,
            K: 30.0,
            K_P: 10.0,
            f_max: 12.5,
        };
        let settings = Settings {
            law: which,
            tuning_time: 0.0,
            ..Settings::default()
        };
        let mut law = Admittance::new(settings, [base]).expect("valid parameters");
        for k in 0..5000_u32 {
            let vary = |period: u32| if k % period < period / 2 { 3.0 } else { 1.0 };
            let f_max = if which == Law::Passive {
                f64::INFINITY
            } else {
                12.5 * vary(14)
            };
            let gains = Gains {
                M_n: 5.0 * vary(4),
                K: 30.0 * vary(6),
                K_P: 10.0 * vary(10),
                f_max,
                ..base
            };
            law.tune([gains]).expect("valid gains");
            let G = law.ledger().G();
            tick(&mut law, 0.3, if k < 3000 { 6.0 } else { -6.0 });
            assert!(
                law.ledger().G() - G <= 1e-12 * (1.0 + G.abs()),
                "{which:?} at tick {k}"
            );
        }
    }
}

/// An importer may set all it has at every step.
#[test]
fn wanting_the_same_gains_at_every_tick_is_wanting_them_once() {
    let (soft, stiff) = (
        unlimited(5.0, 0.5, 30.0, 10.0),
        unlimited(5.0, 0.5, 60.0, 20.0),
    );
    let forces = |again: bool| -> Vec<f64> {
        let mut law = robot::law(Law::PassiveBounded, 0.002, soft);
        (0..200)
            .map(|k| {
                if k == 20 || (again && k > 20) {
                    law.tune([stiff]).expect("valid gains");
                }
                tick(&mut law, 0.001 * f64::from(k), 5.0).f.x
            })
            .collect()
    };
    assert_eq!(forces(true), forces(false));
}

/// Over the tuning time of 0.1 s, 50 ticks: K y with K on a straight line, on a robot that moves with 1 m/s.
#[test]
fn changed_gains_come_into_force_on_a_straight_line() {
    let light = |K: f64| unlimited(1e9, 0.0, K, 1e-6); // a nominal that stands still: y = −dq
    let mut law = robot::law(Law::Passive, 0.002, light(30.0));
    for k in 0..20 {
        tick(&mut law, 0.002 * f64::from(k), 0.0);
    }
    law.tune([light(80.0)]).expect("valid gains");
    for k in 1..=60 {
        let f = tick(&mut law, 0.002 * f64::from(19 + k), 0.0).f.x;
        let expected = -(30.0 + f64::from(k.min(50)));
        assert!((f - expected).abs() < 1e-3, "tick {k}: {f} N"); // K K_P e, e of some 0.2 m
    }
}
