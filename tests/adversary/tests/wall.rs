//! The wall experiment of docs/specification.md section 5 with the second writing of the law: what the two wrong
//! readings of `passive_bounded` do, without a budget that could hide it.
#![allow(non_snake_case, reason = "the paper's symbols")]

use admittance::{Bounds, Gains, Reach, Settings};
use adversary::plain::{FEELS_THE_DEMAND, NO_BUDGET, NO_RESET, NO_SLIP, Plain};
use adversary::subject::{Setup, Subject};

const T: f64 = 0.002;
const WALL: f64 = 0.3;

/// What came of the experiment.
struct Run {
    /// s
    release_delay: f64,
    /// max G, J
    created: f64,
}

/// 4.17 N at 0.31 Hz to 10 s, then 5 N by a ramp of 0.5 s, from 20 s on to −5 N within 0.5 s.
fn f_h(t: f64) -> f64 {
    if t < 10.0 {
        4.17 * (core::f64::consts::TAU * 0.31 * t).sin()
    } else {
        5.0 * ((t - 10.0) / 0.5).min(1.0) - 10.0 * ((t - 20.0) / 0.5).clamp(0.0, 1.0)
    }
}

fn testbed(M_n: f64, D_n: f64) -> Setup<1> {
    Setup {
        settings: Settings::default(),
        gains: [Gains {
            M_n,
            D_n,
            K: 30.0,
            K_P: 10.0,
            f_max: 12.5,
        }],
        bounds: [Bounds::default()],
        reach: Reach::default(),
        rate: f64::INFINITY,
        tau_max: f64::INFINITY,
        clip: false,
        lag: 1.0,
    }
}

/// The testbed: 6 kg, 0.64 N of dry friction, 0.19 N·s/m, a wall of 1e5 N/m and 300 N·s/m.
fn run<const OFF: u16>(M_n: f64, D_n: f64) -> Run {
    let mut law = Plain::<OFF>::build(&testbed(M_n, D_n)).expect("valid");
    let (M, dt) = (6.0, T / 25.0);
    let (mut q, mut v) = (0.0_f64, 0.0_f64);
    let (mut release, mut created) = (None, f64::MIN);
    for k in 0..30_000 {
        let t = T * f64::from(k);
        let human = f_h(t);
        let seen = law.step(q, human, 1.0);
        created = created.max(seen.G);
        if release.is_none() && t > 20.25 && q < WALL - 1e-3 {
            release = Some(t - 20.25);
        }
        for _ in 0..25 {
            let contact = if q > WALL {
                (1e5 * (q - WALL) + 300.0 * v).max(0.0)
            } else {
                0.0
            };
            v += dt / M * (seen.tau.x + human - contact - 0.19 * v);
            let friction = dt / M * 0.64;
            v = if v.abs() <= friction {
                0.0
            } else {
                v - friction * v.signum()
            };
            q += dt * v;
        }
    }
    Run {
        release_delay: release.unwrap_or(f64::INFINITY),
        created,
    }
}

const CASES: [(f64, f64, f64); 4] = [
    (0.1, 0.5, 0.092),
    (5.0, 0.5, 0.332),
    (5.0, 5.0, 0.342),
    (10.0, 0.5, 0.434),
];

/// The figures of docs/specification.md section 5, wall, to its tolerance.
#[test]
fn the_second_writing_lets_go_of_the_wall_when_the_specification_says() {
    for (M_n, D_n, expected) in CASES {
        let run = run::<0>(M_n, D_n);
        assert!(
            (run.release_delay - expected).abs() <= 0.03,
            "({M_n}, {D_n}): {} s",
            run.release_delay
        );
        assert!(run.created <= 1e-9, "{} J", run.created); // rounding of 30,000 samples of some 1 J
    }
}

/// docs/specification.md section 1: 0.2 to 6 s.
#[test]
fn without_the_reset_the_robot_sticks_to_the_wall() {
    let delays = CASES.map(|(M_n, D_n, expected)| {
        let run = run::<{ NO_RESET | NO_BUDGET }>(M_n, D_n);
        println!(
            "({M_n}, {D_n}): {} s instead of {expected} s",
            run.release_delay
        );
        (run.release_delay, expected)
    });
    assert!(
        delays
            .iter()
            .all(|(delay, expected)| delay >= &(expected - 0.03))
    );
    let longest = delays
        .iter()
        .fold(0.0, |most, (delay, _)| f64::max(most, *delay));
    assert!(longest > 2.0, "{longest} s");
}

/// max G, J, in 16 s with the limit 5 N, the robot at `q(t)` and the human's force `f_h(t)`.
fn created<const OFF: u16>(q: fn(f64) -> f64, f_h: fn(f64) -> f64) -> f64 {
    let mut setup = testbed(5.0, 0.5);
    setup.gains[0].f_max = 5.0;
    let mut law = Plain::<OFF>::build(&setup).expect("valid");
    (0..8000)
        .map(|k| T * f64::from(k))
        .map(|t| law.step(q(t), f_h(t), 1.0).G)
        .fold(f64::MIN, f64::max)
}

/// What one sample of at most 5 m/s² may create while dissipation has not begun: K a²T³ (¼ + ½ K_P T), J.
const A_START: f64 = 30.0 * 25.0 * T * T * T * (0.25 + 0.5 * 10.0 * T);

/// Moved 0.4 m there and back at 0.8 Hz while the human presses: what the budget would have to pay for all the time.
#[test]
fn a_spring_that_does_not_slip_creates_energy_when_stretched() {
    let q = |t: f64| 0.2 * (1.0 - (5.0 * t).cos());
    let f_h = |t: f64| 8.0 * (0.5 * t).sin();
    let [right, wrong] = [
        created::<NO_BUDGET>(q, f_h),
        created::<{ NO_SLIP | NO_BUDGET }>(q, f_h),
    ];
    println!("{right} J; no slip: {wrong} J");
    assert!(right <= A_START, "{right} J");
    assert!(wrong > 1.0, "{wrong} J");
}

/// Dragged away at 2 m/s while the human holds against it with 1 N. With w = v_n − dq the wrong reading creates
/// (f − K y) dq − K w² − (K/alpha) D_n v_n² in a second, and there y = (f_h − D_n v_n)/alpha, w = y − f_max/K.
#[test]
fn a_nominal_that_feels_the_demand_creates_energy_when_dragged() {
    let q = |t: f64| -2.0 * (t + (-t).exp() - 1.0);
    let [right, wrong] = [
        created::<NO_BUDGET>(q, |_| 1.0),
        created::<{ FEELS_THE_DEMAND | NO_BUDGET }>(q, |_| 1.0),
    ];
    println!("{right} J; feels the demand: {wrong} J");
    assert!(right <= A_START, "{right} J");
    assert!(wrong > 50.0, "{wrong} J");
}
