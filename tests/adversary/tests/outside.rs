//! Motions beyond the reach: flagged, reported as a debt, no force until it is repaid, and no more energy than the excess.
#![allow(non_snake_case, reason = "the paper's symbols")]

use admittance::budget::SampleReach;
use admittance::{Admittance, Gains, Reach, Settings};
use adversary::random::Random;
use nalgebra::Vector1;

const T: f64 = 0.002;
const E_0: f64 = 0.5;

fn law() -> Admittance<1> {
    let settings = Settings {
        T,
        E_0,
        ..Settings::default()
    };
    let gains = Gains {
        M_n: 5.0,
        D_n: 2.0,
        K: 300.0,
        K_P: 20.0,
        f_max: 200.0,
    };
    Admittance::new(settings, [gains])
        .and_then(|law| law.reaching(reach()))
        .expect("valid parameters")
}

fn reach() -> Reach<1> {
    Reach {
        v_max: Vector1::new(0.5),
        a_max: Vector1::new(100.0),
    }
}

/// Held, and along the force by up to 30 times the reach seldom; the human pushes this way and that.
#[test]
fn no_more_energy_is_given_out_than_E_0_and_the_excess() {
    for seed in 0..20 {
        let mut random = Random::new(seed);
        let mut law = law();
        let reach = SampleReach::new(&reach(), T);
        let (mut q, mut f_h) = (0.0, 0.0);
        let mut last: Option<f64> = None;
        let (mut excess, mut most, mut debts, mut forces_in_debt, mut repaid) =
            (0.0, f64::MIN, 0, 0, 0);
        let mut least = f64::MAX;
        let (mut in_debt, mut outside) = (false, false);
        for k in 0..20_000 {
            if k % 200 == 0 {
                f_h = random.within(-30.0, 30.0);
            }
            let tick = law.step(&Vector1::new(q), &Vector1::new(f_h));
            let (E, G) = (law.ledger().tank(), law.ledger().G());
            assert_eq!(tick.outside_bounds, outside, "seed {seed}, tick {k}");
            let rounding = 1e-11 * (1.0 + excess); // of 20,000 samples of at most some J
            assert!(E >= -excess - rounding, "seed {seed}, tick {k}: {E} J");
            // Since any earlier moment: what has been dissipated before is not given out.
            least = f64::min(least, G);
            most = f64::max(most, G - least);
            assert!(
                G - least <= E_0 + excess + rounding,
                "seed {seed}, tick {k}"
            );
            repaid += u32::from(in_debt && !law.ledger().is_in_debt());
            debts += u32::from(!in_debt && law.ledger().is_in_debt());
            in_debt = law.ledger().is_in_debt();
            assert!(!in_debt || excess > 0.0, "a debt without an excess");
            forces_in_debt += u32::from(in_debt && tick.f.x != 0.0);

            let (v, a) = (0.5 * T, 100.0 * T * T);
            let (low, high) = last
                .filter(|_| !outside)
                .map_or((-v, v), |last| (last - a, last + a));
            let within = 0.0_f64.max(low).min(high);
            let beyond = random.chance(0.002);
            let step = if beyond {
                tick.f.x.signum() * v * random.within(2.0, 30.0)
            } else {
                within
            };
            let next = q + step;
            let step = next - q;
            let foretelling = last.filter(|_| !outside).map(Vector1::new);
            let covered = reach.most_work(&tick.f, foretelling.as_ref(), 1);
            excess += f64::max(0.0, tick.f.x * step - covered);
            outside = reach.is_left(&Vector1::new(step), last.map(Vector1::new).as_ref());
            (q, last) = (next, Some(step));
        }
        assert!(
            debts > 3 && repaid + 1 >= debts,
            "seed {seed}: {debts} debts, {repaid} repaid"
        );
        assert_eq!(forces_in_debt, 0, "seed {seed}");
        assert!(most > E_0, "seed {seed}: {most} J: nothing was tried");
    }
}

/// A robot that is held does not repay; a human who pushes does, since the nominal's energy is taken for it.
#[test]
fn a_debt_keeps_the_force_off_until_the_human_has_repaid_it() {
    let mut law = law();
    let push =
        |law: &mut Admittance<1>, q: f64, f_h: f64| law.step(&Vector1::new(q), &Vector1::new(f_h));
    for _ in 0..500 {
        push(&mut law, 0.0, 20.0);
    }
    let q = 0.05; // 0.05 m in 2 ms along 200 N: 10 J, of which the tank, spring and nominal hold less
    push(&mut law, q, 0.0);
    assert!(law.ledger().is_in_debt() && law.ledger().is_outside());
    for _ in 0..1000 {
        assert_eq!(push(&mut law, q, 0.0).f.x, 0.0);
        assert!(law.ledger().is_in_debt());
    }
    let ticks = (0..100_000)
        .take_while(|_| {
            let f = push(&mut law, q, 20.0).f.x;
            f == 0.0 || law.ledger().is_in_debt()
        })
        .count();
    assert!((1..100_000).contains(&ticks), "{ticks}");
    assert!(!law.ledger().is_in_debt());
}
