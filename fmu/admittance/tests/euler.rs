//! Why the midpoint rule: explicit Euler, the paper's two steps taken literally, creates energy with a light nominal.
#![allow(non_snake_case, reason = "the paper's symbols")]

mod robot;
use admittance::Law;
use robot::{tick, unlimited};

const T: f64 = 0.002;
const D_N: f64 = 0.5;
const K: f64 = 30.0;
const K_P: f64 = 10.0;
/// Below this nominal mass explicit Euler does not dissipate: (D_n + alpha)T/2.
const LIMIT: f64 = (D_N + 1.0) * T / 2.0;

/// Stored energy at each of 200 ticks at a robot that does not move, of which the first 5 push with 1 N: by explicit
/// Euler, v_n⁺ = v_n + T (f_h − D_n v_n − y)/M_n, e⁺ = e + T v_n, y = v_n + K_P e.
fn explicit_euler(M_n: f64) -> Vec<f64> {
    let (mut e, mut v_n) = (0.0, 0.0);
    (0..200)
        .map(|k| {
            let H = K * (0.5 * M_n * v_n * v_n + 0.5 * K_P * e * e);
            let f_h = if k < 5 { 1.0 } else { 0.0 };
            let y = v_n + K_P * e;
            (e, v_n) = (e + T * v_n, v_n + T * (f_h - D_N * v_n - y) / M_n);
            H
        })
        .collect()
}

fn midpoint(M_n: f64) -> Vec<f64> {
    let mut law = robot::law(Law::Passive, T, unlimited(M_n, D_N, K, K_P));
    (0..200)
        .map(|k| {
            tick(&mut law, 0.0, if k < 5 { 1.0 } else { 0.0 });
            law.ledger().H()
        })
        .collect()
}

/// Whether energy appears while nobody pushes and nothing moves.
fn creates_energy(H: &[f64]) -> bool {
    H[5..]
        .windows(2)
        .any(|pair| pair[1] > pair[0] * (1.0 + 1e-12)) // rounding of a square
}

#[test]
fn explicit_euler_creates_energy_below_its_limit_and_the_midpoint_rule_does_not() {
    for M_n in [0.1 * LIMIT, 0.9 * LIMIT] {
        assert!(creates_energy(&explicit_euler(M_n)), "M_n = {M_n}");
        assert!(!creates_energy(&midpoint(M_n)), "M_n = {M_n}");
    }
    assert!(
        explicit_euler(0.9 * LIMIT)[199] > 1e3 * explicit_euler(0.9 * LIMIT)[5],
        "it diverges"
    );
}

#[test]
fn above_its_limit_explicit_euler_rings_down() {
    let H = explicit_euler(1.1 * LIMIT);
    assert!(H[199] < 0.1 * H[5]);
}
