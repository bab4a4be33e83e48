//! The Python environment `.venv`: from the lock file, with hashes, and made anew when the lock file changes.

use crate::process::{Failure, Outcome, answer, at, program, root, run};
use std::path::PathBuf;
use std::process::Command;

const OLDEST: (u32, u32) = (3, 11);

/// The environment.
pub struct Venv {
    folder: PathBuf,
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
    /// The environment, made if it is not there or not from the present lock file.
    pub fn ready() -> Outcome<Self> {
        check_machine()?;
        let venv = Self {
            folder: root().join(".venv"),
        };
        let (wanted, stamp) = (venv.wanted()?, venv.folder.join("made-from"));
        if std::fs::read_to_string(&stamp).is_ok_and(|text| text == wanted)
            && venv.installed("python").exists()
        {
            return Ok(venv);
        }
        println!("making .venv from harness/requirements.lock");
        if venv.folder.exists() {
            std::fs::remove_dir_all(&venv.folder).map_err(at(&venv.folder))?;
        }
        run(clean(program("python3", ["-m", "venv"])).arg(&venv.folder))?;
        let pip = [
            "-m",
            "pip",
            "install",
            "--quiet",
            "--no-input",
            "--disable-pip-version-check",
        ];
        run(venv.command(pip).args([
            "--require-hashes",
            "--only-binary=:all:",
            "-r",
            "harness/requirements.lock",
        ]))?;
        run(venv
            .command(pip)
            .args(["--no-deps", "--no-build-isolation", "-e", "harness"]))?;
        // Last: an interrupted installation leaves no stamp.
        std::fs::write(&stamp, wanted).map_err(at(&stamp))?;
        Ok(venv)
    }

    /// What the environment is made from: a change of any part means making it anew.
    fn wanted(&self) -> Outcome<String> {
        let mut text = format!("{}\n", self.folder.display()); // an environment cannot be moved
        for file in ["harness/requirements.lock", "harness/pyproject.toml"] {
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
            "the libclang wheel is not in .venv: it belongs in harness/requirements.in",
        ))
    }
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
    fn the_lock_file_names_no_registry_and_has_a_hash_for_each_package() {
        let text = std::fs::read_to_string(root().join("harness/requirements.lock"))
            .expect("is committed");
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
