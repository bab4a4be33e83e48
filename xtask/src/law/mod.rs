//! The C library: headers, static libraries in both precisions, examples. `cargo xtask dist` compiles it for a
//! microcontroller, too.
//!
//! | module | what |
//! |---|---|
//! | [`mod@pack`] | of what cargo makes, the law alone and its own symbols alone; it must link though no panic handler is there |
//! | [`install`] | a folder as other programs expect it: pkg-config, CMake, licences, bill of materials |

pub mod install;
pub mod pack;

use crate::build::{forbid_private_paths, remapping};
use crate::catalogue::law_headers;
use crate::process::{Outcome, at, cargo, program, root, run};
use pack::{Binutils, pack};
use std::env::consts::DLL_SUFFIX;
use std::path::{Path, PathBuf};
use std::process::Command;

/// One precision of the library.
pub struct Precision {
    /// Folder in `target/law`.
    pub folder: &'static str,
    /// The package.
    pub package: &'static str,
    /// Name of the library.
    pub library: &'static str,
    /// How its symbols begin, in place of `exo_`.
    pub prefix: &'static str,
    /// What a C compiler must be told.
    pub define: Option<&'static str>,
}

/// Both.
pub const PRECISIONS: [Precision; 2] = [
    Precision {
        folder: "f64",
        package: "exo-law",
        library: "libexo_law.a",
        prefix: "exo_",
        define: None,
    },
    Precision {
        folder: "f32",
        package: "exo-law-f32",
        library: "libexo_law_f32.a",
        prefix: "exo_f32_",
        define: Some("-DEXO_LAW_F32"),
    },
];

/// The headers: of double precision, which all programs include, and of single precision.
pub const HEADERS: [&str; 2] = ["exo_law.h", "exo_law_f32.h"];

/// The programs of `fmu/c/examples`, built beside each library.
const EXAMPLES: [&str; 2] = ["control", "replay"];

/// The one that is a shared library: the law behind the functions of FMI 2.0, for `exo run --c-library`.
const FMI: &str = "fmi2";

fn source() -> PathBuf {
    root().join("fmu/c")
}

/// The headers' committed place.
pub fn committed() -> PathBuf {
    source().join("include")
}

/// Builds `target/law/{f64,f32}`: library, headers, and the examples; with a `prefix` also installs there.
pub fn build_all(bless: bool, prefix: Option<&Path>) -> Outcome {
    let made = root().join("target/law/include");
    law_headers(&made)?;
    for name in HEADERS {
        let (from, to) = (made.join(name), committed().join(name));
        if bless {
            copy(&from, &to)?;
        } else if std::fs::read(&from).ok() != std::fs::read(&to).ok() {
            println!(
                "note: fmu/c/include/{name} is out of date: `cargo xtask law --bless`, then read the diff"
            );
        }
    }
    for precision in &PRECISIONS {
        let folder = root().join("target/law").join(precision.folder);
        for name in HEADERS {
            copy(&made.join(name), &folder.join(name))?;
        }
        let library = folder.join(precision.library);
        copy(&build(precision)?, &library)?;
        for name in EXAMPLES {
            example(name, precision, &folder, &[], "")?;
        }
        example(FMI, precision, &folder, &["-shared", "-fPIC"], DLL_SUFFIX)?;
        let size = std::fs::metadata(&library).map_or(0, |file| file.len()) / 1000;
        println!(
            "target/law/{}/{}  {size} kB",
            precision.folder, precision.library
        );
    }
    if let Some(prefix) = prefix {
        install::install(prefix, &root().join("target/law"))?;
    }
    // That they link shows that no path of the law panics.
    let mut examples = cargo(["build", "--locked", "--release"]);
    for (package, example) in [("arm-law", "no_panic"), ("arm-law-f32", "no_panic_f32")] {
        examples.args(["--package", package, "--example", example]);
    }
    run(&mut examples)?;
    println!("for a Cortex-M4F: `cargo xtask dist`");
    Ok(())
}

fn copy(from: &Path, to: &Path) -> Outcome {
    let bytes = std::fs::read(from).map_err(at(from))?;
    cargo_fmu::pack::replace(to, &bytes)
}

/// The call of cargo that builds the static library.
pub fn cargo_for(precision: &Precision) -> Command {
    cargo([
        "rustc",
        "--locked",
        "--profile",
        "law",
        "--package",
        precision.package,
        "--lib",
        "--crate-type",
        "staticlib",
        "--features",
        "freestanding",
    ])
}

/// The static library for this machine.
///
/// # Errors
/// When cargo fails, or a path of the law panics.
pub fn build(precision: &Precision) -> Outcome<PathBuf> {
    let target = root().join("target/law-build");
    run(cargo_for(precision)
        .arg("--target-dir")
        .arg(&target)
        .env("CARGO_ENCODED_RUSTFLAGS", remapping(&[])?))?;
    let packed = target.join("packed").join(precision.library);
    let made = target.join("law").join(precision.library);
    pack(&made, precision, &Binutils::of_this_machine(), &packed)?;
    let bytes = std::fs::read(&packed).map_err(at(&packed))?;
    forbid_private_paths(precision.library, &bytes)?;
    Ok(packed)
}

/// A program of `fmu/c/examples`, linked with the library; with `flags` another kind of file.
fn example(name: &str, precision: &Precision, folder: &Path, flags: &[&str], end: &str) -> Outcome {
    let mut cc = program("cc", ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-O2"]);
    cc.args(flags)
        .args(precision.define)
        .arg("-I")
        .arg(folder)
        .arg(source().join("examples").join(name).with_extension("c"))
        .arg(folder.join(precision.library))
        .args(["-lm", "-o"])
        .arg(folder.join(format!("{name}{end}")));
    run(&mut cc)
}
