//! The harness's zero-delay loop without the harness: the two testbed FMUs, coupled by dlopen.
//!
//! ```text
//! native_loop --fmu-dir DIR --input IN.csv --output OUT.csv [--set controller.NAME=VALUE] [--set testbed.NAME=VALUE]
//! ```
//!
//! `IN.csv` has the columns `t,tau_h,tau_d`, one row for every tick of the controller (its parameter T is the step).
//! At tick k: controller.q ← testbed.q, both tau_h ← the row's; the controller steps; testbed.tau_a ← controller.tau_a,
//! tau_d ← the row's; the testbed steps. `OUT.csv` has `t,q,q_n,e_nr,tau_a,energy.G` with 17 significant digits: what
//! the controller read and answered at t. Exit code 0, or 1 with a sentence on stderr.

use abi::{Fmu, Instance, Kind, Status};
use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

const USAGE: &str = "usage: native_loop --fmu-dir DIR --input IN.csv --output OUT.csv \
                     [--set controller.NAME=VALUE | --set testbed.NAME=VALUE] …";

/// The command line.
#[derive(Debug, Default)]
struct Arguments {
    fmu_dir: PathBuf,
    input: PathBuf,
    output: PathBuf,
    /// Model (`controller` or `testbed`), variable, value.
    settings: Vec<(String, String, f64)>,
}

impl Arguments {
    fn parse(mut words: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut arguments = Self::default();
        while let Some(option) = words.next() {
            let value = words
                .next()
                .ok_or_else(|| format!("{option} needs a value\n{USAGE}"))?;
            match option.as_str() {
                "--fmu-dir" => arguments.fmu_dir = value.into(),
                "--input" => arguments.input = value.into(),
                "--output" => arguments.output = value.into(),
                "--set" => arguments.settings.push(setting(&value)?),
                _ => return Err(format!("unknown option {option}\n{USAGE}")),
            }
        }
        for (path, option) in [
            (&arguments.fmu_dir, "--fmu-dir"),
            (&arguments.input, "--input"),
            (&arguments.output, "--output"),
        ] {
            if path.as_os_str().is_empty() {
                return Err(format!("{option} is missing\n{USAGE}"));
            }
        }
        Ok(arguments)
    }
}

/// `model.variable=value`; a Boolean is 0 or 1, an enumeration its number.
fn setting(text: &str) -> Result<(String, String, f64), String> {
    text.split_once('=')
        .and_then(|(name, value)| {
            let (model, variable) = name.split_once('.')?;
            let value = value.trim().parse().ok()?;
            let known = ["controller", "testbed"].contains(&model);
            known.then(|| (model.to_owned(), variable.to_owned(), value))
        })
        .ok_or_else(|| {
            format!("--set {text}: expected controller.NAME=NUMBER or testbed.NAME=NUMBER")
        })
}

/// One row of the input: t (s), tau_h (N), tau_d (N).
fn rows(text: &str) -> Result<Vec<[f64; 3]>, String> {
    let mut lines = text.lines();
    let head = lines.next().unwrap_or_default().trim();
    if head != "t,tau_h,tau_d" {
        return Err(format!("expected the columns t,tau_h,tau_d, got {head}"));
    }
    lines
        .enumerate()
        .map(|(i, line)| {
            let numbers: Result<Vec<f64>, _> = line.split(',').map(|n| n.trim().parse()).collect();
            numbers
                .ok()
                .and_then(|numbers| <[f64; 3]>::try_from(numbers).ok())
                .ok_or_else(|| format!("line {}: expected three numbers, got {line}", i + 2))
        })
        .collect()
}

/// An instance with the settings of its model, not yet initialized.
fn prepared(fmu: &Fmu, model: &str, arguments: &Arguments) -> Result<Instance, String> {
    let instance = fmu.instantiate();
    for (_, name, value) in arguments.settings.iter().filter(|(m, ..)| m == model) {
        let variable = fmu
            .variables
            .iter()
            .find(|v| v.name == *name)
            .ok_or_else(|| format!("--set {model}.{name}: {} has no such variable", fmu.name))?;
        let reference = [variable.reference];
        let status = match variable.kind {
            Kind::Real {} => instance.set_real(&reference, &[*value]),
            Kind::Boolean {} => instance.set_boolean(&reference, &[i32::from(*value != 0.0)]),
            Kind::Integer {} | Kind::Enumeration {} if value.fract() == 0.0 => {
                instance.set_integer(&reference, &[*value as i32])
            }
            Kind::Integer {} | Kind::Enumeration {} | Kind::String {} => {
                return Err(format!("--set {model}.{name}: {value} is not of its type"));
            }
        };
        ok(&instance, status)?;
    }
    Ok(instance)
}

/// A status as a result, with what the instance said.
fn ok(instance: &Instance, status: Status) -> Result<(), String> {
    if status == Status::OK {
        return Ok(());
    }
    let log: Vec<_> = instance.messages().into_iter().map(|m| m.text).collect();
    Err(format!("{status:?}: {}", log.join("; ")))
}

fn run(arguments: &Arguments) -> Result<String, String> {
    let text = std::fs::read_to_string(&arguments.input)
        .map_err(|e| format!("{}: {e}", arguments.input.display()))?;
    let rows = rows(&text).map_err(|e| format!("{}: {e}", arguments.input.display()))?;

    let controller_fmu = Fmu::open_in(&arguments.fmu_dir, "TestbedController");
    let testbed_fmu = Fmu::open_in(&arguments.fmu_dir, "Testbed");
    let controller = prepared(&controller_fmu, "controller", arguments)?;
    let testbed = prepared(&testbed_fmu, "testbed", arguments)?;
    let period = controller.real(controller_fmu.reference("T"));
    let start = rows.first().map_or(0.0, |row| row[0]);

    let sensed = controller_fmu.references(["q", "tau_h"]);
    let shown = controller_fmu.references(["q_n", "e_nr", "tau_a", "energy.G"]);
    let forces = testbed_fmu.references(["tau_a", "tau_h", "tau_d"]);
    let position = testbed_fmu.reference("q");

    for instance in [&testbed, &controller] {
        ok(instance, instance.setup_experiment(start, None))?;
        ok(instance, instance.enter_initialization_mode())?;
    }
    let first = rows.first().map_or([0.0; 3], |row| *row);
    ok(&testbed, testbed.set_real(&forces[1..], &first[1..]))?;
    let at_start = [testbed.real(position), first[1]];
    ok(&controller, controller.set_real(&sensed, &at_start))?;
    for instance in [&testbed, &controller] {
        ok(instance, instance.exit_initialization_mode())?;
    }

    let mut table = String::from("t,q,q_n,e_nr,tau_a,energy.G\n");
    for [t, tau_h, tau_d] in rows {
        let q = testbed.real(position);
        ok(&controller, controller.set_real(&sensed, &[q, tau_h]))?;
        ok(&controller, controller.step(t, period))?;
        let got = controller
            .get_real(&shown)
            .map_err(|status| format!("fmi2GetReal: {status:?}"))?;
        ok(&testbed, testbed.set_real(&forces, &[got[2], tau_h, tau_d]))?;
        ok(&testbed, testbed.step(t, period))?;
        let numbers = [t, q, got[0], got[1], got[2], got[3]];
        for (i, number) in numbers.into_iter().enumerate() {
            // 17 significant digits: every double comes back as it was.
            let comma = if i == 0 { "" } else { "," };
            let _ = write!(table, "{comma}{number:.16e}");
        }
        table.push('\n');
    }
    Ok(table)
}

fn main() -> ExitCode {
    let outcome = Arguments::parse(std::env::args().skip(1)).and_then(|arguments| {
        let table = run(&arguments)?;
        std::fs::write(&arguments.output, table)
            .map_err(|e| format!("{}: {e}", arguments.output.display()))
    });
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("native_loop: {reason}");
            ExitCode::FAILURE
        }
    }
}
