//! Names of the structured naming convention (FMI 2.0.5, section 2.2.9).
//!
//! ```text
//! name         = B-name [ arrayIndices ] { "." B-name [ arrayIndices ] }
//! B-name       = nondigit { digit | nondigit }          nondigit = letter | "_"
//! arrayIndices = "[" unsignedInteger { "," unsignedInteger } "]"
//! ```
//! `der(…)` and quoted names belong to the convention too; no row needs them, and they are refused.

/// Whether `name` is legal, as `energy.H`, `tau_a[1]` and `segment[2].t_on` are.
pub fn is_structured(name: &str) -> bool {
    name.split('.').all(|part| {
        let (base, indices) = match part.split_once('[') {
            None => (part, None),
            Some((base, rest)) => (base, Some(rest)),
        };
        is_identifier(base)
            && indices.is_none_or(|rest| rest.strip_suffix(']').is_some_and(are_indices))
    })
}

/// Whether `name` is a C identifier in ASCII, as a model identifier must be.
pub fn is_identifier(name: &str) -> bool {
    let nondigit = |c: char| c.is_ascii_alphabetic() || c == '_';
    name.starts_with(nondigit) && name.chars().all(|c| nondigit(c) || c.is_ascii_digit())
}

/// Most letters of a model's name: a file system has 255 for a library's file, and importers put something before or behind it.
pub const LONGEST_MODEL_NAME: usize = 200;

/// Words of C11 that are no identifiers.
const KEYWORDS: &str = "auto break case char const continue default do double else enum extern float for goto if inline int \
    long register restrict return short signed sizeof static struct switch typedef union unsigned void \
    volatile while _Alignas _Alignof _Atomic _Bool _Complex _Generic _Imaginary _Noreturn _Static_assert \
    _Thread_local";

/// Whether `name` can be a model's: a C identifier, and so the name of a library's file on every system. Windows has no
/// file with the name of a device, whatever its extension.
pub fn is_model_name(name: &str) -> bool {
    let capitals = name.to_ascii_uppercase();
    let numbered = ["COM", "LPT"].iter().any(|device| {
        let number = capitals.strip_prefix(device);
        number.is_some_and(|number| number.len() == 1 && number.as_bytes()[0].is_ascii_digit())
    });
    is_identifier(name)
        && name.len() <= LONGEST_MODEL_NAME
        && KEYWORDS.split(' ').all(|word| word != name)
        && !["CON", "PRN", "AUX", "NUL"].contains(&capitals.as_str())
        && !numbered
}

/// Whether XML can carry `text` and gives it back as it was: no control characters, line ends included, and none of the
/// two letters that are none.
pub fn is_line(text: &str) -> bool {
    !text
        .chars()
        .any(|c| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}'))
}

fn are_indices(list: &str) -> bool {
    list.split(',')
        .all(|index| !index.is_empty() && index.chars().all(|c| c.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_names_of_the_specification_are_structured() {
        for name in [
            "q",
            "energy.H",
            "tau_a[1]",
            "segment[16].t_on",
            "K_P",
            "energy.E_0",
            "inertia[1,3]",
            "_x",
        ] {
            assert!(is_structured(name), "{name}");
        }
    }

    #[test]
    fn a_model_is_named_as_c_and_every_file_system_can() {
        let longest = "A".repeat(LONGEST_MODEL_NAME);
        for name in ["Tank", "_x1", "Int", "COM10", "Console", &longest] {
            assert!(is_model_name(name), "{name}");
        }
        let longer = format!("{longest}A");
        for name in [
            "", "1st", "Fläche", "my model", "../x", "int", "_Bool", "CON", "nul", "Com1", "LPT9",
            &longer,
        ] {
            assert!(!is_model_name(name), "{name}");
        }
    }

    #[test]
    fn what_xml_cannot_carry_is_no_line() {
        for text in ["", "größer als 1 µm", "\u{10ffff}"] {
            assert!(is_line(text), "{text:?}");
        }
        for text in [
            "a\0", "\u{7}", "a\nb", "\t", "\u{7f}", "\u{fffe}", "\u{ffff}",
        ] {
            assert!(!is_line(text), "{text:?}");
        }
    }

    #[test]
    fn other_names_are_refused() {
        for name in [
            "", "1q", "energy.", ".H", "tau a", "tau[", "tau[]", "tau[i]", "tau[1", "tau[1]x", "τ",
            "a..b", "a-b",
        ] {
            assert!(!is_structured(name), "{name}");
        }
    }
}
