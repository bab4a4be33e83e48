//! The claims, attacked: for every motion within the reach the tank stays ≥ 0, and no more energy leaves the controller than
//! came in, plus E_0. The bounds are in units of what rounding may take, see `trial`.

use adversary::attack::{Attack, TARGETS};
use adversary::regressions;
use adversary::trial::Outcome;

fn judge(attack: &Attack, outcome: &Outcome) {
    assert!(
        !outcome.is_broken(),
        "{attack}\n{outcome:#?}\n{}",
        attack.describe()
    );
}

#[test]
fn attacks_that_once_broke_a_law_break_it_no_more() {
    let stored = regressions::stored().expect("attacks, one a line");
    assert!(stored.len() > 10);
    for (line, attack) in stored {
        println!("line {line}");
        judge(&attack, &attack.run().0);
    }
}

/// Each of 300 seeds on each target; the budget acts in half of them.
#[test]
fn random_attacks_do_not_empty_the_tank() {
    let mut limited = 0;
    for target in TARGETS {
        for seed in 0..300 {
            let attack = Attack::new(target, seed);
            let (outcome, _) = attack.run();
            judge(&attack, &outcome);
            limited += u32::from(outcome.limited > 0);
        }
    }
    assert!(limited > 400, "the budget acted in {limited} of 1500 only");
}

/// From 15 starts on each target, 40 mutations each, towards an emptier tank and a greater rounding.
#[test]
fn attacks_that_are_bred_do_not_empty_the_tank_below_zero() {
    let mut emptied = 0;
    for target in TARGETS {
        for seed in 1_000_000..1_000_015 {
            let best = Attack::new(target, seed).climbed(40, |attack, outcome| {
                judge(attack, outcome);
                true
            });
            let (_, score) = best.run();
            emptied += u32::from(score >= 1.0);
        }
    }
    assert!(emptied > 30, "{emptied} of 75 climbs emptied the tank");
}
