//! Commands made of stages one after the other; `cargo xtask test` and `ci` are in [`checks`](crate::checks). Each stage prints its name and its time; the first failure ends the command, unless it was
//! told to keep going.

use crate::process::{Failure, Outcome, cargo, root, run};
use crate::venv::{Packages, Venv, check_machine};
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Stages that ran, with their time and result.
struct Stages {
    keep_going: bool,
    done: Vec<(&'static str, Duration, bool)>,
}

impl Stages {
    fn new(keep_going: bool) -> Self {
        Self {
            keep_going,
            done: Vec::new(),
        }
    }

    /// Runs one stage, if none before it has stopped the command.
    fn stage<T>(&mut self, name: &'static str, work: impl FnOnce() -> Outcome<T>) -> Option<T> {
        if !self.keep_going && self.failed().next().is_some() {
            return None;
        }
        println!("\n── {name}");
        let began = Instant::now();
        let outcome = work();
        self.done.push((name, began.elapsed(), outcome.is_ok()));
        match outcome {
            Ok(value) => {
                println!("   {name}: {:.1} s", began.elapsed().as_secs_f64());
                Some(value)
            }
            Err(failure) => {
                eprintln!("   {name}: {failure}");
                None
            }
        }
    }

    fn failed(&self) -> impl Iterator<Item = &'static str> {
        self.done
            .iter()
            .filter(|(_, _, good)| !good)
            .map(|(name, _, _)| *name)
    }

    /// Prints the summary.
    fn finish(self) -> Outcome {
        println!();
        for (name, time, good) in &self.done {
            println!(
                "{} {name:<14} {:7.1} s",
                if *good { "ok    " } else { "FAILED" },
                time.as_secs_f64()
            );
        }
        let total: Duration = self.done.iter().map(|(_, time, _)| *time).sum();
        println!("       {:<14} {:7.1} s", "total", total.as_secs_f64());
        let failed: Vec<_> = self.failed().collect();
        if failed.is_empty() {
            Ok(())
        } else {
            Err(Failure::Stages(failed))
        }
    }
}

/// `cargo xtask fmu`
pub fn fmu(bless: bool) -> Outcome {
    crate::fmu::build_all(bless)
}

/// `cargo xtask ssp`
pub fn ssp() -> Outcome {
    check_machine()?;
    let mut stages = Stages::new(false);
    let venv = stages.stage("venv", || Venv::ready(Packages::Run));
    stages.stage("fmu", || crate::fmu::build_all(false));
    if let Some(venv) = venv {
        stages.stage("exo ssp", || run(&mut venv.exo(["ssp"])));
    }
    stages.finish()
}

/// `cargo xtask venv`
pub fn venv(tests: bool) -> Outcome {
    let packages = if tests { Packages::Test } else { Packages::Run };
    Venv::ready(packages).map(|_| ())
}

/// `cargo xtask reproduce`
pub fn reproduce() -> Outcome {
    check_machine()?;
    let mut stages = Stages::new(false);
    let venv = stages.stage("venv", || Venv::ready(Packages::Run));
    stages.stage("fmu", || crate::fmu::build_all(false));
    let report = root().join("results/report.html");
    let mut written = false;
    if let Some(venv) = venv {
        stages.stage("exo reproduce", || {
            // A failed verdict is an error, yet leaves its report; an old report is not this run's.
            let _ = std::fs::remove_file(&report);
            let outcome = run(&mut venv.exo(["reproduce"]));
            written = report.exists();
            outcome
        });
    }
    let outcome = stages.finish();
    if written {
        println!("\nreport: {}", report.display());
    }
    outcome
}

/// `cargo xtask bench --instructions`, `--bless`
pub fn instructions(folder: Option<PathBuf>, bless: bool) -> Outcome {
    let folder = match folder {
        Some(folder) => folder,
        None => {
            crate::fmu::build_all(false)?;
            fmus()
        }
    };
    match bless {
        true => crate::instructions::bless(&folder),
        false => crate::instructions::check(&folder),
    }
}

/// Where the built archives lie.
fn fmus() -> PathBuf {
    root().join("target/fmu")
}

/// `cargo xtask bench`
pub fn bench() -> Outcome {
    check_machine()?;
    let mut stages = Stages::new(false);
    let venv = stages.stage("venv", || Venv::ready(Packages::Test));
    stages.stage("fmu", || crate::fmu::build_all(false));
    stages.stage("instructions", || crate::instructions::check(&fmus()));
    stages.stage("cargo bench", || {
        run(&mut cargo(["bench", "--locked", "--package", "abi"]))
    });
    if let Some(venv) = venv {
        stages.stage("exo benchmark", || {
            run(&mut venv.command(["-m", "exo.benchmark"]))
        });
        stages.stage("arm benchmark", || {
            run(&mut venv.command(["tests/system/oracles/benchmark.py"]))
        });
    }
    stages.finish()
}

/// `cargo xtask adversary`
pub fn adversary(minutes: f64, seed: u64) -> Outcome {
    let (minutes, seed) = (minutes.to_string(), seed.to_string());
    run(&mut cargo([
        "run",
        "--locked",
        "--release",
        "--package",
        "adversary",
        "--",
        &minutes,
        &seed,
    ]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fails() -> Outcome {
        Err(Failure::Missing("it is not there"))
    }

    #[test]
    fn the_first_failure_stops_the_stages_after_it() {
        let mut stages = Stages::new(false);
        assert_eq!(stages.stage("one", || Ok(1)), Some(1));
        assert_eq!(stages.stage("two", fails), None);
        assert_eq!(stages.stage("three", || Ok(3)), None);
        assert!(matches!(stages.finish(), Err(Failure::Stages(names)) if names == ["two"]));
    }

    #[test]
    fn keep_going_runs_what_follows_and_still_fails() {
        let mut stages = Stages::new(true);
        stages.stage("one", fails);
        assert_eq!(stages.stage("two", || Ok(2)), Some(2));
        assert!(matches!(stages.finish(), Err(Failure::Stages(names)) if names == ["one"]));
    }

    #[test]
    fn stages_that_succeed_succeed() {
        let mut stages = Stages::new(false);
        stages.stage("one", || Ok(()));
        assert!(stages.finish().is_ok());
    }
}
