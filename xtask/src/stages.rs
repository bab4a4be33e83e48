//! Commands made of stages one after the other, each with its name and its time; `cargo xtask test` and `ci` are in
//! [`checks`](crate::checks).

use crate::instructions;
use crate::process::{Outcome, cargo, root, run};
use crate::venv::{Packages, Venv};
use std::path::PathBuf;
use std::time::Instant;

/// Runs one stage of a command.
fn stage<T>(name: &str, work: impl FnOnce() -> Outcome<T>) -> Outcome<T> {
    println!("\n── {name}");
    let began = Instant::now();
    let value = work()?;
    println!("   {name}: {:.1} s", began.elapsed().as_secs_f64());
    Ok(value)
}

/// What the harness works with: the Python environment and the FMUs.
fn harness(packages: Packages) -> Outcome<Venv> {
    let venv = stage("venv", || Venv::ready(packages))?;
    stage("fmu", || crate::fmu::build_all(false))?;
    Ok(venv)
}

/// `cargo xtask ssp`
pub fn ssp() -> Outcome {
    let venv = harness(Packages::Run)?;
    stage("exo ssp", || run(&mut venv.exo(["ssp"])))
}

/// `cargo xtask references`, `--bless`
pub fn references(bless: bool) -> Outcome {
    let venv = harness(Packages::Run)?;
    let mut record = venv.exo(["record"]);
    if bless {
        record.arg("--bless");
    }
    stage("exo record", || run(&mut record))?;
    if bless {
        // They go into the archives.
        stage("fmu", || crate::fmu::build_all(false))?;
    }
    Ok(())
}

/// `cargo xtask venv`
pub fn venv(tests: bool) -> Outcome {
    let packages = if tests { Packages::Test } else { Packages::Run };
    Venv::ready(packages).map(|_| ())
}

/// `cargo xtask site`: the documentation; a dead link is an error.
pub fn site() -> Outcome {
    let venv = Venv::ready(Packages::Test)?;
    let mut build = venv.command(["-m", "mkdocs", "build", "--strict"]);
    // What Material for MkDocs says about another product.
    build.env("NO_MKDOCS_2_WARNING", "1");
    stage("mkdocs", || run(&mut build))?;
    println!("site: target/site/index.html");
    Ok(())
}

/// `cargo xtask native`: the harness' native engine as a wheel, installed into the environment.
pub fn native(packages: Packages) -> Outcome {
    let venv = Venv::ready(packages)?;
    let wheels = root().join("target/wheels");
    // Those of an earlier version would be installed beside this one.
    let _ = std::fs::remove_dir_all(&wheels);
    let mut build = venv.command(["-m", "maturin", "build", "--release", "--locked", "--quiet"]);
    let manifest = root().join("harness/native/Cargo.toml");
    run(build
        .arg("--manifest-path")
        .arg(manifest)
        .arg("--out")
        .arg(&wheels))?;
    venv.install_wheel(&wheels)
}

/// `cargo xtask reproduce`
pub fn reproduce() -> Outcome {
    let venv = harness(Packages::Run)?;
    let report = root().join("results/report.html");
    // A failed verdict is an error, yet leaves its report; an old report is not this run's.
    let _ = std::fs::remove_file(&report);
    let outcome = stage("exo reproduce", || run(&mut venv.exo(["reproduce"])));
    if report.exists() {
        println!("\nreport: {}", report.display());
    }
    outcome
}

/// `cargo xtask bench --instructions`, `--bless`
pub fn count(folder: Option<PathBuf>, bless: bool) -> Outcome {
    let folder = match folder {
        Some(folder) => folder,
        None => {
            crate::fmu::build_all(false)?;
            fmus()
        }
    };
    match bless {
        true => instructions::bless(&folder),
        false => instructions::check(&folder),
    }
}

/// Where the built archives lie.
fn fmus() -> PathBuf {
    root().join("target/fmu")
}

/// `cargo xtask bench`, `--write`: the table of ratios. A count of instructions that is too high fails it, at its end; no time does.
pub fn bench(write: bool) -> Outcome {
    let venv = harness(Packages::Test)?;
    stage("native", || native(Packages::Test))?;
    stage("law", || crate::law::build_all(false, None))?;
    // An earlier run's counts are not this one's.
    for file in [instructions::COUNTED, instructions::FLOOR] {
        let _ = std::fs::remove_file(root().join(file));
    }
    let counted = stage("instructions", || Ok(instructions::check(&fmus())))?;
    let floors = root().join("target/bench/floors");
    stage("instructions of the FMI floor", || {
        run(venv.command(["-m", "benches", "--floors"]).arg(&floors))?;
        instructions::floors(&floors)
    })?;
    stage("table", || {
        let mut table = venv.command(["-m", "benches"]);
        table.args(["--counts-fmu", instructions::COUNTED]);
        table.args(["--counts-floor", instructions::FLOOR]);
        run(table.args(write.then_some("--write")))
    })?;
    counted
}

/// `cargo xtask adversary`
pub fn adversary(minutes: f64, seed: u64) -> Outcome {
    run(cargo([
        "run",
        "--locked",
        "--release",
        "--package",
        "adversary",
        "--",
    ])
    .args([minutes.to_string(), seed.to_string()]))
}
