//! What a C program links: one object that holds the law, and shows no symbol but the law's functions.
//!
//! Of a Rust library cargo makes an archive with all that Rust's own library might be asked for: megabytes, a reference to
//! a function that a program without Rust does not have (`rust_eh_personality`), and symbols that a second Rust library in
//! the same program has, too. Here the linker takes from it what the law's functions reach; everything else is dropped,
//! the other symbols are made local, and those of single precision get a name of their own.
//!
//! That is also the link test for panics: the library's panic handler calls a function that nobody defines. The linker
//! drops it because nothing reaches it; if any path of the law could panic, the name would stay.

use super::Precision;
use crate::process::{Failure, Outcome, answer, at, program, run};
use std::path::{Path, PathBuf};
use std::process::Command;

/// What the law may ask of the program: moving memory, which every C library has, and every compiler asks for.
const ASKED: [&str; 5] = ["memcpy", "memmove", "memset", "memcmp", "bcmp"];

/// The programs that take libraries apart.
pub struct Binutils {
    /// How their names begin, with a folder where they are not on PATH.
    prefix: PathBuf,
    /// Where their shared libraries lie, where they are not installed.
    libraries: Option<PathBuf>,
}

impl Binutils {
    /// Those that come with the C compiler.
    pub fn of_this_machine() -> Self {
        Self {
            prefix: PathBuf::new(),
            libraries: None,
        }
    }

    /// Those of another platform, unpacked in `folder`; their names begin with `prefix`.
    pub fn unpacked(folder: &Path, prefix: &str) -> Self {
        Self {
            prefix: folder.join("usr/bin").join(prefix),
            libraries: Some(folder.to_owned()),
        }
    }

    fn program(&self, name: &str) -> Command {
        let mut path = self.prefix.clone().into_os_string();
        path.push(name);
        let mut command = program::<&str>(path, []);
        if let Some(folder) = &self.libraries {
            crate::dist::with_libraries(&mut command, folder);
        }
        command
    }
}

/// Writes the library `to` from the archive `made` by cargo.
///
/// # Errors
/// When a program of binutils is missing or fails, or when a path of the law panics.
pub fn pack(made: &Path, precision: &Precision, tools: &Binutils, to: &Path) -> Outcome {
    if !cfg!(target_os = "linux") {
        return Err(Failure::Missing(
            "the C library is packed with the linker of Linux: expected a Linux machine",
        ));
    }
    let folder = to.with_extension("parts");
    std::fs::create_dir_all(&folder).map_err(at(&folder))?;
    let (whole, object) = (folder.join("whole.o"), folder.join(object_name(precision)));

    // Bitcode, which the compiler's own objects carry: where LLVM's plugin for binutils is of another version, it takes an object
    // with bitcode for one that it cannot read, and no symbol of it is found any more.
    let plain = folder.join("plain.a");
    run(tools
        .program("objcopy")
        .args(["--remove-section=.llvmbc", "--remove-section=.llvmcmd"])
        .arg(made)
        .arg(&plain))?;
    let functions = functions(&listed(tools, &["-g", "--defined-only"], &plain)?);
    if functions.is_empty() {
        return Err(Failure::Found(format!(
            "{} defines no function whose name begins with exo_",
            precision.library
        )));
    }
    let mut link = tools.program("ld");
    link.args(["-r", "--gc-sections"]);
    for function in &functions {
        link.args(["-u", function]);
    }
    run(link.arg(&plain).arg("-o").arg(&whole))?;
    asks_for_nothing_else(&listed(tools, &["-u"], &whole)?)?;

    let names = |file: &str, line: &dyn Fn(&str) -> String| -> Outcome<PathBuf> {
        let path = folder.join(file);
        let lines: String = functions.iter().map(|name| line(name) + "\n").collect();
        std::fs::write(&path, lines).map_err(at(&path))?;
        Ok(path)
    };
    let keep = names("keep", &str::to_owned)?;
    let rename = names("rename", &|name| {
        let new = name.replacen("exo_", precision.prefix, 1);
        format!("{name} {new}")
    })?;
    // The names are those before it until it has ended.
    run(tools
        .program("objcopy")
        .args(["--strip-debug", "--strip-unneeded"])
        .arg(argument("--keep-global-symbols=", &keep))
        .arg(&whole)
        .arg(&object))?;
    run(tools
        .program("objcopy")
        .arg(argument("--redefine-syms=", &rename))
        .arg(&object))?;

    // An old archive would keep its other members.
    let _ = std::fs::remove_file(to);
    run(tools.program("ar").arg("crsD").arg(to).arg(&object))
}

/// What `nm` says of a file; that a member has no symbols, as many have, is not shown.
fn listed(tools: &Binutils, options: &[&str], file: &Path) -> Outcome<String> {
    answer(tools.program("nm").args(options).arg(file)).ok_or(Failure::Missing(
        "the C library is packed with nm, ld, objcopy and ar: nm is missing or fails; install binutils",
    ))
}

fn object_name(precision: &Precision) -> String {
    precision.library.replace("lib", "").replace(".a", ".o")
}

fn argument(option: &str, path: &Path) -> std::ffi::OsString {
    let mut argument = std::ffi::OsString::from(option);
    argument.push(path);
    argument
}

/// The law's functions in what `nm` prints.
fn functions(listed: &str) -> Vec<String> {
    let mut names: Vec<_> = listed
        .lines()
        .filter_map(|line| {
            let mut words = line.split_whitespace().rev();
            let (name, kind) = (words.next()?, words.next()?);
            (kind == "T" && name.starts_with("exo_")).then(|| name.to_owned())
        })
        .collect();
    names.sort();
    names.dedup();
    names
}

/// Refuses a library that asks the program for more than memory to be moved.
fn asks_for_nothing_else(undefined: &str) -> Outcome {
    // A plugin of nm (LLVM's, of another version) says more on the same stream.
    let names = undefined.lines().filter_map(|line| {
        let mut words = line.split_whitespace().rev();
        let (name, kind) = (words.next()?, words.next()?);
        matches!(kind, "U" | "w" | "v").then_some(name)
    });
    let others: Vec<_> = names.filter(|name| !ASKED.contains(name)).collect();
    if others.contains(&"exo_law_has_a_path_that_panics") {
        return Err(Failure::Found(
            "a path of the law can panic: the panic handler of fmu/c/src/panic.rs is reached"
                .into(),
        ));
    }
    if others.is_empty() {
        Ok(())
    } else {
        Err(Failure::Found(format!(
            "the C library needs {}: expected nothing but {}",
            others.join(", "),
            ASKED.join(", ")
        )))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_that_panics_and_a_foreign_function_are_named() {
        assert!(asks_for_nothing_else("                 U memcpy\n").is_ok());
        let chatter = "LLVM gold plugin has failed to create LTO module: (Reader: 'LLVM 14.0.6')\n U memcpy\n";
        assert!(asks_for_nothing_else(chatter).is_ok());
        let message = |undefined| asks_for_nothing_else(undefined).unwrap_err().to_string();
        assert!(message(" U exo_law_has_a_path_that_panics\n U memcpy\n").contains("can panic"));
        assert!(message(" U rust_eh_personality\n").contains("needs rust_eh_personality"));
    }

    #[test]
    fn the_functions_are_those_that_the_law_defines() {
        let listed = "a.o:\n0000 T exo_arm_tick\n0000 t local\n0010 W memcpy\n0000 T exo_arm_tick\n0 T rust_begin_unwind\n";
        assert_eq!(functions(listed), ["exo_arm_tick"]);
    }
}
