//! Everything that is checked, as stages: `cargo xtask test`, and with the distribution `cargo xtask ci`.

use crate::build::SMALLEST;
use crate::dist;
use crate::process::{Outcome, answer, build, cargo, program, root, run};
use crate::schedule::{self, Stage};
use crate::venv::{Packages, Venv, check_machine};
use std::process::Command;

/// The stages of `cargo xtask test`. Where two may begin, the first one does.
static TEST: [Stage; 16] = [
    stage("fmt", &[], || run(&mut cargo(["fmt", "--all", "--check"]))),
    stage("venv", &[], || Venv::ready(Packages::Test).map(|_| ())),
    // What the archives are written by; what the tests make a stranger's archives with has most in common with it.
    stage("catalogue", &[], || build(&["catalogue", "cargo-fmu"])),
    stage("fmu", &["catalogue"], || crate::fmu::build_all(false)),
    stage("clippy", &["venv", "catalogue"], clippy),
    stage("rustdoc", &["clippy"], rustdoc),
    stage("tests built", &["rustdoc"], || {
        with_libclang(cargo(TESTS).arg("--no-run"))
    }),
    stage("law", &["catalogue"], || {
        crate::law::build_all(false, Some(&root().join("target/law/installed")))
    }),
    stage("native", &["venv", "tests built"], || {
        crate::stages::native(Packages::Test)
    }),
    stage("pytest", &["fmu", "law", "native"], || {
        run(&mut Venv::ready(Packages::Test)?.command([
            "-m",
            "pytest",
            "tests/system",
            "--durations=20",
        ]))
    }),
    stage("cargo test", &["fmu", "law", "tests built"], || {
        with_libclang(&mut cargo(TESTS))
    }),
    stage("memcheck", &["fmu", "tests built"], crate::fuzz::memcheck),
    stage("instructions", &["fmu", "law", "tests built"], || {
        crate::instructions::check(&root().join("target/fmu"))
    }),
    stage("ruff and mypy", &["venv"], python),
    stage("exo validate", &["venv", "fmu"], validate),
    // What the archives carry is what the FMUs give.
    stage("references", &["venv", "fmu"], || {
        run(&mut Venv::ready(Packages::Test)?.exo(["record"]))
    }),
];

/// What `cargo xtask ci` has besides them: see [`dist`].
static DISTRIBUTION: [Stage; 9] = [
    stage("toolchains", &["venv"], dist::toolchains),
    stage("dist linux64", &["toolchains", "catalogue"], || {
        dist::platform("linux64")
    }),
    stage("dist win64", &["dist linux64"], || dist::platform("win64")),
    stage("dist aarch64-linux", &["dist win64"], || {
        dist::platform("aarch64-linux")
    }),
    stage("dist darwin64", &["dist aarch64-linux"], || {
        dist::platform("darwin64")
    }),
    stage("dist aarch64-darwin", &["dist darwin64"], || {
        dist::platform("aarch64-darwin")
    }),
    stage("dist firmware", &["dist aarch64-darwin"], dist::firmware),
    stage("dist twice", &["dist firmware"], dist::twice),
    stage("dist --check", &["dist firmware", "law"], || {
        dist::dist(true)
    }),
];

/// All tests, with the same packages as in the stages before them, so that none builds again what another has built.
const TESTS: [&str; 3] = ["test", "--locked", "--workspace"];

/// What no build of this workspace turns on, so that it is looked at, too.
const EVERYTHING: [&str; 2] = ["--features", "fmu-export/interface"];

const fn stage(name: &'static str, after: &'static [&'static str], work: fn() -> Outcome) -> Stage {
    Stage { name, after, work }
}

/// `cargo xtask test`
pub fn test(keep_going: bool) -> Outcome {
    check_machine()?;
    schedule::run(&TEST.iter().collect::<Vec<_>>(), keep_going)
}

/// `cargo xtask ci`
pub fn ci(keep_going: bool) -> Outcome {
    check_machine()?;
    schedule::run(&all(), keep_going)
}

/// `cargo xtask stage NAME`
pub fn one(name: &str) -> Outcome {
    schedule::one(&all(), name)
}

/// The distribution goes first: each of its stages waits for the one before it, and others run beside them.
fn all() -> Vec<&'static Stage> {
    let (first, rest) = TEST.split_at(4);
    first.iter().chain(&DISTRIBUTION).chain(rest).collect()
}

/// The packages of the workspace with libclang, which one of them needs.
fn with_libclang(command: &mut Command) -> Outcome {
    let headers = answer(&mut program("cc", ["-print-file-name=include"])).unwrap_or_default();
    run(command
        .env("LIBCLANG_PATH", Venv::ready(Packages::Test)?.libclang()?)
        .env("BINDGEN_EXTRA_CLANG_ARGS", format!("-I{headers}")))
}

fn clippy() -> Outcome {
    let what = ["clippy", "--locked", "--workspace", "--all-targets"];
    with_libclang(cargo(what).args(EVERYTHING).args(["--", "-D", "warnings"]))
}

fn rustdoc() -> Outcome {
    let mut doc = cargo(["doc", "--locked", "--workspace", "--no-deps"]);
    with_libclang(doc.args(EVERYTHING).env("RUSTDOCFLAGS", "-D warnings"))
}

fn python() -> Outcome {
    let venv = Venv::ready(Packages::Test)?;
    let ruff = |arguments: &[&str]| {
        let mut ruff = venv.command(["-m", "ruff"]);
        run(ruff
            .args(arguments)
            .args(["harness", "tests/system", "benches", "docs/site"]))
    };
    ruff(&["check"])?;
    ruff(&["format", "--check"])?;
    // Its configuration lies there.
    run(venv
        .command(["-m", "mypy"])
        .current_dir(root().join("harness")))
}

fn validate() -> Outcome {
    let mut archives = vec![format!("target/fmu/test/{SMALLEST}.fmu")];
    for folder in ["", "fmi3/", "fmi3/scheduled/"] {
        let here = fmus::NAMES
            .iter()
            .map(|name| format!("target/fmu/{folder}{name}.fmu"));
        // A plant has no scheduled twin.
        archives.extend(here.filter(|path| root().join(path).exists()));
    }
    run(Venv::ready(Packages::Test)?
        .exo(["validate", "--strict", "--load"])
        .args(archives))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_stage_waits_for_stages_that_stand_before_it_or_are_known() {
        let all = all();
        for stage in &all {
            for name in stage.after {
                assert!(all.iter().any(|other| other.name == *name), "{name}");
            }
        }
        let mut names: Vec<_> = all.iter().map(|stage| stage.name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), all.len());
    }

    #[test]
    fn every_platform_has_its_stage() {
        let stages: Vec<_> = DISTRIBUTION
            .iter()
            .filter_map(|stage| stage.name.strip_prefix("dist "))
            .filter(|name| !["firmware", "twice", "--check"].contains(name))
            .collect();
        assert_eq!(stages, dist::platforms());
    }
}
