//! C header with the value references.

use crate::arrays::{self, CLOCK, CLOCK_REFERENCE};
use crate::entry::{Entry, Kind};
use crate::interface::Interface;
use crate::standard::Standard;
use crate::xml::{causality, variability};
use std::fmt::Write as _;

/// Writes the header: one `#define` per variable, `TESTBED_ENERGY_KINETIC` for `energy.kinetic`, `…_TAU_A_1` for `tau_a[1]` of
/// FMI 2.0, `…_TAU_A` for the array `tau_a` of FMI 3.0, and one enumerator per item of each enumeration.
///
/// # Panics
/// Never: text is written to memory.
pub fn write(interface: &Interface, standard: Standard) -> String {
    let mut text = String::new();
    let guard = format!("{}_VALUE_REFERENCES_H", macro_name(interface.name));
    let _ = writeln!(
        text,
        "/* {}: value references, {} {}. Generated, do not edit. */",
        interface.name,
        standard.token(),
        interface.guid
    );
    let _ = writeln!(text, "#ifndef {guard}\n#define {guard}\n");
    let _ = writeln!(
        text,
        "#define {}_{} \"{}\"\n",
        macro_name(interface.name),
        macro_name(standard.token()),
        interface.guid
    );
    if standard == Standard::Fmi3Scheduled {
        let prefix = macro_name(interface.name);
        let _ = writeln!(
            text,
            "#define {prefix}_CLOCK {CLOCK_REFERENCE}u /* discrete input {CLOCK}: Clock */"
        );
    }
    let variables = variables(interface, standard);
    for (variable, name) in variables
        .iter()
        .zip(macro_names(interface.name, &variables))
    {
        let Named {
            name: variable,
            reference,
            entry,
            length,
        } = variable;
        let (causality, variability) = (causality(entry.causality), variability(entry.variability));
        let kind = kind(entry, standard);
        let length = length.map_or(String::new(), |length| format!("[{length}]"));
        let _ = writeln!(
            text,
            "#define {name} {reference}u /* {variability} {causality} {variable}{length}: {kind} */"
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

/// A variable of the version of the standard.
struct Named<'a> {
    name: String,
    reference: u32,
    /// Itself, or an array's first element.
    entry: &'a Entry,
    /// Of an array.
    length: Option<usize>,
}

fn variables(interface: &Interface, standard: Standard) -> Vec<Named<'_>> {
    if standard.is_fmi3() {
        let arrays = arrays::of(interface).into_iter();
        return arrays
            .map(|array| Named {
                length: array.is_vector().then_some(array.elements.len()),
                name: array.name,
                reference: array.reference,
                entry: &array.elements[0],
            })
            .collect();
    }
    let scalars = interface.scalars.iter();
    scalars
        .map(|entry| Named {
            name: entry.name.clone(),
            reference: entry.reference,
            entry,
            length: None,
        })
        .collect()
}

fn kind(entry: &Entry, standard: Standard) -> String {
    let of_items = if standard.is_fmi3() {
        "Enumeration"
    } else {
        "Integer"
    };
    match &entry.kind {
        Kind::Enumeration { of, .. } => format!("{of_items}, item of {}", of.name),
        Kind::Real { unit, .. } => format!("{}, {}", standard.type_name(&entry.kind), unit.name),
        Kind::Binary { mime_type, .. } => {
            format!("{}, {mime_type}", standard.type_name(&entry.kind))
        }
        other => standard.type_name(other).to_owned(),
    }
}

/// Macro names of all variables, different from each other: where `a[1]` and `a_1` meet, the later gets its value
/// reference appended.
fn macro_names(model: &str, variables: &[Named<'_>]) -> Vec<String> {
    let mut seen = std::collections::BTreeSet::new();
    let prefix = macro_name(model);
    let name = |variable: &Named<'_>| {
        let name = format!("{prefix}_{}", macro_name(&variable.name));
        if seen.insert(name.clone()) {
            name
        } else {
            format!("{name}_VR{}", variable.reference)
        }
    };
    variables.iter().map(name).collect()
}

/// Capitals, with underscores where words meet and in place of everything else: `energy.E_0` → `ENERGY_E_0`,
/// `TestbedController` → `TESTBED_CONTROLLER`.
pub(crate) fn macro_name(name: &str) -> String {
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
