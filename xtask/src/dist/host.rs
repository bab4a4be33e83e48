//! The C host, compiled for a platform and run there: its text is what two platforms must agree on.

use crate::catalogue::tables;
use crate::process::{Failure, Outcome, at, program, root};
use cargo_fmu::debian::quietly;
use cargo_fmu::plan::{Built, Library};
use cargo_fmu::platform::{Platform, Runner};
use cargo_fmu::toolchain::Toolchains;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The table of the test model, which has no committed description; references are 256 times the row.
const LAG_TABLE: &str = "model lag\nguid ?\nstep 0.01\npanic 1280\nreal-input 0 0 1\nreal-output 256\nreal-output 768\ninteger-output 1024\nboolean-output 1280\n";

/// What the host printed, by library.
pub type Texts = BTreeMap<String, String>;

/// A compiled host and how to start it.
pub struct Host {
    executable: PathBuf,
    runner: Runner,
    emulator: PathBuf,
}

impl Host {
    /// Compiles the host for a platform.
    ///
    /// # Errors
    /// Why the platform's programs cannot be made or run here.
    pub fn of(platform: &Platform, tools: &Toolchains) -> Result<Self, String> {
        let folder = root().join("target/dist-build/host");
        std::fs::create_dir_all(&folder).map_err(|cause| cause.to_string())?;
        let executable = folder.join(match platform.runner {
            Runner::Wine => "host-win64.exe".to_owned(),
            _ => format!("host-{}", platform.folder),
        });
        let (mut compiler, emulator) = match platform.runner {
            Runner::Machine => (Command::new("cc"), PathBuf::new()),
            Runner::Wine => {
                let programs = tools.mingw()?.join("usr/bin");
                let compiler = programs.join("x86_64-w64-mingw32-gcc-win32");
                (Command::new(compiler), tools.wine()?)
            }
            Runner::Qemu => {
                let programs = tools.zig()?;
                let mut compiler = program(programs.join("python"), ["-m", "ziglang", "cc"]);
                compiler.args(["-target", &platform.zig_c_target()]);
                tools.with_zig(&mut compiler, &programs);
                (compiler, tools.qemu()?)
            }
            Runner::Nothing => return Err("nothing here runs its programs".to_owned()),
        };
        compiler
            .args(["-std=c11", "-O1", "-o"])
            .arg(&executable)
            .arg(root().join("tests/host/host.c"));
        if platform.runner != Runner::Wine {
            compiler.arg("-ldl");
        }
        quietly(&mut compiler).map_err(|_| "the C host does not compile".to_owned())?;
        let host = Self {
            executable,
            runner: platform.runner,
            emulator,
        };
        host.starts(tools)
    }

    /// Whether its programs start at all, so that an emulator that does not is told from a library that fails: without
    /// arguments the host says how it is used.
    fn starts(self, tools: &Toolchains) -> Result<Self, String> {
        let output = self.command(tools).output();
        let said = output.map_err(|cause| cause.to_string())?.stderr;
        if String::from_utf8_lossy(&said).contains("usage: host <library> <table>") {
            Ok(self)
        } else {
            Err("its programs do not start".to_owned())
        }
    }

    /// Runs every library.
    ///
    /// # Errors
    /// When a library cannot be used, or breaks a promise that needs no other platform to be seen.
    pub fn run(&self, built: &Built, tools: &Toolchains) -> Outcome<Texts> {
        let mut texts = Texts::new();
        let folder = self.executable.with_file_name("tables");
        tables(&folder)?;
        let lag = folder.join("lag.txt");
        std::fs::write(&lag, LAG_TABLE).map_err(at(&lag))?;
        for (name, library) in &built.libraries {
            let table = folder.join(name).with_extension("txt");
            texts.insert(name.clone(), self.run_one(library, &table, tools)?);
        }
        Ok(texts)
    }

    fn run_one(&self, library: &Library, table: &Path, tools: &Toolchains) -> Outcome<String> {
        let mut command = self.command(tools);
        command.arg(&library.path).arg(table);
        printed(&mut command, &library.path)
    }

    fn command(&self, tools: &Toolchains) -> Command {
        match self.runner {
            Runner::Wine => tools.under_wine(&self.emulator, &self.executable),
            Runner::Qemu => tools.under_qemu(&self.emulator, &self.executable),
            _ => program::<&Path>(&self.executable, []),
        }
    }
}

/// What a C program of `tests/host` prints when it runs to its end.
///
/// # Errors
/// When it does not, or says that `subject` breaks a promise that needs no other platform to be seen.
pub fn printed(command: &mut Command, subject: &Path) -> Outcome<String> {
    let program = PathBuf::from(command.get_program());
    let output = command.output().map_err(at(&program))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    // The last line: a program that an emulator loses half way must not pass.
    if output.status.success() && text.ends_with("end\n") {
        return Ok(text);
    }
    let broken = text.lines().find(|line| line.starts_with("broken"));
    Err(Failure::Found(format!(
        "the C program failed on {}: {} {}",
        subject.display(),
        broken.unwrap_or_default(),
        String::from_utf8_lossy(&output.stderr).trim()
    )))
}

/// Compares what two platforms printed.
///
/// # Errors
/// The first line that differs.
pub fn compare(reference: &Texts, other: &Texts) -> Result<usize, String> {
    let mut lines = 0;
    for (name, expected) in reference {
        let text = other.get(name).ok_or(format!("{name} was not run"))?;
        let mut left = expected.lines();
        let mut right = text.lines();
        loop {
            match (left.next(), right.next()) {
                (None, None) => break,
                (a, b) if a == b => lines += 1,
                (a, b) => return Err(format!("{name}: {}", difference(a, b))),
            }
        }
    }
    Ok(lines)
}

/// Two lines, shortened to the first word in which they differ.
fn difference(a: Option<&str>, b: Option<&str>) -> String {
    let (Some(a), Some(b)) = (a, b) else {
        return "one text is longer".to_owned();
    };
    let first = a.split(' ').next().unwrap_or_default();
    let words = a.split(' ').zip(b.split(' ')).find(|(a, b)| a != b);
    let (expected, got) = words.unwrap_or((a, b));
    format!("in the line that begins with {first}: expected {expected}, got {got}")
}

/// Whether the outputs of a run moved, so that equal texts say something: at least half of its lines of numbers differ
/// from the line before.
pub fn moves(text: &str) -> bool {
    let numbers: Vec<_> = text
        .lines()
        .filter_map(|line| line.split_once(' '))
        .filter(|(number, _)| number.parse::<u32>().is_ok())
        .map(|(_, values)| values)
        .collect();
    let moved = numbers.windows(2).filter(|pair| pair[0] != pair[1]).count();
    2 * moved > numbers.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(text: &str) -> Texts {
        Texts::from([("Lag".to_owned(), text.to_owned())])
    }

    #[test]
    fn one_differing_bit_is_found_and_named() {
        let reference = texts("start\n1 256=3ff0000000000000 512=1\nend\n");
        assert_eq!(compare(&reference, &reference), Ok(3));
        let other = texts("start\n1 256=3ff0000000000001 512=1\nend\n");
        let found = compare(&reference, &other).expect_err("differs");
        assert!(
            found.contains("Lag") && found.contains("256=3ff0000000000001"),
            "{found}"
        );
        assert!(compare(&reference, &texts("start\n")).is_err());
        assert!(compare(&reference, &Texts::new()).is_err());
    }

    #[test]
    fn a_run_in_which_nothing_moves_is_no_comparison() {
        assert!(moves("a\n0 1=0\n1 1=1\n2 1=2\n"));
        assert!(!moves("a\n0 1=0\n1 1=0\n2 1=0\n"));
    }
}
