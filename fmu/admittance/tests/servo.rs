//! The servo form (footnote of sec:standard_adm): the nominal drives a drive, and feels what was measured one sample late.
#![allow(non_snake_case, reason = "the paper's symbols")]

mod robot;

use admittance::{Gains, Law, Servo, Settings, servo};
use nalgebra::SMatrix;
use robot::{Mass, unlimited};

const T: f64 = 0.002;
const SUBSTEPS: u32 = 200;

fn servo(law: Law, gains: Gains) -> Servo {
    let settings = Settings {
        law,
        T,
        ..Settings::default()
    };
    Servo::new(settings, gains).expect("valid parameters")
}

/// A drive with the law's own loop, nearly continuous, on a mass. Returns its mean force over the sample.
fn drive(mass: &mut Mass, tick: &servo::ServoTick, gains: &Gains, f_h: f64) -> f64 {
    let mut mean = 0.0;
    for _ in 0..SUBSTEPS {
        let tau = gains.K * ((tick.dq_d - mass.dq) + gains.K_P * (tick.q_d - mass.q));
        let tau = tau.clamp(-gains.f_max, gains.f_max);
        mass.hold(tau + f_h, T / f64::from(SUBSTEPS));
        mean += tau / f64::from(SUBSTEPS);
    }
    mean
}

/// The loop written down a second time as a matrix on (q, dq, q_n, v_n, tau_m), without limits and human force, the drive
/// being continuous: exp(A T) of the mass under the held command, and its integral for the mean force.
fn loop_matrix(M: f64, gains: &Gains) -> SMatrix<f64, 5, 5> {
    let Gains {
        M_n, D_n, K, K_P, ..
    } = *gains;
    let row = |c: [f64; 5]| SMatrix::<f64, 1, 5>::from_row_slice(&c);
    let (q, dq) = (
        row([1.0, 0.0, 0.0, 0.0, 0.0]),
        row([0.0, 1.0, 0.0, 0.0, 0.0]),
    );
    let (q_n, v_n) = (
        row([0.0, 0.0, 1.0, 0.0, 0.0]),
        row([0.0, 0.0, 0.0, 1.0, 0.0]),
    );
    let tau_m = row([0.0, 0.0, 0.0, 0.0, 1.0]);
    let v_m = (v_n * (2.0 * M_n / T) - tau_m / K) / (2.0 * M_n / T + D_n);
    let q_d = q_n + v_m * (T / 2.0);
    // (q, dq, q_d, dq_d) over one sample.
    let flow = SMatrix::<f64, 4, 4>::from_row_slice(&[
        0.0,
        T,
        0.0,
        0.0,
        -K * K_P / M * T,
        -K / M * T,
        K * K_P / M * T,
        K / M * T,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
    ])
    .exp();
    let next =
        |i: usize| q * flow[(i, 0)] + dq * flow[(i, 1)] + q_d * flow[(i, 2)] + v_m * flow[(i, 3)];
    let mean = (next(1) - dq) * (M / T);
    SMatrix::from_rows(&[next(0), next(1), q_n + v_m * T, v_m * 2.0 - v_n, mean])
}

fn spectral_radius(M: f64, gains: &Gains) -> f64 {
    // Translation of everything is an eigenvalue of exactly 1: take relative positions, q_n − q in place of both.
    let A = loop_matrix(M, gains);
    let mut to = SMatrix::<f64, 5, 5>::identity();
    to[(2, 0)] = -1.0;
    let mut back = SMatrix::<f64, 5, 5>::identity();
    back[(2, 0)] = 1.0;
    let relative = (to * A * back).remove_row(0).remove_column(0);
    relative
        .complex_eigenvalues()
        .iter()
        .map(|z| z.norm())
        .fold(0.0, f64::max)
}

/// Largest |change of v_n in a tick| in ticks 100 to 200 and in the last hundred of 2000, after a push of one sample.
fn ringing(M: f64, gains: Gains) -> (f64, f64) {
    let mut law = servo(Law::PassiveApplied, gains);
    let mut mass = Mass::new(M);
    let (mut tau_m, mut before, mut first, mut last) = (0.0, 0.0_f64, 0.0_f64, 0.0_f64);
    for k in 0..2000 {
        let f_h = if k == 0 { 1.0 } else { 0.0 };
        let tick = law.step(mass.q, f_h, tau_m);
        tau_m = drive(&mut mass, &tick, &gains, f_h);
        let change = (tick.dq_n - before).abs();
        before = tick.dq_n;
        if (100..200).contains(&k) {
            first = first.max(change);
        } else if k >= 1900 {
            last = last.max(change);
        }
    }
    (first, last)
}

#[test]
fn the_matrix_is_the_loop() {
    // One push, then 200 ticks of the matrix on the state after the first sample, against law and drive.
    let gains = unlimited(0.1, 0.5, 300.0, 10.0);
    let (M, f_h) = (6.0, 1.0);
    let mut law = servo(Law::PassiveApplied, gains);
    let mut mass = Mass::new(M);
    let tick = law.step(mass.q, f_h, 0.0);
    let mut tau_m = drive(&mut mass, &tick, &gains, f_h);
    let v_m = tick.dq_d;
    let mut state = nalgebra::SVector::<f64, 5>::from([mass.q, mass.dq, T * v_m, 2.0 * v_m, tau_m]);
    let A = loop_matrix(M, &gains);
    for _ in 0..200 {
        let tick = law.step(mass.q, 0.0, tau_m);
        tau_m = drive(&mut mass, &tick, &gains, 0.0);
        state = A * state;
        // The drive holds its force for T/200: K dt/2M = 2.5e-4 of a velocity of some 5e-3 m/s and a force of some 5 N.
        assert!(
            (mass.dq - state[1]).abs() < 2e-6,
            "{} {}",
            mass.dq,
            state[1]
        );
        assert!((tau_m - state[4]).abs() < 2e-3);
    }
}

#[test]
fn a_light_nominal_is_stable_while_its_mass_exceeds_half_of_alpha_T() {
    // A soft drive: v_m,k+1 = (1 − a/2) v_m,k − (a/2) v_m,k−1, a = alpha T/M_n, stable for a < 2.
    for (share, stable) in [(1.01, true), (0.99, false)] {
        let gains = unlimited(share * T / 2.0, 0.0, 30.0, 1e-3);
        assert_eq!(spectral_radius(6.0, &gains) < 1.0, stable, "{share}");
        let (start, end) = ringing(6.0, gains);
        assert_eq!(end < start, stable, "{share}: {start} {end}");
    }
}

#[test]
fn the_drive_may_be_as_stiff_as_it_likes() {
    // The torque form's limit is K T/M = 1.9 (stability.rs); here the fast loop is the drive's own.
    for kt in [0.01, 1.0, 1.9, 4.0, 30.0] {
        let gains = unlimited(5.0, 0.5, kt * 6.0 / T, 10.0);
        assert!(spectral_radius(6.0, &gains) < 1.0, "K T/M = {kt}");
    }
    let (start, end) = ringing(6.0, unlimited(5.0, 0.5, 4.0 * 6.0 / T, 10.0));
    assert!(end < start);
}

#[test]
fn the_drive_follows_the_nominal_without_the_lag_that_another_instant_has() {
    // Constant velocity by a constant force, friction-free drive: the mean torque is 0 once the swing has died out, so
    // the robot runs with q = q_n at every tick. A command for the start of the sample would leave e = T v/2.
    let gains = unlimited(5.0, 2.0, 300.0, 10.0);
    let mut law = servo(Law::Standard, gains);
    let mut mass = Mass::new(6.0);
    let (mut tau_m, mut e, mut v) = (0.0, 0.0, 0.0);
    for k in 0..20_000 {
        let f_h = if k < 100 { 5.0 } else { 2.0 * v };
        let tick = law.step(mass.q, f_h, tau_m);
        if k == 99 {
            v = tick.dq_n;
        }
        tau_m = drive(&mut mass, &tick, &gains, 0.0);
        e = tick.e_nr;
    }
    assert!(v > 0.1);
    // What is left is the drive's own sampling, half of its cycle late: T v/2 less the number of cycles.
    let own = T * v / 2.0 / f64::from(SUBSTEPS);
    assert!((e + own).abs() < 0.01 * own, "{e} {own}"); // the swing's rest
}

#[test]
fn the_ledger_is_the_derived_balance() {
    // ΔG = −K D_n v_m² T/alpha − K w² T + T v_m (tau_k − tau_{k−1}), exact if tau_k is K(w + K_P(e + T w/2)).
    let gains = unlimited(5.0, 0.5, 30.0, 10.0);
    let Gains { D_n, K, K_P, .. } = gains;
    let mut law = servo(Law::PassiveApplied, gains);
    let (mut q, mut tau_m, mut G, mut expected) = (0.0_f64, 0.0, 0.0, 0.0);
    for k in 0..500 {
        let f_h = 4.0 * (0.02 * f64::from(k)).sin();
        let tick = law.step(q, f_h, tau_m);
        // Rounding: 500 terms of some 0.1 J.
        G = law.energy().G;
        assert!((G - expected).abs() < 1e-13, "{G} {expected}");
        let moved = 1e-3 * (0.05 * f64::from(k)).cos();
        let (v_m, w) = (tick.dq_d, tick.dq_d - moved / T);
        let tau = K * (w + K_P * (tick.e_nr + T * w / 2.0));
        expected += -K * D_n * v_m * v_m * T - K * w * w * T + T * v_m * (tau - tau_m);
        (q, tau_m) = (q + moved, tau);
    }
    assert!(G.abs() > 0.1);
}

#[test]
fn bounded_slips_and_passive_is_refused() {
    let gains = Gains {
        f_max: 12.5,
        ..unlimited(5.0, 0.5, 30.0, 10.0)
    };
    let mut law = servo(Law::PassiveBounded, gains);
    let mut largest = 0.0_f64;
    for _ in 0..10_000 {
        let tick = law.step(0.3, 6.0, 12.5); // at a wall, the drive on its limit
        largest = largest.max(tick.e_nr);
        assert!(law.energy().tank >= 10.0 - 1e-12); // rounding of 1e4 samples of some 1e-3 J
    }
    assert!((largest - 12.5 / 300.0).abs() < 1e-15);
    // The reset: spring and drive are at their limit, so the nominal rests with the wall; without it v_n would go towards
    // (6 − 12.5/30)/0.5 = 11 m/s.
    assert!(law.step(0.3, 6.0, 12.5).dq_n.abs() < 1e-14);

    let settings = Settings {
        law: Law::Passive,
        ..Settings::default()
    };
    assert_eq!(
        Servo::new(settings, gains)
            .expect_err("no form")
            .to_string(),
        "law = 2 (passive) has no servo form: expected 1 (standard), 3 (passive_applied), 4 (passive_bounded)"
    );
}

#[test]
fn the_drives_gains_cannot_be_tuned_and_a_heavier_nominal_is_slowed() {
    let gains = unlimited(5.0, 0.5, 30.0, 10.0);
    let mut law = servo(Law::PassiveApplied, gains);
    for _ in 0..100 {
        law.step(0.0, 3.0, 0.0);
    }
    let before = law;
    let refusal = law
        .tune(Gains { K: 60.0, ..gains })
        .expect_err("the drive's");
    assert_eq!(
        refusal.to_string(),
        "K = 60: expected the value at the start, in servo form the drive has it too"
    );
    assert_eq!(law, before);
    law.tune(Gains { M_n: 20.0, ..gains })
        .expect("the law's own");
    let (mut tuned, mut untuned) = (law, before);
    let (slow, fast) = (tuned.step(0.0, 0.0, 0.0), untuned.step(0.0, 0.0, 0.0));
    assert!((slow.dq_n / fast.dq_n - 0.5).abs() < 1e-15); // M_n v_n² is kept
    assert!(tuned.energy().G <= untuned.energy().G + 1e-15);
}

#[test]
fn out_of_the_loop_the_drive_is_told_to_stand_still() {
    let mut law = servo(Law::PassiveBounded, unlimited(5.0, 0.5, 30.0, 10.0));
    for k in 0..100 {
        law.step(1e-4 * f64::from(k), 3.0, 1.0);
    }
    let stored = law.energy().H;
    let G = law.energy().G;
    let tick = law.rest(0.0099, 0.0);
    assert_eq!((tick.q_d, tick.dq_d, tick.e_nr), (0.0099, 0.0, 0.0));
    assert!(stored > 0.0 && law.energy().H == 0.0 && law.energy().G < G);
    assert_eq!(law.step(0.02, 0.0, 5.0).q_n, 0.02);
}
