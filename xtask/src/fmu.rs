//! Archives from libraries.

use crate::build::{forbid_private_paths, library};
use crate::catalogue::{FMUS, Fmu};
use crate::process::{Failure, Outcome, at, root};
use crate::{linked, wiring};
use model_description::archive::{self, Binary, Contents};
use model_description::{Component, Guide, Interface};
use std::path::Path;

/// Builds `target/fmu/<Name>.fmu` of every FMU, and `target/fmu/test/` for the tests of the C interface.
pub fn build_all(bless: bool) -> Outcome {
    let platform = platform()?;
    let folder = root().join("target/fmu");
    // Before anything is built: a diff can be read while the libraries are made.
    for fmu in FMUS {
        let interface = fmu.interface()?;
        if bless {
            fmu.bless(&interface)?;
        } else if !fmu.is_committed(&interface) {
            println!(
                "note: modelDescription/{}.xml is out of date: `cargo xtask fmu --bless`, then read the diff",
                fmu.name
            );
        }
    }
    for fmu in FMUS {
        let interface = fmu.interface()?;
        let bytes = library(fmu.package, fmu.name)?;
        let binary = Binary {
            platform,
            extension: std::env::consts::DLL_SUFFIX,
            bytes: &bytes,
        };
        let archive = archive(
            &fmu,
            &interface,
            &[binary],
            &linked::components(fmu.package)?,
        )?;
        let path = folder.join(fmu.name).with_extension("fmu");
        replace(&path, &archive)?;
        println!(
            "target/fmu/{}.fmu  {} kB, library {} kB, {platform}",
            fmu.name,
            archive.len() / 1000,
            bytes.len() / 1000
        );
    }
    let name = format!(
        "{}lag{}",
        std::env::consts::DLL_PREFIX,
        std::env::consts::DLL_SUFFIX
    );
    replace(&folder.join("test").join(name), &library("export", "lag")?)
}

/// The archive of one FMU, with libraries for some platforms and what is linked into them.
///
/// # Errors
/// When a path of this machine stands in one of its files.
pub fn archive(
    fmu: &Fmu,
    interface: &Interface,
    binaries: &[Binary<'_>],
    linked: &[Component],
) -> Outcome<Vec<u8>> {
    let contents = Contents {
        interface,
        binaries,
        linked,
        guide: Guide {
            picture: fmu.picture,
            wiring: &wiring::of(fmu.name),
        },
        icon: fmu.icon,
    };
    for (path, bytes) in archive::files(&contents) {
        forbid_private_paths(&format!("{}.fmu: {path}", fmu.name), &bytes)?;
    }
    archive::write(&contents).map_err(|cause| Failure::Found(cause.to_string()))
}

/// Folder of this machine's libraries in an archive.
fn platform() -> Outcome<&'static str> {
    match (std::env::consts::OS, std::env::consts::ARCH) {
        ("linux", "x86_64") => Ok("linux64"),
        ("linux", "aarch64") => Ok("aarch64-linux"),
        ("windows", "x86_64") => Ok("win64"),
        ("macos", "x86_64") => Ok("darwin64"),
        ("macos", "aarch64") => Ok("aarch64-darwin"),
        _ => Err(Failure::Missing(
            "no folder for libraries of this platform is known: expected Linux, Windows or macOS, 64 bit",
        )),
    }
}

/// Replaces a file in one go, so that nobody who loads it sees half of it.
pub fn replace(path: &Path, bytes: &[u8]) -> Outcome {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(at(folder))?;
    }
    let new = path.with_extension("new");
    std::fs::write(&new, bytes).map_err(at(&new))?;
    std::fs::rename(&new, path).map_err(at(path))
}
