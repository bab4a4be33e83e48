//! The C library on the microcontroller's processor: a program that runs every law (`tests/host/law.c`), emulated, must print
//! what it prints on this machine.
//!
//! qemu's user mode has no Cortex-M of its own. It executes the same instructions as an Arm of the A profile, which knows
//! them all; what the profiles differ in (interrupts, the memory map) is not in the library.

use super::compile;
use super::debian::quietly;
use super::firmware::{TARGET, linker};
use super::toolchain::{Toolchains, with_libraries, with_zig};
use crate::law::{self, PRECISIONS, Precision};
use crate::process::{Failure, Outcome, at, program, root};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Options of every compilation: a sum of products rounded once would be another number.
const OPTIONS: [&str; 3] = ["-std=c11", "-O1", "-ffp-contract=off"];

/// Runs the program here and emulated, in both precisions; says what was compared.
///
/// # Errors
/// When the texts differ, or a program fails. The inner error is why nothing was run.
pub fn run(tools: &Toolchains) -> Outcome<Result<String, String>> {
    let (zig, binutils, qemu) = match (tools.zig(), tools.arm_binutils(), tools.qemu()) {
        (Ok(zig), Ok(binutils), Ok(qemu)) => (zig, binutils, qemu),
        (Err(reason), ..) | (_, Err(reason), _) | (.., Err(reason)) => return Ok(Err(reason)),
    };
    let mut lines = 0;
    for precision in &PRECISIONS {
        let here = text(&mut program::<&Path>(on_this_machine(precision)?, []))?;
        let image = on_the_microcontroller(precision, &zig, &binutils)?;
        let emulator = qemu.join("usr/bin/qemu-arm-static");
        // A processor with the Cortex-M4F's floating-point unit, and no more of it in use.
        let arguments = [
            OsStr::new("-cpu"),
            OsStr::new("cortex-a15"),
            image.as_os_str(),
        ];
        let there = text(&mut program(emulator, arguments))?;
        lines += same(&here, &there, precision.folder)?;
    }
    Ok(Ok(format!("run, {lines} lines equal bit for bit")))
}

fn on_this_machine(precision: &Precision) -> Outcome<PathBuf> {
    let library = law::build(precision)?;
    let executable = folder()?.join(format!("law-{}", precision.folder));
    let mut compiler = Command::new("cc");
    source(&mut compiler, precision);
    compiler.arg(library).args(["-lm", "-o"]).arg(&executable);
    compiled(&mut compiler)?;
    Ok(executable)
}

fn on_the_microcontroller(precision: &Precision, zig: &Path, binutils: &Path) -> Outcome<PathBuf> {
    let folder = folder()?;
    let object = folder.join(format!("law-{TARGET}-{}.o", precision.folder));
    let image = object.with_extension("elf");
    let mut compiler = program(zig.join("python"), ["-m", "ziglang", "cc"]);
    compiler.args(["-target", "thumb-freestanding-eabihf", "-mcpu=cortex_m4"]);
    // Nobody unwinds there.
    compiler.args([
        "-ffreestanding",
        "-fno-unwind-tables",
        "-fno-asynchronous-unwind-tables",
    ]);
    source(with_zig(&mut compiler, zig), precision);
    compiled(compiler.arg("-c").arg("-o").arg(&object))?;
    let mut link = linker(binutils);
    link.args(["--gc-sections", "-e", "start", "-Ttext=0x10000"]);
    link.arg(&object);
    link.arg(
        compile::folder()
            .join(TARGET)
            .join("law")
            .join(precision.library),
    );
    compiled(with_libraries(&mut link, binutils).arg("-o").arg(&image))?;
    Ok(image)
}

fn source(compiler: &mut Command, precision: &Precision) {
    compiler
        .args(OPTIONS)
        .args(precision.define)
        .arg("-I")
        .arg(root().join("fmu/c/include"))
        .arg(root().join("tests/host/law.c"));
}

fn folder() -> Outcome<PathBuf> {
    let folder = compile::folder().join("host");
    std::fs::create_dir_all(&folder).map_err(at(&folder))?;
    Ok(folder)
}

fn compiled(command: &mut Command) -> Outcome {
    quietly(command).map_err(|_| Failure::Found("tests/host/law.c does not compile".to_owned()))
}

/// What the program prints, which must end as it should.
fn text(command: &mut Command) -> Outcome<String> {
    let name = PathBuf::from(command.get_program());
    let output = command.output().map_err(at(&name))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    if output.status.success() && text.ends_with("end\n") {
        return Ok(text);
    }
    let broken = text.lines().find(|line| line.starts_with("broken"));
    Err(Failure::Found(format!(
        "the law's program failed under {}: {} {}",
        name.display(),
        broken.unwrap_or_default(),
        String::from_utf8_lossy(&output.stderr).trim()
    )))
}

/// How many lines are the same, when all are.
fn same(here: &str, there: &str, precision: &str) -> Outcome<usize> {
    let differs = here.lines().zip(there.lines()).position(|(a, b)| a != b);
    match differs {
        Some(line) => Err(Failure::Found(format!(
            "the law in {precision} on {TARGET} differs from this machine's in line {}",
            line + 1
        ))),
        None if here != there => Err(Failure::Found(format!(
            "the law in {precision} on {TARGET} prints another number of lines than on this machine"
        ))),
        None => Ok(here.lines().count()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_differing_digit_and_a_missing_line_are_found() {
        assert!(same("a\nb\n", "a\nb\n", "f64").is_ok_and(|lines| lines == 2));
        let differs = same("a\nb\n", "a\nc\n", "f32").unwrap_err().to_string();
        assert!(differs.contains("f32") && differs.contains("line 2"));
        assert!(same("a\nb\n", "a\n", "f64").is_err());
    }
}
