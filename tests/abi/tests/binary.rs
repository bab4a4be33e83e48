//! The shared libraries as files: what they export, what they need, what they tell about the machine that built them.
#![cfg(target_os = "linux")]

use abi::{Fmu, Library};
use object::read::elf::{Dyn, ElfFile64, FileHeader, SectionTable};
use object::{Endianness, Object, ObjectSymbol, elf};
use std::collections::BTreeSet;

/// The shared library, byte by byte.
fn bytes(fmu: &Fmu) -> Vec<u8> {
    std::fs::read(&fmu.path).expect("the library can be read")
}

#[test]
fn exactly_the_functions_of_fmi_2_and_fmi_3_are_exported() {
    let fmi3 = abi::fmi3::Library::FUNCTIONS;
    let expected = Library::FUNCTIONS.into_iter().chain(fmi3);
    let expected: BTreeSet<_> = expected.map(String::from).collect();
    assert_eq!(expected.len(), 34 + 75);
    for fmu in Fmu::all() {
        let data = bytes(&fmu);
        let file = ElfFile64::<Endianness>::parse(&*data).expect("an ELF file");
        let exported: BTreeSet<_> = file
            .dynamic_symbols()
            .filter(|symbol| symbol.is_definition() && !symbol.is_local())
            .map(|symbol| symbol.name().expect("UTF-8").to_owned())
            .collect();
        assert_eq!(exported, expected, "{}", fmu.name);
    }
}

#[test]
fn only_the_system_s_own_libraries_are_needed() {
    for fmu in Fmu::all() {
        let data = bytes(&fmu);
        for needed in needed_libraries(&data) {
            // libgcc_s is the unwinder, part of every system with glibc; a build that links it statically needs less.
            let known = [
                "libc.so",
                "libm.so",
                "libdl.so",
                "libpthread.so",
                "ld-linux",
                "libgcc_s.so",
            ];
            assert!(
                known.iter().any(|name| needed.starts_with(name)),
                "{} needs {needed}",
                fmu.name
            );
        }
    }
}

/// Each platform's C library rounds these in its own way, so that the numbers would be another machine's.
#[test]
fn no_mathematics_of_the_platform_is_called() {
    let rounded = [
        "sin", "cos", "sincos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh",
        "exp", "exp2", "expm1", "log", "log2", "log10", "log1p", "pow", "cbrt", "hypot",
    ];
    for fmu in Fmu::all() {
        let data = bytes(&fmu);
        let file = ElfFile64::<Endianness>::parse(&*data).expect("an ELF file");
        for symbol in file
            .dynamic_symbols()
            .filter(|symbol| symbol.is_undefined())
        {
            let name = symbol.name().expect("UTF-8");
            assert!(!rounded.contains(&name), "{} calls {name}", fmu.name);
        }
    }
}

fn needed_libraries(data: &[u8]) -> Vec<String> {
    let header = elf::FileHeader64::<Endianness>::parse(data).expect("an ELF file");
    let endian = header.endian().expect("a known byte order");
    let sections: SectionTable<'_, _> = header.sections(endian, data).expect("sections");
    let (entries, strings) = sections
        .dynamic(endian, data)
        .expect("a readable dynamic section")
        .expect("a shared library has one");
    let strings = sections
        .strings(endian, data, strings)
        .expect("its string table");
    entries
        .iter()
        .filter(|entry| entry.tag32(endian) == Some(elf::DT_NEEDED))
        .map(|entry| entry.string(endian, strings).expect("a name"))
        .map(|name| String::from_utf8_lossy(name).into_owned())
        .collect()
}

#[test]
fn no_path_of_the_building_machine_is_inside() {
    let workspace = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .ancestors()
        .nth(2)
        .expect("tests/abi lies in the workspace");
    let mut paths = vec![workspace.to_path_buf()];
    for variable in ["HOME", "CARGO_HOME", "RUSTUP_HOME"] {
        paths.extend(std::env::var_os(variable).map(Into::into));
    }
    // A home of `/` is in every path.
    paths.retain(|path| path.components().count() > 1);
    for fmu in Fmu::all() {
        let data = bytes(&fmu);
        for path in &paths {
            // With the separator: a home directory `/root` must not match a word.
            let needle = format!("{}/", path.display());
            let found = find(&data, needle.as_bytes()).next();
            assert!(
                found.is_none(),
                "{} contains {}",
                fmu.name,
                found.map_or_else(String::new, |(at, _)| String::from_utf8_lossy(
                    &data[at..(at + 120).min(data.len())]
                )
                .into_owned())
            );
        }
    }
}

/// All places of `needle`.
fn find<'a>(data: &'a [u8], needle: &'a [u8]) -> impl Iterator<Item = (usize, &'a [u8])> {
    data.windows(needle.len())
        .enumerate()
        .filter(move |(_, window)| *window == needle)
}
