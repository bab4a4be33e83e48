//! Debian packages, unpacked into folders of our own. Nothing is installed, no root is needed, and the machine's own
//! package lists are left alone.

use crate::process::{answer, program};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Where packages come from: the sources that this machine is configured for.
pub struct Debian {
    folder: PathBuf,
}

impl Debian {
    /// Fetches the lists of packages into `folder`.
    ///
    /// # Errors
    /// A reason, when this is no Debian or its sources cannot be reached.
    pub fn at(folder: PathBuf) -> Result<Self, String> {
        if answer(&mut program("dpkg", ["--version"])).is_none() {
            return Err("no Debian packages on this machine: no dpkg".to_owned());
        }
        let debian = Self { folder };
        for part in ["apt/state/lists/partial", "apt/cache/archives/partial"] {
            let path = debian.folder.join(part);
            std::fs::create_dir_all(&path)
                .map_err(|cause| format!("{}: {cause}", path.display()))?;
        }
        quietly(debian.apt("apt-get").arg("update"))
            .map_err(|_| "the lists of Debian's packages cannot be fetched".to_owned())?;
        Ok(debian)
    }

    /// Names of the packages that `package` depends on, alternatives included.
    pub fn dependencies(&self, package: &str) -> Vec<String> {
        let text = answer(self.apt("apt-cache").args(["depends", package])).unwrap_or_default();
        text.lines()
            .filter_map(|line| line.trim().strip_prefix("Depends: "))
            .map(str::to_owned)
            .collect()
    }

    /// Unpacks packages into the folder `name`, unless it has been done.
    ///
    /// # Errors
    /// A reason that names the packages.
    pub fn unpacked(&self, name: &str, packages: &[String]) -> Result<PathBuf, String> {
        let root = self.folder.join(name);
        let _ = std::fs::remove_dir_all(&root);
        let archives = self.folder.join(format!("{name}-packages"));
        let _ = std::fs::remove_dir_all(&archives);
        let reason = |what: &str| {
            format!(
                "Debian packages that cannot be {what}: {}",
                packages.join(" ")
            )
        };
        std::fs::create_dir_all(&archives).map_err(|_| reason("stored"))?;
        let mut download = self.apt("apt-get");
        download
            .arg("download")
            .args(packages)
            .current_dir(&archives);
        quietly(&mut download).map_err(|_| reason("downloaded"))?;
        let files = std::fs::read_dir(&archives).map_err(|_| reason("listed"))?;
        for file in files.flatten() {
            let mut unpack = Command::new("dpkg");
            unpack.arg("-x").arg(file.path()).arg(&root);
            quietly(&mut unpack).map_err(|_| reason("unpacked"))?;
        }
        let _ = std::fs::remove_dir_all(&archives);
        Ok(root)
    }

    /// An apt program that keeps its state in our folder.
    fn apt(&self, name: &str) -> Command {
        let mut command = program(name, ["-q", "-o", "APT::Sandbox::User=root"]);
        for (option, path) in [
            ("Dir::State::lists", "apt/state/lists"),
            ("Dir::Cache", "apt/cache"),
        ] {
            command
                .arg("-o")
                .arg(assignment(option, &self.folder.join(path)));
        }
        command.args(["-o", "Debug::NoLocking=1"]);
        // A machine without a way out is told in a minute, not in ten.
        for limit in [
            "Acquire::http::Timeout=30",
            "Acquire::https::Timeout=30",
            "Acquire::Retries=1",
        ] {
            command.args(["-o", limit]);
        }
        command
    }
}

fn assignment(option: &str, path: &Path) -> String {
    format!("{option}={}", path.display())
}

/// Runs a program, and shows what it printed only if it fails.
pub fn quietly(command: &mut Command) -> Result<(), String> {
    let output = command.output().map_err(|cause| cause.to_string())?;
    if output.status.success() {
        return Ok(());
    }
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    eprint!("{text}");
    Err(text)
}
