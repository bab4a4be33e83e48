//! The C headers of the law's library, made by cbindgen from `fmu/c/src`.
//!
//! | module | what is added |
//! |---|---|
//! | [`mod@constants`] | a constant for every item of every choice |
//! | [`precision`] | one header for each precision |

pub mod constants;
pub mod precision;

use crate::root;
use admittance::hand::StiffHand;
use admittance::law::OFFERED_LAW;
use admittance::one_axis::{AxisInputs, AxisOutputs, AxisParameters};
use arm_law::encoders::EncoderParameters;
use arm_law::joint_space::JointSettings;
use arm_law::kinematics::Kinematics;
use arm_law::nominal::{Link, NominalArm};
use arm_law::singularity::Singularity;
use arm_law::supervision::Parameters;
use arm_law::workspace::Workspace;
use arm_law::wrench::{Sensor, Tool, tare::TareSettings, validity::Checks};
use arm_law::{ArmInputs, ArmOutputs, ArmParameters};
use fmu_declaration::unit::NONE;
use fmu_declaration::{Access, Item, Rows};
use std::collections::{BTreeMap, HashMap};
use std::path::PathBuf;

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
    let version = crate::PACKAGE.version;
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
    let renamed = config.export.rename.clone();
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
    let text = with_units(&text, &renamed);
    let begin = "#if !defined(EXO_LAW_F32)";
    if !text.contains(begin) {
        return Err(format!("cbindgen's header has no {begin}"));
    }
    Ok(text.replacen(begin, &(preamble() + begin), 1))
}

/// What a row says of its value beside the description: a unit, the items of a choice, or a Boolean.
fn meaning(access: &Access<impl Sized>) -> Option<String> {
    match access {
        Access::Real { unit, .. } => (*unit != NONE).then(|| unit.name.to_owned()),
        Access::Boolean { .. } => Some("0 or 1".to_owned()),
        Access::Enumeration { of, .. } => {
            let item = |item: &Item| format!("{} {}", item.value, item.name);
            // One axis of the library has the laws that the arm has, too.
            let of = if of.name == OFFERED_LAW.name {
                &OFFERED_LAW
            } else {
                of
            };
            Some(of.items.iter().map(item).collect::<Vec<_>>().join(", "))
        }
        Access::Integer { .. }
        | Access::Wide { .. }
        | Access::String { .. }
        | Access::Binary { .. } => None,
    }
}

/// The meaning of each field, by struct and field: cbindgen keeps the descriptions only.
fn meanings() -> BTreeMap<(&'static str, &'static str), String> {
    let mut found = BTreeMap::new();
    macro_rules! rows_of {
        ($($Struct:ident),*) => {$(
            for row in $Struct::ROWS {
                if let Some(what) = meaning(&row.access) {
                    found.insert((stringify!($Struct), row.field), what);
                }
            }
        )*};
    }
    rows_of!(
        AxisParameters,
        AxisInputs,
        AxisOutputs,
        ArmParameters,
        ArmInputs,
        ArmOutputs
    );
    rows_of!(
        Kinematics,
        Singularity,
        StiffHand,
        Sensor,
        Tool,
        Checks,
        TareSettings,
        Parameters
    );
    rows_of!(
        EncoderParameters,
        JointSettings,
        NominalArm,
        Link,
        Workspace
    );
    found
}

/// The name at the begin of `text`.
fn word(text: &str) -> String {
    let is_part = |c: &char| c.is_ascii_alphanumeric() || *c == '_';
    text.chars().take_while(is_part).collect()
}

/// The header with each field's unit behind it. The structs are `renamed` in C.
fn with_units(text: &str, renamed: &HashMap<String, String>) -> String {
    let units: BTreeMap<_, _> = meanings()
        .into_iter()
        .filter_map(|((of, field), what)| {
            Some(((renamed.get(of)?.clone(), field.to_owned()), what))
        })
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
    fn each_struct_of_a_law_but_its_memory_says_what_its_fields_mean() {
        let [text, _] = made();
        let mut structs: Vec<_> = text.split("typedef struct ").skip(1).collect();
        structs.retain(|of| of.starts_with("exo_a") && !word(of).ends_with("_state"));
        assert!(structs.len() > 15, "{}", structs.len());
        for of in structs {
            let fields = of.split_once('}').map_or("", |(fields, _)| fields);
            assert!(
                fields.contains("; // "),
                "{}: not in the list of this file",
                word(of)
            );
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
