//! What a library offers and what it needs: read from the file, whatever its format.

use crate::platform::{GLIBC, Platform};
use object::read::elf::{Dyn as _, FileHeader as _, SectionTable};
use object::{Endianness, Object as _, elf};
use std::collections::BTreeSet;

/// Libraries that every system has, by the start of the name in lower case.
const SYSTEM: [&str; 18] = [
    // Linux with the GNU C library
    "libc.so.6",
    "libm.so.6",
    "libdl.so.2",
    "libpthread.so.0",
    "ld-linux-x86-64.so.2",
    "ld-linux-aarch64.so.1",
    // Windows 7 and newer; the names that begin with api-ms-win-core are Windows' own aliases
    "kernel32.dll",
    "kernelbase.dll",
    "ntdll.dll",
    "msvcrt.dll",
    "advapi32.dll",
    "bcrypt.dll",
    "bcryptprimitives.dll",
    "userenv.dll",
    "ws2_32.dll",
    "api-ms-win-core-",
    // macOS
    "/usr/lib/libsystem.b.dylib",
    "/usr/lib/libiconv.2.dylib",
];

/// Functions of C's mathematics that each platform rounds in its own way, without the `f` of single precision.
const ROUNDED: [&str; 27] = [
    "sin", "cos", "sincos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh",
    "asinh", "acosh", "atanh", "exp", "exp2", "exp10", "expm1", "log", "log2", "log10", "log1p",
    "pow", "cbrt", "hypot", "tgamma", "lgamma",
];

/// What was read.
#[derive(Debug)]
pub struct Report {
    /// Libraries that it needs.
    pub needs: BTreeSet<String>,
    /// Newest version of the GNU C library that it asks for.
    pub glibc: Option<(u32, u32)>,
    /// Functions of C's mathematics that it calls, which each platform rounds in its own way.
    pub rounded: BTreeSet<String>,
}

/// Reads a library and checks it: it must offer `functions` and no others. `strict` also asks for the floor of the C library,
/// which only zig's linker gives.
///
/// # Errors
/// The first rule that it breaks.
pub fn inspect(
    bytes: &[u8],
    platform: &Platform,
    functions: &BTreeSet<String>,
    strict: bool,
) -> Result<Report, String> {
    let file = object::File::parse(bytes).map_err(|cause| cause.to_string())?;
    let exports = file.exports().map_err(|cause| cause.to_string())?;
    let offered: BTreeSet<String> = exports
        .iter()
        .map(|export| String::from_utf8_lossy(export.name()).into_owned())
        // Names of C begin with an underscore in files of macOS.
        .map(|name| match platform.suffix {
            ".dylib" => name.strip_prefix('_').map(str::to_owned).unwrap_or(name),
            _ => name,
        })
        .collect();
    exactly_the_standard_s(&offered, functions)?;
    let imports = file.imports().map_err(|cause| cause.to_string())?;
    let called = imports
        .iter()
        .map(|import| String::from_utf8_lossy(import.name()));
    let rounded = mathematics(called);
    let mut report = match &file {
        object::File::Elf64(_) => elf_needs(bytes).map_err(|cause| cause.to_string())?,
        _ => Report {
            needs: imports
                .iter()
                .map(|import| String::from_utf8_lossy(import.library()).into_owned())
                .filter(|name| !name.is_empty())
                .collect(),
            glibc: None,
            rounded: BTreeSet::new(),
        },
    };
    report.rounded = rounded;
    if strict {
        only_the_system_s(&report)?;
    }
    Ok(report)
}

fn exactly_the_standard_s(
    offered: &BTreeSet<String>,
    expected: &BTreeSet<String>,
) -> Result<(), String> {
    if let Some(name) = expected.difference(offered).next() {
        return Err(format!("does not export {name}"));
    }
    match offered.difference(expected).next() {
        Some(name) => Err(format!(
            "exports {name}, which is no function of the standard"
        )),
        None => Ok(()),
    }
}

/// The same inputs give the same bits everywhere if no function is called that a platform rounds in its own way. Where
/// the C library is linked in, this sees nothing: it is the same source that is looked at on the other platforms.
fn mathematics(called: impl Iterator<Item = impl AsRef<str>>) -> BTreeSet<String> {
    let plain = called.map(|name| name.as_ref().trim_start_matches('_').to_owned());
    plain
        .filter(|name| {
            let double = name.strip_suffix('f').unwrap_or(name);
            ROUNDED.contains(&name.as_str()) || ROUNDED.contains(&double)
        })
        .collect()
}

fn only_the_system_s(report: &Report) -> Result<(), String> {
    for name in &report.needs {
        let lower = name.to_lowercase();
        if !SYSTEM.iter().any(|known| lower.starts_with(known)) {
            return Err(format!("needs {name}, which not every system has"));
        }
    }
    match report.glibc {
        Some(version) if version > GLIBC => Err(format!(
            "needs version {}.{} of the GNU C library, expected at most {}.{}",
            version.0, version.1, GLIBC.0, GLIBC.1
        )),
        _ => Ok(()),
    }
}

/// Needed libraries and the newest version `GLIBC_x.y` of an ELF file.
fn elf_needs(bytes: &[u8]) -> object::Result<Report> {
    let header = elf::FileHeader64::<Endianness>::parse(bytes)?;
    let endian = header.endian()?;
    let sections: SectionTable<'_, _> = header.sections(endian, bytes)?;
    let mut report = Report {
        needs: BTreeSet::new(),
        glibc: None,
        rounded: BTreeSet::new(),
    };
    if let Some((entries, link)) = sections.dynamic(endian, bytes)? {
        let strings = sections.strings(endian, bytes, link)?;
        for entry in entries {
            if entry.tag32(endian) == Some(elf::DT_NEEDED) {
                let name = entry.string(endian, strings)?;
                report
                    .needs
                    .insert(String::from_utf8_lossy(name).into_owned());
            }
        }
    }
    if let Some((mut files, link)) = sections.gnu_verneed(endian, bytes)? {
        let strings = sections.strings(endian, bytes, link)?;
        while let Some((_, mut versions)) = files.next()? {
            while let Some(version) = versions.next()? {
                let name = version.name(endian, strings)?;
                report.glibc = report.glibc.max(glibc(name));
            }
        }
    }
    Ok(report)
}

/// `GLIBC_2.17` as numbers.
fn glibc(name: &[u8]) -> Option<(u32, u32)> {
    let mut numbers = std::str::from_utf8(name)
        .ok()?
        .strip_prefix("GLIBC_")?
        .split('.');
    Some((numbers.next()?.parse().ok()?, numbers.next()?.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_of_the_c_library_compare_by_number() {
        assert_eq!(glibc(b"GLIBC_2.2.5"), Some((2, 2)));
        assert!(glibc(b"GLIBC_2.17") > glibc(b"GLIBC_2.4"));
        assert_eq!(glibc(b"GLIBC_PRIVATE"), None);
        assert_eq!(glibc(b"GCC_3.0"), None);
    }

    fn report(needs: &[&str], glibc: Option<(u32, u32)>) -> Report {
        Report {
            needs: needs.iter().map(|&name| name.to_owned()).collect(),
            glibc,
            rounded: BTreeSet::new(),
        }
    }

    #[test]
    fn the_platform_s_mathematics_is_named_and_what_is_exact_is_not() {
        for (name, told) in [
            ("sin", "sin"),
            ("_sin", "sin"),
            ("expf", "expf"),
            ("__sincosf", "sincosf"),
            ("hypot", "hypot"),
        ] {
            assert!(mathematics([name].into_iter()).contains(told), "{name}");
        }
        let exact = [
            "memcpy", "fmod", "sqrt", "floor", "printf", "_exit", "signal",
        ];
        assert!(mathematics(exact.into_iter()).is_empty());
    }

    #[test]
    fn a_newer_c_library_and_a_library_that_not_every_system_has_are_named() {
        assert_eq!(
            only_the_system_s(&report(&["libc.so.6", "KERNEL32.dll"], Some((2, 17)))),
            Ok(())
        );
        let newer = only_the_system_s(&report(&["libc.so.6"], Some((2, 18))));
        assert!(newer.is_err_and(|text| text.contains("2.18")));
        for foreign in ["libgcc_s.so.1", "libgcc_s_seh-1.dll", "libwinpthread-1.dll"] {
            let found = only_the_system_s(&report(&[foreign], None));
            assert!(found.is_err_and(|text| text.contains(foreign)));
        }
    }

    #[test]
    fn one_function_too_few_and_one_too_many_are_named() {
        let names = ["fmi2DoStep", "fmi2GetVersion"].map(str::to_owned);
        let expected = BTreeSet::from(names.clone());
        let mut offered = BTreeSet::from([names[0].clone()]);
        let found = exactly_the_standard_s(&offered, &expected);
        assert!(found.is_err_and(|text| text.contains("does not export fmi2GetVersion")));
        offered.insert(names[1].clone());
        assert_eq!(exactly_the_standard_s(&offered, &expected), Ok(()));
        offered.insert("rust_eh_personality".to_owned());
        let found = exactly_the_standard_s(&offered, &expected);
        assert!(found.is_err_and(|text| text.contains("rust_eh")));
    }

    #[test]
    fn a_file_of_no_known_format_is_refused() {
        let platform = &crate::platform::PLATFORMS[0];
        assert!(inspect(b"no library", platform, &BTreeSet::new(), true).is_err());
    }
}
