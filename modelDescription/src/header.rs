//! C header with the value references.

use crate::entry::Kind;
use crate::interface::Interface;
use crate::xml::{causality, variability};
use std::fmt::Write as _;

/// Writes the header: one `#define` per scalar, `TESTBED_ENERGY_KINETIC` for `energy.kinetic`, `…_TAU_A_1` for `tau_a[1]`,
/// and one enumerator per item of each enumeration.
///
/// # Panics
/// Never: text is written to memory.
pub fn write(interface: &Interface) -> String {
    let mut text = String::new();
    let guard = format!("{}_VALUE_REFERENCES_H", macro_name(interface.name));
    let _ = writeln!(
        text,
        "/* {}: value references, guid {}. Generated, do not edit. */",
        interface.name, interface.guid
    );
    let _ = writeln!(text, "#ifndef {guard}\n#define {guard}\n");
    let _ = writeln!(
        text,
        "#define {}_GUID \"{}\"\n",
        macro_name(interface.name),
        interface.guid
    );
    for (entry, name) in interface.scalars.iter().zip(macro_names(interface)) {
        let kind = match &entry.kind {
            Kind::Real { unit, .. } => format!("Real, {}", unit.name),
            Kind::Integer { .. } => "Integer".to_owned(),
            Kind::Boolean { .. } => "Boolean".to_owned(),
            Kind::String { .. } => "String".to_owned(),
            Kind::Enumeration { of, .. } => format!("Integer, item of {}", of.name),
        };
        let (causality, variability) = (causality(entry.causality), variability(entry.variability));
        let _ = writeln!(
            text,
            "#define {name} {}u /* {variability} {causality} {}: {kind} */",
            entry.reference, entry.name
        );
    }
    for of in interface.enumerations() {
        let prefix = format!("{}_{}", macro_name(interface.name), macro_name(of.name));
        let _ = writeln!(text);
        for item in of.items {
            let _ = writeln!(
                text,
                "#define {prefix}_{} {}",
                macro_name(item.name),
                item.value
            );
        }
    }
    let _ = writeln!(text, "\n#endif");
    text
}

/// Macro names of all scalars, different from each other: where `a[1]` and `a_1` meet, the later gets its value
/// reference appended.
fn macro_names(interface: &Interface) -> Vec<String> {
    let mut seen = std::collections::BTreeSet::new();
    let prefix = macro_name(interface.name);
    let name = |entry: &crate::entry::Entry| {
        let name = format!("{prefix}_{}", macro_name(&entry.name));
        if seen.insert(name.clone()) {
            name
        } else {
            format!("{name}_VR{}", entry.reference)
        }
    };
    interface.scalars.iter().map(name).collect()
}

/// Capitals, with underscores where words meet and in place of everything else: `energy.E_0` → `ENERGY_E_0`,
/// `TestbedController` → `TESTBED_CONTROLLER`.
fn macro_name(name: &str) -> String {
    let mut out = String::new();
    let mut before = ' ';
    for c in name.chars() {
        let boundary = before.is_ascii_lowercase() && c.is_ascii_uppercase();
        if (boundary || !c.is_ascii_alphanumeric()) && !out.ends_with('_') {
            out.push('_');
        }
        if c.is_ascii_alphanumeric() {
            out.push(c.to_ascii_uppercase());
        }
        before = c;
    }
    out.trim_end_matches('_').to_owned()
}

#[cfg(test)]
mod tests {
    use super::macro_name;

    #[test]
    fn names_become_macros() {
        for (name, wanted) in [
            ("energy.E_0", "ENERGY_E_0"),
            ("tau_a[3]", "TAU_A_3"),
            ("segment[16].t_on", "SEGMENT_16_T_ON"),
            ("TestbedController", "TESTBED_CONTROLLER"),
            ("K_P", "K_P"),
        ] {
            assert_eq!(macro_name(name), wanted);
        }
    }
}
