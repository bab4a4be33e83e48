//! The Python environment `.venv`: from the lock files, with hashes, and made anew when they change.
//!
//! It begins with what running the scenarios needs; the first command that tests adds what only tests need. Commands that
//! begin at the same time make it one after the other.

use crate::process::{Failure, Outcome, answer, at, program, root, run};
use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

const OLDEST: (u32, u32) = (3, 11);

/// The environment.
pub struct Venv {
    folder: PathBuf,
}

/// What is installed in it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Packages {
    /// The harness and what it imports.
    Run,
    /// What tests, lints and benches import besides.
    Test,
}

impl Packages {
    const fn lock(self) -> &'static str {
        match self {
            Self::Run => "harness/requirements.lock",
            Self::Test => "harness/requirements-test.lock",
        }
    }

    /// Written last, so that an interrupted installation leaves none; holds what was installed.
    const fn stamp(self) -> &'static str {
        match self {
            Self::Run => "made-from",
            Self::Test => "tests-made-from",
        }
    }
}

/// What has to be installed, from what the stamps say.
#[derive(Debug, PartialEq, Eq)]
enum Work {
    Nothing,
    Add,
    Anew,
}

/// `run`, `test`: what each stamp holds; `None` without one. A stamp of tests that is old means packages that are too.
fn work(packages: Packages, run: Option<&str>, test: Option<&str>, wanted: [&str; 2]) -> Work {
    let [run_wanted, test_wanted] = wanted;
    let tests_are_old = test.is_some_and(|made| made != test_wanted);
    match (run, test) {
        (Some(made), _) if made != run_wanted || tests_are_old => Work::Anew,
        (None, _) => Work::Anew,
        (Some(_), None) if packages == Packages::Test => Work::Add,
        _ => Work::Nothing,
    }
}

/// What the machine must offer, looked for before any work begins.
pub fn check_machine() -> Outcome {
    if answer(&mut program("cc", ["--version"])).is_none() {
        return Err(Failure::Missing(
            "no C compiler: `cc` is not on PATH; install gcc or clang (Debian, Ubuntu: apt-get install gcc)",
        ));
    }
    check_python("python3")
}

fn check_python(python: &str) -> Outcome {
    let script = "import sys; print(sys.version_info[0], sys.version_info[1])";
    let Some(text) = answer(&mut clean(program(python, ["-c", script]))) else {
        return Err(Failure::Missing(
            "no Python: `python3` is not on PATH or does not start; install Python 3.11 or newer",
        ));
    };
    if version(&text).is_none_or(|version| version < OLDEST) {
        return Err(Failure::Found(format!(
            "`python3` is Python {}: install Python {}.{} or newer",
            text.replace(' ', "."),
            OLDEST.0,
            OLDEST.1
        )));
    }
    if answer(&mut clean(program(
        python,
        ["-c", "import venv, ensurepip"],
    )))
    .is_none()
    {
        return Err(Failure::Missing(
            "`python3` has no venv module: install it (Debian, Ubuntu: apt-get install python3-venv)",
        ));
    }
    Ok(())
}

fn version(text: &str) -> Option<(u32, u32)> {
    let (major, minor) = text.split_once(' ')?;
    Some((major.parse().ok()?, minor.parse().ok()?))
}

impl Venv {
    /// The environment, made if it is not there or not from the present lock files.
    pub fn ready(packages: Packages) -> Outcome<Self> {
        check_machine()?;
        let venv = Self {
            folder: root().join(".venv"),
        };
        let _alone = alone(&root().join("target/venv.lock"))?;
        let wanted = [venv.wanted(Packages::Run)?, venv.wanted(Packages::Test)?];
        let made = |packages: Packages| {
            let there = venv.installed("python").exists();
            let text = std::fs::read_to_string(venv.folder.join(packages.stamp())).ok();
            text.filter(|_| there)
        };
        let (run_made, test_made) = (made(Packages::Run), made(Packages::Test));
        let [run_wanted, test_wanted] = &wanted;
        match work(
            packages,
            run_made.as_deref(),
            test_made.as_deref(),
            [run_wanted, test_wanted],
        ) {
            Work::Nothing => return Ok(venv),
            Work::Add => {}
            Work::Anew => venv.make(run_wanted)?,
        }
        if packages == Packages::Test {
            venv.add_tests(test_wanted)?;
        }
        Ok(venv)
    }

    fn make(&self, wanted: &str) -> Outcome {
        println!("making .venv from {}", Packages::Run.lock());
        if self.folder.exists() {
            std::fs::remove_dir_all(&self.folder).map_err(at(&self.folder))?;
        }
        run(clean(program("python3", ["-m", "venv"])).arg(&self.folder))?;
        run(self.install().args(["-r", Packages::Run.lock()]))?;
        run(self.command(PIP_INSTALL).args([
            "--require-hashes",
            "--no-deps",
            "--no-build-isolation",
            "-r",
            SOURCE_LOCK,
        ]))?;
        run(self.command(PIP_INSTALL).args([
            "--no-deps",
            "--no-build-isolation",
            "-e",
            "harness",
        ]))?;
        self.write_stamp(Packages::Run, wanted)
    }

    fn add_tests(&self, wanted: &str) -> Outcome {
        println!("adding to .venv what {} has", Packages::Test.lock());
        run(self.install().args(["-r", Packages::Test.lock()]))?;
        self.write_stamp(Packages::Test, wanted)
    }

    /// Installs the one wheel in a folder, in place of an earlier one.
    pub fn install_wheel(&self, folder: &Path) -> Outcome {
        let mut wheels = std::fs::read_dir(folder)
            .map_err(at(folder))?
            .filter_map(|entry| entry.ok().map(|entry| entry.path()))
            .filter(|path| path.extension().is_some_and(|end| end == "whl"));
        let wheel = wheels
            .next()
            .ok_or(Failure::Missing("maturin has left no wheel"))?;
        let mut pip = self.command(PIP_INSTALL);
        run(pip
            .args(["--no-deps", "--no-index", "--force-reinstall"])
            .arg(wheel))
    }

    fn install(&self) -> Command {
        let mut pip = self.command(PIP_INSTALL);
        // A lock names every package, so nothing is looked for beyond it.
        pip.args(["--require-hashes", "--no-deps", "--only-binary=:all:"]);
        pip
    }

    fn write_stamp(&self, packages: Packages, text: &str) -> Outcome {
        let stamp = self.folder.join(packages.stamp());
        std::fs::write(&stamp, text).map_err(at(&stamp))
    }

    /// What the environment is made from: a change of any part means making it anew.
    fn wanted(&self, packages: Packages) -> Outcome<String> {
        let mut text = format!("{}\n", self.folder.display()); // an environment cannot be moved
        for file in [packages.lock(), SOURCE_LOCK, "harness/pyproject.toml"] {
            let path = root().join(file);
            text += &std::fs::read_to_string(&path).map_err(at(&path))?;
        }
        Ok(text)
    }

    fn installed(&self, name: &str) -> PathBuf {
        let folder = self
            .folder
            .join(if cfg!(windows) { "Scripts" } else { "bin" });
        folder
            .join(name)
            .with_extension(std::env::consts::EXE_EXTENSION)
    }

    /// Its Python with arguments.
    pub fn command<'a>(&self, arguments: impl IntoIterator<Item = &'a str>) -> Command {
        clean(program(self.installed("python"), arguments))
    }

    /// The command line of the harness.
    pub fn exo<'a>(&self, arguments: impl IntoIterator<Item = &'a str>) -> Command {
        clean(program(self.installed("exo"), arguments))
    }

    /// Where the `libclang` wheel puts its library.
    pub fn libclang(&self) -> Outcome<PathBuf> {
        let script = "import pathlib, clang; print(pathlib.Path(clang.__file__).parent / 'native')";
        let folder = answer(&mut self.command(["-c", script]))
            .map(PathBuf::from)
            .filter(|folder| folder.is_dir());
        folder.ok_or(Failure::Missing(
            "the libclang wheel is not in .venv: it belongs in harness/requirements-test.in",
        ))
    }
}

/// Packages that have no wheel.
const SOURCE_LOCK: &str = "harness/requirements-source.lock";

const PIP_INSTALL: [&str; 6] = [
    "-m",
    "pip",
    "install",
    "--quiet",
    "--no-input",
    "--disable-pip-version-check",
];

const LOOKS: u32 = 20;
const BETWEEN_LOOKS: Duration = Duration::from_millis(50);

/// Waits until no other process holds the file's lock; it is held until the result is dropped.
fn alone(path: &Path) -> Outcome<File> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(at(folder))?;
    }
    let file = File::create(path).map_err(at(path))?;
    // Two stages that look at the same time are not worth a word.
    for _ in 0..LOOKS {
        match file.try_lock() {
            Ok(()) => return Ok(file),
            Err(TryLockError::WouldBlock) => std::thread::sleep(BETWEEN_LOOKS),
            Err(TryLockError::Error(cause)) => return Err(at(path)(cause)),
        }
    }
    println!("waiting: another command makes .venv");
    file.lock().map_err(at(path))?;
    Ok(file)
}

/// A Python that sees nothing of the caller's own packages.
fn clean(mut command: Command) -> Command {
    command
        .env_remove("PYTHONPATH")
        .env_remove("PYTHONHOME")
        .env("PYTHONNOUSERSITE", "1")
        .env("PIP_USER", "0");
    command
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_compare_by_number() {
        assert!(version("3 9") < Some(OLDEST));
        assert!(version("3 11") >= Some(OLDEST));
        assert!(version("3 100") > Some(OLDEST));
        assert_eq!(version("Python"), None);
    }

    #[test]
    fn a_python_that_is_not_there_is_one_sentence() {
        let sentence = check_python("no-such-python")
            .expect_err("not there")
            .to_string();
        assert!(
            sentence.contains("python3")
                && sentence.contains("install")
                && !sentence.contains('\n'),
            "{sentence}"
        );
    }

    #[test]
    fn the_lock_files_name_no_registry_and_have_a_hash_for_each_package() {
        for lock in [Packages::Run.lock(), Packages::Test.lock(), SOURCE_LOCK] {
            let text = std::fs::read_to_string(root().join(lock)).expect("is committed");
            assert!(
                !text.contains("://")
                    && !text.contains("--index-url")
                    && !text.contains("--find-links")
            );
            let mut hashes = None;
            for line in text.lines() {
                if line.contains("==") {
                    assert_ne!(hashes, Some(0), "before {line}");
                    hashes = Some(0);
                } else if line.contains("--hash=sha256:") {
                    hashes = hashes.map(|count| count + 1);
                }
            }
            assert!(hashes.is_some_and(|count| count > 0));
        }
    }

    fn locked(packages: Packages) -> String {
        std::fs::read_to_string(root().join(packages.lock())).expect("is committed")
    }

    fn pinned(text: &str) -> Vec<&str> {
        text.lines()
            .filter_map(|line| line.trim_end_matches(" \\").split_once("=="))
            .map(|(name, _)| name)
            .collect()
    }

    #[test]
    fn each_package_is_in_one_lock_file_and_what_is_wanted_is_in_its_own() {
        let texts = [Packages::Run, Packages::Test].map(locked);
        let [run, test] = texts.each_ref().map(|text| pinned(text));
        assert!(run.iter().all(|name| !test.contains(name)));
        for (packages, pins) in [(Packages::Run, &run), (Packages::Test, &test)] {
            let path = root().join(packages.lock()).with_extension("in");
            let wanted = std::fs::read_to_string(path).expect("is committed");
            let lines = texts.concat();
            for line in wanted.lines().filter(|line| line.contains("==")) {
                let (name, _) = line.split_once("==").expect("has it");
                assert!(pins.contains(&name), "{name} is not in {}", packages.lock());
                assert!(lines.contains(&format!("{line} \\")), "{line}");
            }
        }
        for heavy in ["mujoco", "pin", "libcosimpy", "libclang", "pytest", "mypy"] {
            assert!(!run.contains(&heavy), "{heavy} is for tests only");
        }
    }

    #[test]
    fn tests_add_to_what_runs_need_and_an_old_lock_file_makes_it_anew() {
        let wanted = ["run", "test"];
        let (run, old, test) = (Some("run"), Some("old"), Some("test"));
        for (packages, made, expected) in [
            (Packages::Run, (None, None), Work::Anew),
            (Packages::Test, (None, None), Work::Anew),
            (Packages::Run, (run, None), Work::Nothing),
            (Packages::Test, (run, None), Work::Add),
            (Packages::Run, (run, test), Work::Nothing),
            (Packages::Test, (run, test), Work::Nothing),
            (Packages::Run, (old, test), Work::Anew),
            (Packages::Run, (run, old), Work::Anew),
            (Packages::Test, (run, old), Work::Anew),
        ] {
            assert_eq!(work(packages, made.0, made.1, wanted), expected, "{made:?}");
        }
    }

    #[test]
    fn a_second_command_waits_until_the_first_one_has_the_environment() {
        let path = std::env::temp_dir().join(format!("venv-{}.lock", std::process::id()));
        let first = alone(&path).expect("is free");
        let (sender, receiver) = std::sync::mpsc::channel();
        let waiting = path.clone();
        let second = std::thread::spawn(move || {
            let held = alone(&waiting).map(drop);
            sender.send(()).expect("is heard");
            held
        });
        let patience = Duration::from_millis(1300);
        assert!(receiver.recv_timeout(patience).is_err(), "did not wait");
        drop(first);
        receiver.recv().expect("goes on");
        second.join().expect("ends").expect("is free");
        std::fs::remove_file(&path).expect("is there");
    }
}
