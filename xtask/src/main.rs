//! The project's commands.
//!
//! | command | what | leaves |
//! |---|---|---|
//! | `cargo xtask fmu` | builds the archives | `target/fmu/*.fmu`, `target/fmu/test/` |
//! | `cargo xtask ssp` | the coupled systems for other tools | `target/ssp/*.ssp`, `*.fmu` |
//! | `cargo xtask references` | whether the references in the archives are what the FMUs give; `--bless` records them | `modelDescription/references` |
//! | `cargo xtask dist` | the archives with the libraries of every platform | `target/dist/*.fmu` |
//! | `cargo xtask test` | everything that is checked | |
//! | `cargo xtask ci` | the same, and `dist --check` beside it | |
//! | `cargo xtask stage NAME` | one stage of it, after those that it waits for | |
//! | `cargo xtask reproduce` | the paper's experiments | `results/report.html` |
//! | `cargo xtask adversary --minutes N` | attacks on the energy tank | what breaks it, in `tests/adversary/regressions.txt` |
//! | `cargo xtask fuzz [--calls N] [--seed S] [--fmu NAME]` | random calls on the built FMUs | a failing sequence, printed |
//! | `cargo xtask law [--prefix DIR]` | the C library | `target/law/{f64,f32}`, and an installation in DIR |
//! | `cargo xtask bench` | how fast the FMUs and the harness are, as ratios | with `--write` `docs/benchmarks.md` |
//! | `cargo xtask native` | the harness' native engine, `exo run --engine native` | a wheel in `target/wheels`, installed into `.venv` |
//! | `cargo xtask site` | the documentation as a site | `target/site/index.html` |
//! | `cargo xtask venv [--tests]` | the Python environment of the others | `.venv` |
//!
//! | module | what |
//! |---|---|
//! | [`catalogue`] | what the program `catalogue`, which knows the models, is asked for |
//! | [`build`] | the libraries of all FMUs |
//! | [`fmu`] | archives from libraries |
//! | [`fuzz`] | random calls on the FMUs, under memcheck |
//! | [`instructions`] | instructions per call, counted by callgrind |
//! | [`linked`], [`licence`] | what is linked into a library, and which licences may be |
//! | [`law`] | the C library: headers, static libraries, examples, installation |
//! | [`dist`] | archives for many platforms |
//! | [`venv`] | the Python environment |
//! | [`checks`], [`schedule`] | the stages of `test` and `ci`, and how they run side by side |
//! | [`stages`] | other commands made of stages, each with its time |
//! | [`process`] | other programs, and what went wrong with them |

mod build;
mod catalogue;
mod checks;
mod dist;
mod fmu;
mod fuzz;
mod instructions;
mod law;
mod licence;
mod linked;
mod process;
mod schedule;
mod stages;
mod venv;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Passivity-based admittance control as FMUs: build, test, reproduce.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Build the FMUs into target/fmu
    Fmu {
        /// Also rewrite the committed modelDescription/*.xml, so that an interface change is a diff to read
        #[arg(long)]
        bless: bool,
    },
    /// Build the FMUs, then the coupled systems into target/ssp
    Ssp,
    /// Build the FMUs, then record what they carry as references (experiments, results) and say what differs
    References {
        /// Rewrite the committed modelDescription/references, so that a change is a diff to read, and pack it
        #[arg(long)]
        bless: bool,
    },
    /// Build the FMUs for every platform that this machine has tools for, into target/dist
    Dist {
        /// Also run the libraries (natively, under wine, under qemu), compare every number, and build one twice
        #[arg(long)]
        check: bool,
    },
    /// Run all checks: format, lints, documentation, Rust tests, importers, Python tests
    Test {
        /// Run the remaining stages after one has failed
        #[arg(long)]
        keep_going: bool,
    },
    /// What `test` and `dist --check` do, side by side
    Ci {
        /// Run the remaining stages after one has failed
        #[arg(long)]
        keep_going: bool,
    },
    /// Run one stage of `ci`
    Stage {
        /// Its name, as the table of stages shows it
        name: String,
    },
    /// Build the C library into target/law: f64 and f32
    Law {
        /// Also rewrite the committed headers
        #[arg(long)]
        bless: bool,
        /// Also install them here: include, lib with pkg-config and CMake files, share with licences and bill of materials
        #[arg(long, value_name = "DIR")]
        prefix: Option<std::path::PathBuf>,
    },
    /// Run the paper's experiments from a fresh clone to results/report.html
    Reproduce,
    /// Search for what empties the energy tank; what is found is kept as a regression
    Adversary {
        /// How long
        #[arg(long, default_value_t = 10.0)]
        minutes: f64,
        /// Seed of the first attack
        #[arg(long, default_value_t = 10_000_000)]
        seed: u64,
    },
    /// Play random calls on the FMUs in target/fmu; what fails is shortened and printed with how to play it again
    Fuzz(fuzz::Request),
    /// Measure, and print one table of ratios: FMUs, engines, sweeps beside their peers; no time fails it
    Bench {
        /// Also commit the table to docs/benchmarks.md, with its picture, the date and the machine
        #[arg(long, conflicts_with_all = ["instructions", "bless", "fmu_dir"])]
        write: bool,
        /// Count instructions only
        #[arg(long)]
        instructions: bool,
        /// Count instructions, and rewrite the committed counts
        #[arg(long)]
        bless: bool,
        /// Count instructions of the archives in this folder; without it they are built
        #[arg(long)]
        fmu_dir: Option<std::path::PathBuf>,
    },
    /// Build the harness' native engine and install it into .venv: exo run --engine native
    Native,
    /// Write the documentation as a site into target/site
    Site,
    /// Create the Python environment .venv from harness/requirements.lock
    Venv {
        /// With what only tests, lints and benches need
        #[arg(long)]
        tests: bool,
    },
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().command {
        Command::Fmu { bless } => fmu::build_all(bless),
        Command::Ssp => stages::ssp(),
        Command::References { bless } => stages::references(bless),
        Command::Dist { check } => dist::dist(check),
        Command::Test { keep_going } => checks::test(keep_going),
        Command::Ci { keep_going } => checks::ci(keep_going),
        Command::Stage { name } => checks::one(&name),
        Command::Law { bless, prefix } => law::build_all(bless, prefix.as_deref()),
        Command::Native => stages::native(venv::Packages::Run),
        Command::Site => stages::site(),
        Command::Reproduce => stages::reproduce(),
        Command::Adversary { minutes, seed } => stages::adversary(minutes, seed),
        Command::Fuzz(request) => fuzz::fuzz(&request),
        Command::Bench {
            write,
            instructions,
            bless,
            fmu_dir,
        } => match fmu_dir {
            None if !instructions && !bless => stages::bench(write),
            folder => stages::count(folder, bless),
        },
        Command::Venv { tests } => stages::venv(tests),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::FAILURE
        }
    }
}
