//! Start, engaging and leaving, the backward difference, parameter errors.
#![allow(non_snake_case, reason = "the paper's symbols")]

mod robot;
use admittance::{Admittance, Gains, Law, ParameterError, Reach, Settings};
use nalgebra::Vector1;
use robot::{tick, unlimited};

const GAINS: Gains = Gains {
    M_n: 5.0,
    D_n: 0.5,
    K: 30.0,
    K_P: 10.0,
    f_max: 12.5,
};

fn law() -> Admittance<1> {
    Admittance::new(Settings::default(), [GAINS]).expect("valid parameters")
}

#[test]
fn the_first_tick_engages_at_the_sensed_position_with_the_nominal_at_rest() {
    let tick = tick(&mut law(), 0.4, 0.0);
    assert_eq!(
        (tick.q_n.x, tick.dq_n.x, tick.e_nr.x, tick.dq.x, tick.f.x),
        (0.4, 0.0, 0.0, 0.0, 0.0)
    );
}

#[test]
fn leaving_gives_up_the_stored_energy_and_coming_back_starts_anew() {
    let mut law = law();
    for _ in 0..2000 {
        tick(&mut law, 0.0, 6.0);
    }
    let (H, G) = (law.ledger().H(), law.ledger().G());
    assert!(H > 0.1);
    let out = law.rest(&Vector1::new(0.0));
    assert!(!out.engaged && out.f.x == 0.0);
    assert!(law.ledger().H() == 0.0 && law.ledger().G() < G);
    let G = law.ledger().G();
    law.rest(&Vector1::new(5.0)); // moved by hand: no force, no work, no energy
    assert_eq!(law.ledger().G(), G);
    let again = tick(&mut law, 7.0, 0.0);
    assert_eq!(
        (again.q_n.x, again.e_nr.x, again.dq.x, again.f.x),
        (7.0, 0.0, 0.0, 0.0)
    );
    assert!(!again.outside_bounds);
}

#[test]
fn dq_is_the_backward_difference() {
    let mut law = law();
    tick(&mut law, 0.1, 0.0);
    assert_eq!(tick(&mut law, 0.104, 0.0).dq.x, (0.104 - 0.1) / 0.002);
}

/// A step of the velocity from 0 to 1 m/s: dq_k = 1 − exp(−2π f_c T k).
#[test]
fn the_low_pass_is_the_exact_sampled_first_order_one() {
    let settings = Settings {
        dq_cutoff: 30.0,
        ..Settings::default()
    };
    let mut law = Admittance::new(settings, [GAINS]).expect("valid parameters");
    for k in 0..100 {
        let dq = tick(&mut law, 0.002 * f64::from(k), 0.0).dq.x;
        let expected = 1.0 - (-core::f64::consts::TAU * 30.0 * 0.002 * f64::from(k)).exp();
        assert!((dq - expected).abs() < 1e-12, "{k}"); // q's rounding over T
    }
}

fn reach(v_max: f64, a_max: f64) -> Reach<1> {
    Reach {
        v_max: Vector1::new(v_max),
        a_max: Vector1::new(a_max),
    }
}

#[test]
fn motion_beyond_v_max_or_a_max_is_flagged_for_that_tick() {
    let flags = |differences: &[f64]| {
        let mut law = Admittance::new(Settings::default(), [GAINS])
            .and_then(|law| law.reaching(reach(1.0, 100.0)))
            .expect("valid parameters");
        let mut q = 0.0;
        tick(&mut law, q, 0.0);
        let mut flag = |dq: &f64| {
            q += 0.002 * dq;
            tick(&mut law, q, 0.0).outside_bounds
        };
        differences.iter().map(&mut flag).collect::<Vec<_>>()
    };
    // 0.2 m/s from one sample to the next are 100 m/s².
    assert_eq!(flags(&[0.9, 0.8, 0.55, 0.7]), [false, false, true, false]);
    assert_eq!(flags(&[1.1, 0.95, -0.9]), [true, false, true]);
}

/// Left alone, the nominal decays to zero exactly instead of through the denormal numbers.
#[test]
fn the_nominal_velocity_ends_at_zero() {
    let mut law = robot::law(Law::Standard, 0.002, unlimited(0.1, 5.0, 30.0, 10.0));
    tick(&mut law, 0.0, 1.0);
    let speeds: Vec<f64> = (0..10_000)
        .map(|_| tick(&mut law, 0.0, 0.0).dq_n.x)
        .collect();
    assert_eq!(speeds.last(), Some(&0.0));
    assert!(speeds.iter().all(|&v| v == 0.0 || v.abs() >= 1e-150));
}

#[test]
fn errors_name_the_parameter_the_axis_the_value_and_the_range() {
    let settings = |change: fn(&mut Settings)| {
        let mut settings = Settings::default();
        change(&mut settings);
        Admittance::new(settings, [GAINS])
            .expect_err("out of range")
            .to_string()
    };
    let finite = "expected a finite value";
    assert_eq!(
        settings(|s| s.alpha = -1.0),
        format!("alpha = -1: {finite} not less than 0")
    );
    assert_eq!(
        settings(|s| s.T = f64::NAN),
        format!("T = NaN: {finite}, at least 1e-6")
    );
    assert_eq!(
        settings(|s| s.dq_cutoff = f64::INFINITY),
        format!("dq_cutoff = inf: {finite} not less than 0")
    );
    assert_eq!(
        settings(|s| s.E_0 = -2.0),
        format!("E_0 = -2: {finite} not less than 0")
    );
    assert_eq!(
        settings(|s| s.tuning_time = -1.0),
        format!("tuning_time = -1: {finite} not less than 0")
    );
    let reaching = |v_max, a_max| {
        let law = Admittance::new(Settings::default(), [GAINS]).expect("valid parameters");
        let error = law.reaching(reach(v_max, a_max)).expect_err("out of range");
        error.to_string()
    };
    assert_eq!(
        reaching(f64::INFINITY, 1.0),
        format!("v_max = inf: {finite}, at least 1e-6")
    );
    assert_eq!(
        reaching(1.0, f64::NAN),
        format!("a_max = NaN: {finite}, at least 1e-6")
    );
    let offered = "1 (standard), 2 (passive), 3 (passive_applied), 4 (passive_bounded)";
    assert_eq!(
        settings(|s| s.law = Law::Natural),
        format!(
            "law = 5 (natural) is a comparator, for one axis, and not offered here: expected {offered}"
        )
    );
    assert_eq!(
        Law::try_from(0).expect_err("no law").to_string(),
        format!("law = 0: expected {offered}")
    );

    let second =
        |gains| Admittance::new(Settings::default(), [GAINS, gains]).expect_err("out of range");
    assert_eq!(
        second(Gains { K_P: 0.0, ..GAINS }).to_string(),
        format!("K_P[2] = 0: {finite}, at least 1e-6")
    );
    assert_eq!(
        second(Gains {
            f_max: -3.0,
            ..GAINS
        })
        .to_string(),
        format!("f_max[2] = -3: {finite}, at least 1e-6")
    );
    assert!(
        Admittance::new(
            Settings::default(),
            [Gains {
                f_max: f64::INFINITY,
                ..GAINS
            }]
        )
        .is_ok()
    );
    assert_eq!(
        Law::ALL.map(|law| Law::try_from(law.number())),
        Law::ALL.map(Ok::<_, ParameterError>)
    );
}
