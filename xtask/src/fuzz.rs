//! Random call sequences on the built FMUs (`tests/abi`, `call_sequences`): as a command, and under valgrind's memcheck.

use crate::process::{Failure, Outcome, answer, built, program, run};
use std::path::Path;
use std::process::Command;

/// Calls on each FMU under memcheck in `cargo xtask test`.
const CALLS: u64 = 20_000;

/// Seed of `cargo xtask test`.
const SEED: u64 = 7;

/// What `cargo xtask fuzz` was asked for.
#[derive(clap::Args)]
pub struct Request {
    /// Calls on each FMU
    #[arg(long, default_value_t = 1_000_000)]
    calls: u64,
    /// Seed; without it another one at each run, printed
    #[arg(long)]
    seed: Option<u64>,
    /// One FMU by its name, or Lag, the test model; without it all
    #[arg(long)]
    fmu: Option<String>,
    /// Play one sequence: the numbers that a failure has printed
    #[arg(long)]
    replay: Option<String>,
    /// Under valgrind's memcheck, about 30 times slower
    #[arg(long)]
    memcheck: bool,
}

/// The FMUs by name, and the test model.
fn names() -> Vec<&'static str> {
    let mut names = vec!["Lag"];
    names.extend(fmus::NAMES);
    names
}

/// `cargo xtask fuzz`
pub fn fuzz(request: &Request) -> Outcome {
    let seed = request.seed.unwrap_or_else(|| {
        let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
        now.map_or(0, |time| time.as_secs())
    });
    let wanted: Vec<_> = match &request.fmu {
        Some(name) => vec![name.as_str()],
        None => names(),
    };
    if request.replay.is_some() && request.fmu.is_none() {
        return Err(Failure::Missing(
            "--replay needs --fmu: a sequence's numbers stand for other calls on each FMU",
        ));
    }
    if request.memcheck && valgrind().is_none() {
        return Err(Failure::Missing(VALGRIND));
    }
    let player = built("call_sequences")?;
    if request.replay.is_none() {
        println!("seed {seed}");
    }
    let command = |name: &str| {
        let mut command = played(&player, name, request.calls, seed, request.memcheck);
        if let Some(numbers) = &request.replay {
            command.args(["--replay", numbers]);
        }
        command
    };
    if request.memcheck {
        return two_at_a_time(&wanted, command);
    }
    // One after the other: each shows a bar.
    wanted.iter().try_for_each(|name| run(&mut command(name)))
}

/// The stage of `cargo xtask test`: every FMU under memcheck; without valgrind the same calls natively.
pub fn memcheck() -> Outcome {
    let valgrind = valgrind();
    match &valgrind {
        Some(version) => println!("{version}: {CALLS} calls on each FMU, seed {SEED}"),
        None => println!(
            "NOT RUN: memcheck, {VALGRIND}; the same {CALLS} calls on each FMU without it, seed {SEED}"
        ),
    }
    let player = built("call_sequences")?;
    two_at_a_time(fmus::NAMES, |name| {
        played(&player, name, CALLS, SEED, valgrind.is_some())
    })
}

/// What to say when it is missing.
pub const VALGRIND: &str =
    "valgrind is not on PATH; install it (Debian, Ubuntu: apt-get install valgrind)";

/// Its version, if it is there.
pub fn valgrind() -> Option<String> {
    answer(&mut program("valgrind", ["--version"]))
}

/// Runs a command for each name, on two processors.
fn two_at_a_time(names: &[&str], command: impl Fn(&str) -> Command) -> Outcome {
    for pair in names.chunks(2) {
        let outcomes: Vec<_> = std::thread::scope(|scope| {
            let started: Vec<_> = pair
                .iter()
                .map(|name| {
                    let mut command = command(name);
                    scope.spawn(move || run(&mut command))
                })
                .collect();
            let panicked = |_| Err(Failure::Found("a thread of this command panicked".into()));
            let ended = started.into_iter().map(|one| one.join());
            ended.map(|one| one.unwrap_or_else(panicked)).collect()
        });
        outcomes.into_iter().collect::<Outcome>()?;
    }
    Ok(())
}

/// The program with its arguments.
fn played(player: &Path, name: &str, calls: u64, seed: u64, memcheck: bool) -> Command {
    let mut command = if memcheck {
        memchecked(player)
    } else {
        program(player, [] as [&str; 0])
    };
    command.args(["--fmu", name, "--seed", &seed.to_string()]);
    command.args(["--calls", &calls.to_string()]);
    command
}

/// The program under memcheck: any wrong access, any use of memory that nobody wrote, and any lost block is exit code 9.
/// Blocks to which only a pointer into their middle is left do not count: Rust's standard library holds the main thread's
/// handle so, in every program. What a library's own statics hold is lost, and so counts, once the library is closed.
fn memchecked(player: &Path) -> Command {
    let mut command = program(
        "valgrind",
        [
            "--quiet",
            "--error-exitcode=9",
            "--leak-check=full",
            "--show-leak-kinds=definite,indirect",
            "--errors-for-leak-kinds=definite,indirect",
            "--keep-debuginfo=yes",
            "--num-callers=30",
        ],
    );
    command.arg(player);
    command
}
