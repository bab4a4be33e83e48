//! The C library on the microcontroller's processor: a program that runs every law (`tests/host/law.c`), emulated, must print
//! what it prints on this machine.
//!
//! qemu's user mode has no Cortex-M of its own. It executes the same instructions as an Arm of the A profile, which knows
//! them all; what the profiles differ in (interrupts, the memory map) is not in the library.

use super::firmware::{TARGET, linker};
use super::host::{Texts, compare, printed};
use super::stack;
use crate::law::{self, PRECISIONS, Precision};
use crate::process::{Failure, Outcome, at, program, root};
use cargo_fmu::debian::quietly;
use cargo_fmu::toolchain::{Toolchains, limited, with_libraries};
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
    let (mut here, mut there) = (Texts::new(), Texts::new());
    let mut stacks = Vec::new();
    for precision in &PRECISIONS {
        let executable = on_this_machine(precision)?;
        let text = printed(&mut program::<&Path>(&executable, []), &executable)?;
        here.insert(precision.folder.to_owned(), text);
        let emulated = |define: Option<&str>| {
            let image = on_the_microcontroller(precision, define, &zig, &binutils)?;
            let mut emulated = limited(qemu.join("usr/bin/qemu-arm-static"));
            // A processor with the Cortex-M4F's floating-point unit, and no more of it in use.
            emulated.args(["-cpu", "cortex-a15"]).arg(&image);
            printed(&mut emulated, &image)
        };
        there.insert(precision.folder.to_owned(), emulated(None)?);
        stacks.push(stack::check(precision, &emulated(Some(stack::PAINTED))?)?);
    }
    let lines = compare(&here, &there)
        .map_err(|what| Failure::Found(format!("the law on {TARGET} differs: {what}")))?;
    Ok(Ok(format!(
        "run, {lines} lines equal bit for bit; {}",
        stacks.join("; ")
    )))
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

fn on_the_microcontroller(
    precision: &Precision,
    define: Option<&str>,
    zig: &Path,
    binutils: &Path,
) -> Outcome<PathBuf> {
    let folder = folder()?;
    let what = if define.is_some() { "stack" } else { "law" };
    let object = folder.join(format!("{what}-{TARGET}-{}.o", precision.folder));
    let image = object.with_extension("elf");
    let mut compiler = program(zig.join("python"), ["-m", "ziglang", "cc"]);
    compiler.args(["-target", "thumb-freestanding-eabihf", "-mcpu=cortex_m4"]);
    // Nobody unwinds there.
    compiler.args([
        "-ffreestanding",
        "-fno-unwind-tables",
        "-fno-asynchronous-unwind-tables",
    ]);
    source(super::tools().with_zig(&mut compiler, zig), precision);
    compiled(compiler.args(define).arg("-c").arg("-o").arg(&object))?;
    let mut link = linker(binutils);
    link.args(["--gc-sections", "-e", "start", "-Ttext=0x10000"]);
    link.arg(&object);
    link.arg(super::firmware::library(precision));
    // The program's own arithmetic in double precision, for which there is no other library here.
    link.arg(super::firmware::made(precision));
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
    let folder = super::folder().join("host");
    std::fs::create_dir_all(&folder).map_err(at(&folder))?;
    Ok(folder)
}

fn compiled(command: &mut Command) -> Outcome {
    quietly(command).map_err(|_| Failure::Found("tests/host/law.c does not compile".to_owned()))
}
