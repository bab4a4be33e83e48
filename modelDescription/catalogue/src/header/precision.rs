//! Two headers from what cbindgen writes of both precisions: the names of double precision are the plain ones, those of
//! single precision have `exo_f32_` in place of `exo_`. So the libraries share no symbol and the headers no type, and a
//! program may use both; a program that defines EXO_LAW_F32 writes the plain names and gets single precision.

use std::collections::BTreeSet;

/// How a name of single precision begins.
const SINGLE: &str = "exo_f32_";

/// A struct without a number of the law: the same in both.
const SHARED: &str = "exo_variable";

/// What cbindgen puts around what one precision has.
const DOUBLE_ONLY: &str = "#if !defined(EXO_LAW_F32)\n";
const SINGLE_ONLY: &str = "#if defined(EXO_LAW_F32)\n";
const END_OF_IT: &str = "#endif\n\n";

/// `exo_law.h` and `exo_law_f32.h`, from cbindgen's header with units and constants.
///
/// # Errors
/// When cbindgen's header is not built as expected.
pub fn split(both: &str) -> Result<(String, String), String> {
    let (before, double, rest) = block(both, DOUBLE_ONLY)?;
    let (between, single, after) = block(rest, SINGLE_ONLY)?;
    let names = names(&format!("{double}{after}"));
    let close = "#endif  /* EXO_LAW_H */\n";
    let declarations = after
        .strip_suffix(close)
        .ok_or_else(|| format!("cbindgen's header does not end with {close}"))?;
    let double_header = format!(
        "{before}{double}\n{between}{declarations}{}{close}",
        plain_names(&names)
    );
    let single_header = format!(
        "{TITLE}{}{}#endif  /* EXO_LAW_F32_H */\n",
        renamed(single, &names),
        renamed(&without(declarations, SHARED)?, &names)
    );
    Ok((double_header, single_header))
}

const TITLE: &str = "\
/*
 * The admittance laws as a C library in single precision: what exo_law.h declares, with names that begin with exo_f32_.
 *
 * A program that uses no other precision defines EXO_LAW_F32, includes exo_law.h and writes the names of that header.
 */

#ifndef EXO_LAW_F32_H
#define EXO_LAW_F32_H

/* Generated from fmu/c/src by `cargo xtask law --bless`: do not edit. */

#include \"exo_law.h\"

";

/// What stands before, in and after the block that begins with `begin`.
fn block<'a>(text: &'a str, begin: &str) -> Result<(&'a str, &'a str, &'a str), String> {
    let expected = || format!("cbindgen's header has no block {begin}");
    let (before, rest) = text.split_once(begin).ok_or_else(expected)?;
    let (inside, after) = rest.split_once(END_OF_IT).ok_or_else(expected)?;
    Ok((before, inside, after))
}

/// The names that each precision has for itself: the number, the structs, the functions.
fn names(declarations: &str) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for line in declarations.lines() {
        let declared = line
            .strip_prefix("typedef struct ")
            .and_then(|rest| rest.split(' ').next())
            .or_else(|| {
                let rest = line.strip_prefix("typedef ")?.strip_suffix(';')?;
                rest.split(' ').next_back()
            })
            .or_else(|| {
                let (head, _) = line.split_once('(').filter(|_| !line.starts_with("//"))?;
                head.split([' ', '*']).next_back()
            });
        names.extend(
            declared
                .filter(|name| name.starts_with("exo_") && *name != SHARED)
                .map(str::to_owned),
        );
    }
    names
}

/// The plain names as macros for those of single precision, for programs that define EXO_LAW_F32.
fn plain_names(names: &BTreeSet<String>) -> String {
    let mut text = String::from(
        "#ifdef EXO_LAW_F32\n// The plain names stand for those of single precision.\n#include \"exo_law_f32.h\"\n",
    );
    for name in names {
        text += &format!("#define {name} {}\n", single(name));
    }
    text + "#endif\n\n"
}

fn single(name: &str) -> String {
    name.replacen("exo_", SINGLE, 1)
}

/// The text with the names of single precision, whole words only.
fn renamed(text: &str, names: &BTreeSet<String>) -> String {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut out = String::new();
    let mut rest = text;
    while let Some(begin) = rest.find(is_part) {
        let word = &rest[begin..];
        let word = &word[..word.find(|c| !is_part(c)).unwrap_or(word.len())];
        out += &rest[..begin];
        out += &if names.contains(word) {
            single(word)
        } else {
            word.to_owned()
        };
        rest = &rest[begin + word.len()..];
    }
    out + rest
}

/// The text without the struct `name` and its comment.
fn without(text: &str, name: &str) -> Result<String, String> {
    let expected = || format!("cbindgen's header has no struct {name}");
    let begin = text
        .find(&format!("typedef struct {name} {{"))
        .ok_or_else(expected)?;
    let end = format!("}} {name};\n\n");
    let after = text.split_once(&end).ok_or_else(expected)?.1;
    let before = text[..begin].rfind("\n\n").map_or(0, |at| at + 2);
    Ok(text[..before].to_owned() + after)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_renamed_whole() {
        let names = BTreeSet::from(["exo_arm_state".to_owned()]);
        assert_eq!(
            renamed(
                "struct exo_arm_state *a; exo_arm_state_of exo_status",
                &names
            ),
            "struct exo_f32_arm_state *a; exo_arm_state_of exo_status"
        );
    }
}
