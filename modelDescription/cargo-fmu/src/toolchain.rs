//! The tools that make and run libraries of other platforms, in a folder of their own. Each is fetched once; what cannot
//! be had is a reason in words, not a failure.

use crate::debian::{Debian, quietly};
use crate::process::{Outcome, answer, at, program};
use crate::trace::sysroot;
use std::cell::OnceCell;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A tool's folder, or why it is not there.
type Tool = Result<PathBuf, String>;

/// Versions and hashes of zig and cargo-zigbuild.
const WHEELS: &str = include_str!("../wheels.lock");

/// All tools.
pub struct Toolchains {
    folder: PathBuf,
    debian: OnceCell<Result<Debian, String>>,
    zig: OnceCell<Tool>,
    rust: OnceCell<Tool>,
    apple: OnceCell<Tool>,
    mingw: OnceCell<Tool>,
    arm_binutils: OnceCell<Tool>,
    wine: OnceCell<Tool>,
    qemu: OnceCell<Tool>,
}

impl Toolchains {
    /// Tools that lie in a folder, or will.
    pub fn at(folder: PathBuf) -> Self {
        Self {
            folder,
            debian: OnceCell::new(),
            zig: OnceCell::new(),
            rust: OnceCell::new(),
            apple: OnceCell::new(),
            mingw: OnceCell::new(),
            arm_binutils: OnceCell::new(),
            wine: OnceCell::new(),
            qemu: OnceCell::new(),
        }
    }

    /// Where they lie.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Fetches all, those that nothing here can use included.
    pub fn fetch(&self) {
        for (name, tool) in [
            ("zig", self.zig()),
            ("rust", self.rust()),
            ("apple", self.apple()),
            ("mingw", self.mingw()),
            ("arm-binutils", self.arm_binutils()),
            ("wine", self.wine()),
            ("qemu", self.qemu()),
        ] {
            match tool {
                Ok(_) => println!("{name}: there"),
                Err(reason) => println!("{name}: not there: {reason}"),
            }
        }
    }

    /// zig and cargo-zigbuild: the folder of their programs.
    pub fn zig(&self) -> Tool {
        self.zig
            .get_or_init(|| {
                let folder = self.complete("zig", WHEELS, wheels)?;
                Ok(folder.join("bin"))
            })
            .clone()
    }

    /// Debian's compiler with the source of its standard library.
    pub fn rust(&self) -> Tool {
        self.rust
            .get_or_init(|| {
                self.complete("rust", "1", |_| {
                    let debian = self.debian()?;
                    let shared = debian
                        .dependencies("libstd-rust-web-dev")
                        .into_iter()
                        .find(|name| name.starts_with("libstd-rust-web-"))
                        .ok_or("Debian has no package libstd-rust-web-dev here")?;
                    let mut packages: Vec<_> = debian
                        .dependencies(&shared)
                        .into_iter()
                        .filter(|name| name.starts_with("libllvm"))
                        .collect();
                    packages.extend(
                        ["rustc-web", &shared, "libstd-rust-web-dev", "rust-web-src"]
                            .map(str::to_owned),
                    );
                    debian.unpacked("rust", &packages).map(|_| ())
                })
            })
            .clone()
    }

    /// What a linker must know of macOS: the names in its system library, as a folder like that of Apple's SDK. zig has them,
    /// with names of processors that a linker of another version does not know.
    pub fn apple(&self) -> Tool {
        self.apple
            .get_or_init(|| {
                let names = self.zig()?;
                let names = zig_folder(&names).join("lib/libc/darwin/libSystem.tbd");
                let text = std::fs::read_to_string(&names)
                    .map_err(|cause| format!("zig's names of macOS cannot be read: {cause}"))?
                    .replace("arm64e.x1-", "arm64-")
                    .replace("arm64e-", "arm64-");
                self.complete("apple", &text, |folder| {
                    let libraries = folder.join("usr/lib");
                    std::fs::create_dir_all(&libraries).map_err(|cause| cause.to_string())?;
                    for name in ["libSystem.tbd", "libc.tbd", "libm.tbd"] {
                        write(&libraries.join(name), &text)
                            .map_err(|failure| failure.to_string())?;
                    }
                    Ok(())
                })
            })
            .clone()
    }

    /// LLVM's linker, beside the standard library of the compiler of this machine.
    pub fn lld(&self) -> Tool {
        let sysroot = sysroot().ok_or("rustc does not say its sysroot")?;
        let lld = sysroot.join("lib/rustlib/x86_64-unknown-linux-gnu/bin/rust-lld");
        if lld.exists() {
            Ok(lld)
        } else {
            Err("the compiler of this machine comes without rust-lld".to_owned())
        }
    }

    /// GCC for Windows.
    pub fn mingw(&self) -> Tool {
        self.packages(
            &self.mingw,
            "mingw",
            &[
                "binutils-mingw-w64-x86-64",
                "gcc-mingw-w64-base",
                "gcc-mingw-w64-x86-64-win32",
                "gcc-mingw-w64-x86-64-win32-runtime",
                "mingw-w64-common",
                "mingw-w64-x86-64-dev",
            ],
        )
    }

    /// A linker for microcontrollers.
    pub fn arm_binutils(&self) -> Tool {
        let packages = ["binutils-arm-none-eabi"];
        self.packages(&self.arm_binutils, "arm-binutils", &packages)
    }

    /// wine, for 64-bit programs without windows.
    pub fn wine(&self) -> Tool {
        let packages = ["wine64", "libwine", "libunwind8", "libz-mingw-w64"];
        let folder = self.packages(&self.wine, "wine", &packages)?;
        // The package's wineserver is a script with fixed paths; wine's own zlib lies where the package manager links it.
        for (from, to) in [
            ("usr/lib/wine/wineserver64", "usr/lib/wine/wineserver"),
            (
                "usr/x86_64-w64-mingw32/lib/zlib1.dll",
                "usr/lib/x86_64-linux-gnu/wine/x86_64-windows/zlib1.dll",
            ),
        ] {
            std::fs::copy(folder.join(from), folder.join(to))
                .map_err(|cause| format!("wine's package has changed: {from}: {cause}"))?;
        }
        Ok(folder)
    }

    /// qemu for programs of aarch64 Linux, and their C library.
    pub fn qemu(&self) -> Tool {
        let packages = [
            "qemu-user-static",
            "libc6-arm64-cross",
            "libgcc-s1-arm64-cross",
        ];
        self.packages(&self.qemu, "qemu", &packages)
    }

    fn packages(&self, cell: &OnceCell<Tool>, name: &str, packages: &[&str]) -> Tool {
        let packages: Vec<_> = packages.iter().map(|&name| name.to_owned()).collect();
        cell.get_or_init(|| {
            self.complete(name, &packages.join(" "), |_| {
                self.debian()?.unpacked(name, &packages).map(|_| ())
            })
        })
        .clone()
    }

    fn debian(&self) -> Result<&Debian, String> {
        let debian = self.debian.get_or_init(|| Debian::at(self.folder.clone()));
        debian.as_ref().map_err(Clone::clone)
    }

    /// zig's caches, kept out of the user's home.
    pub fn with_zig<'a>(&self, command: &'a mut Command, programs: &Path) -> &'a mut Command {
        command
            .env("PATH", path_with(programs))
            .env("ZIG_GLOBAL_CACHE_DIR", self.folder.join("zig-cache"))
            .env("ZIG_LOCAL_CACHE_DIR", self.folder.join("zig-cache"))
            .env(
                "CARGO_ZIGBUILD_CACHE_DIR",
                self.folder.join("zigbuild-cache"),
            )
    }

    /// Makes a tool's folder, unless it was completed before from the same `wanted`.
    fn complete(
        &self,
        name: &str,
        wanted: &str,
        make: impl FnOnce(&Path) -> Result<(), String>,
    ) -> Tool {
        let folder = self.folder.join(name);
        let stamp = folder.join("made-from");
        if std::fs::read_to_string(&stamp).is_ok_and(|text| text == wanted) {
            return Ok(folder);
        }
        println!("fetching {name} into {}", self.folder.display());
        let _ = std::fs::remove_dir_all(&folder);
        make(&folder)?;
        // Last: an interrupted one leaves no stamp.
        write(&stamp, wanted).map_err(|failure| failure.to_string())?;
        Ok(folder)
    }

    /// A program of a Windows machine.
    pub fn under_wine(&self, folder: &Path, executable: &Path) -> Command {
        let mut command = limited(folder.join("usr/lib/wine/wine64"));
        with_libraries(&mut command, folder)
            .arg(executable)
            .env("WINEPREFIX", self.folder.join("wine-prefix"))
            .env("WINEDLLOVERRIDES", "mscoree,mshtml=")
            .env("WINEDEBUG", "-all")
            .env_remove("DISPLAY");
        command
    }

    /// A program of an aarch64 Linux machine.
    pub fn under_qemu(&self, folder: &Path, executable: &Path) -> Command {
        let mut command = limited(folder.join("usr/bin/qemu-aarch64-static"));
        command
            .arg("-L")
            .arg(folder.join("usr/aarch64-linux-gnu"))
            .arg(executable);
        command
    }
}

/// An emulator, ended when it hangs: wine's first start takes a quarter of a minute, a run a few seconds.
pub fn limited(emulator: PathBuf) -> Command {
    let mut command = program("timeout", ["600"]);
    command.arg(emulator);
    command
}

/// `PATH` with a folder before all others.
pub fn path_with(first: &Path) -> OsString {
    let others = std::env::var_os("PATH").unwrap_or_default();
    let mut folders = vec![first.to_path_buf()];
    folders.extend(std::env::split_paths(&others));
    std::env::join_paths(folders).unwrap_or(others)
}

/// Where the wheel of zig lies.
pub fn zig_folder(programs: &Path) -> PathBuf {
    let place = "import os, ziglang; print(os.path.dirname(ziglang.__file__))";
    answer(&mut program(programs.join("python"), ["-c", place]))
        .unwrap_or_default()
        .into()
}

/// A program from an unpacked folder of packages finds its shared libraries there.
pub fn with_libraries<'a>(command: &'a mut Command, folder: &Path) -> &'a mut Command {
    command.env("LD_LIBRARY_PATH", folder.join("usr/lib/x86_64-linux-gnu"))
}

fn write(path: &Path, text: &str) -> Outcome {
    std::fs::write(path, text).map_err(at(path))
}

/// A Python environment of its own: these tools are none of the harness' business.
fn wheels(folder: &Path) -> Result<(), String> {
    let reason = "cargo-zigbuild and ziglang cannot be installed from Python's package index";
    let mut make = program("python3", ["-m", "venv"]);
    quietly(make.arg(folder)).map_err(|_| reason.to_owned())?;
    let lock = folder.join("wheels.lock");
    write(&lock, WHEELS).map_err(|failure| failure.to_string())?;
    let mut pip = program(folder.join("bin/python"), ["-m", "pip", "install"]);
    pip.args([
        "--quiet",
        "--no-input",
        "--disable-pip-version-check",
        "--no-deps",
        "--require-hashes",
        "--only-binary=:all:",
        "-r",
    ])
    .arg(lock);
    quietly(&mut pip).map_err(|_| reason.to_owned())
}
