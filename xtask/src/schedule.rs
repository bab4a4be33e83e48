//! Stages that depend on one another, two at a time.
//!
//! Each stage is a process of its own, this program again, so that what it prints can be kept apart: it is shown whole when
//! the stage ends. Two at a time is what two processors need: a stage compiles on both, links on one, fetches on none.

use crate::process::{Failure, Outcome, at, program, root};
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::sync::mpsc::{Sender, channel};
use std::time::{Duration, Instant};

/// Set in the environment of a stage: programs of this workspace that a stage before it has built need not be built again.
const BUILT: &str = "XTASK_PROGRAMS_ARE_BUILT";

/// How many stages run at the same time.
const AT_A_TIME: usize = 2;

/// One stage.
pub struct Stage {
    /// Its name, for `cargo xtask stage NAME`.
    pub name: &'static str,
    /// Names of the stages that must have succeeded before it begins. Those that use the same target directory of cargo wait
    /// for each other anyhow, so they stand here, too.
    pub after: &'static [&'static str],
    /// What it does.
    pub work: fn() -> Outcome,
}

/// A stage that ran.
struct Done {
    name: &'static str,
    began: Duration,
    took: Duration,
    /// Processor time of its programs, where the system tells.
    processor: Option<Duration>,
    outcome: Outcome,
}

/// Runs stages; after a failure no other begins, unless told to keep going. Prints the table of their times.
///
/// # Errors
/// Names the stages that failed.
pub fn run(stages: &[&'static Stage], keep_going: bool) -> Outcome {
    let began = Instant::now();
    let (sender, receiver) = channel();
    let mut waiting = stages.to_vec();
    let mut running: Vec<&str> = Vec::new();
    let mut done: Vec<Done> = Vec::new();
    loop {
        while running.len() < AT_A_TIME {
            let Some(i) = next(&waiting, stages, &done, keep_going) else {
                break;
            };
            let stage = waiting.remove(i);
            println!("── {} begins", stage.name);
            running.push(stage.name);
            start(stage.name, began, sender.clone());
        }
        if running.is_empty() {
            break;
        }
        let ended: Done = receiver
            .recv()
            .map_err(|_| Failure::Found("a thread of this command panicked".into()))?;
        running.retain(|name| *name != ended.name);
        show(&ended);
        done.push(ended);
    }
    summary(&done, &waiting, began.elapsed());
    let failed: Vec<_> = done
        .iter()
        .filter(|one| one.outcome.is_err())
        .map(|one| one.name)
        .collect();
    if failed.is_empty() {
        Ok(())
    } else {
        Err(Failure::Found(format!("failed: {}", failed.join(", "))))
    }
}

/// Position of the first stage that may begin now.
fn next(
    waiting: &[&'static Stage],
    all: &[&'static Stage],
    done: &[Done],
    keep_going: bool,
) -> Option<usize> {
    if !keep_going && done.iter().any(|one| one.outcome.is_err()) {
        return None;
    }
    // A stage that is not part of this command need not be waited for.
    let part = |name: &str| all.iter().any(|stage| stage.name == name);
    let good = |name: &str| {
        done.iter()
            .any(|one| one.name == name && one.outcome.is_ok())
    };
    waiting
        .iter()
        .position(|stage| stage.after.iter().all(|name| !part(name) || good(name)))
}

fn start(name: &'static str, command_began: Instant, sender: Sender<Done>) {
    std::thread::spawn(move || {
        let began = command_began.elapsed();
        let outcome = in_a_process(name);
        let done = Done {
            name,
            began,
            took: command_began.elapsed() - began,
            processor: processor_time(name),
            outcome,
        };
        // Nobody listens once the command has ended.
        let _ = sender.send(done);
    });
}

fn in_a_process(name: &'static str) -> Outcome {
    let log = file(name, "log");
    if let Some(folder) = log.parent() {
        std::fs::create_dir_all(folder).map_err(at(folder))?;
    }
    let _ = std::fs::remove_file(file(name, "time"));
    let out = std::fs::File::create(&log).map_err(at(&log))?;
    let err = out.try_clone().map_err(at(&log))?;
    let own = std::env::current_exe().map_err(at(Path::new("xtask")))?;
    let mut command = program(own, ["stage", name]);
    command.env(BUILT, "1").stdout(out).stderr(err);
    let status = command
        .stdin(Stdio::null())
        .status()
        .map_err(|cause| Failure::Start {
            command: format!("xtask stage {name}"),
            cause,
        })?;
    if status.success() {
        Ok(())
    } else {
        // It has said why.
        Err(Failure::Found(format!("failed: {name}")))
    }
}

/// Whether this process is a stage of a command that runs several: what stands before it is built.
pub fn in_a_stage() -> bool {
    std::env::var_os(BUILT).is_some()
}

/// `cargo xtask stage NAME`: the stage in this process.
///
/// # Errors
/// What failed.
pub fn one(stages: &[&'static Stage], name: &str) -> Outcome {
    let stage = stages.iter().find(|stage| stage.name == name);
    let stage = stage.ok_or_else(|| {
        let names: Vec<_> = stages.iter().map(|stage| stage.name).collect();
        Failure::Found(format!("no stage {name}: expected {}", names.join(", ")))
    })?;
    let outcome = (stage.work)();
    if in_a_stage()
        && let Some(ticks) = ticks_of_children()
    {
        let path = file(name, "time");
        std::fs::write(&path, ticks.to_string()).map_err(at(&path))?;
    }
    outcome
}

/// Processor time of all programs that this one has waited for, in hundredths of a second: fields 16 and 17 of
/// `/proc/self/stat` (proc(5)); its unit is 1/100 s wherever Linux runs on a PC.
fn ticks_of_children() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The second field, in parentheses, may have spaces; the one after it is the third.
    let (_, rest) = text.rsplit_once(')')?;
    let fields: Vec<_> = rest.split_whitespace().collect();
    Some(fields.get(13)?.parse::<u64>().ok()? + fields.get(14)?.parse::<u64>().ok()?)
}

fn processor_time(name: &str) -> Option<Duration> {
    let text = std::fs::read_to_string(file(name, "time")).ok()?;
    Some(Duration::from_millis(10 * text.trim().parse::<u64>().ok()?))
}

/// Where a stage's output and time are kept.
fn file(name: &str, end: &str) -> PathBuf {
    root()
        .join("target/stages")
        .join(name.replace(' ', "-"))
        .with_extension(end)
}

fn show(done: &Done) {
    println!("\n── {}", done.name);
    print!(
        "{}",
        std::fs::read_to_string(file(done.name, "log")).unwrap_or_default()
    );
    let state = if done.outcome.is_ok() { "" } else { " FAILED," };
    println!(
        "   {}:{state} {:.1} s\n",
        done.name,
        done.took.as_secs_f64()
    );
}

/// The table: when each began, how long it took, and the processor time of its programs.
fn summary(done: &[Done], waiting: &[&'static Stage], total: Duration) {
    println!(
        "\n       {:<20} {:>9} {:>10} {:>14}",
        "stage", "began", "took", "processor time"
    );
    let seconds = |time: Duration| format!("{:.1} s", time.as_secs_f64());
    let mut processor = Duration::ZERO;
    for one in done {
        let state = if one.outcome.is_ok() {
            "ok    "
        } else {
            "FAILED"
        };
        processor += one.processor.unwrap_or_default();
        println!(
            "{state} {:<20} {:>9} {:>10} {:>14}",
            one.name,
            seconds(one.began),
            seconds(one.took),
            one.processor.map_or_else(|| "?".to_owned(), seconds)
        );
    }
    for stage in waiting {
        println!("not run {}", stage.name);
    }
    println!(
        "       {:<20} {:>9} {:>10} {:>14}",
        "total",
        "",
        seconds(total),
        seconds(processor)
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nothing() -> Outcome {
        Ok(())
    }

    static A: Stage = Stage {
        name: "a",
        after: &[],
        work: nothing,
    };
    static B: Stage = Stage {
        name: "b",
        after: &["a"],
        work: nothing,
    };
    static C: Stage = Stage {
        name: "c",
        after: &["not here"],
        work: nothing,
    };

    fn ended(name: &'static str, good: bool) -> Done {
        Done {
            name,
            began: Duration::ZERO,
            took: Duration::ZERO,
            processor: None,
            outcome: if good {
                Ok(())
            } else {
                Err(Failure::Missing("it"))
            },
        }
    }

    #[test]
    fn a_stage_waits_for_those_before_it_and_not_for_those_of_other_commands() {
        let all = [&A, &B, &C];
        assert_eq!(next(&all, &all, &[], false), Some(0));
        assert_eq!(next(&[&B, &C], &all, &[], false), Some(1));
        assert_eq!(next(&[&B], &all, &[ended("a", true)], false), Some(0));
        assert_eq!(next(&[&B], &all, &[], false), None);
    }

    #[test]
    fn after_a_failure_nothing_begins_unless_told_to_keep_going() {
        let all = [&A, &B, &C];
        let failed = [ended("a", false)];
        assert_eq!(next(&[&B, &C], &all, &failed, false), None);
        // What depends on it does not begin even then.
        assert_eq!(next(&[&B, &C], &all, &failed, true), Some(1));
    }

    #[test]
    fn the_time_of_programs_is_read_from_the_system() {
        let spun = "i=0; while [ $i -lt 200000 ]; do i=$((i+1)); done";
        let before = ticks_of_children();
        let _ = program("sh", ["-c", spun]).status();
        if cfg!(target_os = "linux") {
            assert!(ticks_of_children() > before);
        }
    }
}
