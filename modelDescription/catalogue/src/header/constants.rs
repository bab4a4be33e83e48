//! A named constant for every item of every choice, state, diagnostic and fault in the structs of the C library: from the
//! rows, so that a new one is in the header.

use admittance::one_axis::{AxisInputs, AxisOutputs, AxisParameters};
use arm_law::{ArmInputs, ArmOutputs, ArmParameters};
use fmu_declaration::{Access, Enumeration, Rows};
use std::fmt::Write as _;

/// A choice, and the variables that take its items.
pub struct Choice {
    /// Its items.
    pub of: &'static Enumeration,
    /// Names of the variables.
    pub variables: Vec<&'static str>,
}

/// The choices of the structs, in the order in which they first stand there.
pub fn choices() -> Vec<Choice> {
    let mut found = Vec::new();
    // Those of the arm first: they offer what the library accepts, also where one axis of the FMU offers more.
    add::<ArmParameters>(&mut found);
    add::<ArmInputs>(&mut found);
    add::<ArmOutputs>(&mut found);
    add::<AxisParameters>(&mut found);
    add::<AxisInputs>(&mut found);
    add::<AxisOutputs>(&mut found);
    found
}

fn add<S: Rows>(found: &mut Vec<Choice>) {
    for row in S::ROWS {
        let Access::Enumeration { of, .. } = row.access else {
            continue;
        };
        let name = row.base_name();
        match found.iter_mut().find(|choice| choice.of.name == of.name) {
            Some(choice) if choice.variables.contains(&name) => (),
            Some(choice) => choice.variables.push(name),
            None => found.push(Choice {
                of,
                variables: vec![name],
            }),
        }
    }
}

/// The constants as C text, one `enum` a choice.
pub fn text() -> String {
    let mut text = String::new();
    for Choice { of, variables } in choices() {
        let _ = writeln!(text, "// {}: {}.\nenum {{", of.about, variables.join(", "));
        for item in of.items {
            let (prefix, name) = (capitals(of.name), capitals(item.name));
            let _ = writeln!(
                text,
                "  // {}\n  EXO_{prefix}_{name} = {},",
                item.about, item.value
            );
        }
        text += "};\n\n";
    }
    text
}

/// `TorqueLimiting`, `soft_stop` as a part of a macro's name.
fn capitals(name: &str) -> String {
    let mut out = String::new();
    for c in name.chars() {
        if c.is_ascii_uppercase() && !out.is_empty() {
            out.push('_');
        }
        out.push(c.to_ascii_uppercase());
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_item_of_the_tables_has_a_constant_and_no_two_share_a_name() {
        let text = text();
        let mut names: Vec<_> = text
            .lines()
            .filter_map(|line| line.trim().split_once(" = "))
            .map(|(name, _)| name)
            .collect();
        let items: usize = choices().iter().map(|choice| choice.of.items.len()).sum();
        assert_eq!(names.len(), items);
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), items);
    }

    #[test]
    fn the_laws_are_those_that_the_library_accepts() {
        let text = text();
        assert!(text.contains("  EXO_LAW_PASSIVE_BOUNDED = 4,\n"));
        assert!(!text.contains("SLIDING_MODE"), "one axis refuses it");
    }
}
