//! N axes are N times the one axis, under one ledger and one factor.
#![allow(non_snake_case, reason = "the paper's symbols")]

use admittance::ledger::Flow;
use admittance::tick::Coordinates;
use admittance::{Admittance, Axes, Gains, Law, Ledger, Reach, Request, Settings};
use nalgebra::{Vector1, Vector3};

const OFFERED: [Law; 4] = [
    Law::Standard,
    Law::Passive,
    Law::PassiveApplied,
    Law::PassiveBounded,
];

const GAINS: [Gains; 3] = [
    Gains {
        M_n: 5.0,
        D_n: 20.0,
        K: 1000.0,
        K_P: 20.0,
        f_max: 400.0,
    },
    Gains {
        M_n: 2.0,
        D_n: 5.0,
        K: 300.0,
        K_P: 10.0,
        f_max: 100.0,
    },
    Gains {
        M_n: 8.0,
        D_n: 30.0,
        K: 700.0,
        K_P: 15.0,
        f_max: 200.0,
    },
];

fn settings(law: Law) -> Settings {
    Settings {
        law,
        T: 0.001,
        ..Settings::default()
    }
}

/// Position (m) and human force (N) at tick `k`: three different motions, forces that saturate at times.
fn world(k: u32) -> (Vector3<f64>, Vector3<f64>) {
    let t = 0.001 * f64::from(k);
    let q = Vector3::new((2.0 * t).sin(), (3.0 * t).cos(), t.sin()) * 0.05;
    let f_h = Vector3::new((1.1 * t).sin(), (0.7 * t).cos(), (1.7 * t).sin()) * 25.0;
    (q, f_h)
}

#[test]
fn three_axes_equal_three_scalars_and_their_ledger_is_the_sum() {
    for which in OFFERED {
        let mut all = Admittance::new(settings(which), GAINS).expect("valid parameters");
        let mut each =
            GAINS.map(|gains| Admittance::new(settings(which), [gains]).expect("valid parameters"));
        for k in 0..3000 {
            let (q, f_h) = world(k);
            let tick = all.step(&q, &f_h);
            for (i, axis) in each.iter_mut().enumerate() {
                let alone = axis.step(&Vector1::new(q[i]), &Vector1::new(f_h[i]));
                assert_eq!(
                    (tick.f[i], tick.q_n[i], tick.e_nr[i]),
                    (alone.f.x, alone.q_n.x, alone.e_nr.x)
                );
            }
            let sum: f64 = each.iter().map(|axis| axis.ledger().G()).sum();
            assert!((all.ledger().G() - sum).abs() < 1e-12 * (1.0 + sum.abs() + all.ledger().H())); // order of sums
        }
    }
}

/// After one tick at rest with authority s: e⁺ = T v_m, which shows what the nominal felt.
#[test]
fn the_authority_acts_on_what_each_law_says() {
    let (q, f_h, s) = (Vector3::zeros(), Vector3::new(20.0, -10.0, 5.0), 0.25);
    for which in OFFERED {
        let mut law = Admittance::new(settings(which), GAINS).expect("valid parameters");
        let asked = law.clone().step(&q, &f_h).f;
        let tick = law.tick(&q, &f_h, &with_authority(s));
        assert_eq!(tick.f, asked * s);
        assert!(tick.saturated);
        let next = law.step(&q, &f_h);
        for i in 0..3 {
            let Gains { M_n, D_n, K, .. } = GAINS[i];
            let felt = match which {
                Law::Standard => 0.0,
                Law::Passive => asked[i] / K,
                _ => s * asked[i] / K,
            };
            // M_n v_n⁺/T = f_h − D_n v_n⁺/2 − alpha y;  passive_bounded may lower v_n⁺ by its reset, but not e⁺ = T v_m.
            let v_m = (f_h[i] - felt) / (2.0 * M_n / 0.001 + D_n);
            assert!(
                (next.e_nr[i] - 0.001 * v_m).abs() < 1e-12 * v_m.abs(),
                "{which:?}, axis {i}"
            );
        }
    }
}

fn with_authority(authority: f64) -> Request<3> {
    Request {
        authority,
        ..Request::default()
    }
}

#[test]
fn an_authority_out_of_range_is_brought_into_it() {
    let mut law = Admittance::new(settings(Law::PassiveBounded), GAINS).expect("valid parameters");
    let (q, f_h) = world(700);
    law.step(&q, &f_h);
    let asked = law.clone().step(&q, &f_h).f;
    for (s, used) in [(f64::NAN, 0.0), (-1.0, 0.0), (2.0, 1.0), (0.3, 0.3)] {
        assert_eq!(
            law.clone().tick(&q, &f_h, &with_authority(s)).f,
            asked * used
        );
    }
}

/// An authority that delivers what drives the robot and withholds what brakes it lets the robot stretch the spring for
/// free: the slip knows f_max, not the factor. Under `passive_applied` that creates energy, and the ledger sees it; under
/// `passive_bounded` the tank pays for it as far as it goes, and no further.
#[test]
fn a_malicious_factor_is_paid_for_by_the_tank_and_by_nothing_else() {
    let run = |which| {
        let mut law = Admittance::new(settings(which), GAINS).expect("valid parameters");
        let (mut most, mut least_tank) = (f64::MIN, f64::MAX);
        for k in 0..20_000 {
            let (q, nobody) = (world(k).0, Vector3::zeros());
            let drives = law.clone().step(&q, &nobody).f.dot(&(world(k + 1).0 - q)) > 0.0;
            law.tick(&q, &nobody, &with_authority(if drives { 1.0 } else { 0.0 }));
            most = most.max(law.ledger().G());
            least_tank = least_tank.min(law.ledger().tank());
        }
        (most, least_tank)
    };
    let [(applied, _), (bounded, tank)] = [Law::PassiveApplied, Law::PassiveBounded].map(run);
    assert!(applied > 100.0, "{applied} J");
    let E_0 = Settings::default().E_0;
    assert!(
        tank > -1e-10 && bounded <= E_0 + 1e-10,
        "{tank}, {bounded} J"
    ); // rounding over 20,000 ticks
    assert!(bounded > 0.9 * E_0, "{bounded} J: nothing was tried");
}

/// The parts of which [`Admittance`] is made, put together by a caller whose force works on other coordinates.
#[test]
fn axes_with_a_ledger_of_the_callers_own_make_the_law() {
    for delayed in [false, true] {
        let settings = Settings {
            delayed,
            ..settings(Law::PassiveBounded)
        };
        let mut law = Admittance::new(settings, GAINS).expect("valid parameters");
        let mut axes = Axes::new(settings, GAINS).expect("valid parameters");
        let mut own = Ledger::new(&settings, &Reach::default());
        for k in 0..1000 {
            let (q, f_h) = world(k);
            if k == 500 {
                law.rest(&q);
                axes.rest();
                let ended = own.close(0.0, &q);
                own.book(&ended, Some(&q), &Vector3::zeros(), Flow::default());
            } else {
                let tick = law.step(&q, &f_h);
                let mut sensed = axes.sense(&q, 1.0);
                let mut ended = own.settle(&axes, &mut sensed, &q);
                if !axes.is_engaged() {
                    ended = ended.without_motion();
                }
                let proposal = axes.propose(&sensed, &f_h, &Request::default());
                let f = axes.f(&proposal);
                assert_eq!(f, tick.f);
                let driven = axes.driven(&proposal, &f);
                let flow = Flow {
                    supplied: axes.supplied(&proposal, &driven),
                    exchanged: axes.exchanged(&proposal, &driven),
                };
                own.book(&ended, Some(&q), &f, flow);
                axes.commit(&proposal, &driven, &f);
            }
            assert_eq!(&own, law.ledger(), "tick {k}");
        }
        assert!(own.G() < -1.0);
    }
}
