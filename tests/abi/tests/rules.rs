//! `docs/fmi-rules.md` names tests and deviations: each of them exists.

use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Rows of the tables of the document: the rule and its tests as `path::name`.
fn rows(text: &str) -> Vec<(&str, Vec<(&str, &str)>)> {
    let mut of_rules = false;
    let cells = text.lines().filter_map(|line| {
        of_rules = line.starts_with('|') && (of_rules || line == "| rule | test |");
        let (rule, tests) = line.strip_prefix("| ")?.rsplit_once(" | ")?;
        (of_rules && rule != "rule").then_some((rule, tests))
    });
    cells
        .map(|(rule, tests)| {
            let words = tests.split('`').filter_map(|word| word.split_once("::"));
            (rule, words.collect())
        })
        .collect()
}

/// Whether a file has a test of this name: a function under `#[test]`, or a Python function that pytest finds.
fn has_test(source: &str, path: &str, name: &str) -> bool {
    if path.ends_with(".py") {
        return name.starts_with("test_") && source.contains(&format!("\ndef {name}("));
    }
    let lines: Vec<_> = source.lines().map(str::trim).collect();
    let function = format!("fn {name}(");
    let at = lines.iter().position(|line| line.starts_with(&function));
    at.is_some_and(|at| {
        let attributes = lines[..at]
            .iter()
            .rev()
            .take_while(|line| line.starts_with("#["));
        let attributes: Vec<_> = attributes.collect();
        attributes.iter().any(|line| **line == "#[test]")
            && !attributes.iter().any(|line| line.starts_with("#[ignore"))
    })
}

#[test]
fn every_rule_has_a_test_and_every_test_that_is_named_exists() {
    let text = std::fs::read_to_string(root().join("docs/fmi-rules.md")).expect("the document");
    let rows = rows(&text);
    assert!(rows.len() > 50, "{} rows were read", rows.len());
    for (rule, tests) in rows {
        assert!(!tests.is_empty(), "no test: {rule}");
        for (path, name) in tests {
            let source = std::fs::read_to_string(root().join(path))
                .unwrap_or_else(|e| panic!("{path}, named for '{rule}': {e}"));
            assert!(
                has_test(&source, path, name),
                "{path} has no test {name}, named for '{rule}'"
            );
        }
    }
}

#[test]
fn every_deviation_from_the_table_is_in_the_document_with_its_reason() {
    let text = std::fs::read_to_string(root().join("docs/fmi-rules.md")).expect("the document");
    let lines = |words: &[&str]| {
        text.lines()
            .any(|line| words.iter().all(|w| line.contains(w)))
    };
    for (functions, phase, reason) in abi::standard::DEVIATIONS {
        assert!(lines(&[phase.name(), reason]), "{functions:?} in {phase:?}");
    }
    for (what, reason) in abi::fmi3::standard::DEVIATIONS_FROM_THE_TEXT {
        assert!(lines(&[what, reason]), "{what}");
    }
    for (what, reason) in abi::rights::DEVIATIONS {
        let before = what == "get before Initialization Mode"; // the same as that of the functions above
        assert!(
            lines(&[if before { "fmi2GetReal" } else { what }, reason]),
            "{what}"
        );
    }
}

#[test]
fn a_function_that_is_no_test_a_name_that_is_gone_and_an_empty_row_are_seen() {
    let source = "#[test]\n#[should_panic]\nfn one() {}\nfn two() {}\n#[test]\n#[ignore = \"slow\"]\nfn three() {}\n";
    let seen = ["one", "two", "three", "four"].map(|name| has_test(source, "a.rs", name));
    assert_eq!(seen, [true, false, false, false]);
    assert!(has_test("\ndef test_a() -> None:\n", "a.py", "test_a"));
    assert!(!has_test("\ndef test_ab() -> None:\n", "a.py", "test_a"));
    let text = "| rule | test |\n|---|---|\n| a | `x.rs::one`, `y.py::two` |\n| b \\| c | |\n";
    let expected = vec![("a", vec![("x.rs", "one"), ("y.py", "two")])];
    assert_eq!(rows(text)[..1], expected);
}
