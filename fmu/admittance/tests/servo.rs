//! The servo form (footnote of sec:standard_adm): the nominal drives a drive, and feels what was measured one sample late.
#![allow(non_snake_case, reason = "the paper's symbols")]

mod robot;

use admittance::servo::{Command, Servo};
use admittance::{Axes, Bounds, Gains, Law, Ledger, Reach, Request, Settings, servo};
use nalgebra::{SMatrix, Vector1};
use robot::{Mass, unlimited};

const T: f64 = 0.002;
const SUBSTEPS: u32 = 200;

/// One axis.
#[derive(Clone, Copy, Debug, PartialEq)]
struct OneServo(Servo<Axes<1>, 1>);

impl OneServo {
    fn step(&mut self, q: f64, f_h: f64, tau_m: f64) -> Shown {
        self.tick(q, f_h, tau_m, &Request::default())
    }

    fn tick(&mut self, q: f64, f_h: f64, tau_m: f64, request: &Request<1>) -> Shown {
        let [q, f_h, tau_m] = [q, f_h, tau_m].map(Vector1::new);
        let mut shown = None;
        let inputs = servo::Inputs {
            place: &q,
            q: &q,
            f_h: &f_h,
            tau_m: &tau_m,
            request,
            after: request.after,
        };
        let accept = |command: &Command<1>, _| {
            shown = Some(Shown::from(command));
            true
        };
        self.0.tick(&inputs, accept).expect("accepted");
        shown.expect("a tick")
    }

    fn rest(&mut self, q: f64, tau_m: f64) -> Shown {
        let (q, tau_m) = (Vector1::new(q), Vector1::new(tau_m));
        self.0.rest(&q, &tau_m, |_| true).expect("accepted");
        Shown::from(&Command::at_rest(&q))
    }

    fn ledger(&self) -> &Ledger<1> {
        self.0.ledger()
    }
}

/// What a tick shows, as numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Shown {
    q_d: f64,
    dq_d: f64,
    q_n: f64,
    dq_n: f64,
    e_nr: f64,
    saturated: bool,
    held: bool,
}

impl From<&Command<1>> for Shown {
    fn from(Command { q_d, dq_d, tick }: &Command<1>) -> Self {
        Self {
            q_d: q_d.x,
            dq_d: dq_d.x,
            q_n: tick.q_n.x,
            dq_n: tick.dq_n.x,
            e_nr: tick.e_nr.x,
            saturated: tick.saturated,
            held: tick.held,
        }
    }
}

fn with(settings: Settings, gains: Gains) -> OneServo {
    let reach = Reach::default();
    OneServo(Servo::new(settings, [gains], &reach).expect("valid parameters"))
}

fn servo(law: Law, gains: Gains) -> OneServo {
    with(
        Settings {
            law,
            T,
            ..Settings::default()
        },
        gains,
    )
}

/// A drive with the law's own loop, nearly continuous, on a mass. Returns its mean force over the sample.
fn drive(mass: &mut Mass, tick: &Shown, gains: &Gains, f_h: f64) -> f64 {
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
        G = law.ledger().G();
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
        assert!(law.ledger().tank() >= 10.0 - 1e-12); // rounding of 1e4 samples of some 1e-3 J
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
        Servo::new(settings, [gains], &Reach::default())
            .expect_err("no form")
            .to_string(),
        "law = 2 (passive) has no servo form: expected 1 (standard), 3 (passive_applied), 4 (passive_bounded)"
    );
}

#[test]
fn the_drives_gains_cannot_be_tuned_and_a_heavier_nominal_is_slowed() {
    let gains = unlimited(5.0, 0.5, 30.0, 10.0);
    let names = ["K", "K_P", "f_max"];
    let at_once = Settings {
        law: Law::PassiveApplied,
        T,
        tuning_time: 0.0,
        ..Settings::default()
    };
    let mut law = with(at_once, gains);
    for _ in 0..100 {
        law.step(0.0, 3.0, 0.0);
    }
    let before = law;
    let refusal = law
        .0
        .tune([Gains { K: 60.0, ..gains }], names)
        .expect_err("the drive's");
    assert_eq!(
        refusal.to_string(),
        "K = 60: expected the value at the start, in servo form the drive has it too"
    );
    assert_eq!(law, before);
    let heavier = Gains { M_n: 20.0, ..gains };
    law.0.tune([heavier], names).expect("the law's own");
    let (mut tuned, mut untuned) = (law, before);
    let (slow, fast) = (tuned.step(0.0, 0.0, 0.0), untuned.step(0.0, 0.0, 0.0));
    assert!((slow.dq_n / fast.dq_n - 0.5).abs() < 1e-15); // M_n v_n² is kept
    assert!(tuned.ledger().G() <= untuned.ledger().G() + 1e-15);

    // Over the tuning time it is slowed as much, in steps.
    let slowly = Settings {
        tuning_time: 0.1,
        ..at_once
    };
    let mut law = with(slowly, gains);
    for _ in 0..100 {
        law.step(0.0, 3.0, 0.0);
    }
    let before = law.step(0.0, 0.0, 0.0).dq_n;
    law.0.tune([heavier], names).expect("the law's own");
    let after = (0..51)
        .map(|_| law.step(0.0, 0.0, 0.0).dq_n)
        .collect::<Vec<_>>();
    let largest = after.windows(2).map(|v| v[0] - v[1]).fold(0.0, f64::max);
    assert!((after[50] / before - 0.5).abs() < 0.01, "{after:?}"); // D_n takes 0.5 % in 0.1 s
    assert!(largest < 0.05 * before);
}

#[test]
fn out_of_the_loop_the_drive_is_told_to_stand_still() {
    let mut law = servo(Law::PassiveBounded, unlimited(5.0, 0.5, 30.0, 10.0));
    for k in 0..100 {
        law.step(1e-4 * f64::from(k), 3.0, 1.0);
    }
    let stored = law.ledger().H();
    let G = law.ledger().G();
    let tick = law.rest(0.0099, 0.0);
    assert_eq!((tick.q_d, tick.dq_d, tick.e_nr), (0.0099, 0.0, 0.0));
    assert!(stored > 0.0 && law.ledger().H() == 0.0 && law.ledger().G() < G);
    assert_eq!(law.step(0.02, 0.0, 5.0).q_n, 0.02);
}

/// The robot at a wall, pressed for 3 s and pulled from then on, by a drive with `gains`; returns the time from the pull to
/// 1 mm off the wall (s), with what the law says of the drive.
fn off_the_wall(gains: Gains, measured: impl Fn(f64) -> f64) -> (Option<f64>, i32) {
    let bounded = Gains {
        f_max: 12.5,
        ..unlimited(5.0, 0.5, 30.0, 10.0)
    };
    let mut law = servo(Law::PassiveBounded, bounded);
    let mut mass = Mass::new(6.0);
    let (mut tau_m, mut fault) = (0.0, 0);
    for k in 0..10_000 {
        let f_h = if k < 1500 { 5.0 } else { -5.0 };
        let tick = law.step(mass.q, f_h, measured(tau_m));
        fault = law.0.feedback().number();
        tau_m = drive(&mut mass, &tick, &gains, f_h);
        if mass.q > 0.0 {
            (mass.q, mass.dq) = (0.0, 0.0); // an inelastic wall
        }
        if k >= 1500 && mass.q < -1e-3 {
            return (Some(f64::from(k - 1500) * T), fault);
        }
    }
    (None, fault)
}

#[test]
fn a_drive_that_is_not_quite_the_law_lets_go_of_a_wall_all_the_same() {
    let exact = Gains {
        f_max: 12.5,
        ..unlimited(5.0, 0.5, 30.0, 10.0)
    };
    let (release, _) = off_the_wall(exact, |tau| tau);
    let release = release.expect("an exact drive lets go");
    assert!((0.1..0.5).contains(&release), "{release}");
    for off in [-0.1, -0.03, -0.01, -0.003, 0.003, 0.01, 0.03, 0.1] {
        let part = 1.0 + off;
        let drives = [
            Gains {
                K: 30.0 * part,
                ..exact
            },
            Gains {
                K_P: 10.0 * part,
                ..exact
            },
            Gains {
                f_max: 12.5 * part,
                ..exact
            },
        ];
        for gains in drives {
            let (time, fault) = off_the_wall(gains, |tau| tau);
            let time = time.unwrap_or(f64::INFINITY);
            assert!(
                (time - release).abs() < 0.1 * release,
                "{gains:?}: {time}, {release}"
            );
            assert_eq!(fault, 0, "{gains:?}");
        }
        let (time, fault) = off_the_wall(exact, |tau| tau * part);
        let time = time.unwrap_or(f64::INFINITY);
        assert!(
            (time - release).abs() < 0.1 * release,
            "measured × {part}: {time}, {release}"
        );
        assert_eq!(fault, 0);
    }
}

#[test]
fn a_measured_force_that_is_missing_or_has_the_wrong_sign_is_named() {
    let exact = Gains {
        f_max: 12.5,
        ..unlimited(5.0, 0.5, 30.0, 10.0)
    };
    assert_eq!(off_the_wall(exact, |_| 0.0).1, 1);
    assert_eq!(off_the_wall(exact, |tau| -tau).1, 2);
    assert_eq!(off_the_wall(exact, |tau| 0.1 * tau).1, 1);
    // A drive that is switched off while the law runs: it gives nothing, and says so.
    let off = Gains {
        f_max: 1e-9,
        ..exact
    };
    assert_eq!(off_the_wall(off, |tau| tau).1, 1);
}

#[test]
fn limits_of_the_nominal_are_kept_in_what_the_drive_is_told() {
    let gains = unlimited(5.0, 0.5, 300.0, 10.0);
    let mut law = servo(Law::PassiveBounded, gains);
    let bounds = Bounds {
        speed: 0.2,
        q_min: -1.0,
        q_max: 0.1,
    };
    law.0.bound([bounds]).expect("a box");
    let mut mass = Mass::new(6.0);
    let (mut tau_m, mut fastest, mut furthest, mut held) = (0.0, 0.0_f64, 0.0_f64, false);
    for _ in 0..2000 {
        let tick = law.step(mass.q, 20.0, tau_m);
        fastest = fastest.max(tick.dq_d.abs());
        furthest = furthest.max(tick.q_d);
        held |= tick.held;
        tau_m = drive(&mut mass, &tick, &gains, 20.0);
    }
    assert!(held && fastest <= 0.2 && fastest > 0.19, "{fastest}");
    assert!(furthest <= 0.1 + 1e-15 && furthest > 0.0999, "{furthest}");
    assert!(law.ledger().tank() >= 10.0 - 1e-12); // bounds only take
    // And it holds: the command stands still, whoever pushes.
    let hold = Request {
        hold: true,
        ..Request::default()
    };
    let told = law.tick(mass.q, -30.0, tau_m, &hold);
    assert_eq!((told.dq_d, told.held), (0.0, true));
}

/// In debt the drive is told to stand still, and the human's work on the nominal repays: with a robot that stands still,
/// (K/alpha) f_h² T/(2 M_n/T + D_n) a sample.
#[test]
fn a_debt_has_the_drive_stand_still_and_the_hand_repays_it() {
    let gains = Gains {
        f_max: 12.5,
        ..unlimited(5.0, 0.5, 30.0, 10.0)
    };
    let settings = Settings {
        E_0: 0.0,
        T,
        ..Settings::default()
    };
    let mut law = with(settings, gains);
    law.step(0.0, 0.0, 0.0);
    // The drive pushes 12.5 N over 0.1 mm, for which nobody has paid.
    let told = law.step(1e-4, 3.0, 12.5);
    assert!(law.ledger().is_in_debt());
    assert!((law.ledger().tank() + 12.5e-4).abs() < 1e-15);
    assert_eq!((told.q_d, told.dq_d), (1e-4, 0.0));
    let (mut debt, mut ticks) = (12.5e-4, 0);
    while law.ledger().is_in_debt() {
        law.step(1e-4, 3.0, 0.0);
        debt -= 30.0 * 9.0 * T / (2.0 * 5.0 / T + 0.5);
        ticks += 1;
        assert!((law.ledger().tank() + debt).abs() < 1e-12 || debt < 0.0);
    }
    assert_eq!(ticks, 12); // 1.25 mJ at .108 mJ a sample
    assert!(law.step(1e-4, 3.0, 0.0).dq_d > 0.0);
}
