//! Random call sequences on one FMU, for `cargo xtask fuzz` and for memcheck.
//!
//! ```text
//! call_sequences --fmu NAME [--calls N] [--seed S]
//! call_sequences --fmu NAME --replay N,N,…
//! ```
//!
//! A quarter as many calls are played by FMI 3.0 afterwards, each beside its like of FMI 2.0 (`abi::fmi3::mirror`).
//!
//! Exit code 0, or 1 with the shortest failing sequence and how to play it again on stderr.

use abi::Fmu;
use abi::sequence::search::{Finding, search, tried};
use abi::sequence::{Subject, Tally};
use std::io::{IsTerminal as _, Write as _};
use std::process::ExitCode;

const USAGE: &str = "usage: call_sequences --fmu NAME [--calls N] [--seed S] [--replay N,N,…]";

/// The command line.
#[derive(Debug)]
struct Arguments {
    fmu: String,
    calls: u64,
    seed: u64,
    replay: Option<Vec<u32>>,
}

impl Arguments {
    fn parse(mut words: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut arguments = Self {
            fmu: String::new(),
            calls: 20_000,
            seed: 1,
            replay: None,
        };
        while let Some(option) = words.next() {
            let value = words
                .next()
                .ok_or_else(|| format!("{option} needs a value\n{USAGE}"))?;
            let wrong = |_| format!("{option} {value}: expected whole numbers\n{USAGE}");
            match option.as_str() {
                "--fmu" => arguments.fmu = value,
                "--calls" => arguments.calls = value.parse().map_err(wrong)?,
                "--seed" => arguments.seed = value.parse().map_err(wrong)?,
                "--replay" => {
                    let numbers: Result<_, _> = value.split(',').map(str::parse).collect();
                    arguments.replay = Some(numbers.map_err(wrong)?);
                }
                _ => return Err(format!("unknown option {option}\n{USAGE}")),
            }
        }
        let names = fmus::NAMES;
        if arguments.fmu == "Lag" || names.contains(&arguments.fmu.as_str()) {
            return Ok(arguments);
        }
        let names = names.join(", ");
        Err(format!(
            "--fmu {}: expected Lag, {names}\n{USAGE}",
            arguments.fmu
        ))
    }
}

/// A bar on a terminal, nothing elsewhere.
struct Bar<'a> {
    name: &'a str,
    total: u64,
    shown: u64,
}

impl Bar<'_> {
    fn show(&mut self, done: u64) {
        let percent = 100 * done.min(self.total) / self.total.max(1);
        let mut err = std::io::stderr();
        if percent == self.shown || !err.is_terminal() {
            return;
        }
        self.shown = percent;
        let (full, name) = (percent as usize / 4, self.name);
        let end = if percent == 100 { "\n" } else { "" };
        // A bar that cannot be shown is no failure.
        let _ = write!(
            err,
            "\r{name:<18} [{:<25}] {percent:>3} %{end}",
            "#".repeat(full)
        );
    }
}

fn run(arguments: &Arguments) -> Result<Tally, String> {
    let subject = Subject::new(Fmu::named(&arguments.fmu));
    if let Some(numbers) = &arguments.replay {
        return tried(&subject, numbers);
    }
    let mut bar = Bar {
        name: &arguments.fmu,
        total: arguments.calls,
        shown: 0,
    };
    let tally = search(&subject, arguments.calls, arguments.seed, |done| {
        bar.show(done);
    })
    .map_err(|finding: Finding| finding.report(&subject, arguments.seed))?;
    let fmi3 = abi::fmi3::Fmu::new(Fmu::named(&arguments.fmu));
    let played = abi::fmi3::mirror::play(&fmi3, arguments.calls / 4, arguments.seed)?;
    println!(
        "{}: {} calls by FMI 3.0 as by FMI 2.0, {} of them accepted, {} steps failed",
        arguments.fmu, played.calls, played.accepted, played.broken
    );
    Ok(tally)
}

fn main() -> ExitCode {
    let arguments = match Arguments::parse(std::env::args().skip(1)) {
        Ok(arguments) => arguments,
        Err(reason) => {
            eprintln!("call_sequences: {reason}");
            return ExitCode::FAILURE;
        }
    };
    match run(&arguments) {
        Ok(tally) => {
            println!(
                "{}: {} calls as expected, {} of them accepted, {} steps failed, {} states restored; seed {}",
                arguments.fmu,
                tally.calls,
                tally.accepted,
                tally.broken,
                tally.restored,
                arguments.seed
            );
            ExitCode::SUCCESS
        }
        Err(report) => {
            eprintln!("{report}");
            ExitCode::FAILURE
        }
    }
}
