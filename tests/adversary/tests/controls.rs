//! Negative controls: the same adversary beats the laws that make no such promise, and ours with a part left out. What it
//! cannot beat is said, and why.
#![allow(non_snake_case, reason = "the paper's symbols")]

use admittance::{Admittance, Bounds, Gains, Law, ParameterError};
use adversary::case::Case;
use adversary::genes::Genes;
use adversary::plain::{
    BRAKING_PAYS, EULER, FEELS_THE_DEMAND, NO_BUDGET, NO_LOOK_AHEAD, NO_RESERVE, NO_RESET,
    NO_SETTLING, NO_SLIP, Plain,
};
use adversary::subject::{Order, Seen, Setup, Subject};
use adversary::trial::{self, Outcome};
use nalgebra::Vector1;

/// The case of a seed without commands, bounds and rates, which [`Plain`] does not know.
fn bare(seed: u64) -> Case<1> {
    let mut case = Case::new(&Genes::new(seed));
    case.events = [0.0; 5];
    case.setup.bounds = [Bounds::default()];
    case.setup.rate = f64::INFINITY;
    case.setup.lag = 1.0;
    case.jitter = 0.0;
    case
}

/// The cases of 300 seeds in which the law loses more than rounding, a millionth of E_0 that is: how many, and the worst loss
/// as a multiple of E_0.
fn beaten<S: Subject<1>>(change: impl Fn(&mut Case<1>)) -> (u32, f64) {
    (0..300).fold((0, 0.0), |(count, worst), seed| {
        let mut case = bare(seed);
        case.setup.settings.E_0 = case.setup.settings.E_0.max(1e-9);
        change(&mut case);
        let outcome: Outcome = trial::run::<1, S>(&case, 500);
        let loss = -outcome.least_tank / case.setup.settings.E_0;
        let lost = loss > 1e-6 && outcome.tank_in_roundings > 1e3;
        (
            count + u32::from(lost),
            f64::max(worst, if lost { loss } else { 0.0 }),
        )
    })
}

fn shown(name: &str, (count, worst): (u32, f64)) -> u32 {
    println!("{name}: {count} of 300 cases, at worst {worst:.3} E_0 below zero");
    count
}

#[test]
fn the_second_writing_of_the_law_is_not_beaten_and_is_the_law() {
    assert_eq!(shown("complete", beaten::<Plain<0>>(|_| ())), 0);
    // Force by force the same up to rounding, as long as neither has had to act on the tank's last digits.
    let mut compared = 0;
    for seed in 0..100 {
        let case = bare(seed);
        let mut plain = Plain::<0>::build(&case.setup).expect("valid");
        let mut law = <Admittance<1> as Subject<1>>::build(&case.setup).expect("valid");
        let order = adversary::subject::Order::Run(admittance::Request::default());
        let step = case.setup.reach.v_max.x * case.setup.settings.T;
        for k in 0..300 {
            let t = f64::from(k);
            let q = nalgebra::Vector1::new(step * 20.0 * (0.04 * t).sin());
            let f_h = nalgebra::Vector1::new(case.force.min(1e3) * (0.01 * t).sin());
            let (a, b) = (
                plain.tick(&q, &f_h, &order),
                Subject::tick(&mut law, &q, &f_h, &order),
            );
            if b.share < 1.0 || b.tank < 1e-3 * case.setup.settings.E_0 {
                break;
            }
            let scale =
                1e-9 * (a.tau.amax() + case.setup.gains[0].K * step / case.setup.settings.T);
            assert!(
                (a.tau - b.tau).amax() <= scale,
                "seed {seed}, tick {k}: {} {}",
                a.tau,
                b.tau
            );
            compared += 1;
        }
    }
    assert!(compared > 3000, "{compared} ticks compared");
}

#[test]
fn without_the_budget_the_law_is_beaten() {
    assert!(shown("no budget", beaten::<Plain<NO_BUDGET>>(|_| ())) > 100);
}

#[test]
fn without_looking_ahead_the_law_is_beaten() {
    assert!(shown("no look-ahead", beaten::<Plain<NO_LOOK_AHEAD>>(|_| ())) > 100);
}

#[test]
fn without_settling_the_law_is_beaten() {
    assert!(shown("no settling", beaten::<Plain<NO_SETTLING>>(|_| ())) > 30);
}

#[test]
fn a_law_that_does_not_know_of_its_delay_is_beaten() {
    // Told of no delay, its force works one sample later all the same: the ledger is right, the look-ahead is not.
    let delayed = |case: &mut Case<1>| case.setup.settings.delayed = true;
    assert!(shown("no reserve", beaten::<Plain<NO_RESERVE>>(delayed)) > 30);
    assert!(shown("braking pays", beaten::<Plain<BRAKING_PAYS>>(delayed)) > 5);
    assert_eq!(shown("complete, delayed", beaten::<Plain<0>>(delayed)), 0);
}

/// A law that takes the delay for a whole sample, as it is without [`Admittance::lag`].
#[derive(Clone, Copy, Debug)]
struct Untold(Admittance<1>);

impl Subject<1> for Untold {
    fn build(setup: &Setup<1>) -> Result<Self, ParameterError> {
        let whole = Setup { lag: 1.0, ..*setup };
        <Admittance<1> as Subject<1>>::build(&whole).map(Self)
    }

    fn home() -> Vector1<f64> {
        <Admittance<1> as Subject<1>>::home()
    }

    fn tick(&mut self, q: &Vector1<f64>, f_h: &Vector1<f64>, order: &Order<1>) -> Seen<1> {
        Subject::tick(&mut self.0, q, f_h, order)
    }

    fn acts(&mut self, _: &Vector1<f64>) {}

    fn tune(&mut self, gains: [Gains; 1]) -> Result<(), ParameterError> {
        Subject::tune(&mut self.0, gains)
    }
}

/// The cases in which more energy leaves the law than E_0, by the audit.
fn gave_out<S: Subject<1>>(change: impl Fn(&mut Case<1>)) -> u32 {
    let gives = |seed| {
        let mut case = bare(seed);
        case.setup.settings.E_0 = case.setup.settings.E_0.max(1e-9);
        change(&mut case);
        let outcome: Outcome = trial::run::<1, S>(&case, 500);
        outcome.energy_in_roundings > 1e3
    };
    (0..300).map(|seed| u32::from(gives(seed))).sum()
}

#[test]
fn a_law_that_takes_half_a_sample_of_delay_for_a_whole_one_is_beaten() {
    let half = |case: &mut Case<1>| (case.setup.settings.delayed, case.setup.lag) = (true, 0.5);
    let (untold, told) = (gave_out::<Untold>(half), gave_out::<Admittance<1>>(half));
    println!("half a sample of delay: untold {untold} of 300, told {told}");
    assert!(untold > 30, "{untold}");
    assert_eq!(told, 0);
    assert_eq!(shown("told", beaten::<Admittance<1>>(half)), 0);
}

/// The ledger never asks what dq is: a clock that tells the law nonsense costs no energy.
#[test]
fn ticks_that_are_late_or_early_do_not_beat_the_law() {
    let unsteady = |case: &mut Case<1>| case.jitter = 0.5;
    assert_eq!(gave_out::<Admittance<1>>(unsteady), 0);
    assert_eq!(shown("unsteady", beaten::<Admittance<1>>(unsteady)), 0);
}

/// The budget looks at what the nominal is said to feel: if it feels something else, the look-ahead is wrong.
#[test]
fn a_nominal_that_feels_the_demand_is_beaten_in_spite_of_the_budget() {
    assert!(
        shown(
            "feels the demand",
            beaten::<Plain<FEELS_THE_DEMAND>>(|_| ())
        ) > 30
    );
}

#[test]
fn the_paper_s_law_is_beaten_once_it_is_saturated_and_explicit_euler_always() {
    let limited = |case: &mut Case<1>| {
        case.setup.settings.law = Law::Passive;
        case.setup.gains[0].f_max = 0.1 * case.setup.gains[0].K * case.setup.reach.v_max.x;
    };
    assert!(shown("passive", beaten::<Admittance<1>>(limited)) > 100);
    assert!(shown("Euler", beaten::<Plain<{ EULER | NO_BUDGET }>>(|_| ())) > 100);
}

/// Not beaten: slip and reset only ever lower what is stored, and the budget holds whatever is stored. They are there so that
/// it hardly ever acts, and so that the robot lets go of a wall ([`wall`](crate)).
#[test]
fn without_slip_or_reset_the_budget_still_holds() {
    assert_eq!(shown("no slip", beaten::<Plain<NO_SLIP>>(|_| ())), 0);
    assert_eq!(shown("no reset", beaten::<Plain<NO_RESET>>(|_| ())), 0);
}
