//! The table of the platforms.

use crate::process::{Failure, Outcome};

/// Which standard library a platform's libraries are linked with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standard {
    /// The one that comes with the compiler of this machine.
    Shipped,
    /// Built from source with Debian's compiler, because no compiled one can be had.
    FromSource,
}

/// Who links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Linker {
    /// zig, through cargo-zigbuild.
    Zig,
    /// GCC for Windows.
    MinGw,
    /// LLVM's linker for macOS, which comes with the compiler of this machine. zig's own offers every function of the
    /// library to the world, and writes into it where it was built.
    Lld,
}

/// What runs the platform's programs on this machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Runner {
    /// The machine itself.
    Machine,
    /// wine
    Wine,
    /// qemu in user mode
    Qemu,
    /// Nothing: built, not run.
    Nothing,
}

/// One platform.
#[derive(Debug)]
pub struct Platform {
    /// Folder in the archive.
    pub folder: &'static str,
    /// Rust's name.
    pub target: &'static str,
    /// End of a library's file name.
    pub suffix: &'static str,
    /// Standard library.
    pub standard: Standard,
    /// Linker.
    pub linker: Linker,
    /// How it is tried.
    pub runner: Runner,
}

/// Newest version of the GNU C library that a Linux library may ask for: that of 2012, older than every system in use.
pub const GLIBC: (u32, u32) = (2, 17);

/// All platforms. The first is what the others are compared with.
pub const PLATFORMS: [Platform; 5] = [
    Platform {
        folder: "linux64",
        target: "x86_64-unknown-linux-gnu",
        suffix: ".so",
        standard: Standard::Shipped,
        linker: Linker::Zig,
        runner: Runner::Machine,
    },
    Platform {
        folder: "win64",
        target: "x86_64-pc-windows-gnu",
        suffix: ".dll",
        standard: Standard::FromSource,
        linker: Linker::MinGw,
        runner: Runner::Wine,
    },
    Platform {
        folder: "aarch64-linux",
        target: "aarch64-unknown-linux-gnu",
        suffix: ".so",
        standard: Standard::FromSource,
        linker: Linker::Zig,
        runner: Runner::Qemu,
    },
    Platform {
        folder: "darwin64",
        target: "x86_64-apple-darwin",
        suffix: ".dylib",
        standard: Standard::FromSource,
        linker: Linker::Lld,
        runner: Runner::Nothing,
    },
    Platform {
        folder: "aarch64-darwin",
        target: "aarch64-apple-darwin",
        suffix: ".dylib",
        standard: Standard::FromSource,
        linker: Linker::Lld,
        runner: Runner::Nothing,
    },
];

/// The platform that this program runs on.
///
/// # Errors
/// When archives have no folder for it.
pub fn here() -> Outcome<&'static Platform> {
    let target = match (std::env::consts::OS, std::env::consts::ARCH) {
        ("linux", "x86_64") => "linux64",
        ("linux", "aarch64") => "aarch64-linux",
        ("windows", "x86_64") => "win64",
        ("macos", "x86_64") => "darwin64",
        ("macos", "aarch64") => "aarch64-darwin",
        _ => "",
    };
    let known = PLATFORMS.iter().find(|platform| platform.folder == target);
    known.ok_or(Failure::Missing(
        "no folder for libraries of this platform is known: expected Linux, Windows or macOS, 64 bit",
    ))
}

impl Platform {
    /// One by its folder in an archive.
    ///
    /// # Errors
    /// Names those that are known.
    pub fn named(folder: &str) -> Outcome<&'static Self> {
        let known = PLATFORMS.iter().find(|platform| platform.folder == folder);
        known.ok_or_else(|| {
            let names = PLATFORMS
                .each_ref()
                .map(|platform| platform.folder)
                .join(", ");
            Failure::Found(format!("platform {folder}: expected one of {names}"))
        })
    }

    /// What cargo-zigbuild is told: the target, with the oldest C library to support.
    pub fn zig_target(&self) -> String {
        format!("{}.{}.{}", self.target, GLIBC.0, GLIBC.1)
    }

    /// What zig's C compiler is told.
    pub fn zig_c_target(&self) -> String {
        let machine = self.target.split('-').next().unwrap_or_default();
        format!("{machine}-linux-gnu.{}.{}", GLIBC.0, GLIBC.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_platform_is_the_one_that_runs_without_an_emulator() {
        assert_eq!(PLATFORMS[0].runner, Runner::Machine);
        assert!(
            PLATFORMS[1..]
                .iter()
                .all(|other| other.runner != Runner::Machine)
        );
    }

    #[test]
    fn linux_is_asked_for_with_its_oldest_c_library() {
        let asked: Vec<_> = PLATFORMS
            .iter()
            .filter(|platform| platform.linker == Linker::Zig)
            .map(Platform::zig_target)
            .collect();
        let expected = ["x86_64", "aarch64"].map(|arch| format!("{arch}-unknown-linux-gnu.2.17"));
        assert_eq!(asked, expected);
    }
}
