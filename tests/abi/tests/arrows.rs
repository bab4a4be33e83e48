//! Who depends on whom: laws and physics on mathematics only, the export on no model.

use std::process::Command;

/// Names of the packages that `package` depends on (itself first), with its default features; only the direct ones, or
/// all.
fn dependencies(package: &str, direct: bool) -> Vec<String> {
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
    let mut names: Vec<_> = text
        .lines()
        .filter_map(|line| line.split_whitespace().next().map(str::to_owned))
        .collect();
    assert_eq!(names.first().map(String::as_str), Some(package));
    names.sort();
    names.dedup();
    names
}

const OURS: [&str; 14] = [
    "admittance",
    "arm-controller",
    "arm-law",
    "declaration",
    "exo-law",
    "exoskeleton-arm",
    "exoskeleton-arms",
    "export",
    "human-operator",
    "mechanics",
    "model-description",
    "testbed",
    "testbed-controller",
    "xtask",
];

#[test]
fn laws_and_physics_depend_on_nalgebra_and_libm_only() {
    for package in ["admittance", "mechanics"] {
        for name in dependencies(package, true) {
            let allowed = [package, "nalgebra", "libm"];
            assert!(
                allowed.contains(&name.as_str()),
                "{package} depends on {name}"
            );
        }
        // Nor does anything reach them through nalgebra.
        let all = dependencies(package, false);
        for name in OURS
            .iter()
            .filter(|&&name| name != package)
            .chain(&["serde", "serde_core"])
        {
            assert!(
                !all.iter().any(|n| n == name),
                "{package} depends on {name}"
            );
        }
    }
}

#[test]
fn the_export_depends_on_the_declaration_and_on_no_model() {
    let all = dependencies("export", false);
    assert!(all.iter().any(|name| name == "declaration"), "{all:?}");
    for name in OURS
        .iter()
        .filter(|name| !["export", "declaration"].contains(name))
        .chain(&["nalgebra"])
    {
        assert!(!all.iter().any(|n| n == name), "export depends on {name}");
    }
}

#[test]
fn the_declaration_depends_on_nothing_of_ours() {
    let all = dependencies("declaration", false);
    for name in OURS.iter().filter(|&&name| name != "declaration") {
        assert!(
            !all.iter().any(|n| n == name),
            "declaration depends on {name}"
        );
    }
}

#[test]
fn each_fmu_depends_on_its_own_side_only() {
    for (package, own, other) in [
        ("testbed-controller", "admittance", "mechanics"),
        ("testbed", "mechanics", "admittance"),
        ("arm-controller", "admittance", "mechanics"),
        ("exoskeleton-arm", "mechanics", "admittance"),
        ("exoskeleton-arms", "mechanics", "admittance"),
    ] {
        let all = dependencies(package, false);
        assert!(all.iter().any(|n| n == own), "{package}: {all:?}");
        assert!(
            !all.iter().any(|n| n == other),
            "{package} depends on {other}"
        );
    }
}

#[test]
fn the_c_library_depends_on_the_laws_and_on_mathematics_only() {
    for (package, suffix) in [("exo-law", ""), ("exo-law-f32", "-f32")] {
        let laws = ["admittance", "arm-law"].map(|law| format!("{law}{suffix}"));
        for name in dependencies(package, true) {
            assert!(
                [package, "nalgebra"].contains(&name.as_str()) || laws.contains(&name),
                "{package} depends on {name}"
            );
        }
        let all = dependencies(package, false);
        assert!(!all.iter().any(|name| name.starts_with("serde")), "{all:?}");
    }
}
