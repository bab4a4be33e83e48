//! The C header of the law's library, made by cbindgen from `fmu/c/src`.

use crate::root;
use arm_law::choices;
use declaration::Enumeration;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The header's committed place.
pub fn committed() -> PathBuf {
    root().join("fmu/c/include/exo_law.h")
}

/// The header that the source gives.
///
/// # Errors
/// When cbindgen cannot read the source.
pub fn header() -> Result<String, String> {
    let source = root().join("fmu/c");
    let found = |error: &dyn std::fmt::Display| format!("cbindgen: {error}");
    let config =
        cbindgen::Config::from_file(source.join("cbindgen.toml")).map_err(|error| found(&error))?;
    let bindings = cbindgen::Builder::new()
        .with_config(config)
        .with_src(source.join("../admittance/src/lib.rs"))
        .with_src(source.join("../arm-law/src/lib.rs"))
        .with_src(source.join("src/lib.rs"))
        .generate()
        .map_err(|error| found(&error))?;
    let mut text = Vec::new();
    bindings.write(&mut text);
    let text = String::from_utf8(text).map_err(|error| found(&error))?;
    let config = std::fs::read_to_string(source.join("cbindgen.toml")).map_err(|e| found(&e))?;
    Ok(with_units(&text, &config, &units(&source)?))
}

/// The choices of the law, by the names of their constants.
const CHOICES: [(&str, Enumeration); 11] = [
    ("LAW", admittance::law::LAW),
    ("OFFERED_LAW", admittance::law::OFFERED_LAW),
    ("TORQUE_LIMITING", choices::TORQUE_LIMITING),
    ("FRAME", choices::FRAME),
    ("SOURCE", choices::SOURCE),
    ("FAULT", choices::FAULT),
    ("TARE_STATE", choices::TARE_STATE),
    ("TARE_FAILURE", choices::TARE_FAILURE),
    ("STATE", choices::STATE),
    ("DIAGNOSTIC", choices::DIAGNOSTIC),
    ("SPACE", choices::SPACE),
];

/// What the rows say of a value: a unit, an item of a choice, or a Boolean.
fn meaning(word: &str) -> Option<String> {
    let unit = |name: &str| {
        Some(
            declaration::unit::ALL
                .iter()
                .find(|(unit, _)| *unit == name)?
                .1,
        )
    };
    if word == "boolean" {
        return Some("0 or 1".to_owned());
    }
    match CHOICES.iter().find(|(name, _)| *name == word) {
        Some((_, of)) => {
            let items = of
                .items
                .iter()
                .map(|item| format!("{} {}", item.value, item.name));
            Some(items.collect::<Vec<_>>().join(", "))
        }
        None => unit(word).map(|unit| unit.name.to_owned()),
    }
}

/// Unit, choice or Boolean of each field, by struct and field, as the rows in the sources say it: cbindgen keeps their
/// descriptions only.
fn units(source: &Path) -> Result<BTreeMap<(String, String), String>, String> {
    let mut found = BTreeMap::new();
    for folder in ["../admittance/src", "../arm-law/src"] {
        for file in rust_files(&source.join(folder)) {
            let text = std::fs::read_to_string(&file).map_err(|e| format!("{file:?}: {e}"))?;
            let (mut of, mut attribute) = (String::new(), String::new());
            for line in text.lines().map(str::trim) {
                if let Some(rest) = line.strip_prefix("pub struct ") {
                    of = word(rest);
                }
                if line.starts_with("#[") {
                    attribute.clear();
                }
                if let Some(rest) = line.strip_prefix("pub ").filter(|_| line.contains(':')) {
                    let after = |key: &str| Some(word(attribute.split_once(key)?.1));
                    let boolean = attribute.contains("boolean").then(|| "boolean".to_owned());
                    if let Some(what) = after("unit = ").or_else(|| after("items = ")).or(boolean) {
                        found.insert((of.clone(), word(rest)), what);
                    }
                    attribute.clear();
                } else {
                    attribute += line;
                }
            }
        }
    }
    Ok(found)
}

/// The name at the begin of `text`.
fn word(text: &str) -> String {
    let is_part = |c: &char| c.is_ascii_alphanumeric() || *c == '_';
    text.chars().take_while(is_part).collect()
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut files: Vec<_> = entries
        .map(|entry| entry.path())
        .flat_map(|path| {
            if path.is_dir() {
                rust_files(&path)
            } else {
                vec![path]
            }
        })
        .collect();
    files.sort();
    files
}

/// The header with each field's unit behind it.
fn with_units(text: &str, config: &str, units: &BTreeMap<(String, String), String>) -> String {
    // What cbindgen calls a struct: `Kinematics = "exo_arm_kinematics"`.
    let renamed = |of: &str| {
        let line = config
            .lines()
            .find(|line| line.split(" = ").next() == Some(of))?;
        Some(line.split('"').nth(1)?.to_owned())
    };
    let units: BTreeMap<_, _> = units
        .iter()
        .filter_map(|((of, field), what)| Some(((renamed(of)?, field.clone()), meaning(what)?)))
        .collect();
    let mut of = String::new();
    let mut lines = Vec::new();
    for line in text.lines() {
        if let Some(rest) = line.strip_prefix("typedef struct ") {
            of = word(rest);
        }
        let field = line
            .strip_prefix("  exo_real ")
            .or_else(|| line.strip_prefix("  double "))
            .or_else(|| line.strip_prefix("  int32_t "))
            .map(word);
        let unit = field.and_then(|field| units.get(&(of.clone(), field)));
        lines.push(match unit {
            Some(unit) => format!("{line} // {unit}"),
            None => line.to_owned(),
        });
    }
    lines.join("\n") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_field_bears_the_unit_or_the_choice_of_its_row() {
        let text = header().unwrap_or_else(|error| panic!("{error}"));
        for line in [
            "  exo_real engage_time; // s",
            "  exo_real Lambda_n[3]; // kg",
            "  double q[3]; // rad",
            "  exo_real I_xz; // kg.m2",
            "  int32_t space; // 1 task, 2 joint",
            "  int32_t engage; // 0 or 1",
        ] {
            assert!(text.lines().any(|found| found == line), "{line}");
        }
    }

    #[test]
    fn the_committed_header_is_what_the_source_gives() {
        let text = header().unwrap_or_else(|error| panic!("{error}"));
        let committed = std::fs::read_to_string(committed()).expect("is committed");
        assert!(
            committed == text,
            "run `cargo xtask law --bless` and read the diff"
        );
    }
}
