//! The servo form (footnote of sec:standard_adm): with an ideal drive and motions within the reach, a tank ends a sample at most that sample's worth below
//! zero, f_max (v_max + |v_m|) T, and from there it rises. Laws without the parts that see to it are beaten.
#![allow(non_snake_case, reason = "the paper's symbols")]

use admittance::servo::Servo;
use admittance::{Axes, Bounds, Gains, Reach, Request, Settings};
use adversary::case::Case;
use adversary::genes::Genes;
use adversary::plain_servo::{FEELS_IN_DEBT, NO_SETTLING, NO_STANDSTILL, PlainServo};
use adversary::random::Random;
use adversary::servo::{Commands, JointDrives, Shown, run, servo_case};
use adversary::subject::{Order, Setup};
use nalgebra::Vector1;

fn case<const N: usize>(seed: u64) -> Case<N> {
    servo_case(Case::new(&Genes::new(seed)))
}

fn unbroken<const N: usize, C: Commands<N>>(seeds: u64, ticks: u32) {
    unbroken_in::<N, C>(seeds, ticks, case);
}

fn unbroken_in<const N: usize, C: Commands<N>>(
    seeds: u64,
    ticks: u32,
    case: impl Fn(u64) -> Case<N>,
) {
    let (mut worst, mut rounding, mut debts) = (0.0_f64, 0.0_f64, 0);
    for seed in 0..seeds {
        let shown = run::<N, C>(&case(seed), ticks);
        assert!(!shown.is_broken(), "seed {seed}: {shown:?}");
        worst = worst.max(shown.tank_in_worths);
        rounding = rounding.max(shown.tank_in_roundings);
        debts += u32::from(shown.in_debt > 0);
    }
    println!(
        "of {seeds}: {debts} were in debt; -E up to {worst:.3} samples' worth, {rounding:.3} roundings beyond"
    );
    assert!(debts > 10, "the attacks are too weak: {debts}");
}

#[test]
fn one_axis_owes_a_sample_s_worth_at_most() {
    unbroken::<1, Servo<Axes<1>, 1>>(1500, 500);
}

#[test]
fn three_axes_under_one_tank_owe_a_sample_s_worth_at_most() {
    unbroken::<3, Servo<Axes<3>, 3>>(600, 200);
}

#[test]
fn the_arm_s_joints_owe_a_sample_s_worth_at_most() {
    let joints = |seed| {
        let mut case = case::<3>(seed);
        for i in 1..3 {
            case.setup.gains[i].K = case.setup.gains[0].K; // one number for all joints
        }
        case
    };
    unbroken_in::<3, JointDrives>(600, 200, joints);
}

/// The case of a seed without commands and bounds, which [`PlainServo`] does not know.
fn bare(seed: u64) -> Case<1> {
    let mut case = case(seed);
    case.events = [0.0; 5];
    case.setup.bounds = [Bounds::default()];
    case.setup.settings.dq_cutoff = 0.0;
    case
}

/// How many of 300 seeds have the tank more than a thousand roundings below what its sample may take it to.
fn beaten<C: Commands<1>>(name: &str) -> u32 {
    let lost = |shown: &Shown| shown.tank_in_roundings > 1e3;
    let all: Vec<Shown> = (0..300).map(|seed| run::<1, C>(&bare(seed), 500)).collect();
    let beaten = all.iter().filter(|shown| lost(shown)).count() as u32;
    let worst = all
        .iter()
        .map(|shown| shown.tank_in_worths)
        .fold(0.0, f64::max);
    println!("{name}: {beaten} of 300 cases, -E up to {worst:.1} samples' worth");
    beaten
}

#[test]
fn the_second_writing_is_not_beaten_and_is_the_law() {
    assert_eq!(beaten::<PlainServo<0>>("complete"), 0);
    let mut same = 0;
    for seed in 0..300 {
        let (a, b) = (
            run::<1, PlainServo<0>>(&bare(seed), 200),
            run::<1, Servo<Axes<1>, 1>>(&bare(seed), 200),
        );
        // Rounding decides where a motion that looks ahead turns off: what is compared is a tank that is not near that.
        let scale = 1e-9 * (a.worth + bare(seed).setup.settings.E_0);
        same += u32::from((a.least_tank - b.least_tank).abs() <= scale);
    }
    assert!(same > 280, "{same} of 300 alike");
}

#[test]
fn without_settling_the_law_is_beaten() {
    assert!(beaten::<PlainServo<NO_SETTLING>>("no settling") > 30);
}

#[test]
fn a_drive_that_goes_on_in_debt_beats_the_law() {
    assert!(beaten::<PlainServo<NO_STANDSTILL>>("no standstill") > 1);
}

#[test]
fn a_nominal_that_feels_the_drive_in_debt_is_beaten() {
    assert!(beaten::<PlainServo<FEELS_IN_DEBT>>("feels in debt") > 3);
}

/// A mass between a hand and a wall, under a drive that samples 50 times a period: tank, energy that left, the largest sample's
/// worth, and how far the ledger's work can be from the true one.
struct Run {
    least_tank: f64,
    created: f64,
    worth: f64,
    inexact: f64,
}

fn mass<C: Commands<1>>(seed: u64, E_0: f64) -> Run {
    const CYCLES: u32 = 50;
    let mut random = Random::new(seed);
    let T = random.decades(5e-4, 5e-3);
    let M = random.decades(0.2, 20.0);
    let gains = Gains {
        M_n: random.decades(0.002, 20.0).max(0.6 * T),
        D_n: random.decades(0.05, 5.0),
        K: M / T * random.decades(1e-3, 1.0),
        K_P: random.decades(0.5, 50.0),
        f_max: random.decades(5.0, 200.0),
    };
    let settings = Settings {
        T,
        E_0,
        ..Settings::default()
    };
    let dt = T / f64::from(CYCLES);
    let setup = Setup {
        settings,
        gains: [gains],
        bounds: [Bounds::default()],
        reach: Reach {
            v_max: Vector1::new(1e3),
            a_max: Vector1::new(f64::INFINITY),
        },
        rate: f64::INFINITY,
        tau_max: f64::INFINITY,
        clip: false,
        lag: 1.0,
    };
    let mut law = C::build(&setup).expect("valid");
    let (k_h, wall_k) = (
        random.decades(1.0, 1e3),
        M / (dt * dt) * random.decades(1e-5, 1e-2),
    );
    let (wall, amplitude) = (
        random.within(0.0, 0.1),
        random.decades(0.1, 2.0) * gains.f_max,
    );
    let omega = random.decades(0.5, 50.0);
    let (mut q, mut dq, mut tau_m) = (0.0_f64, 0.0_f64, 0.0);
    let mut run = Run {
        least_tank: E_0,
        created: f64::NEG_INFINITY,
        worth: 0.0,
        inexact: 0.0,
    };
    let (mut given, mut brought) = (0.0, 0.0);
    for k in 0..3000 {
        let t = f64::from(k) * T;
        let f_h = (amplitude * (omega * t).sin() - k_h * q).clamp(-amplitude, amplitude);
        let order = Order::Run(Request::default());
        let felt = Vector1::new(tau_m);
        let (told, seen) = law.tick(&Vector1::new(q), &Vector1::new(f_h), &felt, &order);
        let [q_d, dq_d] = told.map(|told| told.x);
        run.least_tank = run.least_tank.min(seen.tank);
        run.created = run.created.max(given - brought);

        // The human's port, from the nominal's equation of motion.
        let reaction = seen.felt.x / gains.K;
        let v_m = (2.0 * gains.M_n * seen.dq_n.x / T + f_h - reaction)
            / (2.0 * gains.M_n / T + gains.D_n);
        brought += gains.K * f_h * v_m * T;
        let (before, mut work) = (q, 0.0);
        tau_m = 0.0;
        for _ in 0..CYCLES {
            let tau = gains.K * ((dq_d - dq) + gains.K_P * (q_d - q));
            let tau = tau.clamp(-gains.f_max, gains.f_max);
            let contact = if q > wall { -wall_k * (q - wall) } else { 0.0 };
            dq += (tau + f_h + contact) / M * dt;
            q += dq * dt;
            work += tau * dq * dt;
            tau_m += tau / f64::from(CYCLES);
        }
        given += work;
        let worth = gains.f_max * (q - before).abs() + T * (felt.x * dq_d).abs();
        run.worth = run.worth.max(worth);
        run.inexact += (tau_m * (q - before) - work).max(0.0);
    }
    run
}

/// What the ledger counts is a mean force times a motion. It exceeds the true work where the mass accelerates within a
/// sample, K a² T³/12: that is what the tank may lack beyond a sample's worth. The energy that left is the true one.
#[test]
fn masses_at_walls_get_no_more_than_a_sample_s_worth() {
    let (mut worst, mut beaten) = (0.0_f64, 0);
    for seed in 0..80 {
        for E_0 in [0.0, 0.1] {
            let run = mass::<Servo<Axes<1>, 1>>(seed, E_0);
            let most = run.worth * (1.0 + 1e-9);
            assert!(
                run.least_tank >= -most - run.inexact,
                "seed {seed}: {}",
                run.least_tank
            );
            assert!(
                run.created <= E_0 + most,
                "seed {seed}: {}",
                run.created - E_0
            );
            worst = worst.max(-run.least_tank / run.worth);
            let run = mass::<PlainServo<NO_SETTLING>>(seed, E_0);
            beaten += u32::from(run.least_tank < -run.worth - run.inexact);
        }
    }
    println!("-E up to {worst:.3} samples' worth; without settling {beaten} of 160 are beaten");
    assert!(beaten > 4);
}
