//! N axes are N times the one axis, under one ledger and one factor.
#![allow(non_snake_case, reason = "the paper's symbols")]

use admittance::{Admittance, Gains, Law, Ledger, Settings};
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

/// After one tick at rest with factor s: v_n⁺ = 2 v_m, which shows what the nominal felt.
#[test]
fn the_common_factor_acts_on_what_each_law_says() {
    let (q, f_h, s) = (Vector3::zeros(), Vector3::new(20.0, -10.0, 5.0), 0.25);
    for which in OFFERED {
        let mut law = Admittance::new(settings(which), GAINS).expect("valid parameters");
        let proposal = law.propose(&q, &f_h);
        let asked = proposal.f();
        let tick = law.commit(proposal, s);
        assert_eq!(tick.f, asked * s);
        assert!(tick.saturated);
        let next = law.propose(&q, &f_h); // e⁺ and v_n⁺ are the state at the next tick
        let next = law.commit(next, 1.0);
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

#[test]
fn a_proposal_changes_nothing_and_a_factor_out_of_range_is_brought_into_it() {
    let mut law = Admittance::new(settings(Law::PassiveBounded), GAINS).expect("valid parameters");
    let (q, f_h) = world(700);
    law.step(&q, &f_h);
    let before = law;
    let first = law.propose(&q, &f_h);
    assert_eq!(law.propose(&q, &f_h), first);
    assert_eq!(law, before);
    for (s, used) in [(f64::NAN, 0.0), (-1.0, 0.0), (2.0, 1.0), (0.3, 0.3)] {
        let mut law = before;
        assert_eq!(law.commit(first, s).f, first.f() * used);
    }
}

/// A factor that delivers what drives the robot and withholds what brakes it lets the robot stretch the spring for free,
/// under every law: the slip knows f_max, not the factor. The ledger sees it. The bound on e keeps it smallest under
/// `passive_bounded`; covering it is what a budget is for.
#[test]
fn a_malicious_factor_creates_energy_and_the_ledger_sees_it() {
    let run = |which| {
        let mut law = Admittance::new(settings(which), GAINS).expect("valid parameters");
        let mut most = f64::MIN;
        for k in 0..20_000 {
            let (q, nobody) = (world(k).0, Vector3::zeros());
            let proposal = law.propose(&q, &nobody);
            let drives = proposal.f().dot(&(world(k + 1).0 - q)) > 0.0;
            law.commit(proposal, if drives { 1.0 } else { 0.0 });
            most = most.max(law.ledger().G());
        }
        most
    };
    let [paper, applied, bounded] =
        [Law::Passive, Law::PassiveApplied, Law::PassiveBounded].map(run);
    assert!(
        bounded > 1.0 && applied > bounded && paper > bounded,
        "{paper}, {applied}, {bounded} J"
    );
}

/// What a caller needs whose force works on other coordinates: H of this tick and the energy that its sample brings.
#[test]
fn a_ledger_kept_by_the_caller_from_a_tick_is_the_laws_own() {
    for delayed in [false, true] {
        let settings = Settings {
            delayed,
            ..settings(Law::PassiveBounded)
        };
        let mut law = Admittance::new(settings, GAINS).expect("valid parameters");
        let mut own = Ledger::new(&settings);
        for k in 0..1000 {
            let (q, f_h) = world(k);
            let tick = if k == 500 {
                law.rest(&q)
            } else {
                law.step(&q, &f_h)
            };
            own = own
                .settled(law.ledger().H(), &q)
                .opened(&tick.f, tick.supplied);
            assert_eq!(&own, law.ledger(), "tick {k}");
        }
        assert!(own.G() < -1.0);
    }
}
