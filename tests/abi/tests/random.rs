//! Random call sequences ([`abi::sequence`]): a million calls on the test model, 100,000 on every FMU. More, and under
//! memcheck: `cargo xtask fuzz`, and the stage `memcheck` of `cargo xtask test`.

use abi::Fmu;
use abi::sequence::search::search;
use abi::sequence::{Subject, Tally};

/// Plays the calls and shows what failed, if anything.
fn played(fmu: Fmu, calls: u64, seed: u64) -> Tally {
    let subject = Subject::new(fmu);
    search(&subject, calls, seed, |_| {})
        .unwrap_or_else(|finding| panic!("{}", finding.report(&subject, seed)))
}

/// Asserts that a tally has enough of everything that is to be tried.
fn all_was_tried(name: &str, tally: &Tally) {
    let share = |n: u64| n as f64 / tally.calls as f64;
    let phases = tally.phases.map(share);
    // The human's hand is off at the start, and then no input makes a step fail: tests/legality.rs switches it on.
    let breakable = name != "HumanOperator";
    let tried = if breakable { &phases[..] } else { &phases[..4] };
    assert!(tried.iter().all(|&p| p > 0.02), "{name}: {phases:?}");
    let accepted = share(tally.accepted);
    assert!((0.2..0.8).contains(&accepted), "{name}: {tally:?}");
    assert!(tally.restored > 0, "{name}: {tally:?}");
    assert!(tally.broken > 0 || !breakable, "{name}: {tally:?}");
    // What only the model can object to is the exception, so that nearly every status is forecast.
    assert!(share(tally.objected) < 0.02, "{name}: {tally:?}");
}

#[test]
fn a_million_calls_on_the_test_model_do_what_the_table_forecasts() {
    let tally = played(Fmu::lag(), 1_000_000, 20_051);
    assert_eq!(tally.calls, 1_000_000);
    all_was_tried("Lag", &tally);
}

#[test]
fn random_calls_on_every_fmu_do_what_the_table_forecasts() {
    for fmu in Fmu::products() {
        let name = fmu.name.clone();
        all_was_tried(&name, &played(fmu, 100_000, 20_052));
    }
}
