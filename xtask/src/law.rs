//! The C library: header, static libraries in both precisions, what shows that they cannot panic. `cargo xtask dist`
//! compiles it for a microcontroller, too.

use crate::build::remapping;
use crate::catalogue::law_header;
use crate::process::{Outcome, at, cargo, program, root, run};
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
    /// What a C compiler must be told.
    pub define: Option<&'static str>,
}

/// Both.
pub const PRECISIONS: [Precision; 2] = [
    Precision {
        folder: "f64",
        package: "exo-law",
        library: "libexo_law.a",
        define: None,
    },
    Precision {
        folder: "f32",
        package: "exo-law-f32",
        library: "libexo_law_f32.a",
        define: Some("-DEXO_LAW_F32"),
    },
];

fn source() -> PathBuf {
    root().join("fmu/c")
}

/// The header's committed place.
fn committed() -> PathBuf {
    source().join("include/exo_law.h")
}

/// Builds `target/law/{f64,f32}`: library, header, and the example, which replays recorded vectors.
pub fn build_all(bless: bool) -> Outcome {
    let text = law_header()?;
    if bless {
        std::fs::write(committed(), &text).map_err(at(&committed()))?;
    } else if !is_committed(&text) {
        println!(
            "note: fmu/c/include/exo_law.h is out of date: `cargo xtask law --bless`, then read the diff"
        );
    }
    for precision in &PRECISIONS {
        let folder = root().join("target/law").join(precision.folder);
        std::fs::create_dir_all(&folder).map_err(at(&folder))?;
        let header = folder.join("exo_law.h");
        std::fs::write(&header, &text).map_err(at(&header))?;
        let library = folder.join(precision.library);
        let built = build(precision)?;
        std::fs::copy(&built, &library).map_err(at(&built))?;
        example(precision, &folder)?;
        println!("target/law/{}/{}", precision.folder, precision.library);
    }
    for (package, example) in [("arm-law", "no_panic"), ("arm-law-f32", "no_panic_f32")] {
        let flags = ["build", "--locked", "--release", "--package", package];
        run(cargo(flags).args(["--example", example]))?;
    }
    println!("for a Cortex-M4F: `cargo xtask dist`");
    Ok(())
}

fn is_committed(text: &str) -> bool {
    std::fs::read_to_string(committed()).is_ok_and(|committed| committed == text)
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
/// When cargo fails.
pub fn build(precision: &Precision) -> Outcome<PathBuf> {
    let target = root().join("target/law-build");
    run(cargo_for(precision)
        .arg("--target-dir")
        .arg(&target)
        .env("CARGO_ENCODED_RUSTFLAGS", remapping(&[])?))?;
    Ok(target.join("law").join(precision.library))
}

/// `replay`, from C source, linked with the library: that it links shows that no path of the law panics.
fn example(precision: &Precision, folder: &Path) -> Outcome {
    let mut cc = program("cc", ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-O2"]);
    cc.args(precision.define)
        .arg("-I")
        .arg(folder)
        .arg(source().join("examples/replay.c"))
        .arg(folder.join(precision.library))
        .args(["-lm", "-o"])
        .arg(folder.join("replay"));
    run(&mut cc)
}
