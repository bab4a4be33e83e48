//! One platform's libraries: all FMUs and the test model in one call of cargo.

use super::platform::{Linker, Platform, Standard};
use super::runtime;
use super::toolchain::{Toolchains, path_with, with_libraries, with_zig};
use crate::build::{LAG, git_hash, remapping};
use crate::component::Component;
use crate::process::{Outcome, at, cargo, program, root, run};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What was built, and how.
pub struct Built {
    /// Libraries by name.
    pub libraries: BTreeMap<&'static str, Library>,
    /// Whether the linker promises the oldest C library.
    pub strict: bool,
    /// What the tools have linked in besides cargo's packages.
    pub runtimes: Vec<Component>,
}

/// A library as a file.
pub struct Library {
    /// Where it lies.
    pub path: PathBuf,
    /// What is in it.
    pub bytes: Vec<u8>,
}

/// Tools of one platform, or the reason why it is left out.
pub struct Plan {
    zig: Option<PathBuf>,
    rust: Option<PathBuf>,
    mingw: Option<PathBuf>,
    /// The linker, and what it must know of macOS.
    lld: Option<(PathBuf, PathBuf)>,
}

impl Plan {
    /// Looks for the tools.
    ///
    /// # Errors
    /// Why the platform cannot be built here.
    pub fn of(platform: &Platform, tools: &Toolchains) -> Result<Self, String> {
        let host = (std::env::consts::OS, std::env::consts::ARCH);
        if host != ("linux", "x86_64") {
            return Err(format!(
                "built on x86-64 Linux only, this is {} {}",
                host.0, host.1
            ));
        }
        let rust = match platform.standard {
            Standard::Shipped => None,
            Standard::FromSource => Some(tools.rust()?),
        };
        let mut plan = Self {
            zig: None,
            rust,
            mingw: None,
            lld: None,
        };
        match (platform.linker, platform.standard) {
            (Linker::MinGw, _) => plan.mingw = Some(tools.mingw()?),
            (Linker::Lld, _) => plan.lld = Some((tools.lld()?, tools.apple()?)),
            // This machine's own linker does, although what it makes needs this machine's C library.
            (Linker::Zig, Standard::Shipped) => plan.zig = tools.zig().ok(),
            (Linker::Zig, Standard::FromSource) => plan.zig = Some(tools.zig()?),
        }
        Ok(plan)
    }

    /// Builds all FMUs and the test model, or `only` one of them, into the folder `target`.
    ///
    /// # Errors
    /// When cargo fails: the tools are there, so this is no reason to leave the platform out.
    pub fn build(&self, platform: &Platform, target: &Path, only: Option<&str>) -> Outcome<Built> {
        let mut command = self.cargo(platform);
        command
            .args(["--locked", "--release", "--target-dir"])
            .arg(target);
        let mut names = Vec::new();
        for (package, name) in fmus::ALL
            .iter()
            .map(|fmu| (fmu.package(), fmu.name))
            .chain([("fmu-export".to_owned(), LAG)])
            .filter(|(_, name)| only.is_none_or(|only| only == *name))
        {
            command.args(["--package", &package, "--example", name]);
            names.push(name);
        }
        let compilers = self.rust.as_deref().map(renamed).unwrap_or_default();
        command
            .env("FMU_GIT_HASH", git_hash())
            .env("CARGO_ENCODED_RUSTFLAGS", self.flags(platform, &compilers)?);
        run(&mut command)?;
        let folder = target.join(platform.target).join("release/examples");
        let mut libraries = BTreeMap::new();
        for name in names {
            let path = folder.join(format!("{}{name}{}", platform.prefix, platform.suffix));
            let bytes = std::fs::read(&path).map_err(at(&path))?;
            libraries.insert(name, Library { path, bytes });
        }
        Ok(Built {
            libraries,
            strict: self.zig.is_some() || self.mingw.is_some() || self.lld.is_some(),
            runtimes: self.runtimes()?,
        })
    }

    /// What the tools link in besides cargo's packages.
    fn runtimes(&self) -> Outcome<Vec<Component>> {
        let mut components = Vec::new();
        if let Some(rust) = &self.rust {
            components.push(runtime::rust(rust)?);
        }
        if let Some(zig) = &self.zig {
            components.push(runtime::zig(zig)?);
        }
        if let Some(mingw) = &self.mingw {
            components.extend(runtime::mingw(mingw)?);
        }
        Ok(components)
    }

    fn cargo(&self, platform: &Platform) -> Command {
        let mut command = match &self.zig {
            Some(programs) => {
                let mut zig = program(programs.join("cargo-zigbuild"), ["zigbuild", "--target"]);
                zig.arg(platform.zig_target());
                with_zig(&mut zig, programs);
                zig
            }
            None => cargo(["build", "--target", platform.target]),
        };
        if let Some(rust) = &self.rust {
            with_libraries(&mut command, rust)
                .arg("-Zbuild-std=std,panic_unwind")
                .env("RUSTC", rust.join("usr/bin/rustc"))
                // The standard library is built with this compiler's own unstable features.
                .env("RUSTC_BOOTSTRAP", "1");
        }
        if let Some(mingw) = &self.mingw {
            let programs = mingw.join("usr/bin");
            command.env("PATH", path_with(&programs)).env(
                "CARGO_TARGET_X86_64_PC_WINDOWS_GNU_LINKER",
                programs.join("x86_64-w64-mingw32-gcc-win32"),
            );
        }
        if let Some((lld, apple)) = &self.lld {
            let variable = platform.target.to_uppercase().replace('-', "_");
            command
                .env(format!("CARGO_TARGET_{variable}_LINKER"), lld)
                .env("SDKROOT", apple)
                // The linker strips: Debian's compiler comes without the program that would.
                .env("CARGO_PROFILE_RELEASE_STRIP", "none");
        }
        command
    }

    fn flags(
        &self,
        platform: &Platform,
        compilers: &[(PathBuf, String)],
    ) -> Outcome<std::ffi::OsString> {
        let mut flags = remapping(compilers)?;
        flags.push(match platform.linker {
            Linker::Zig => "",
            // The linker would write the time of day into the library.
            Linker::MinGw => "\x1f-Clink-arg=-Wl,--no-insert-timestamp",
            // No symbols, and as its own name not the path at which it was linked.
            Linker::Lld => concat!(
                "\x1f-Clinker-flavor=ld64.lld\x1f-Clink-arg=-S\x1f-Clink-arg=-x",
                "\x1f-Clink-arg=-install_name\x1f-Clink-arg=@rpath/model.dylib"
            ),
        });
        Ok(flags)
    }
}

/// What stands in a library instead of the place of Debian's compiler.
pub fn renamed(rust: &Path) -> Vec<(PathBuf, String)> {
    vec![(rust.to_owned(), "/rust".to_owned())]
}

/// Where a platform's build lives between calls.
pub fn folder() -> PathBuf {
    root().join("target/dist-build")
}
