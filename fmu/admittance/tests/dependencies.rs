//! The law depends on nalgebra and libm, and on nothing else.

use std::process::Command;

#[test]
fn the_law_depends_on_nalgebra_and_libm_only() {
    let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml");
    let output = Command::new(env!("CARGO"))
        .args([
            "tree",
            "--offline",
            "--manifest-path",
            manifest,
            "--package",
            "admittance",
        ])
        .args([
            "--edges", "normal", "--depth", "1", "--prefix", "none", "--format", "{p}",
        ])
        .output()
        .expect("cargo runs");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let tree = String::from_utf8(output.stdout).expect("names are UTF-8");
    let mut names: Vec<&str> = tree
        .lines()
        .filter_map(|line| line.split(' ').next())
        .collect();
    names.sort_unstable();
    assert_eq!(names, ["admittance", "libm", "nalgebra"]);
}
