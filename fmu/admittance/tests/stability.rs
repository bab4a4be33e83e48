//! The stability limit of K T/M for a sampled law on a mass, with the backward difference as velocity.
#![allow(non_snake_case, reason = "the paper's symbols")]

mod robot;
use admittance::Law;
use nalgebra::SMatrix;
use robot::{Mass, tick, unlimited};

const T: f64 = 0.002;
const M: f64 = 6.0;
const M_N: f64 = 5.0;
const D_N: f64 = 0.5;

/// One tick of the loop without human force, written down a second time as a matrix on
/// (e, q_k − q_{k−1}, dq, v_n, tau_{k−1}); the robot is an exact mass under u = tau_k, or tau_{k−1} when delayed.
fn loop_matrix(K: f64, K_P: f64, delayed: bool) -> SMatrix<f64, 5, 5> {
    let row = |c: [f64; 5]| SMatrix::<f64, 1, 5>::from_row_slice(&c);
    let (e, moved, v, v_n, before) = (
        row([1.0, 0.0, 0.0, 0.0, 0.0]),
        row([0.0, 1.0, 0.0, 0.0, 0.0]),
        row([0.0, 0.0, 1.0, 0.0, 0.0]),
        row([0.0, 0.0, 0.0, 1.0, 0.0]),
        row([0.0, 0.0, 0.0, 0.0, 1.0]),
    );
    let dq = moved / T;
    let c = 1.0 + K_P * T / 2.0;
    let v_m = (v_n * (2.0 * M_N / T) + dq * c - e * K_P) / (2.0 * M_N / T + D_N + c);
    let tau = ((v_m - dq) * c + e * K_P) * K;
    let u = if delayed { before } else { tau };
    let moves = v * T + u * (0.5 * T * T / M);
    SMatrix::from_rows(&[
        e + v_m * T - moves,
        moves,
        v + u * (T / M),
        v_m * 2.0 - v_n,
        tau,
    ])
}

fn spectral_radius(matrix: SMatrix<f64, 5, 5>) -> f64 {
    matrix
        .complex_eigenvalues()
        .iter()
        .map(|z| z.norm())
        .fold(0.0, f64::max)
}

/// The K T/M at which the matrix's spectral radius reaches 1.
fn limit(K_P: f64, delayed: bool) -> f64 {
    let (mut stable, mut unstable) = (0.1, 3.0);
    while unstable - stable > 1e-9 {
        let middle = 0.5 * (stable + unstable);
        let below = spectral_radius(loop_matrix(middle * M / T, K_P, delayed)) < 1.0;
        *(if below { &mut stable } else { &mut unstable }) = middle;
    }
    stable
}

/// Largest |tau| in the first and in the last thousand of 10,000 ticks after a push of one sample.
fn ringing(K: f64, K_P: f64, delayed: bool) -> (f64, f64) {
    let mut law = robot::law(Law::Passive, T, unlimited(M_N, D_N, K, K_P));
    let mut mass = Mass::new(M);
    let (mut before, mut first, mut last) = (0.0, 0.0_f64, 0.0_f64);
    for k in 0..10_000 {
        let tau = tick(&mut law, mass.q, if k == 0 { 1.0 } else { 0.0 }).f.x;
        mass.hold(if delayed { before } else { tau }, T);
        before = tau;
        if k < 1000 {
            first = first.max(tau.abs());
        } else if k >= 9000 {
            last = last.max(tau.abs());
        }
    }
    (first, last)
}

/// As K_P → 0 and M_n → ∞ the loop is d_{k+1} = d_k − a(d_k + d_{k−1}), d = q_k − q_{k−1}, a = K T/2M: stable for a < 1.
/// One sample of delay, d_{k+1} = d_k − a(d_{k−1} + d_{k−2}), leaves a < tan(π/8).
/// The tolerance is what D_n + alpha and K_P = 0.01 1/s still change.
#[test]
fn without_the_spring_the_limits_are_2_and_2_tan_of_a_sixteenth_turn() {
    assert!((limit(0.01, false) - 2.0).abs() < 1e-2);
    assert!((limit(0.01, true) - 2.0 * (core::f64::consts::PI / 8.0).tan()).abs() < 1e-2);
}

/// The spring takes its share: K_P from 10 to 20 1/s at 500 Hz. Rounded to two decimals.
#[test]
fn limits_with_the_spring() {
    for (K_P, delayed, expected) in [
        (10.0, false, 1.94),
        (20.0, false, 1.89),
        (10.0, true, 0.80),
        (20.0, true, 0.77),
    ] {
        let found = limit(K_P, delayed);
        assert!(
            (found - expected).abs() < 5e-3,
            "K_P {K_P}, delayed {delayed}: {found}"
        );
    }
}

#[test]
fn the_law_rings_down_below_the_limit_and_up_above_it() {
    for delayed in [false, true] {
        let K = limit(10.0, delayed) * M / T;
        let (first, last) = ringing(0.99 * K, 10.0, delayed);
        assert!(
            last < 1e-3 * first,
            "delayed {delayed}: {first} then {last}"
        );
        let (first, last) = ringing(1.01 * K, 10.0, delayed);
        assert!(last > 1e3 * first, "delayed {delayed}: {first} then {last}");
    }
}
