//! Physics depends on mathematics only: `cargo tree` is asked, so that a new dependency is a decision.

use std::process::Command;

#[test]
fn the_crate_depends_on_nothing_but_nalgebra_and_libm() {
    let tree = Command::new(env!("CARGO"))
        .args([
            "tree",
            "--package",
            "mechanics",
            "--edges",
            "normal",
            "--depth",
            "1",
            "--prefix",
            "none",
        ])
        .args([
            "--manifest-path",
            concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml"),
            "--offline",
        ])
        .output()
        .expect("cargo runs");
    let text = String::from_utf8_lossy(&tree.stdout);
    assert!(
        tree.status.success(),
        "{}",
        String::from_utf8_lossy(&tree.stderr)
    );

    let mut names = text
        .lines()
        .filter_map(|line| line.split_whitespace().next());
    assert_eq!(names.next(), Some("mechanics"));
    for name in names {
        assert!(
            ["nalgebra", "libm"].contains(&name),
            "unexpected dependency {name}:\n{text}"
        );
    }
}
