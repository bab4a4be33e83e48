//! callgrind's files: what each function executed itself.

use crate::process::{Failure, Outcome, output, program};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Function at whose entry callgrind writes what it has counted, and begins anew.
const PART: &str = "counted_part";

/// What was executed between two parts.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Counted {
    /// Instructions.
    pub all: u64,
    /// Those of them in `memcpy` and `memmove`; `None` where the C library does not name its functions.
    pub copying: Option<u64>,
}

/// Runs `command` and counts inside `functions` only, callees included; returns what it printed, and one count for each part
/// but the first, which warms up.
///
/// # Errors
/// When the program fails, or does not end as many parts.
pub fn count<const PARTS: usize>(
    command: &Command,
    functions: &[&str],
    out: &Path,
) -> Outcome<(String, [Counted; PARTS])> {
    let mut valgrind = program("valgrind", ["--quiet", "--tool=callgrind"]);
    valgrind.args([
        "--collect-atstart=no",
        "--compress-strings=no",
        "--compress-pos=no",
    ]);
    valgrind.arg(format!("--dump-before={PART}"));
    for function in functions {
        valgrind.arg(format!("--toggle-collect={function}"));
    }
    valgrind.arg(format!("--callgrind-out-file={}", out.display()));
    valgrind.arg(command.get_program()).args(command.get_args());
    // What is called first is bound at once, so that no part pays for it.
    let text = output(valgrind.env("LD_BIND_NOW", "1"))?;
    let mut counted = Vec::new();
    for part in 0..PARTS {
        let path = PathBuf::from(format!("{}.{}", out.display(), part + 2));
        let text = std::fs::read_to_string(&path).map_err(crate::process::at(&path))?;
        counted.push(sum(&text));
    }
    let counted = counted
        .try_into()
        .map_err(|_| Failure::Found(format!("{}: expected {PARTS} parts", out.display())))?;
    Ok((text, counted))
}

fn sum(text: &str) -> Counted {
    let costs = costs(text);
    let unnamed = |(object, function): &(String, String)| {
        object.contains("libc") && function.starts_with("0x")
    };
    let copies = |(_, function): &(String, String)| {
        function.contains("memcpy") || function.contains("memmove")
    };
    let of_those = |wanted: &dyn Fn(&(String, String)) -> bool| -> u64 {
        let some = costs.iter().filter(|(place, _)| wanted(place));
        some.map(|(_, cost)| cost).sum()
    };
    Counted {
        all: of_those(&|_| true),
        copying: (of_those(&unnamed) == 0).then(|| of_those(&copies)),
    }
}

/// What each function of each object executed itself, without its callees. A line of cost is a line number and a count; the
/// one after `calls=` belongs to a callee.
fn costs(text: &str) -> BTreeMap<(String, String), u64> {
    let mut costs = BTreeMap::new();
    let (mut object, mut function) = (String::new(), String::new());
    let mut of_callee = false;
    for line in text.lines() {
        if let Some(name) = line.strip_prefix("ob=") {
            object = name.to_owned();
        } else if let Some(name) = line.strip_prefix("fn=") {
            function = name.to_owned();
        } else if line.starts_with("calls=") {
            of_callee = true;
        } else if line.starts_with(|first: char| first.is_ascii_digit()) {
            let cost = line.split(' ').nth(1).and_then(|word| word.parse().ok());
            if !std::mem::take(&mut of_callee) {
                *costs.entry((object.clone(), function.clone())).or_default() +=
                    cost.unwrap_or(0u64);
            }
        }
    }
    costs
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "\
version: 1
positions: line
events: Ir

ob=/tmp/libmodel.so
fl=???
fn=fmi2DoStep
0 30
cob=/lib/libc.so.6
cfi=memmove.S
cfn=__memcpy_avx_unaligned_erms
calls=2 262
0 12
0 8

ob=/lib/libc.so.6
fl=memmove.S
fn=__memcpy_avx_unaligned_erms
262 4
271 8
";

    #[test]
    fn a_function_counts_what_it_executed_itself() {
        let counted = sum(FILE);
        assert_eq!(counted.all, 50);
        assert_eq!(counted.copying, Some(12));
    }

    #[test]
    fn a_c_library_without_names_leaves_the_copies_unknown() {
        let text = FILE.replace("fn=__memcpy_avx_unaligned_erms", "fn=0x0000000000162cc0");
        assert_eq!(sum(&text).all, 50);
        assert_eq!(sum(&text).copying, None);
    }
}
