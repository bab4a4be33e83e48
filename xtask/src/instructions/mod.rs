//! Instructions that a step of each FMU takes at rest and moving, a call that gets or sets all its variables, and a tick of
//! the C library: counted by valgrind's callgrind on the release libraries. The same binary gives the same count on any machine with the
//! same C library, so that a rise is found that no clock would show.

mod baseline;
mod callgrind;

use crate::catalogue::tables;
use crate::fuzz::{VALGRIND, valgrind};
use crate::law::{self, PRECISIONS};
use crate::process::{Failure, Outcome, answer, at, built, program, root, run};
use baseline::{Baseline, Counts};
use callgrind::{Counted, count};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Calls of each kind that are counted.
const CALLS: u64 = 200;

/// What is counted of an FMU.
const FUNCTIONS: [&str; 3] = ["fmi2DoStep", "fmi2Get*", "fmi2Set*"];

/// Where the counts of the last run lie, and those of the FMI floor, for the table of ratios.
pub const COUNTED: &str = "target/instructions/counted.json";
pub const FLOOR: &str = "target/instructions/floor.json";

/// Ticks that `tests/host/counted_ticks.c` makes of each law.
const TICKS: u64 = 1000;

/// Counts all, prints the table, and compares it with the committed one.
///
/// # Errors
/// When a count is more than 5 % above the committed one.
pub fn check(folder: &Path) -> Outcome {
    let Some(counts) = counted(folder)? else {
        return Ok(());
    };
    let now = Baseline {
        compiler: compiler()?,
        counts,
    };
    now.write(&root().join(COUNTED))?;
    let committed = Baseline::committed()?;
    if committed.compiler != now.compiler {
        println!(
            "not compared: {} was counted with {}, this is {}",
            baseline::PATH,
            committed.compiler,
            now.compiler
        );
        return Ok(());
    }
    committed.allows(&now.counts)
}

/// Counts the same calls on the archives of the FMI floor (`benches/floor.c`) in `folder`, for the table of ratios.
///
/// # Errors
/// When valgrind is there and a count fails.
pub fn floors(folder: &Path) -> Outcome {
    if valgrind().is_none() {
        return Ok(());
    }
    let out = root().join("target/instructions");
    let driver = built("counted_calls")?;
    let mut counts = Counts::new();
    for fmu in fmus::ALL {
        let calls = calls(&driver, folder, fmu.name);
        let place = out.join(format!("{}-floor", fmu.name));
        let (_, parts) = count::<3>(&calls, &FUNCTIONS, &place)?;
        for (what, part) in ["step", "get", "set"].iter().zip(&parts) {
            counts.insert(format!("{} {what}", fmu.name), part.all / CALLS);
        }
    }
    let compiler = compiler()?;
    Baseline { compiler, counts }.write(&root().join(FLOOR))
}

/// The program that calls an FMU of a folder.
fn calls(driver: &Path, folder: &Path, name: &str) -> Command {
    let mut command = program(driver, ["--fmu-dir"]);
    command.arg(folder).args(["--fmu", name]);
    command.args(["--calls", &CALLS.to_string()]);
    command
}

/// Counts all, prints the table, and commits it to the file.
///
/// # Errors
/// When valgrind is missing.
pub fn bless(folder: &Path) -> Outcome {
    let counts = counted(folder)?.ok_or(Failure::Missing(VALGRIND))?;
    Baseline {
        compiler: compiler()?,
        counts,
    }
    .commit()
}

/// All counts, printed; `None` without valgrind.
fn counted(folder: &Path) -> Outcome<Option<Counts>> {
    let Some(version) = valgrind() else {
        println!("NOT RUN: the count of instructions, {VALGRIND}");
        return Ok(None);
    };
    println!("{version}, start values, own communication step; instructions per call");
    println!(
        "{:<18} {:>9} {:>7} {:>9} {:>7}   {:>16}   {:>16}",
        "", "step", "memcpy", "moving", "memcpy", "get all outputs", "set all inputs"
    );
    let mut counts = Counts::new();
    let out = root().join("target/instructions");
    std::fs::create_dir_all(&out).map_err(at(&out))?;
    let driver = built("counted_calls")?;
    tables(&out)?;
    for fmu in fmus::ALL {
        let mut command = calls(&driver, folder, fmu.name);
        let (printed, [step, get, set]) = count(&command, &FUNCTIONS, &out.join(fmu.name))?;
        command.arg("--moving");
        command.arg(out.join(fmu.name).with_extension("txt"));
        let moving = out.join(format!("{}-moving", fmu.name));
        let (_, [moving]) = count(&command, &["fmi2DoStep"], &moving)?;
        let (outputs, inputs) = printed.trim().split_once(' ').unwrap_or_default();
        let [step_n, moving_n, get_n, set_n] =
            [&step, &moving, &get, &set].map(|part| part.all / CALLS);
        println!(
            "{:<18} {:>9} {:>7} {:>9} {:>7}   {:>8} of {outputs:>4}   {:>8} of {inputs:>4}",
            fmu.name,
            grouped(step_n),
            share(&step),
            grouped(moving_n),
            share(&moving),
            grouped(get_n),
            grouped(set_n)
        );
        for (what, n) in [
            ("step", step_n),
            ("step, moving", moving_n),
            ("get", get_n),
            ("set", set_n),
        ] {
            counts.insert(format!("{} {what}", fmu.name), n);
        }
    }
    let functions = ["exo_arm_tick", "exo_axis_tick"];
    let (_, [arm, axis, arm_moving, axis_moving]): (_, [Counted; 4]) = count(
        &program::<&str>(ticking()?, []),
        &functions,
        &out.join("law"),
    )?;
    for (function, at_rest, moving) in [
        (functions[0], &arm, &arm_moving),
        (functions[1], &axis, &axis_moving),
    ] {
        let [at_rest_n, moving_n] = [at_rest, moving].map(|part| part.all / TICKS);
        println!(
            "{function:<18} {:>9} {:>7} {:>9} {:>7}",
            grouped(at_rest_n),
            share(at_rest),
            grouped(moving_n),
            share(moving)
        );
        counts.insert(function.to_owned(), at_rest_n);
        counts.insert(format!("{function}, moving"), moving_n);
    }
    Ok(Some(counts))
}

/// The program that calls the C library.
fn ticking() -> Outcome<PathBuf> {
    let library = law::build(&PRECISIONS[0])?;
    let executable = root().join("target/instructions/counted_ticks");
    let mut compiler = program("cc", ["-std=c11", "-O1", "-g"]);
    compiler.arg("-I").arg(root().join("fmu/c/include"));
    compiler.arg(root().join("tests/host/counted_ticks.c"));
    compiler.arg(library).args(["-lm", "-o"]).arg(&executable);
    run(&mut compiler)?;
    Ok(executable)
}

/// Version and platform of the compiler: another one makes other instructions.
fn compiler() -> Outcome<String> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let text = answer(&mut program(rustc, ["-vV"])).unwrap_or_default();
    let line = |start: &str| text.lines().find_map(|line| line.strip_prefix(start));
    match (line("release: "), line("host: ")) {
        (Some(release), Some(host)) => Ok(format!("rustc {release} {host}")),
        _ => Err(Failure::Missing("rustc does not say its version")),
    }
}

fn share(part: &Counted) -> String {
    part.copying.map_or_else(
        || "?".to_owned(),
        |copying| format!("{:.1} %", 100.0 * copying as f64 / part.all.max(1) as f64),
    )
}

/// 12345 as 12,345.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::grouped;

    #[test]
    fn thousands_are_set_apart() {
        assert_eq!(
            [0, 999, 1000, 83_830, 1_234_567].map(grouped),
            ["0", "999", "1,000", "83,830", "1,234,567"]
        );
    }
}
