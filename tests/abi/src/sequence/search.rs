//! Many sequences from one seed, and the shortest one that fails.

use super::{Subject, Tally, decode, play};
use std::fmt::Write as _;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Calls of one sequence.
pub const LENGTH: usize = 400;

/// A sequence that does not do what it should.
#[derive(Clone, Debug)]
pub struct Finding {
    /// Which sequence of the seed it was.
    pub sequence: u64,
    /// What was not as it should be, of the shortest sequence.
    pub what: String,
    /// The shortest sequence that still fails.
    pub numbers: Vec<u32>,
}

impl Finding {
    /// The finding with its calls and how to see it again.
    pub fn report(&self, subject: &Subject, seed: u64) -> String {
        let name = &subject.fmu.name;
        let mut text = format!(
            "{name}: sequence {} of seed {seed}, shortened to {} calls: {}\n",
            self.sequence,
            self.numbers.len(),
            self.what
        );
        for &number in &self.numbers {
            let (instance, call) = decode(number, subject);
            let _ = writeln!(text, "  instance {instance}: {call:?}");
        }
        let numbers: Vec<_> = self.numbers.iter().map(u32::to_string).collect();
        let _ = write!(
            text,
            "again: cargo xtask fuzz --fmu {name} --replay {}",
            numbers.join(",")
        );
        text
    }
}

/// The numbers of one sequence of a seed (splitmix64, so that a sequence needs none of those before it).
pub fn numbers(seed: u64, sequence: u64, length: usize) -> Vec<u32> {
    let mut state = seed ^ sequence.wrapping_mul(0xd134_2543_de82_ef95);
    std::iter::repeat_with(|| {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z >> 32) as u32
    })
    .take(length)
    .collect()
}

/// Plays about `calls` calls, a whole number of sequences; `progress` sees the calls so far.
///
/// # Errors
/// The first finding, shortened.
pub fn search(
    subject: &Subject,
    calls: u64,
    seed: u64,
    mut progress: impl FnMut(u64),
) -> Result<Tally, Finding> {
    let mut tally = Tally::default();
    for sequence in 0..calls.div_ceil(LENGTH as u64) {
        let numbers = numbers(seed, sequence, LENGTH);
        match tried(subject, &numbers) {
            Ok(one) => tally.add(&one),
            Err(what) => {
                let (numbers, what) =
                    shortened(numbers, what, |numbers| tried(subject, numbers).err());
                return Err(Finding {
                    sequence,
                    what,
                    numbers,
                });
            }
        }
        progress(tally.calls);
    }
    Ok(tally)
}

/// Plays a sequence; a panic of a check is a finding too.
///
/// # Errors
/// What was not as it should be.
pub fn tried(subject: &Subject, numbers: &[u32]) -> Result<Tally, String> {
    catch_unwind(AssertUnwindSafe(|| play(subject, numbers))).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().cloned();
        Err(text.unwrap_or_else(|| "a check panicked".into()))
    })
}

/// Leaves out calls, in chunks of half the length down to single ones, as long as what is left still fails.
fn shortened(
    mut numbers: Vec<u32>,
    mut what: String,
    fails: impl Fn(&[u32]) -> Option<String>,
) -> (Vec<u32>, String) {
    let mut chunk = numbers.len().div_ceil(2);
    loop {
        let (mut at, length) = (0, numbers.len());
        while at < numbers.len() {
            let mut fewer = numbers.clone();
            fewer.drain(at..(at + chunk).min(numbers.len()));
            match fails(&fewer) {
                Some(reason) => (numbers, what) = (fewer, reason),
                None => at += chunk,
            }
        }
        if chunk == 1 && numbers.len() == length {
            return (numbers, what);
        }
        chunk = chunk.div_ceil(2);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failing_sequence_is_shortened_to_the_calls_that_matter() {
        let sum = |numbers: &[u32]| {
            let (has_7, has_9) = (numbers.contains(&7), numbers.contains(&9));
            (has_7 && has_9).then(|| format!("{} left", numbers.len()))
        };
        let all: Vec<u32> = (0..100).collect();
        let (numbers, what) = shortened(all, "100 left".into(), sum);
        assert_eq!((numbers, what.as_str()), (vec![7, 9], "2 left"));
    }

    #[test]
    fn a_sequence_is_drawn_from_seed_and_position_alone() {
        assert_eq!(numbers(1, 5, 10), numbers(1, 5, 20)[..10]);
        assert_ne!(numbers(1, 5, 10), numbers(1, 6, 10));
        assert_ne!(numbers(1, 5, 10), numbers(2, 5, 10));
    }
}
