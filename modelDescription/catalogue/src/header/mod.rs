//! The C headers of the law's library, made by cbindgen from `fmu/c/src`.
//!
//! | module | what is added |
//! |---|---|
//! | [`mod@constants`] | a constant for every item of every choice |
//! | [`precision`] | one header for each precision |

pub mod constants;
pub mod precision;

use crate::root;
use arm_law::choices;
use declaration::Enumeration;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Names of the headers: of double precision, which all programs include, and of single precision.
pub const NAMES: [&str; 2] = ["exo_law.h", "exo_law_f32.h"];

/// The headers' committed place.
pub fn committed() -> PathBuf {
    root().join("fmu/c/include")
}

/// The headers that the source gives, in the order of [`NAMES`].
///
/// # Errors
/// When cbindgen cannot read the source.
pub fn headers() -> Result<[String; 2], String> {
    let (double, single) = precision::split(&both()?)?;
    Ok([double, single])
}

/// Before what depends on the precision: the version, and a constant for every item.
fn preamble() -> String {
    let version = model_description::VERSION;
    let numbers = ["MAJOR", "MINOR", "PATCH"];
    let parts = version.split(['.', '-', '+']).zip(numbers);
    let parts: Vec<_> = parts
        .map(|(number, part)| format!("#define EXO_LAW_VERSION_{part} {number}\n"))
        .collect();
    format!(
        "// Version of this header; exo_law_version() is that of the library.\n#define EXO_LAW_VERSION \"{version}\"\n{}\n{}",
        parts.concat(),
        constants::text()
    )
}

/// What cbindgen makes of the source, with both precisions in it, units and constants.
fn both() -> Result<String, String> {
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
    let text = with_units(&text, &config, &units(&source)?);
    let begin = "#if !defined(EXO_LAW_F32)";
    if !text.contains(begin) {
        return Err(format!("cbindgen's header has no {begin}"));
    }
    Ok(text.replacen(begin, &(preamble() + begin), 1))
}

/// The choices of the law, by the names of their constants.
const CHOICES: [(&str, Enumeration); 11] = [
    // One axis of the library has the laws that the arm has, too.
    ("LAW", admittance::law::OFFERED_LAW),
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

    fn made() -> [String; 2] {
        headers().unwrap_or_else(|error| panic!("{error}"))
    }

    #[test]
    fn a_field_bears_the_unit_or_the_choice_of_its_row() {
        for text in made() {
            for line in [
                "exo_real engage_time; // s",
                "exo_real Lambda_n[3]; // kg",
                "double q[3]; // rad",
                "exo_real I_xz; // kg.m2",
                "int32_t space; // 1 task, 2 joint",
                "int32_t engage; // 0 or 1",
            ] {
                let single = line.replace("exo_real", "exo_f32_real");
                let is_it = |found: &str| found.trim() == line || found.trim() == single;
                assert!(text.lines().any(is_it), "{line}");
            }
        }
    }

    #[test]
    fn every_choice_of_a_field_is_in_its_comment() {
        let [double, _] = made();
        for choice in constants::choices() {
            let item = &choice.of.items[0];
            let comment = format!("// {} {}", item.value, item.name);
            for variable in choice.variables {
                let field = format!("int32_t {}; ", variable.replace('.', "_"));
                let short = format!("int32_t {}; ", variable.rsplit('.').next().unwrap_or(""));
                let found = double.lines().find(|line| {
                    let line = line.trim();
                    (line.starts_with(&field) || line.starts_with(&short)) && line.contains("//")
                });
                let found = found.unwrap_or_else(|| panic!("{variable} has no field"));
                assert!(found.contains(&comment), "{found}: expected {comment}");
            }
        }
    }

    #[test]
    fn the_committed_headers_are_what_the_source_gives() {
        for (name, text) in NAMES.iter().zip(made()) {
            let committed = std::fs::read_to_string(committed().join(name)).expect("is committed");
            assert!(
                committed == text,
                "{name}: run `cargo xtask law --bless` and read the diff"
            );
        }
    }
}
