//! What the tools add to a library besides cargo's packages: a standard library of another compiler, an unwinder, start
//! files. Their licences go into the archive like those of the packages.

use crate::process::{Failure, Outcome, answer, at, program};
use crate::toolchain::{with_libraries, zig_folder};
use fmu_archive::Component;
use std::path::{Path, PathBuf};

/// Debian's standard library of Rust.
///
/// # Errors
/// When the unpacked packages are not what they were.
pub fn rust(folder: &Path) -> Outcome<Component> {
    let about = answer(with_libraries(
        &mut program(folder.join("usr/bin/rustc"), ["-vV"]),
        folder,
    ))
    .unwrap_or_default();
    let version = about
        .lines()
        .find_map(|line| line.strip_prefix("release: "));
    component(
        "rust-std",
        version,
        "MIT OR Apache-2.0",
        Some("pkg:github/rust-lang/rust"),
        &[(
            "copyright.txt",
            folder.join("usr/share/doc/rust-web-src/copyright"),
        )],
    )
}

/// zig's unwinder (LLVM's libunwind), its compiler runtime, and the start files of the GNU C library.
///
/// # Errors
/// When the wheel is not what it was.
pub fn zig(programs: &Path) -> Outcome<Component> {
    let python = programs.join("python");
    let version = answer(&mut program(&python, ["-m", "ziglang", "version"]));
    let folder = zig_folder(programs);
    component(
        "ziglang",
        version.as_deref(),
        "MIT AND Apache-2.0 WITH LLVM-exception AND LGPL-2.1-or-later WITH GCC-exception-2.0-note",
        Some("pkg:pypi/ziglang"),
        &[
            ("LICENSE-zig.txt", folder.join("LICENSE")),
            (
                "LICENSE-libunwind.txt",
                folder.join("lib/libunwind/LICENSE.TXT"),
            ),
            ("LICENSES-glibc.txt", folder.join("lib/libc/glibc/LICENSES")),
        ],
    )
}

/// GCC's unwinder and compiler runtime, and the start files and import libraries of MinGW-w64.
///
/// # Errors
/// When the unpacked packages are not what they were.
pub fn mingw(folder: &Path) -> Outcome<Vec<Component>> {
    let gcc = folder.join("usr/bin/x86_64-w64-mingw32-gcc-win32");
    let gcc = answer(&mut program(gcc, ["-dumpversion"]));
    let header = folder.join("usr/share/mingw-w64/include/_mingw_mac.h");
    let header = std::fs::read_to_string(&header).map_err(at(&header))?;
    let number = |name: &str| {
        let defined = format!("#define __MINGW64_VERSION_{name}");
        let line = header
            .lines()
            .find_map(|line| line.strip_prefix(&defined))?;
        line.trim().parse::<u32>().ok()
    };
    let runtime = number("MAJOR").zip(number("MINOR")).zip(number("BUGFIX"));
    let runtime = runtime.map(|((major, minor), fix)| format!("{major}.{minor}.{fix}"));
    let text = |package: &str| folder.join("usr/share/doc").join(package).join("copyright");
    Ok(vec![
        component(
            "libgcc",
            gcc.as_deref(),
            "GPL-3.0-or-later WITH GCC-exception-3.1",
            None,
            &[("copyright.txt", text("gcc-mingw-w64-base"))],
        )?,
        component(
            "mingw-w64",
            runtime.as_deref(),
            "ZPL-2.1",
            None,
            &[("copyright.txt", text("mingw-w64-common"))],
        )?,
    ])
}

fn component(
    name: &str,
    version: Option<&str>,
    license: &str,
    purl: Option<&str>,
    texts: &[(&str, PathBuf)],
) -> Outcome<Component> {
    let version = version
        .ok_or_else(|| Failure::Found(format!("the tools do not say the version of {name}")))?;
    let texts = texts
        .iter()
        .map(|(file, path)| Ok(((*file).to_owned(), std::fs::read(path).map_err(at(path))?)))
        .collect::<Outcome<_>>()?;
    Ok(Component {
        name: name.to_owned(),
        version: version.to_owned(),
        license: license.to_owned(),
        purl: purl.map(|purl| format!("{purl}@{version}")),
        sha256: None,
        texts,
        uses: Vec::new(),
    })
}
