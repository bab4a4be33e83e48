//! Libraries for one platform, with its tools; and what they need there.

use crate::Workspace;
use crate::cdylib::Cdylib;
use crate::compile::{as_exported, built};
use crate::functions;
use crate::inspect::inspect;
use crate::platform::{Linker, Platform, Standard};
use crate::process::{Failure, Outcome, at};
use crate::runtime;
use crate::toolchain::{Toolchains, path_with, with_libraries};
use crate::trace::{forbid_private_paths, git_hash, remapping};
use fmu_archive::Component;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

/// What was built, and how.
pub struct Built {
    /// Libraries by name.
    pub libraries: BTreeMap<String, Library>,
    /// Whether the linker promises the oldest C library.
    pub strict: bool,
    /// What the tools have linked in besides cargo's packages.
    pub runtimes: Vec<Component>,
}

/// What was seen in libraries.
pub struct Inspected {
    /// What they need, in words.
    pub said: String,
    /// Libraries, and functions of C's mathematics that they call: each platform rounds them in its own way.
    pub rounded: BTreeSet<(String, String)>,
}

impl Built {
    /// Inspects every library; says what they need.
    ///
    /// # Errors
    /// Names the library and the first rule that it breaks.
    pub fn inspected(&self, workspace: &Workspace, platform: &Platform) -> Outcome<Inspected> {
        let (mut needs, mut rounded) = (BTreeSet::new(), BTreeSet::new());
        let functions = functions::exported();
        let (mut glibc, mut size) = (None, 0);
        for (name, library) in &self.libraries {
            let report =
                inspect(&library.bytes, platform, &functions, self.strict).map_err(|what| {
                    Failure::Found(format!("{name} for {}: {what}", platform.folder))
                })?;
            forbid_private_paths(workspace, &library.path.to_string_lossy(), &library.bytes)?;
            needs.extend(report.needs);
            let called = report.rounded.into_iter();
            rounded.extend(called.map(|function| (name.clone(), function)));
            glibc = glibc.max(report.glibc);
            size = size.max(library.bytes.len());
        }
        let needs = needs.into_iter().collect::<Vec<_>>().join(", ");
        let floor = match glibc {
            Some((major, minor)) if self.strict => format!("glibc {major}.{minor}; "),
            Some((major, minor)) => {
                format!("glibc {major}.{minor}, this machine's, for want of zig's linker; ")
            }
            None => String::new(),
        };
        Ok(Inspected {
            said: format!("{floor}needs {needs}; at most {} kB", size / 1000),
            rounded,
        })
    }
}

/// A library as a file.
pub struct Library {
    /// Where it lies.
    pub path: PathBuf,
    /// What is in it.
    pub bytes: Vec<u8>,
}

/// Tools of one platform, or the reason why it is left out.
pub struct Plan<'t> {
    tools: &'t Toolchains,
    zig: Option<PathBuf>,
    rust: Option<PathBuf>,
    mingw: Option<PathBuf>,
    /// The linker, and what it must know of macOS.
    lld: Option<(PathBuf, PathBuf)>,
}

impl<'t> Plan<'t> {
    /// Looks for the tools.
    ///
    /// # Errors
    /// Why the platform cannot be built here.
    pub fn of(platform: &Platform, tools: &'t Toolchains) -> Result<Self, String> {
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
            tools,
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

    /// Builds libraries into the folder `target`.
    ///
    /// # Errors
    /// When cargo fails: the tools are there, so this is no reason to leave the platform out.
    pub fn build(
        &self,
        workspace: &Workspace,
        platform: &Platform,
        target: &Path,
        cdylibs: &[Cdylib],
    ) -> Outcome<Built> {
        let mut command = self.cargo(workspace, platform);
        command.args(["--release", "--target-dir"]).arg(target);
        let compilers = self.rust.as_deref().map(renamed).unwrap_or_default();
        let mut profile = as_exported("release").to_vec();
        if self.lld.is_some() {
            // The linker strips: Debian's compiler comes without the program that would.
            profile.retain(|(key, _)| !key.ends_with("STRIP"));
        }
        command
            .envs(profile)
            .env("FMU_GIT_HASH", git_hash(workspace))
            .env(
                "CARGO_ENCODED_RUSTFLAGS",
                self.flags(workspace, platform, &compilers)?,
            );
        let mut libraries = BTreeMap::new();
        for (name, path) in built(&mut command, cdylibs, platform.suffix)? {
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

    fn cargo(&self, workspace: &Workspace, platform: &Platform) -> Command {
        let mut command = match &self.zig {
            Some(programs) => {
                let mut zig = workspace.program(programs.join("cargo-zigbuild"));
                zig.args(["zigbuild", "--target", &platform.zig_target()]);
                zig.args(&workspace.flags);
                self.tools.with_zig(&mut zig, programs);
                zig
            }
            None => {
                let mut cargo = workspace.cargo("build");
                cargo.args(["--target", platform.target]);
                cargo
            }
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
                .env("CARGO_PROFILE_RELEASE_STRIP", "none");
        }
        command
    }

    fn flags(
        &self,
        workspace: &Workspace,
        platform: &Platform,
        compilers: &[(PathBuf, String)],
    ) -> Outcome<std::ffi::OsString> {
        let mut flags = remapping(workspace, compilers)?;
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
