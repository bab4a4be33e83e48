//! `cargo xtask law --prefix DIR`: the library as other programs expect to find it.
//!
//! ```text
//! include/exo_law.h, exo_law_f32.h
//! lib/libexo_law.a, libexo_law_f32.a
//! lib/pkgconfig/exo_law.pc, exo_law_f32.pc
//! lib/cmake/exo_law/exo_law-config.cmake, exo_law-config-version.cmake
//! share/licenses/exo_law/      own licence, and the texts of all that is linked in
//! share/sbom/exo_law.cdx.json  bill of materials, CycloneDX 1.5
//! ```
//!
//! No file names the folder itself, so it may be moved.

use super::{HEADERS, PRECISIONS, Precision};
use crate::catalogue::law_documents;
use crate::linked;
use crate::process::{Outcome, at};
use fmu_archive::Component;
use std::path::{Path, PathBuf};

/// The version of the library: the workspace has one.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Installs what lies in `built` (`target/law`) under `prefix`, which is created.
///
/// # Errors
/// When a file cannot be written, or a component has no licence text.
pub fn install(prefix: &Path, built: &Path) -> Outcome {
    std::fs::create_dir_all(prefix).map_err(at(prefix))?;
    // The programs that write there run in the workspace's folder.
    let prefix = &prefix.canonicalize().map_err(at(prefix))?;
    for name in HEADERS {
        super::copy(
            &built.join("include").join(name),
            &prefix.join("include").join(name),
        )?;
    }
    for precision in &PRECISIONS {
        let library = built.join(precision.folder).join(precision.library);
        super::copy(&library, &prefix.join("lib").join(precision.library))?;
    }
    for (path, text) in files() {
        cargo_fmu::pack::replace(&prefix.join(path), text.as_bytes())?;
    }
    law_documents(prefix, components()?)?;
    println!("{}", prefix.display());
    Ok(())
}

/// What is linked into either library.
fn components() -> Outcome<Vec<Component>> {
    let mut components = Vec::new();
    for precision in &PRECISIONS {
        components.extend(linked::components(precision.package)?);
    }
    components.sort_by_key(Component::id);
    components.dedup_by_key(|component| component.id());
    Ok(components)
}

/// The files that tell build systems what is here.
fn files() -> Vec<(PathBuf, String)> {
    let cmake = Path::new("lib/cmake/exo_law");
    let mut files = vec![
        (cmake.join("exo_law-config.cmake"), config()),
        (cmake.join("exo_law-config-version.cmake"), config_version()),
    ];
    for precision in &PRECISIONS {
        let path = Path::new("lib/pkgconfig").join(format!("{}.pc", link_name(precision)));
        files.push((path, pkg_config(precision)));
    }
    files
}

/// What stands behind `-l`.
fn link_name(precision: &Precision) -> &'static str {
    let name = precision.library.trim_end_matches(".a");
    name.strip_prefix("lib").unwrap_or(name)
}

fn pkg_config(precision: &Precision) -> String {
    let (name, folder) = (link_name(precision), precision.folder);
    let define = precision
        .define
        .map_or_else(String::new, |define| format!(" {define}"));
    format!(
        "prefix=${{pcfiledir}}/../..\nincludedir=${{prefix}}/include\nlibdir=${{prefix}}/lib\n\n\
         Name: {name}\nDescription: The admittance laws as a C library, {folder}\nVersion: {VERSION}\n\
         Cflags: -I${{includedir}}{define}\nLibs: -L${{libdir}} -l{name}\n"
    )
}

fn config() -> String {
    let mut text = String::from(
        "# The admittance laws as a C library: exo_law::f64, exo_law::f32 (exo_law.h then means single precision), and\n\
         # exo_law::both for a program that includes exo_law.h and exo_law_f32.h.\n\
         if(TARGET exo_law::f64)\n  return()\nendif()\n\
         get_filename_component(_exo_law \"${CMAKE_CURRENT_LIST_DIR}/../../..\" ABSOLUTE)\n",
    );
    for precision in &PRECISIONS {
        let target = format!("exo_law::{}", precision.folder);
        text += &format!(
            "add_library({target} STATIC IMPORTED)\n\
             set_target_properties({target} PROPERTIES\n  \
             IMPORTED_LOCATION \"${{_exo_law}}/lib/{}\"\n  \
             IMPORTED_LINK_INTERFACE_LANGUAGES C\n  \
             INTERFACE_INCLUDE_DIRECTORIES \"${{_exo_law}}/include\")\n",
            precision.library
        );
        if let Some(define) = precision
            .define
            .and_then(|define| define.strip_prefix("-D"))
        {
            text += &format!(
                "set_property(TARGET {target} PROPERTY INTERFACE_COMPILE_DEFINITIONS {define})\n"
            );
        }
    }
    let libraries = PRECISIONS.map(|precision| format!("${{_exo_law}}/lib/{}", precision.library));
    text += &format!(
        "add_library(exo_law::both INTERFACE IMPORTED)\n\
         set_target_properties(exo_law::both PROPERTIES\n  \
         INTERFACE_LINK_LIBRARIES \"{}\"\n  \
         INTERFACE_INCLUDE_DIRECTORIES \"${{_exo_law}}/include\")\n\
         unset(_exo_law)\n",
        libraries.join(";")
    );
    text
}

/// A program that asks for a version gets this one where major and minor number are the same and it is not older: before 1.0 a
/// minor version may break the interface.
fn config_version() -> String {
    let series: Vec<_> = VERSION.split('.').take(2).collect();
    let series = series.join(".");
    format!(
        "set(PACKAGE_VERSION {VERSION})\n\
         if(PACKAGE_FIND_VERSION VERSION_GREATER PACKAGE_VERSION OR NOT \"${{PACKAGE_FIND_VERSION}}.\" MATCHES \"^{}[.]\")\n  \
         set(PACKAGE_VERSION_COMPATIBLE FALSE)\nelse()\n  set(PACKAGE_VERSION_COMPATIBLE TRUE)\n\
         if(PACKAGE_FIND_VERSION VERSION_EQUAL PACKAGE_VERSION)\n    set(PACKAGE_VERSION_EXACT TRUE)\n  endif()\nendif()\n",
        series.replace('.', "[.]")
    )
}
