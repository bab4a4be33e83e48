//! What a microcontroller gets: the C library, compiled and linked for a Cortex-M4F against `core` only.

use super::folder;
use crate::build::remapping;
use crate::law::pack::{Binutils, pack};
use crate::law::{self, PRECISIONS, Precision};
use crate::process::{Failure, Outcome, answer, at, program, root, run};
use cargo_fmu::pack::replace;
use cargo_fmu::plan;
use cargo_fmu::toolchain::{Toolchains, with_libraries};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Rust's name of the platform.
pub const TARGET: &str = "thumbv7em-none-eabihf";

/// Functions that a program calls.
const CALLED: [(&str, &[&str]); 2] = [
    (
        "arm",
        &[
            "exo_arm_tick",
            "exo_arm_defaults",
            "exo_arm_init",
            "exo_arm_tune",
        ],
    ),
    (
        "axis",
        &[
            "exo_axis_tick",
            "exo_axis_defaults",
            "exo_axis_init",
            "exo_axis_tune",
        ],
    ),
];

/// Builds `target/dist/law/thumbv7em-none-eabihf/{f64,f32}`, header and library; says what programs need that call one law.
///
/// # Errors
/// When something fails that has its tools here. The inner error is why it is left out.
pub fn build(tools: &Toolchains) -> Outcome<Result<String, String>> {
    let (rust, binutils) = match (tools.rust(), tools.arm_binutils()) {
        (Ok(rust), Ok(binutils)) => (rust, binutils),
        (Err(reason), _) | (_, Err(reason)) => return Ok(Err(reason)),
    };
    let mut sizes = Vec::new();
    for precision in &PRECISIONS {
        let mut build = law::cargo_for(precision);
        run(with_libraries(&mut build, &rust)
            .args(["--target", TARGET, "-Zbuild-std=core", "--target-dir"])
            .arg(folder())
            .env("RUSTC", rust.join("usr/bin/rustc"))
            .env("RUSTC_BOOTSTRAP", "1")
            .env("CARGO_ENCODED_RUSTFLAGS", remapping(&plan::renamed(&rust))?))?;
        let library = library(precision);
        let parts = Binutils::unpacked(&binutils, "arm-none-eabi-");
        pack(&made(precision), precision, &parts, &library)?;
        for (law, functions) in CALLED {
            let functions: Vec<_> = functions
                .iter()
                .map(|name| name.replacen("exo_", precision.prefix, 1))
                .collect();
            let text = linked(&binutils, &library, &functions)?;
            sizes.push(format!("{law} {} {text}", precision.folder));
        }
        let bytes = std::fs::read(&library).map_err(at(&library))?;
        crate::build::forbid_private_paths(precision.library, &bytes)?;
        let folder = root()
            .join("target/dist/law")
            .join(TARGET)
            .join(precision.folder);
        replace(&folder.join(precision.library), &bytes)?;
        crate::catalogue::law_headers(&folder)?;
    }
    Ok(Ok(format!("bytes of code: {}", sizes.join(", "))))
}

/// What cargo has made.
pub fn made(precision: &Precision) -> PathBuf {
    let folder = folder().join(TARGET).join("law");
    folder.join(precision.library)
}

/// Where the packed library lies.
pub fn library(precision: &Precision) -> PathBuf {
    let folder = folder().join(TARGET).join("packed");
    folder.join(precision.library)
}

/// The linker.
pub fn linker(binutils: &Path) -> Command {
    program::<&str>(binutils.join("usr/bin/arm-none-eabi-ld"), [])
}

/// Size of a program that calls `functions` and nothing else, in bytes: code and constants. That it links shows that the
/// library needs `core` only and that no path panics.
fn linked(binutils: &Path, library: &Path, functions: &[String]) -> Outcome<u64> {
    let image = library.with_extension("elf");
    let mut link = linker(binutils);
    link.args(["--gc-sections", "--no-undefined", "-e", "0"]);
    for function in functions {
        link.args(["-u", function]);
    }
    link.arg(library).arg("-o").arg(&image);
    run(with_libraries(&mut link, binutils))?;
    let mut size = program(binutils.join("usr/bin/arm-none-eabi-size"), [&image]);
    answer(with_libraries(size.arg("-B"), binutils))
        .and_then(|text| text.lines().nth(1)?.split_whitespace().next()?.parse().ok())
        .ok_or_else(|| Failure::Found(format!("no size of {}", image.display())))
}
