//! What a microcontroller would get: the libraries compiled and linked for a Cortex-M4F against `core` only.
//!
//! The stock toolchain has no library for that target. `docs/real-time.md` says how to get one from Debian; the folder that
//! it was unpacked into is given in `EXO_RUST_WEB`. Without it this part is left out, and said so.

use crate::build::remapping;
use crate::law::PRECISIONS;
use crate::process::{Failure, Outcome, answer, cargo, program, root, run};
use std::path::Path;
use std::process::Command;

const TARGET: &str = "thumbv7em-none-eabihf";

/// Functions that a program calls.
const CALLED: [(&str, &[&str]); 2] = [
    (
        "arm",
        &[
            "exo_arm_tick",
            "exo_arm_defaults",
            "exo_arm_init",
            "exo_arm_tune",
            "exo_arm_tune_joints",
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

/// Builds and prints the sizes, if the toolchain is there.
pub fn report() -> Outcome {
    let Some(toolchain) = std::env::var_os("EXO_RUST_WEB") else {
        println!(
            "left out: {TARGET}; set EXO_RUST_WEB to a toolchain that builds core (docs/real-time.md)"
        );
        return Ok(());
    };
    let toolchain = Path::new(&toolchain);
    let target = root().join("target/law-build");
    for precision in &PRECISIONS {
        let mut build = cargo([
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
            "--target",
            TARGET,
            "-Zbuild-std=core",
            "--target-dir",
        ]);
        run(with(toolchain, &mut build)
            .arg(&target)
            .env("RUSTC", toolchain.join("usr/bin/rustc"))
            .env("RUSTC_BOOTSTRAP", "1")
            .env("CARGO_ENCODED_RUSTFLAGS", remapping()?))?;
        let library = target.join(TARGET).join("law").join(precision.library);
        for (law, functions) in CALLED {
            let text = linked(toolchain, &library, functions)?;
            println!("{TARGET} {} {law}: {text} bytes of text", precision.folder);
        }
    }
    Ok(())
}

/// Size of a program that calls `functions` and nothing else, in bytes: code and constants. That it links shows that the
/// library needs `core` only and that no path panics.
fn linked(toolchain: &Path, library: &Path, functions: &[&str]) -> Outcome<u64> {
    let tool = |name: &str| {
        toolchain
            .join("usr/bin")
            .join(format!("arm-none-eabi-{name}"))
    };
    let image = library.with_extension("elf");
    let mut link = program(tool("ld"), ["--gc-sections", "--no-undefined", "-e", "0"]);
    for function in functions {
        link.args(["-u", function]);
    }
    link.arg(library).arg("-o").arg(&image);
    run(with(toolchain, &mut link))?;
    answer(with(toolchain, program(tool("size"), [&image]).arg("-B")))
        .and_then(|text| text.lines().nth(1)?.split_whitespace().next()?.parse().ok())
        .ok_or_else(|| Failure::Found(format!("no size of {}", image.display())))
}

/// Its programs find their libraries.
fn with<'a>(toolchain: &Path, command: &'a mut Command) -> &'a mut Command {
    command.env(
        "LD_LIBRARY_PATH",
        toolchain.join("usr/lib/x86_64-linux-gnu"),
    )
}
