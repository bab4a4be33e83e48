//! The clock and the ticks alone, for as many steps as nobody waits for with a model behind it.
#![allow(non_snake_case, reason = "T is the sample period of the paper")]

use super::*;
use crate::{Sample, Sampler};

/// How an importer comes to the time of the next step.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Importer {
    /// t + h
    Sums,
    /// startTime + i h
    Multiplies,
    /// startTime + i h, and as step size the difference of two of these (fmpy)
    Subtracts,
}

#[test]
fn times_of_three_hundred_digits_are_said_in_few() {
    let clock = Clock::at_start(0.0);
    assert_eq!(
        clock.step(1e300, 0.1),
        Err("expected currentCommunicationPoint 0 s, got 1e300 s".to_owned())
    );
    let late = Clock::at_start(-1e300);
    assert_eq!(
        late.step(-1e300, 1e-300),
        Err("communicationStepSize = 1e-300 s does not advance the time -1e300 s to a later finite time".to_owned())
    );
    let mut stepped = Clock::at_start(0.0);
    stepped.advance(&stepped.step(0.0, 1e300).unwrap());
    assert_eq!(
        stepped.counted("ticks", 3, 1e-3),
        Err(Refusal(
            "ticks = 3, expected 1e303 periods of 0.001 s in the 1e300 s since the start"
                .to_owned()
        ))
    );
}

/// Makes `steps` steps of `parts`/`of` periods `T` from `start_time` on and asserts after each that the samples are those
/// that whole numbers give.
fn runs(importer: Importer, start_time: f64, T: f64, [parts, of]: [u64; 2], steps: u64) {
    let h = T * parts as f64 / of as f64;
    let (mut clock, mut sampler) = (Clock::at_start(start_time), None);
    let a_sample = (of as f64 / parts as f64).round().max(1.0) as u64;
    let mut t = start_time;
    for i in 0..steps {
        let next = match importer {
            Importer::Sums => t + h,
            _ => start_time + (i + 1) as f64 * h,
        };
        let size = if importer == Importer::Subtracts {
            next - t
        } else {
            h
        };
        let step = clock
            .step(t, size)
            .unwrap_or_else(|refusal| panic!("{importer:?} from {start_time} s: {refusal}"));
        let due = (i % a_sample == 0).then_some(Sample {
            number: i / a_sample,
            after: 1.0,
        });
        let sampler = sampler.get_or_insert_with(|| Sampler::new(&step, T));
        assert_eq!(
            sampler.sample(&step),
            due,
            "{importer:?} from {start_time} s, T = {T} s, step {i} of {parts}/{of} T"
        );
        clock.advance(&step);
        t = next;
    }
    assert_eq!(clock.check(true), Ok(()));
    assert_eq!(sampler.map(|sampler| sampler.check(&clock)), Some(Ok(())));
}

#[test]
fn a_hundred_million_summed_steps_run_one_tick_each() {
    // The plain sum runs two at step 7,160,328.
    runs(Importer::Sums, 0.0, 1e-3, [1, 1], 100_000_000);
}

#[test]
fn a_hundred_million_steps_since_1970_run_one_tick_each() {
    // The sum of these times is 100 s behind at the end: 419 units of 2⁻²² s a step instead of 419.43.
    runs(Importer::Sums, 1.7e9, 1e-4, [1, 1], 100_000_000);
}

#[test]
fn steps_of_one_two_and_half_a_period_run_their_ticks_whatever_the_importer_does() {
    for start_time in [-2e9, -1.0, 0.0, 0.3, 1e5, 1.7e9, 2e9] {
        for T in [1e-4, 1e-3, 2e-3] {
            for share in [[1, 1], [2, 1], [1, 2], [10, 1], [1, 10]] {
                runs(Importer::Sums, start_time, T, share, 200_000);
                runs(Importer::Multiplies, start_time, T, share, 200_000);
            }
            runs(Importer::Subtracts, start_time, T, [1, 1], 200_000);
            runs(Importer::Subtracts, start_time, T, [2, 1], 200_000);
            runs(Importer::Subtracts, start_time, T, [1, 2], 200_000);
        }
    }
}

#[test]
fn a_step_size_that_does_not_divide_the_period_makes_a_period_of_its_own() {
    for start_time in [0.0, -1.0, 1e5] {
        for share in [[7, 10], [3, 10], [3, 2], [61, 10], [13, 100], [1000, 1]] {
            for importer in [Importer::Sums, Importer::Multiplies, Importer::Subtracts] {
                runs(importer, start_time, 1e-3, share, 200_000);
            }
        }
    }
}

#[test]
fn ten_million_multiplied_and_subtracted_steps_run_one_tick_each() {
    for importer in [Importer::Multiplies, Importer::Subtracts] {
        for (start_time, T) in [(0.0, 1e-3), (1.7e9, 1e-4), (2e9, 2e-3)] {
            runs(importer, start_time, T, [1, 1], 10_000_000);
        }
    }
}

#[test]
fn a_compensated_sum_of_steps_is_the_product() {
    let mut sum = Sum::default();
    for _ in 0..10_000_000 {
        sum.add(1e-3);
    }
    assert_eq!(sum.high, 1e-3 * 1e7);
    assert!(sum.low.abs() <= f64::EPSILON * sum.high);
}

/// A clock as bytes could bring it.
fn forged(start_time: f64, time: f64, high: f64, low: f64) -> Clock {
    Clock {
        start_time,
        time,
        elapsed: Sum { high, low },
    }
}

#[test]
fn times_that_no_steps_lead_to_are_refused_with_their_values() {
    for (clock, text) in [
        (forged(-1e6, 0.02, 0.02, 0.0), "start_time = -1000000.0 s"),
        (forged(0.0, 1e6, 0.02, 0.0), "time = 1000000.0 s"),
        (forged(f64::NAN, 0.02, 0.02, 0.0), "start_time = NaN s"),
        (forged(0.0, f64::INFINITY, 0.02, 0.0), "time = inf s"),
        (forged(0.0, 0.0, -1.0, 0.0), "elapsed = -1.0 s"),
        (forged(0.0, 0.02, f64::NAN, 0.0), "elapsed = NaN s"),
        (forged(0.0, 0.02, 0.02, 1e6), "and 1000000.0 s"),
        (forged(0.0, 0.02, 0.0, 0.0), "time = 0.02 s"),
    ] {
        let refusal = clock.check(true).expect_err(text);
        assert!(
            refusal.contains(text) && refusal.contains("expected"),
            "{refusal}"
        );
    }
    assert!(forged(0.0, 0.02, 0.02, 0.0).check(false).is_err());
    assert_eq!(forged(0.0, 0.02, 0.02, 0.0).check(true), Ok(()));
    assert_eq!(Clock::at_start(1.7e9).check(false), Ok(()));
}

#[test]
fn a_count_that_the_clock_did_not_make_is_refused_by_name() {
    let clock = forged(0.0, 0.02, 0.02, 0.0);
    assert_eq!(clock.counted("number of ticks", 20, 1e-3), Ok(()));
    for count in [0, 1_000_000, u64::MAX] {
        let Err(Refusal(text)) = clock.counted("number of ticks", count, 1e-3) else {
            panic!("{count} passed");
        };
        let named = format!("number of ticks = {count}, expected 20 periods of 0.001 s");
        assert!(text.starts_with(&named), "{text}");
    }
}
