//! Who depends on whom: laws and physics on mathematics only, the export on no model.

use std::path::{Path, PathBuf};
use std::process::Command;

/// A package as cargo lists it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Package {
    name: String,
    /// Its folder, of those that are in this workspace.
    folder: Option<PathBuf>,
}

/// The packages that `package` depends on (itself first), with its default features; only the direct ones, or all.
fn packages(package: &str, direct: bool) -> Vec<Package> {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["tree", "-p", package, "-e", "normal", "--prefix", "none"]);
    if direct {
        command.args(["--depth", "1"]);
    }
    let output = command.output().expect("cargo can be started");
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "cargo tree -p {package}: {error}");
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let mut packages: Vec<_> = text.lines().filter_map(read).collect();
    assert_eq!(packages.first().map(|one| &*one.name), Some(package));
    packages.sort();
    packages.dedup();
    packages
}

/// `name v0.1.0 (/its/folder)`, or without a folder; `(*)` and `(proc-macro)` are none.
fn read(line: &str) -> Option<Package> {
    let (name, rest) = line.split_once(' ')?;
    let folder = rest.split_once('(').map(|(_, folder)| folder);
    let folder = folder.and_then(|folder| folder.split_once(')'));
    Some(Package {
        name: name.to_owned(),
        folder: folder
            .map(|(folder, _)| PathBuf::from(folder))
            .filter(|folder| folder.is_absolute()),
    })
}

/// Their names.
fn dependencies(package: &str, direct: bool) -> Vec<String> {
    let packages = packages(package, direct).into_iter();
    packages.map(|one| one.name).collect()
}

/// Names of those that are in this workspace, without itself.
fn ours(package: &str) -> Vec<String> {
    let all = packages(package, false).into_iter();
    let ours = all.filter(|one| one.folder.is_some() && one.name != package);
    ours.map(|one| one.name).collect()
}

#[test]
fn laws_and_physics_depend_on_mathematics_and_the_rows_of_their_parameters_only() {
    for package in ["admittance", "mechanics"] {
        for name in dependencies(package, true) {
            let allowed = [
                package,
                "nalgebra",
                "libm",
                "fmu-declaration",
                "fmu-declaration-derive",
            ];
            assert!(
                allowed.contains(&name.as_str()),
                "{package} depends on {name}"
            );
        }
        // Nor does anything reach them through nalgebra.
        assert_eq!(ours(package), ["fmu-declaration"], "{package}");
        for name in dependencies(package, false) {
            assert!(!name.starts_with("serde"), "{package} depends on {name}");
        }
    }
}

#[test]
fn the_export_depends_on_the_declaration_and_on_no_model() {
    assert_eq!(ours("fmu-export"), ["fmu-declaration"]);
    let all = dependencies("fmu-export", false);
    assert!(!all.iter().any(|name| name == "nalgebra"), "{all:?}");
}

#[test]
fn the_declaration_and_the_list_depend_on_nothing_of_ours() {
    assert_eq!(ours("fmu-declaration"), [""; 0]);
    assert_eq!(dependencies("fmus", false), ["fmus"]);
}

#[test]
fn the_commands_compile_without_any_model() {
    let ours = ours("xtask");
    let no_model = [
        "cargo-fmu",
        "fmu-archive",
        "fmu-declaration",
        "fmu-declaration-derive",
        "fmu-export",
        "fmus",
    ];
    assert!(
        ours.iter().all(|one| no_model.contains(&one.as_str())),
        "{ours:?}"
    );
}

#[test]
fn each_fmu_depends_on_its_own_side_only() {
    for fmu in fmus::ALL {
        let package = fmu.package();
        let all = packages(&package, false);
        let own = all.iter().find(|one| one.name == package);
        let folder = own.and_then(|own| own.folder.clone()).expect("is ours");
        let side = folder.parent().and_then(Path::file_name).expect("a side");
        let (own, other) = match side.to_str() {
            Some("fmu") => ("admittance", "mechanics"),
            Some("plant-fmu") => ("mechanics", "admittance"),
            _ => panic!("{package} lies in {}", folder.display()),
        };
        assert!(
            !all.iter().any(|one| one.name == other),
            "{package} depends on {other}"
        );
        // A human is no mechanism.
        let needs_none = fmu.name == "HumanOperator";
        assert!(
            needs_none || all.iter().any(|one| one.name == own),
            "{package}: {all:?}"
        );
    }
}

#[test]
fn the_c_library_depends_on_the_laws_and_on_mathematics_only() {
    for (package, suffix) in [("exo-law", ""), ("exo-law-f32", "-f32")] {
        let laws = ["admittance", "arm-law"].map(|law| format!("{law}{suffix}"));
        for name in dependencies(package, true) {
            assert!(
                [package, "nalgebra", "fmu-declaration"].contains(&name.as_str())
                    || laws.contains(&name),
                "{package} depends on {name}"
            );
        }
        let all = dependencies(package, false);
        assert!(!all.iter().any(|name| name.starts_with("serde")), "{all:?}");
    }
}
